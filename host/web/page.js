// The page: what is set, what is drawn of it, and what it costs.
'use strict';

const $ = (id) => document.getElementById(id);
const OWN = [['sundial', 'Sundial', 102], ['mixed', 'Mill', 24], ['desk', 'Desk', 0], ['avenue', 'Avenue', 0], ['room', 'Room', 0], ['fence', 'Fence', 0], ['cube', 'Cube', 0]];
const DEFAULTS = {size: '320x240', output: 'rgb565'};
const ORBIT = {yaw: 30, pitch: 25}; // the tool's own, in degrees
const IDLE_MS = 350, PAUSE_MS = 700, PLAYING_PRICE_MS = 1500, FILE_MAX_BYTES = 256 << 20;
const ERROR_GAIN = 8; // as in gnomon compare

const state = {scene: null, yaw: 0, pitch: 0, zoom: 1, hour: -1, frame: 0, preset: '', sets: {...DEFAULTS}, board: null, mhz: 0, view: 'colour'};
const files = new Map();
let live, slow, queue, boards, meanings;
let info = null; // of the picture that is seen; null: there is none
let facts = null; // of the last picture that there was
let drawing = false, stale = false, playing = false, spinning = false;
const others = {}; // pictures beside it, by engine
const prices = new Map();
const drawnAt = [];

// ---- Words for the tool ----------------------------------------------------------------------------------------------

function sceneHasCamera() {
  return !state.scene.lacksCamera; // known from its first picture on, also when another cannot be drawn
}

function turned() {
  return state.yaw !== 0 || state.pitch !== 0 || state.zoom !== 1;
}

// Scene and settings; over: knobs by key that are to be others.
function words(over = {}) {
  const sets = {...state.sets, ...over}, out = [state.scene.path, '--size', sets.size];
  const preset = 'preset' in over ? over.preset : state.preset;
  if (preset) out.push('--set', `preset=${preset}`);
  for (const [key, value] of Object.entries(sets)) if (key !== 'size' && key !== 'preset') out.push('--set', `${key}=${value}`);
  if (turned() && sceneHasCamera()) out.push('--turn', `${angle(state.yaw)},${Math.round(state.pitch)},${state.zoom.toFixed(2)}`);
  else if (turned()) out.push('--orbit', `${angle(ORBIT.yaw + state.yaw)},${Math.round(ORBIT.pitch + state.pitch)},${state.zoom.toFixed(2)}`);
  if (state.hour >= 0) out.push('--hour', String(state.hour));
  return out;
}

function angle(degrees) {
  return Math.round(((((degrees + 180) % 360) + 360) % 360) - 180);
}

function pictureWords(engine) {
  const out = [...words(), '--frame', String(state.frame)];
  if (engine && engine !== 'fixed') out.push('--engine', engine);
  if (state.view !== 'colour') out.push('--view', state.view);
  return out;
}

function priceRequest(over) {
  const frame = String(state.frame);
  return {run: ['price', ...words(over), '--frames', `${frame}-${frame}`, '--simplify', 'none', '--board', state.board.name]};
}

// ---- Pictures --------------------------------------------------------------------------------------------------------

function mode() {
  return document.querySelector('[name=mode]:checked').value;
}

function show(canvas, picture) {
  if (canvas.width !== picture.width || canvas.height !== picture.height) {
    canvas.width = picture.width;
    canvas.height = picture.height;
  }
  canvas.getContext('2d').putImageData(new ImageData(picture.rgba, picture.width, picture.height), 0, 0);
}

function errorOf(a, b) {
  const rgba = new Uint8ClampedArray(a.rgba.length);
  for (let i = 0; i < rgba.length; i++) rgba[i] = i % 4 === 3 ? 255 : ERROR_GAIN * Math.abs(a.rgba[i] - b.rgba[i]);
  return {width: a.width, height: a.height, rgba};
}

function sameShare(a, b) {
  let same = 0;
  for (let i = 0; i < a.rgba.length; i += 4) same += a.rgba[i] === b.rgba[i] && a.rgba[i + 1] === b.rgba[i + 1] && a.rgba[i + 2] === b.rgba[i + 2];
  return `${((400 * same) / a.rgba.length).toFixed(1)} % of pixels alike`;
}

function fits(a, b) {
  return a && b && a.width === b.width && a.height === b.height;
}

// The pictures beside the library's, as far as they are there.
function showOthers() {
  const against = $('against').value, from = against === 'error' ? 'reference' : against, four = mode() === 'four';
  const {fixed, [from]: other} = others;
  $('frame').hidden = four;
  $('four').hidden = !four;
  $('against-field').hidden = mode() === 'one';
  const split = mode() === 'split', ready = split && fits(fixed, other);
  for (const id of ['split', 'edge', 'other', 'right-tag']) $(id).hidden = !split;
  $('other').style.visibility = ready ? '' : 'hidden';
  $('left-tag').textContent = 'fixed point';
  $('right-tag').textContent = ready ? {reference: 'double precision', truth: 'ray tracer', error: 'error, 8 times'}[against] : 'working\u2026';
  if (ready) show($('other'), against === 'error' ? errorOf(fixed, other) : other);
  if (!four) return;
  const comparing = others[$('against').value === 'truth' ? 'truth' : 'reference'];
  for (const figure of $('four').children) {
    const canvas = figure.querySelector('canvas'), of = canvas.dataset.of, text = figure.querySelector('span');
    const picture = of === 'error' ? fits(fixed, comparing) && errorOf(fixed, comparing) : others[of];
    figure.classList.toggle('waits', !fits(fixed, picture || null));
    if (picture) show(canvas, picture);
    text.textContent = of === 'error' ? `of ${$('against').value === 'truth' ? 'shadow maps, too' : 'fixed point alone'}` : of === 'fixed' || !fits(fixed, picture) ? '' : sameShare(fixed, picture);
  }
}

function say(text) {
  const plain = text.trim().split('\n').filter((line) => line && !/gnomon help/.test(line)).map((line) => line.replace(/^gnomon: /, '').replaceAll(`${state.scene.path}: `, '').replaceAll(state.scene.path, state.scene.title).replace(/\buser\d+\//g, ''));
  return plain;
}

async function draw() {
  if (drawing) {
    stale = true;
    return;
  }
  drawing = true;
  const drawn = state.scene;
  const answer = await live.ask({draw: pictureWords()});
  drawing = false;
  if (drawn === state.scene) take(answer);
  if (stale) {
    stale = false;
    draw();
  } else schedule();
}

// What the library drew, or why not.
function take(answer) {
  $('error').hidden = answer.status === 0;
  $('stage').classList.toggle('failed', answer.status !== 0);
  if (answer.status !== 0) {
    $('error').textContent = say(answer.err).join('\n') || 'It cannot be drawn.';
    info = null;
    if (!others.fixed) $('picture').getContext('2d').clearRect(0, 0, $('picture').width, $('picture').height);
    tellScene([]);
    return;
  }
  const first = !info;
  info = facts = answer.info;
  state.scene.lacksCamera = Boolean(info.added.camera);
  const picture = {width: info.width, height: info.height, rgba: answer.rgba};
  others.fixed = picture;
  show($('picture'), picture);
  $('frame').style.setProperty('--aspect', String(info.width / info.height));
  tellRate(performance.now());
  if (first) tellScene(say(answer.err));
  tellSpeed(info.instructions);
  tellTime();
  tellCommand();
  showOthers();
}

// Of pictures that follow each other.
function tellRate(now) {
  if (now - drawnAt[drawnAt.length - 1] > PAUSE_MS) drawnAt.length = 0;
  drawnAt.push(now);
  if (drawnAt.length > 20) drawnAt.shift();
  if (drawnAt.length > 4) $('here').textContent = ((1000 * (drawnAt.length - 1)) / (now - drawnAt[0])).toFixed(0);
}

// ---- What the file is, and what it lacks -------------------------------------------------------------------------------

function tellScene(remarks) {
  $('title').textContent = state.scene.title;
  $('notes').replaceChildren();
  const lists = [];
  if (info) {
    const n = (count, what) => `${count.toLocaleString('en')} ${what}${count === 1 ? '' : 's'}`;
    $('facts').textContent = [n(info.objects, 'object'), n(info.triangles, 'triangle'), n(info.lights.length, 'light'), info.textures ? n(info.textures, 'texture') : '', info.frames > 1 ? n(info.frames, 'frame') : ''].filter(Boolean).join(' \u00b7 ');
    const added = Object.entries(info.added).filter(([, yes]) => yes).map(([what]) => what);
    if (added.length) lists.push(`The file has no ${added.join(', no ')}: ${added.length > 1 ? 'they were' : 'it was'} added.`);
    lists.push(...info.notes);
  } else $('facts').textContent = 'It cannot be drawn.';
  for (const line of new Set([...lists, ...remarks])) {
    const item = document.createElement('li');
    item.textContent = line;
    $('notes').append(item);
  }
  for (const row of document.querySelectorAll('[data-only]')) row.hidden = info && !hasLight(row.dataset.only);
  $('sun-row').hidden = Boolean(info) && !hasLight('directional');
  tellKnobs();
}

function hasLight(kind) {
  return info.lights.some((light) => (light.kind === 'directional') === (kind === 'directional'));
}

function tellTime() {
  $('time').max = info.frames - 1;
  $('time-row').hidden = info.frames < 2;
  $('time').value = state.frame;
  $('time-now').textContent = info.fps ? `${(state.frame / info.fps).toFixed(1)} s` : '';
  const sunHour = Math.floor(state.hour), minutes = String(Math.round((state.hour % 1) * 60)).padStart(2, '0');
  $('sun-now').textContent = state.hour < 0 ? 'as in the file' : `${sunHour}:${minutes}`;
}

// ---- What it costs ---------------------------------------------------------------------------------------------------

function targetInstructions(instructions) {
  return instructions * state.board.core.ratio;
}

function framesPerSecond(instructions) {
  return (state.mhz * 1e6) / (targetInstructions(instructions) * state.board.core.cycles);
}

function tellSpeed(instructions) {
  const fps = framesPerSecond(instructions);
  $('fps').textContent = fps >= 9.95 ? fps.toFixed(0) : fps >= 0.995 ? fps.toFixed(1) : fps.toFixed(2);
  $('fps-how').textContent = `By the tool's cost model: ${state.mhz} MHz${state.board.assumed ? ' (assumed)' : ''}, ${state.board.core.cycles} cycles per instruction, one core at work, the display not counted.`;
  $('instructions').textContent = (targetInstructions(instructions) / 1e6).toFixed(1);
}

function tellMemory(price) {
  if (!price || price.error) {
    $('fits').textContent = price ? 'cannot be compiled' : '';
    $('fits').className = price ? 'no' : '';
    $('nearest').hidden = true;
    for (const [id, text] of [['ram', price ? price.error : ''], ['rom', '']]) $(id).textContent = text;
    return;
  }
  for (const [id, used, all] of [['ram', price.ram, price.board_ram], ['rom', price.rom, price.board_flash]]) {
    $(id).textContent = `${bytesText(used)} of ${bytesText(all)}`;
    $(`${id}-bar`).value = Math.min(1, used / all);
    $(`${id}-bar`).classList.toggle('over', used > all);
  }
  $('fits').textContent = price.fits ? (price.close ? 'fits, just' : 'fits') : 'does not fit';
  $('fits').className = price.fits ? 'yes' : 'no';
  $('nearest').hidden = Boolean(price.fits);
}

function priceKey(request) {
  return JSON.stringify(request.run);
}

function readPrice(answer) {
  return answer.status === 0 ? JSON.parse(answer.out) : {error: say(answer.err)[0] || 'refused'};
}

// Calls back with the price of a configuration, at once if it is known.
function price(over, done) {
  const request = priceRequest(over), key = priceKey(request), of = state.scene;
  if (prices.has(key)) {
    done(prices.get(key));
    return;
  }
  queue.add(request, (answer) => {
    if (answer.given_up || of !== state.scene) return;
    if (prices.size > 3000) prices.clear();
    prices.set(key, readPrice(answer));
    if (priceKey(priceRequest(over)) === key) done(prices.get(key));
  });
}

let timer = 0, pricedAt = 0;

// After a while without change: prices and pictures of what is seen.
function schedule() {
  clearTimeout(timer);
  const moves = playing || spinning;
  timer = setTimeout(moves ? priceNow : settle, moves ? Math.max(0, pricedAt + PLAYING_PRICE_MS - performance.now()) : IDLE_MS);
}

function priceNow() {
  pricedAt = performance.now();
  if (info && !queue.busy) price({}, tellMemory);
}

function settle() {
  queue.clear();
  if (!info) {
    tellMemory(null);
    return;
  }
  price({}, tellMemory);
  if (mode() !== 'one') compare();
  tellKnobs();
}

function compare() {
  const engines = mode() === 'four' ? ['reference', 'truth'] : [$('against').value === 'error' ? 'reference' : $('against').value];
  for (const engine of engines) {
    const words = pictureWords(engine), wanted = JSON.stringify(words);
    if (others[engine] && others[engine].of === wanted) continue;
    delete others[engine];
    queue.add({draw: words}, (answer) => {
      if (answer.status !== 0 || JSON.stringify(pictureWords(engine)) !== wanted) return;
      others[engine] = {width: answer.info.width, height: answer.info.height, rgba: answer.rgba, of: wanted};
      showOthers();
    });
  }
  showOthers();
}

// ---- Knobs -----------------------------------------------------------------------------------------------------------

function knobValue(knob) {
  return state.sets[knob.key] || knobDefault(knob, facts);
}

function knobIndex(knob) {
  const value = knobValue(knob), exact = knob.values.indexOf(value);
  if (exact >= 0) return exact;
  const above = knob.values.findIndex((other) => Number(other) > Number(value));
  return above < 0 ? knob.values.length - 1 : above;
}

function knobWord(knob, value) {
  const i = knob.values.indexOf(value), word = knob.words && i >= 0 ? knob.words[i] : value;
  return word.replace('x', '\u00d7');
}

function setKnob(knob, value) {
  state.sets[knob.key] = value;
  draw();
  tellKnob(knob);
  tellCommand();
}

function makeKnob(knob) {
  const row = document.createElement('div'), id = `knob-${knob.key}`;
  row.className = 'knob';
  row.id = `row-${knob.key}`;
  if (knob.only) row.dataset.only = knob.only;
  const options = knob.values.map((value) => `<option value="${value}">${knobWord(knob, value)}</option>`).join('');
  row.innerHTML = `<div class="row"><label for="${id}">${knob.title}</label><output for="${id}"></output><button class="undo" hidden>undo</button></div>` +
    (knob.select ? `<select id="${id}">${options}</select>` : `<input id="${id}" type="range" min="0" max="${knob.values.length - 1}" step="1">`) +
    '<div class="steps"><button class="less"></button><button class="more"></button></div>';
  row.querySelector('label').title = meanings.get(knob.key) || '';
  const input = row.querySelector('input, select');
  input.addEventListener('input', () => setKnob(knob, knob.select ? input.value : knob.values[input.value]));
  row.querySelector('.undo').setAttribute('aria-label', `${knob.title}: as before`);
  row.querySelector('.undo').addEventListener('click', () => {
    delete state.sets[knob.key];
    if (DEFAULTS[knob.key]) state.sets[knob.key] = DEFAULTS[knob.key];
    draw();
    tellKnob(knob);
    input.focus();
  });
  for (const [name, step] of [['less', -1], ['more', 1]]) row.querySelector(`.${name}`).addEventListener('click', () => setKnob(knob, knob.values[knobIndex(knob) + step]));
  return row;
}

function tellKnob(knob) {
  const row = $(`row-${knob.key}`), i = knobIndex(knob), input = row.querySelector('input, select'), word = knobWord(knob, knobValue(knob));
  input.value = knob.select ? knob.values[i] : i;
  if (!knob.select) input.setAttribute('aria-valuetext', word);
  row.querySelector('output').textContent = knob.select ? '' : word;
  row.querySelector('.undo').hidden = !(knob.key in state.sets) || state.sets[knob.key] === DEFAULTS[knob.key];
  for (const [name, at] of [['less', i - 1], ['more', i + 1]]) tellStep(row.querySelector(`.${name}`), knob, knob.values[at]);
}

function tellStep(button, knob, value) {
  button.hidden = value === undefined;
  if (button.hidden) return;
  const word = knobWord(knob, value);
  if (button.dataset.word !== word) button.innerHTML = '<b></b><span></span>';
  button.dataset.word = word;
  button.querySelector('b').textContent = word;
  button.title = `${knob.title}: ${word}`;
  button.classList.add('waits');
}

function tellKnobs() {
  for (const knob of KNOBS) tellKnob(knob);
  for (const preset of PRESETS) $(`preset-${preset}`).checked = state.preset === preset;
  $('reset').hidden = !state.preset && Object.entries(state.sets).every(([key, value]) => value === DEFAULTS[key]);
  tellCommand();
  if (!info || playing || spinning) return;
  price({}, (now) => {
    if (now.error) return;
    for (const preset of PRESETS) priceOfPreset(preset);
    for (const knob of KNOBS) priceOfKnob(knob, now);
  });
}

function priceOfKnob(knob, now) {
  const row = $(`row-${knob.key}`), i = knobIndex(knob);
  if (row.hidden) return;
  for (const [name, at] of [['less', i - 1], ['more', i + 1]]) {
    const value = knob.values[at], button = row.querySelector(`.${name}`);
    if (value === undefined) continue;
    price({[knob.key]: value}, (then) => {
      button.classList.remove('waits');
      button.querySelector('span').textContent = then.error ? 'cannot be' : stepText(now, then);
      button.title = then.error || `${knob.title}: ${knobWord(knob, value)}`;
      button.classList.toggle('no', Boolean(then.error) || (now.fits && !then.fits));
      button.classList.toggle('yes', !now.fits && Boolean(then.fits));
      button.disabled = Boolean(then.error);
    });
  }
}

function priceOfPreset(preset) {
  price({preset}, (then) => {
    const text = $(`preset-${preset}`).parentElement.querySelector('span');
    text.textContent = then.error ? '\u2013' : bytesText(then.ram);
    text.className = then.fits ? 'yes' : 'no';
  });
}

function tellCommand() {
  const quote = (word) => (/^[\w=.,:/@+-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);
  const own = state.scene.own ? `host/${state.scene.path}` : state.scene.path.replace(/^user\d+\//, '');
  const [, ...rest] = words();
  const lines = ['gnomon render', quote(own), ...rest, '-o out.png'];
  if (state.frame) lines.push(`--frame ${state.frame}`);
  $('command').textContent = lines.join(' ');
}

// ---- Scenes ----------------------------------------------------------------------------------------------------------

function addScene(scene) {
  const button = document.createElement('button');
  button.className = 'scene';
  button.innerHTML = '<canvas width="96" height="72" aria-hidden="true"></canvas><span></span>';
  button.querySelector('span').textContent = scene.title;
  button.addEventListener('click', () => choose(scene));
  scene.button = button;
  if (scene.own) $('scenes').append(button);
  else $('scenes').prepend(button);
  queue.add({draw: [scene.path, '--size', '96x72', '--frame', String(scene.frame), '--set', 'atlas_size=128'], take: []}, (answer) => {
    if (answer.status === 0) show(button.querySelector('canvas'), {width: 96, height: 72, rgba: answer.rgba});
    else button.classList.add('failed');
  });
}

function choose(scene) {
  for (const other of $('scenes').children) other.setAttribute('aria-pressed', String(other === scene.button));
  Object.assign(state, {scene, yaw: 0, pitch: 0, zoom: 1, hour: -1, frame: scene.frame});
  for (const key of ['up', 'intensity']) delete state.sets[key]; // of another file
  info = null;
  for (const engine of Object.keys(others)) delete others[engine];
  $('sun').value = $('sun').min;
  $('picture').setAttribute('aria-label', `${scene.title}, drawn by the library`);
  setPlaying(false);
  setSpinning(false);
  queue.clear();
  draw();
}

// What was dropped, with paths; folders are gone through.
async function gather(items) {
  const found = [];
  const visit = async (entry, path) => {
    if (entry.isFile) found.push([path + entry.name, await new Promise((done, failed) => entry.file(done, failed))]);
    else {
      const reader = entry.createReader();
      for (;;) {
        const some = await new Promise((done, failed) => reader.readEntries(done, failed));
        if (!some.length) break;
        for (const one of some) await visit(one, `${path}${entry.name}/`);
      }
    }
  };
  for (const entry of [...items].map((item) => item.webkitGetAsEntry && item.webkitGetAsEntry()).filter(Boolean)) await visit(entry, '');
  return found;
}

let n_opened = 0;

// list: [path, File]. Every model among them becomes a scene.
async function openFiles(list) {
  const folder = `user${++n_opened}/`, added = [];
  const models = list.map(([path]) => path).filter((path) => /\.(glb|gltf|obj)$/i.test(path));
  if (!list.length) return;
  if (!models.length) models.push(list[0][0]); // the tool says why not
  for (const [path, file] of list) {
    if (file.size > FILE_MAX_BYTES) continue;
    added.push([folder + path, new Uint8Array(await file.arrayBuffer())]);
  }
  for (const [path, bytes] of added) files.set(path, bytes);
  live.add(added);
  slow.add(added);
  const scenes = models.map((path) => ({path: folder + path, title: path.replace(/.*\//, ''), frame: 0, own: false}));
  for (const scene of [...scenes].reverse()) addScene(scene);
  choose(scenes[0]);
}

// ---- Turning -----------------------------------------------------------------------------------------------------------

function turn(yaw, pitch, zoom = 1) {
  if (!info) return;
  state.yaw = angle(10 * (state.yaw + yaw)) / 10 === 0 ? 0 : state.yaw + yaw;
  state.pitch = Math.max(-80, Math.min(60, state.pitch + pitch));
  state.zoom = Math.max(0.25, Math.min(8, state.zoom * zoom));
  if (Math.abs(state.zoom - 1) < 0.005) state.zoom = 1;
  draw();
}

function front() {
  Object.assign(state, {yaw: 0, pitch: 0, zoom: 1});
  setSpinning(false);
  draw();
}

function listenToTurns(canvas) {
  const fingers = new Map();
  const apart = () => {
    const [a, b] = [...fingers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, {x: event.clientX, y: event.clientY});
  });
  canvas.addEventListener('pointermove', (event) => {
    const last = fingers.get(event.pointerId);
    if (!last) return;
    const was = fingers.size === 2 ? apart() : 0, dx = event.clientX - last.x, dy = event.clientY - last.y;
    fingers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    if (fingers.size === 1) turn(-0.45 * dx, 0.35 * dy);
    else if (fingers.size === 2 && was > 0) turn(0, 0, apart() / was);
  });
  for (const name of ['pointerup', 'pointercancel']) canvas.addEventListener(name, (event) => fingers.delete(event.pointerId));
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    turn(0, 0, Math.exp(-0.0015 * event.deltaY));
  }, {passive: false});
  canvas.addEventListener('keydown', (event) => {
    const step = {ArrowLeft: [-6, 0], ArrowRight: [6, 0], ArrowUp: [0, 5], ArrowDown: [0, -5], '+': [0, 0, 1.15], '=': [0, 0, 1.15], '-': [0, 0, 1 / 1.15]}[event.key];
    if (event.key === 'Home' || event.key === '0') front();
    else if (step) turn(...step);
    else return;
    event.preventDefault();
  });
}

// ---- Motion ------------------------------------------------------------------------------------------------------------

function setPlaying(on) {
  playing = on;
  $('play').setAttribute('aria-pressed', String(on));
  $('play').innerHTML = on ? '&#10074;&#10074;' : '&#9654;';
  $('play').setAttribute('aria-label', on ? 'Pause' : 'Play');
  schedule();
}

function setSpinning(on) {
  spinning = on;
  $('spin').setAttribute('aria-pressed', String(on));
  schedule();
}

let before = 0, ahead = 0;

function animate(now) {
  const seconds = Math.min(0.2, (now - before) / 1000);
  before = now;
  if (info && !drawing && (playing || spinning)) {
    ahead += playing && info.fps ? seconds * info.fps : 0;
    const steps = Math.floor(ahead);
    ahead -= steps;
    if (playing) state.frame = (state.frame + steps) % info.frames;
    if (spinning) state.yaw = state.yaw + 40 * seconds;
    if (spinning || steps) draw();
  }
  requestAnimationFrame(animate);
}

// ---- Downloads ---------------------------------------------------------------------------------------------------------

function save(name, blob) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function baseName() {
  return state.scene.title.replace(/\.\w+$/, '').replace(/[^A-Za-z0-9_]+/g, '_').toLowerCase() || 'scene';
}

// What the tool writes, by path; null, and a message, if it refuses.
function make(run, paths) {
  return new Promise((done) => {
    $('taking').textContent = info && info.frames > 1 && run[0] === 'compile' ? `Working on ${info.frames} frames\u2026` : 'Working\u2026';
    $('stop').hidden = false;
    queue.add({run, take: paths}, (answer) => {
      $('stop').hidden = true;
      $('taking').textContent = answer.status === 0 ? (answer.out.trim() || 'Done.').replace(/^out[^:]*: /, '') : say(answer.err).join(' ');
      done(answer.status === 0 ? new Map(answer.files) : null);
    }, true);
  });
}

async function takePicture() {
  const made = await make(['render', ...pictureWords(), '-o', 'out.png'], ['out.png']);
  if (made) save(`${baseName()}.png`, new Blob([made.get('out.png')], {type: 'image/png'}));
  return made;
}

const COMPILED = ['scene.c', 'scene.h', 'gn_scene_config.h'];

function compiled() {
  return make(['compile', ...words(), '-o', 'out'], [...COMPILED.map((name) => `out/${name}`), 'out/scene.d']);
}

// The files of the sketch: the scene, the library in one file with that configuration, and what shows it.
function sketchFiles(made, name) {
  const text = (path) => new TextDecoder().decode(files.get(path)), encode = (string) => new TextEncoder().encode(string);
  const config = '#define GN_USER_CONFIG "gn_scene_config.h"\n';
  const [width, height] = state.sets.size.split('x');
  const facts = {'@NAME@': state.scene.title, '@WIDTH@': width, '@HEIGHT@': height, '@FRAMES@': info.frames > 1 ? `${info.frames} frames` : 'one frame'};
  const sketch = text('sketch.ino').replace(/@[A-Z]+@/g, (word) => facts[word] || word);
  return [
    [`${name}/${name}.ino`, encode(sketch)],
    ...COMPILED.map((file) => [`${name}/${file}`, made.get(`out/${file}`)]),
    [`${name}/gnomon.h`, encode(config + text('library/gnomon.h'))],
    [`${name}/gnomon.c`, encode(config + text('library/gnomon.c'))],
    [`${name}/LICENSE`, files.get('LICENSE')],
  ];
}

async function takeFiles(sketch) {
  const made = await compiled(), name = baseName();
  if (!made) return null;
  const all = sketch ? sketchFiles(made, name) : COMPILED.map((file) => [`${name}/${file}`, made.get(`out/${file}`)]);
  save(`${name}${sketch ? '-sketch' : ''}.zip`, zipOf(all));
  return all;
}

async function findFit() {
  const text = $('nearest').querySelector('span');
  text.textContent = 'Trying configurations\u2026';
  const frame = String(state.frame), asked = priceKey(priceRequest({}));
  queue.add({run: ['compile', ...words(), '--frames', `${frame}-${frame}`, '--simplify', 'safe', '-o', 'out', '--board', state.board.name], take: COMPILED.map((name) => `out/${name}`)}, (answer) => {
    if (asked !== priceKey(priceRequest({}))) return;
    const found = /nearest that does: ((?:--set \S+ ?)+): (.*)/.exec(answer.err.trim());
    text.textContent = answer.status === 0 ? 'It fits when simplified: compile does that.' : found ? found[2] : say(answer.err).join(' ').replace(/^.*; /, '');
    if (!found) return;
    const button = document.createElement('button');
    button.textContent = `Set ${found[1].replaceAll('--set ', '').trim()}`;
    button.addEventListener('click', () => {
      for (const pair of found[1].replaceAll('--set ', '').trim().split(' ')) {
        const [key, value] = pair.split('=');
        if (key === 'preset') state.preset = value;
        else state.sets[key] = value;
      }
      draw();
      tellKnobs();
    });
    text.prepend(button, ' ');
  }, true);
}

// ---- The beginning -----------------------------------------------------------------------------------------------------

async function unpack() {
  const bytes = Uint8Array.from(atob($('archive').textContent.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return tarFiles(new Uint8Array(await new Response(stream).arrayBuffer()));
}

function makePresets() {
  PRESETS.forEach((preset, i) => {
    const label = document.createElement('label');
    label.innerHTML = `<input type="radio" name="preset" id="preset-${preset}"><b>${PRESET_WORDS[i]}</b><span></span>`;
    label.firstChild.addEventListener('change', () => {
      state.preset = preset;
      state.sets = {...DEFAULTS, size: state.sets.size, output: state.sets.output};
      draw();
    });
    $('presets').append(label);
  });
}

function makeKnobs() {
  for (const [title, knobs] of KNOB_GROUPS) {
    const group = document.createElement('fieldset');
    group.innerHTML = `<legend>${title}</legend>`;
    group.append(...knobs.map(makeKnob));
    $('knobs').append(group);
  }
}

function chooseBoard(name) {
  state.board = boards.find((board) => board.name === name);
  state.mhz = state.board.mhz;
  $('clock').value = state.mhz;
}

function makeBoards() {
  for (const board of boards) {
    const option = document.createElement('option');
    option.value = board.name;
    option.textContent = board.title;
    $('board').append(option);
  }
  chooseBoard(boards[0].name);
  $('board').addEventListener('change', () => {
    chooseBoard($('board').value);
    draw();
  });
  $('clock').addEventListener('input', () => {
    state.mhz = Math.max(1, Number($('clock').value) || 1);
    if (info) tellSpeed(info.instructions);
  });
}

function listenToFiles() {
  $('files').addEventListener('change', () => {
    openFiles([...$('files').files].map((file) => [file.webkitRelativePath || file.name, file]));
    $('files').value = '';
  });
  let over = 0;
  const mark = (n) => $('stage').classList.toggle('drop', (over = Math.max(0, over + n)) > 0);
  addEventListener('dragenter', (event) => (event.preventDefault(), mark(1)));
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('dragleave', () => mark(-1));
  addEventListener('drop', async (event) => {
    event.preventDefault();
    over = 0;
    mark(0);
    const loose = [...event.dataTransfer.files], found = await gather(event.dataTransfer.items);
    openFiles(found.length ? found : loose.map((file) => [file.name, file]));
  });
}

function listen() {
  listenToTurns($('picture'));
  listenToTurns($('turns'));
  listenToFiles();
  $('split').addEventListener('input', () => $('frame').style.setProperty('--at', `${$('split').value / 10}%`));
  for (const input of [...document.querySelectorAll('[name=mode]'), $('against')]) input.addEventListener('change', () => (showOthers(), schedule()));
  $('view').addEventListener('change', () => {
    state.view = $('view').value;
    draw();
  });
  $('time').addEventListener('input', () => {
    setPlaying(false);
    state.frame = Number($('time').value);
    draw();
  });
  $('sun').addEventListener('input', () => {
    const hour = Number($('sun').value);
    state.hour = hour < 6 ? -1 : hour;
    draw();
  });
  $('play').addEventListener('click', () => setPlaying(!playing));
  $('spin').addEventListener('click', () => setSpinning(!spinning));
  $('home').addEventListener('click', front);
  $('reset').addEventListener('click', () => {
    state.preset = '';
    state.sets = {...DEFAULTS};
    draw();
  });
  $('take-png').addEventListener('click', takePicture);
  $('take-c').addEventListener('click', () => takeFiles(false));
  $('take-sketch').addEventListener('click', () => takeFiles(true));
  $('stop').addEventListener('click', () => slow.restart('stopped'));
  $('find').addEventListener('click', findFit);
}

async function begin() {
  for (const [path, bytes] of await unpack()) files.set(path, bytes);
  const source = $('worker').textContent, wasm = files.get('gnomon.wasm');
  files.delete('gnomon.wasm');
  live = new Thread(source, wasm, files);
  slow = new Thread(source, wasm, files);
  queue = new Queue(slow);
  meanings = knobMeanings((await live.ask({run: ['knobs']})).out);
  boards = readBoards(new TextDecoder().decode(files.get('part_table.h')), files);
  makeBoards();
  makePresets();
  makeKnobs();
  listen();
  const scenes = OWN.map(([name, title, frame]) => ({path: `scenes/${name}.gltf`, title, frame, own: true}));
  for (const scene of scenes) addScene(scene);
  choose(scenes[0]);
  requestAnimationFrame(animate);
}

begin().catch((error) => {
  $('error').hidden = false;
  $('error').textContent = `This browser cannot show the page: ${error.message}`;
});
