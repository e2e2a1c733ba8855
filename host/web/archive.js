// Archives: what the page carries comes out of a tar, what it gives away goes into a zip. Nothing is compressed here.
'use strict';

// The files of a tar: a Map of path to Uint8Array.
function tarFiles(tar) {
  const BLOCK = 512, files = new Map(), text = (at, n) => new TextDecoder().decode(tar.subarray(at, at + n)).replace(/\0.*/s, '');
  for (let at = 0; at + BLOCK <= tar.length && tar[at]; ) {
    const size = parseInt(text(at + 124, 12), 8), prefix = text(at + 345, 155), name = text(at, 100);
    if (text(at + 156, 1) !== '5') files.set(prefix ? `${prefix}/${name}` : name, tar.slice(at + BLOCK, at + BLOCK + size));
    at += BLOCK + Math.ceil(size / BLOCK) * BLOCK;
  }
  return files;
}

function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

// files: an array of [path, Uint8Array]. The date is 1980-01-01.
function zipOf(files) {
  const parts = [], directory = [];
  let at = 0, n_directory = 0;
  const record = (signature, fields) => {
    const bytes = new Uint8Array(4 + fields.reduce((sum, [size]) => sum + size, 0)), view = new DataView(bytes.buffer);
    let to = 4;
    view.setUint32(0, signature, true);
    for (const [size, value] of fields) {
      if (size === 2) view.setUint16(to, value, true);
      else view.setUint32(to, value, true);
      to += size;
    }
    return bytes;
  };
  for (const [path, bytes] of files) {
    const name = new TextEncoder().encode(path), utf8 = 0x800, day = 0x21;
    const common = [[2, 20], [2, utf8], [2, 0], [2, 0], [2, day], [4, crc32(bytes)], [4, bytes.length], [4, bytes.length], [2, name.length], [2, 0]];
    const local = record(0x04034b50, common);
    const central = record(0x02014b50, [[2, 20], ...common, [2, 0], [2, 0], [2, 0], [4, 0], [4, at]]);
    parts.push(local, name, bytes);
    directory.push(central, name);
    at += local.length + name.length + bytes.length;
    n_directory += central.length + name.length;
  }
  const end = record(0x06054b50, [[2, 0], [2, 0], [2, files.length], [2, files.length], [4, n_directory], [4, at], [2, 0]]);
  return new Blob([...parts, ...directory, end], {type: 'application/zip'});
}

if (typeof module !== 'undefined') module.exports = {tarFiles, zipOf};
