// The knobs that the page shows: by their names in --set, with the values that a step goes through. What they mean is
// asked of the tool.
'use strict';

const FILTERS = ['hard', '2x2', '3x3', '5x5', '7x7', 'disk'];
const OUTPUTS = ['rgb565', 'rgb888', 'rgb565_swapped', 'grey8', 'grey4', 'mono1']; // as gn_format counts them
const POWERS = (from, to) => Array.from({length: Math.log2(to / from) + 1}, (_, i) => String(from << i));

// words: shown in the place of values. usual: where it stands unset, if no picture tells; else the first. select: a list, not a slider. only: what the scene must have.
const KNOB_GROUPS = [
  ['Picture', [
    {key: 'size', title: 'Resolution', select: true, values: ['96x64', '128x64', '128x128', '160x120', '240x240', '320x240', '480x320', '640x480']},
    {key: 'output', title: 'Pixels', select: true, values: OUTPUTS, words: ['RGB565', 'RGB888', 'RGB565, swapped', 'grey, 8 bits', 'grey, 4 bits', 'black and white']},
    {key: 'persp_step', title: 'Shading, coarse to exact', values: ['16', '8', '4', '1']},
    {key: 'tile_width', title: 'Screen tile, width', values: POWERS(8, 256)},
    {key: 'tile_height', title: 'Screen tile, height', values: POWERS(1, 64)},
    {key: 'subpixel_bits', title: 'Subpixel bits', values: ['2', '3', '4', '5', '6', '7', '8']},
    {key: 'compact', title: 'Arithmetic', values: ['0', '1'], words: ['general', 'compact']},
    {key: 'srgb', title: 'sRGB curve', values: ['0', '1'], words: ['off', 'on']},
  ]],
  ['The file', [
    {key: 'up', title: 'Axis that points up', values: ['y', 'z']},
    {key: 'intensity', title: 'Intensity of lights', values: ['0.01', '0.02', '0.05', '0.1', '0.2', '0.5', '1', '2', '5', '10'], usual: '1'},
  ]],
  ['Shadows', [
    {key: 'filter', title: 'Filter', values: FILTERS},
    {key: 'atlas_size', title: 'Atlas', values: POWERS(16, 1024), only: 'directional'},
    {key: 'depth_bits', title: 'Bits per texel', values: ['8', '16', '32'], only: 'directional'},
    {key: 'cascades', title: 'Cascades', values: ['1', '2', '3', '4'], only: 'directional'},
    {key: 'cascade_blend', title: 'From cascade to cascade', select: true, values: ['hard', 'dither', 'soft'], only: 'directional'},
    {key: 'other_atlas_size', title: 'Atlas of spot and point lights', values: POWERS(16, 1024), only: 'punctual'},
    {key: 'other_depth_bits', title: 'Bits per texel of it', values: ['8', '16', '32'], only: 'punctual'},
  ]],
];
const KNOBS = KNOB_GROUPS.flatMap(([, knobs]) => knobs);
const PRESETS = ['', 'tiny', 'fast', 'balanced', 'accurate'];
const PRESET_WORDS = ['as set', 'tiny', 'fast', 'balanced', 'accurate'];

// What a knob stands at where nobody set it: of the last picture's facts.
function knobDefault(knob, info) {
  if (!info) return knob.usual || knob.values[0];
  if (knob.key === 'filter') return FILTERS[info.filter];
  if (knob.key === 'cascades') return String(info.cascades);
  return knob.key in info.knobs ? String(info.knobs[knob.key]) : knob.usual || knob.values[0];
}

// Meanings by key, out of the tables that `gnomon knobs` prints.
function knobMeanings(tables) {
  const meanings = new Map();
  for (const line of tables.split('\n')) {
    const cells = line.split('|').map((cell) => cell.trim());
    if (!/^`\w+`$/.test(cells[1] || '')) continue;
    const key = cells[1].slice(1, -1), words = cells.length === 5 ? [cells[3]] : cells.slice(2).filter((cell) => / /.test(cell) && !/^\d/.test(cell));
    if (words.length) meanings.set(key, words[0]);
  }
  return meanings;
}

// The clock and the speed of cores, as part_table.h lists them: lines NAME("text", 1.5, ...).
function readBoards(text, files) {
  const lines = [...text.matchAll(/^([A-Z]+)(\(".*\))$/gm)].map(([, kind, values]) => [kind, ...JSON.parse(`[${values.slice(1, -1)}]`)]);
  const clocks = new Map(lines.filter(([kind]) => kind === 'BOARD').map(([, name, mhz]) => [name, mhz]));
  const without = new Set(lines.filter(([kind]) => kind === 'WITHOUT').map(([, name]) => name));
  const cores = lines.filter(([kind]) => kind === 'CORE').map(([, has, , ratio, cycles]) => ({has, ratio, cycles}));
  const boards = [];
  for (const [path, bytes] of files) {
    const name = (/^boards\/([^/]*)\/board\.mk$/.exec(path) || [])[1];
    if (!name || without.has(name)) continue;
    const settings = new TextDecoder().decode(bytes), cpu = (/^BOARD_CPU *:= *(.*)$/m.exec(settings) || ['', ''])[1];
    const title = settings.split('\n', 1)[0].replace(/^# */, '').split(/[.:] |\.$/)[0];
    const core = cores.find(({has}) => cpu.includes(has));
    boards.push({name, title, core, mhz: clocks.get(name) || 100, assumed: !clocks.has(name)});
  }
  const order = [...clocks.keys()];
  return boards.sort((a, b) => (order.indexOf(a.name) + 1 || 99) - (order.indexOf(b.name) + 1 || 99));
}

// ---- Numbers for people ---------------------------------------------------------------------------------------------

function bytesText(n) {
  const kilo = n / 1024;
  return Math.abs(n) < 1000 ? `${n} B` : kilo < 1000 ? `${kilo.toFixed(Math.abs(kilo) < 10 ? 1 : 0)} KB` : `${(kilo / 1024).toFixed(1)} MB`;
}

function signed(text) {
  return text[0] === '-' ? `\u2212${text.slice(1)}` : `+${text}`;
}

// What a step from one price to another costs: RAM, flash, frames per second.
function stepText(from, to) {
  const parts = [], speed = from.instructions / to.instructions - 1;
  if (Math.abs(to.ram - from.ram) >= 50) parts.push(`${signed(bytesText(to.ram - from.ram))} RAM`);
  if (Math.abs(to.rom - from.rom) >= 50) parts.push(`${signed(bytesText(to.rom - from.rom))} flash`);
  if (Math.abs(speed) >= 0.005) parts.push(`${signed((100 * speed).toFixed(0))} % fps`);
  return parts.length ? parts.join(', ') : 'costs nothing';
}

if (typeof module !== 'undefined') module.exports = {readBoards};
