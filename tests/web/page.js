// The playground in a headless browser: what it draws, what it does with fingers, keys and files, and that it fits.
//   node tests/web/page.js PAGE.html FOLDER_FOR_PICTURES FOLDER
'use strict';
const fs = require('fs');
const path = require('path');
const {Browser} = require('./browser.js');
const {check, report, crc32, rgb565, malformedFiles} = require('./check.js');

const [page, pictures, folder] = process.argv.slice(2).map((name) => path.resolve(name));
const DESKTOP = [1280, 800], TABLET = [820, 1180], PHONE = [390, 844], IDLE = 'state.scene && drawing === false && stale === false';
const golden = new Map();
for (const line of fs.readFileSync('tests/golden.txt', 'utf8').split('\n')) {
  const found = /^(\w+) frame (\d+) balanced: RGB565 (\w+) RGB888 \w+$/.exec(line);
  if (found && !golden.has(found[1])) golden.set(found[1], {frame: Number(found[2]), crc: found[3]});
}

const browser = new Browser(`${folder}/browser`);
const idle = () => browser.until(IDLE, 120);
const run = async (expression) => {
  const value = await browser.value(expression);
  await new Promise((done) => setTimeout(done, 50));
  await idle();
  return value;
};
const pixels = async (canvas = 'picture') => {
  const text = await browser.value(`(() => { const c = $('${canvas}'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data; let s = ''; for (let i = 0; i < d.length; i += 8192) s += String.fromCharCode(...d.subarray(i, i + 8192)); return btoa(s); })()`);
  return Buffer.from(text, 'base64');
};
const crc = async () => crc32(rgb565(await pixels()));
const box = (selector) => browser.value(`(() => { const b = document.querySelector('${selector}').getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2]; })()`);
const choose = (title) => run(`[...document.querySelectorAll('.scene')].find((b) => b.textContent === '${title}').click()`);
const text = (id) => browser.value(`$('${id}').textContent`);

async function open(names) {
  const {root} = await browser.send('DOM.getDocument');
  const {nodeId} = await browser.send('DOM.querySelector', {nodeId: root.nodeId, selector: '#files'});
  const scenes = await browser.value(`$('scenes').children.length`);
  await browser.send('DOM.setFileInputFiles', {nodeId, files: names.map((name) => path.resolve(name))});
  await browser.until(`$('scenes').children.length > ${scenes} && state.scene.title === '${path.basename(names[0])}'`, 20);
  await idle();
}

async function checkScenes() {
  for (const [name, title] of await browser.value('OWN')) {
    await choose(title);
    if (golden.has(name)) {
      const {frame, crc: wanted} = golden.get(name);
      await run(`state.frame = ${frame}; draw()`);
      check((await crc()) === wanted, `${name}: another picture than the library's, ${await crc()}`);
    } else check(await browser.value('info.triangles > 0'), `${name} is not drawn`);
    check((await browser.value(`$('error').hidden`)) && (await text('facts')).includes('triangle'), `${name}: ${await text('error')}`);
  }
}

async function checkTurns() {
  await choose('Mill');
  const still = await crc(), [x, y] = await box('#picture');
  const changes = async (what, act) => {
    await act();
    await idle();
    check((await crc()) !== still, `${what} changes nothing`);
    await browser.value(`$('picture').focus()`);
    await browser.key('Home');
    await idle();
    check((await crc()) === still, `after ${what} Home is another picture`);
  };
  await run('turn(40, 0)');
  check((await text('command')).includes('--turn 40,0,1.00'), `the command line of what is turned: ${await text('command')}`);
  await run('front()');
  await changes('the mouse', async () => {
    await browser.mouse('mousePressed', x, y);
    for (const step of [10, 30, 60]) await browser.mouse('mouseMoved', x + step, y + step / 2);
    await browser.mouse('mouseReleased', x + 60, y + 30);
  });
  await changes('the wheel', () => browser.mouse('mouseWheel', x, y, {deltaX: 0, deltaY: -200, button: 'none', buttons: 0}));
  for (const key of ['ArrowLeft', 'ArrowUp', '+', '-']) await changes(`the key ${key}`, async () => {
    await browser.value(`$('picture').focus()`);
    await browser.key(key);
  });
  await browser.send('Emulation.setTouchEmulationEnabled', {enabled: true});
  await changes('a finger', async () => {
    await browser.touch('touchStart', [[x, y]]);
    for (const step of [10, 30, 50]) await browser.touch('touchMove', [[x + step, y]]);
    await browser.touch('touchEnd', []);
  });
  await changes('two fingers', async () => {
    await browser.touch('touchStart', [[x - 20, y], [x + 20, y]]);
    for (const step of [30, 50, 70]) await browser.touch('touchMove', [[x - step, y], [x + step, y]]);
    await browser.touch('touchEnd', []);
  });
  await browser.send('Emulation.setTouchEmulationEnabled', {enabled: false});
  for (const [id, value] of [['time', 40], ['sun', 8]]) {
    const before = await crc();
    await run(`$('${id}').value = ${value}; $('${id}').dispatchEvent(new Event('input'))`);
    check((await crc()) !== before, `${id} changes nothing`);
  }
}

async function checkKnobs() {
  await choose('Sundial');
  await browser.until(`document.querySelectorAll('.steps .waits:not([hidden])').length === 0 && $('fits').textContent`, 120);
  const still = await crc(), ram = await text('ram'), fps = Number(await text('fps'));
  check((await text('fits')) === 'fits' && /^\d+ KB of 256 KB$/.test(ram) && fps > 0.2 && fps < 60, `the board: ${ram}, ${fps} frames per second`);
  const priced = await browser.value(`[...document.querySelectorAll('.steps button:not([hidden]) span')].filter((s) => s.offsetParent && /KB|fps|nothing|B RAM|cannot/.test(s.textContent)).length`);
  check(priced > 20, `${priced} steps have a price`);
  await run(`$('row-atlas_size').querySelector('.more').click()`);
  await browser.until(`$('ram').textContent !== '${ram}'`, 60);
  check((await crc()) !== still && (await browser.value(`info.knobs.atlas_size`)) === 256, 'a larger atlas is the same picture');
  check((await text('command')).includes('--set atlas_size=256'), `the command line: ${await text('command')}`);
  await run(`$('row-intensity').querySelector('.less').click()`);
  check((await text('command')).includes('--set intensity=0.5'), `lights of half the intensity: ${await text('command')}`);
  await run(`$('row-intensity').querySelector('.undo').click()`);
  await run(`$('row-atlas_size').querySelector('.undo').click()`);
  check((await crc()) === still, 'undo is another picture');
  await run(`$('knob-filter').focus(); $('knob-filter').value = 0; $('knob-filter').dispatchEvent(new Event('input'))`);
  check((await browser.value(`info.filter`)) === 0 && (await browser.value(`$('knob-filter').getAttribute('aria-valuetext')`)) === 'hard', 'the filter is not hard');
  for (const preset of ['tiny', 'accurate']) {
    await run(`$('preset-${preset}').click()`);
    check((await crc()) !== still, `${preset} is the same picture`);
  }
  await run(`$('reset').click()`);
  await run(`$('knob-size').value = '160x120'; $('knob-size').dispatchEvent(new Event('input'))`);
  // 320x240 is too large for it: what is said of that goes when 160x120 is priced
  await browser.until(`!$('row-compact').querySelector('.waits:not([hidden])') && $('row-compact').querySelector('.more span').textContent !== 'cannot be'`, 60);
  const [general, rom] = [await crc(), await text('rom')], gain = await browser.value(`$('row-compact').querySelector('.more span').textContent`);
  await run(`$('row-compact').querySelector('.more').click()`);
  await browser.until(`$('rom').textContent !== '${rom}'`, 60);
  check((await crc()) !== general && (await browser.value('info.knobs.compact')) === 1, 'compact arithmetic is the same picture');
  check(/\u2212\d+ KB flash/.test(gain) && parseFloat(await text('rom')) < parseFloat(rom), `compact arithmetic: ${gain}; ${rom}, ${await text('rom')}`);
  await run(`$('reset').click()`);
  check((await crc()) === still, 'Reset is another picture');
  await run(`$('board').value = 'microbit'; $('board').dispatchEvent(new Event('change'))`);
  await browser.until(`$('fits').textContent === 'does not fit'`, 60);
  check((await text('fits')) === 'does not fit' && !(await browser.value(`$('nearest').hidden`)), `on 16 KB: ${await text('fits')}`);
  await run(`$('board').value = 'pico'; $('board').dispatchEvent(new Event('change'))`);
}

async function checkComparison() {
  await choose('Desk');
  await run(`document.querySelector('[value=four]').click()`);
  check(await browser.until('fits(others.fixed, others.reference) && fits(others.fixed, others.truth)', 60), 'no pictures side by side');
  const shares = (await browser.value(`[...document.querySelectorAll('#four figcaption span')].map((s) => s.textContent)`)).join(' ');
  const [reference, truth] = (shares.match(/[\d.]+(?= %)/g) || []).map(Number);
  check(reference > 80 && truth < reference, `side by side: ${shares}`);
  await browser.screenshot(`${pictures}/four.png`);
  await run(`document.querySelector('[value=split]').click()`);
  check(await browser.until(`$('other').style.visibility === '' && $('right-tag').textContent === 'ray tracer'`, 60), 'no ray tracer under the slider');
  await run(`$('split').value = 250; $('split').dispatchEvent(new Event('input'))`);
  check((await browser.value(`getComputedStyle($('other')).clipPath`)).includes('25%'), 'the slider moves nothing');
  await browser.screenshot(`${pictures}/slider.png`);
  await run(`document.querySelector('[value=one]').click()`);
}

async function checkFiles() {
  fs.mkdirSync(`${folder}/files`, {recursive: true});
  const put = (name, bytes) => fs.writeFileSync(`${folder}/files/${name}`, bytes);
  put('own.obj', 'mtllib own.mtl\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 2 0\nusemtl red\nf 1 5 2\nf 2 5 3\nf 3 5 4\nf 4 5 1\n');
  put('own.mtl', 'newmtl red\nKd 0.8 0.1 0.1\n');
  await open([`${folder}/files/own.obj`, `${folder}/files/own.mtl`]);
  const [red, green] = [...(await pixels())].reduce((sum, v, i) => (sum[i % 4] += v, sum), [0, 0, 0, 0]);
  check(await browser.value(`info.triangles >= 4 && info.added.camera === 1`), `own.obj: ${await text('error')}`);
  check((await text('notes')).includes('no ground, no camera, no light') && red > green, `own.obj: ${await text('notes')}`);
  const still = await crc();
  await run('turn(40, 0)');
  check((await crc()) !== still && (await text('command')).includes('--orbit 70,25,1.00'), `turned: ${await text('command')}`);
  await browser.screenshot(`${pictures}/own.png`);
  await open([`${folder}/files/own.obj`]);
  check((await text('notes')).includes('own.mtl'), `without its materials: ${await text('notes')}`);
  for (const [name, bytes, word] of malformedFiles(fs)) {
    put(name, bytes);
    await open([`${folder}/files/${name}`]);
    check(!(await browser.value(`$('error').hidden`)) && (await text('error')).length > 5 && (await text('error')).includes(word.replace(/\.gltf:$/, '')), `${name}: ${await text('error')}`);
  }
  await browser.screenshot(`${pictures}/error.png`);
  await choose('Cube');
  check((await browser.value(`$('error').hidden && info.triangles > 0`)), 'no picture after malformed files');
}

// As the document shows it.
async function showPage() {
  await choose('Mill');
  await run(`document.querySelector('[value=split]').click()`);
  await browser.until(`$('other').style.visibility === '' && $('right-tag').textContent === 'ray tracer' && !queue.busy`, 120);
  await browser.screenshot(`${pictures}/playground.png`);
  await run(`document.querySelector('[value=one]').click()`);
}

// What the page gives away, into the folder: the shell test compiles it.
async function checkDownloads() {
  await choose('Cube');
  await browser.value(`window.saved = new Map(); save = async (name, blob) => { const b = new Uint8Array(await blob.arrayBuffer()); let s = ''; for (let i = 0; i < b.length; i += 8192) s += String.fromCharCode(...b.subarray(i, i + 8192)); saved.set(name, btoa(s)); }; 1`);
  for (const id of ['take-png', 'take-c', 'take-sketch']) {
    await browser.value(`$('${id}').click()`);
    await new Promise((done) => setTimeout(done, 100));
    await browser.until(`$('taking').textContent !== 'Working\\u2026' && queue.busy === false`, 120);
    await new Promise((done) => setTimeout(done, 300));
  }
  await choose('Mill');
  await browser.value(`$('take-c').click(); setTimeout(() => $('stop').click(), 300)`);
  check(await browser.until(`$('stop').hidden && $('taking').textContent === 'stopped'`, 30), `stopped: ${await text('taking')}`);
  const saved = await browser.value('[...saved]');
  check(saved.map(([name]) => name).join(' ') === 'cube.png cube.zip cube-sketch.zip', `saved: ${saved.map(([name]) => name)}; ${await text('taking')}`);
  for (const [name, data] of saved) fs.writeFileSync(`${folder}/${name}`, Buffer.from(data, 'base64'));
}

// Nothing is cut off or without a name, and what fingers press is large enough.
async function checkLayout(what, [width, height], phone) {
  await browser.resize(width, height, phone);
  await new Promise((done) => setTimeout(done, 400));
  const wide = await browser.value(`[...document.querySelectorAll('main *, header *')].filter((e) => e.offsetParent && !e.closest('#scenes') && !e.closest('.unseen') && e.getBoundingClientRect().right > innerWidth + 1).map((e) => e.tagName + e.id).join(' ')`);
  const [picture, stage] = await browser.value(`['picture', 'stage'].map((id) => $(id).getBoundingClientRect().width)`);
  check(picture >= 0.98 * stage, `${what}: the picture takes ${picture} of ${stage} pixels`);
  check((await browser.value('document.documentElement.scrollWidth <= innerWidth')) && wide === '', `${what}: wider than the window: ${wide}`);
  const small = await browser.value(`[...document.querySelectorAll('button, select, .segments label, .presets label')].filter((e) => e.offsetParent && e.getBoundingClientRect().height < 24).map((e) => e.className + e.id).join(' ')`);
  check(small === '', `${what}: too small to press: ${small}`);
  const {nodes} = await browser.send('Accessibility.getFullAXTree');
  const roles = new Set(['button', 'slider', 'combobox', 'radio', 'spinbutton', 'meter', 'image', 'link', 'textbox']);
  const unnamed = nodes.filter((node) => !node.ignored && roles.has((node.role || {}).value) && !(node.name || {}).value);
  check(unnamed.length === 0 && nodes.length > 100, `${what}: without a name: ${unnamed.map((node) => node.role.value)}`);
  await browser.screenshot(`${pictures}/${what}.png`);
}

async function frameRate() {
  await choose('Sundial');
  await browser.value(`setSpinning(true)`);
  await new Promise((done) => setTimeout(done, 3000));
  const rate = await text('here');
  await run('setSpinning(false)');
  console.log(`Frames per second in the browser, the sundial at 320x240: ${rate}`);
  check(Number(rate) > 0, 'no frame rate');
}

async function main() {
  fs.mkdirSync(pictures, {recursive: true});
  await browser.open(`file://${page}`, ...DESKTOP);
  if (!check(await browser.until(`${IDLE} && info`, 120), 'the page does not draw')) return;
  await checkLayout('desktop', DESKTOP, false);
  await showPage();
  await checkScenes();
  await checkTurns();
  await checkKnobs();
  await checkComparison();
  await checkFiles();
  await checkDownloads();
  await frameRate();
  await browser.dark(true);
  await choose('Mill');
  await checkLayout('dark', DESKTOP, false);
  await browser.dark(false);
  await checkLayout('tablet', TABLET, true);
  await checkLayout('phone', PHONE, true);
  check(browser.errors.length === 0, `errors in the page: ${browser.errors.join('; ')}`);
}

main().catch((error) => check(false, error.stack)).finally(() => browser.close().then(report));
