// Counts what passed, as tests/support/check.sh does.
'use strict';

const counts = {passed: 0, failed: 0};

function check(ok, what) {
  if (ok) counts.passed++;
  else {
    counts.failed++;
    console.log(`FAILED: ${what}`);
  }
  return Boolean(ok);
}

function report() {
  console.log(`${counts.passed} passed, ${counts.failed} failed`);
  process.exitCode = counts.failed ? 1 : 0;
}

function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return (~crc >>> 0).toString(16).padStart(8, '0');
}

// Of a picture's four bytes per pixel.
function rgb888(rgba) {
  return Uint8Array.from({length: (rgba.length / 4) * 3}, (_, i) => rgba[Math.floor(i / 3) * 4 + (i % 3)]);
}

// What a panel showed in colours that RGB565 has, as it got it.
function rgb565(rgba) {
  const bytes = new Uint8Array(rgba.length / 2);
  for (let i = 0; i < rgba.length; i += 4) {
    const v = ((rgba[i] >> 3) << 11) | ((rgba[i + 1] >> 2) << 5) | (rgba[i + 2] >> 3);
    bytes[i / 2] = v & 255;
    bytes[i / 2 + 1] = v >> 8;
  }
  return bytes;
}

// Files that are no scenes, or lack something: name, bytes, and a word that must be in the message.
function malformedFiles(fs) {
  const text = (string) => new TextEncoder().encode(string);
  const cube = fs.readFileSync('host/scenes/cube.gltf'), glb = new Uint8Array(64);
  new DataView(glb.buffer).setUint32(0, 0x46546c67, true);
  new DataView(glb.buffer).setUint32(4, 2, true);
  new DataView(glb.buffer).setUint32(8, 0xfffffff0, true);
  const noise = Uint8Array.from({length: 5000}, (_, i) => (i * i * 2654435761) >>> 13);
  const lacks = '{"asset":{"version":"2.0"},"buffers":[{"uri":"gone.bin","byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0}';
  return [
    ['empty.glb', new Uint8Array(0), ''],
    ['noise.glb', noise, ''],
    ['length.glb', glb, ''],
    ['half.gltf', cube.subarray(0, cube.length >> 1), 'half.gltf:'],
    ['deep.gltf', text('['.repeat(1000000)), ''],
    ['lacks.gltf', text(lacks), 'gone.bin'],
    ['nothing.obj', text('v 0 0 0\n'), 'no faces'],
    ['huge.obj', text('v 1e300 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n'), 'out of range'],
    ['text.txt', text('hello'), 'not a scene'],
  ];
}

module.exports = {check, report, crc32, rgb888, rgb565, malformedFiles};
