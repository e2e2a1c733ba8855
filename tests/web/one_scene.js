// The tool as WebAssembly draws one scene, says what it costs and refuses what is wrong, as the native tool does.
//   node tests/web/one_scene.js GNOMON.wasm GNOMON FOLDER
'use strict';
const fs = require('fs');
const path = require('path');
const {execFileSync} = require('child_process');
const {Engine} = require('../../host/web/engine.js');
const {readBoards} = require('../../host/web/knobs.js');
const {check, report} = require('./check.js');

const [wasm, tool, folder] = process.argv.slice(2).map((name) => path.resolve(name));
const native = (...args) => execFileSync(tool, args, {cwd: 'host', encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore']});
const scene = 'scenes/cube.gltf', size = ['--size', '96x64'];
const files = new Map([scene, '../boards/pico/link.ld', '../boards/pico/board.mk'].map((name) => [name.replace('../', ''), fs.readFileSync(`host/${name}`)]));
const engine = new Engine(new WebAssembly.Module(fs.readFileSync(wasm)), files);

for (const how of [[], ['--engine', 'reference'], ['--set', 'preset=tiny'], ['--turn', '40,-10,1.5', '--hour', '9.5']]) {
  native('render', scene, ...size, ...how, '-o', `${folder}/native.png`);
  const said = engine.run(['render', scene, ...size, ...how, '-o', 'out.png']);
  check(said.status === 0 && fs.readFileSync(`${folder}/native.png`).equals(Buffer.from(files.get('out.png') || [])), `render ${how.join(' ')}: another file than the native tool's; ${said.err}`);
}
const drawn = engine.draw([scene, ...size]);
check(drawn.status === 0 && drawn.info.width === 96 && drawn.rgba.length === 4 * 96 * 64, `draw: ${drawn.err}`);
check(engine.run(['info', scene, '--json']).out === native('info', scene, '--json'), 'info says something else');
check(engine.run(['price', scene, ...size, '--board', 'pico', '--frames', '0-0']).out.includes(`"board_ram": ${256 * 1024}`), 'no price');
check(engine.run(['sweep', scene, '--target', 'pico']).err.includes('nothing counts here'), 'sweep --target: something counts');
check(engine.draw(['scenes/none.gltf']).status === 1, 'a file that is not there is no error');

// The page's own parts: boards by their whole names.
const settings = new Map(fs.readdirSync('boards').filter((name) => fs.existsSync(`boards/${name}/link.ld`)).map((name) => [`boards/${name}/board.mk`, fs.readFileSync(`boards/${name}/board.mk`)]));
const titles = new Map(readBoards(fs.readFileSync('host/tool/cost/part_table.h', 'utf8'), settings).map((board) => [board.name, board.title]));
for (const [name, title] of [['microbit', 'BBC micro:bit (nRF51822)'], ['pico', 'Raspberry Pi Pico (RP2040)'], ['stm32f429-discovery', 'STM32F429 Discovery']])
  check(titles.get(name) === title, `${name} is called ${titles.get(name)}`);

report();
