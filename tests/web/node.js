// The tool as WebAssembly, in node: the native tool's pictures, files and numbers, and no end to what it survives.
//   node tests/web/node.js GNOMON.wasm GNOMON FOLDER
'use strict';
const fs = require('fs');
const path = require('path');
const {execFileSync} = require('child_process');
const {Engine} = require('../../host/web/engine.js');
const {check, report, crc32, rgb888, rgb565, malformedFiles} = require('./check.js');

const [wasm, tool, folder] = process.argv.slice(2).map((name) => path.resolve(name));
const native = (...args) => execFileSync(tool, args, {cwd: 'host', encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore']});
const files = new Map();
for (const name of fs.readdirSync('host/scenes')) files.set(`scenes/${name}`, fs.readFileSync(`host/scenes/${name}`));
for (const name of ['link.ld', 'board.mk']) files.set(`boards/pico/${name}`, fs.readFileSync(`boards/pico/${name}`));
const engine = new Engine(new WebAssembly.Module(fs.readFileSync(wasm)), files);

// ---- Pictures ---------------------------------------------------------------------------------------------------------

for (const line of fs.readFileSync('tests/golden.txt', 'utf8').trim().split('\n')) {
  const [, scene, frame, preset, short, long, sets] = /^(\w+) frame (\d+) (\w+): RGB565 (\w+) RGB888 (\w+)(.*)$/.exec(line);
  // the golden pictures are of a preset below the scene's own knobs, and --set is above them: they are set again
  const knobs = /"(\w*(?:atlas_size|depth_bits)|tile_width|tile_height|persp_step)": "?(\w+)"?/g;
  const own = [...String(files.get(`scenes/${scene}.gltf`)).matchAll(knobs)].map(([, key, value]) => `${key}=${value}`);
  const words = [`scenes/${scene}.gltf`, '--frame', frame];
  for (const set of [`preset=${preset}`, ...own, ...sets.trim().split(' ').filter(Boolean)]) words.push('--set', set);
  const drawn = engine.draw(words), panel = engine.draw([...words, '--set', 'output=rgb565']);
  check(drawn.status === 0 && crc32(rgb888(drawn.rgba)) === long, `${line}: RGB888 ${drawn.rgba ? crc32(rgb888(drawn.rgba)) : drawn.err}`);
  check(panel.status === 0 && crc32(rgb565(panel.rgba)) === short, `${line}: RGB565 ${panel.rgba ? crc32(rgb565(panel.rgba)) : panel.err}`);
}

const cube = () => crc32(rgb888(engine.draw(['scenes/cube.gltf']).rgba));
const cubeBefore = cube();

// ---- Files and numbers, to the byte -------------------------------------------------------------------------------------

const COMPACT = ['--size', '160x120', '--set', 'compact=1'];
for (const [name, ...how] of [...fs.readdirSync('host/scenes').map((name) => [name]), ['sundial.gltf', ...COMPACT], ['avenue.gltf', ...COMPACT]]) {
  native('render', `scenes/${name}`, '-o', `${folder}/native.png`, ...how);
  const {status} = engine.run(['render', `scenes/${name}`, '-o', 'out.png', ...how]);
  check(status === 0 && fs.readFileSync(`${folder}/native.png`).equals(files.get('out.png')), `${name} ${how.join(' ')}: another PNG file than the native tool's`);
}
for (const scene of ['scenes/cube.gltf', 'scenes/desk.gltf']) {
  const words = ['compile', scene, '--frames', '0-3', '--set', 'preset=fast', '-o'];
  const said = engine.run([...words, 'out']);
  check(native(...words, `${folder}/native`) === said.out, `compile ${scene} says something else: ${said.out}${said.err}`);
  for (const name of ['scene.c', 'scene.h', 'gn_scene_config.h'])
    check(fs.readFileSync(`${folder}/native/${name}`).equals(Buffer.from(files.get(`out/${name}`))), `compile ${scene}: another ${name}`);
  check(engine.run(['price', scene, '--board', 'pico', '--frames', '0-0']).out.includes(`"board_ram": ${256 * 1024}`), `no price of ${scene}`);
}
check(engine.run(['info', 'scenes/sundial.gltf', '--json']).out === native('info', 'scenes/sundial.gltf', '--json'), 'another info');
check(engine.run(['knobs']).out === native('knobs'), 'other knobs');

// ---- The view ---------------------------------------------------------------------------------------------------------

const drawn = (...how) => crc32(rgb888(engine.draw(['scenes/sundial.gltf', '--size', '96x64', ...how]).rgba));
const home = drawn();
check(home === drawn('--turn', '0,0,1'), 'a turn of nothing changes the picture');
for (const how of [['--turn', '30,0,1'], ['--turn', '0,10,1'], ['--turn', '0,0,1.5'], ['--hour', '9']]) check(drawn(...how) !== home, `${how} changes nothing`);
check(drawn('--turn', '360,0,1') === home, 'once around is another picture');
check(drawn('--turn', '0,70,1') === drawn('--turn', '0,90,1'), 'the camera goes over the top');
check(drawn() === home, 'a turn stays');

// ---- What is wrong ------------------------------------------------------------------------------------------------------

for (const [name, bytes, word] of malformedFiles(fs)) {
  files.set(name, bytes);
  const {status, err} = engine.draw([name]);
  check(status !== 0 && err.includes('gnomon: ') && err.includes(word), `${name}: status ${status}, ${err}`);
}
check(engine.draw(['scenes/none.gltf']).status === 1, 'a file that is not there is no error');
check(engine.draw(['scenes/cube.gltf', '--set', 'atlas_size=3']).status === 1, 'a bad setting is no error');
check(engine.draw(['scenes/cube.gltf', '--nonsense']).status === 2, 'a bad option is no error');
check(engine.run(['sweep', 'scenes/cube.gltf', '--target', 'pico']).err.includes('nothing counts here'), 'something counts');
check(cube() === cubeBefore, 'another picture after errors');
engine.exports = {...engine.exports, web_run: () => { throw new WebAssembly.RuntimeError('unreachable'); }};
const broken = engine.draw(['scenes/cube.gltf']);
check(broken.status === -1 && broken.err.includes('unreachable'), `a trap is no error: ${JSON.stringify(broken)}`);
check(cube() === cubeBefore, 'no picture after a trap');

report();
