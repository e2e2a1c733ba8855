// The tool in WebAssembly: its commands as calls, and pictures out of its memory. What crashes it, or uses up its
// memory, ends one instance of it and is an error like others; the next call has a new one.
'use strict';
if (typeof module !== 'undefined') Object.assign(globalThis, require('./wasi.js'));

const MEMORY_KEPT_BYTES = 512 << 20; // memory never shrinks: above that the instance is given up

class Engine {
  // files: a Map of path to Uint8Array, that all calls share
  constructor(module, files) {
    this.module = module;
    this.files = files;
  }

  start() {
    this.wasi = new Wasi(this.files);
    const instance = new WebAssembly.Instance(this.module, this.wasi.imports());
    this.exports = instance.exports;
    this.wasi.memory = this.exports.memory;
    this.exports._initialize();
  }

  // Puts strings into the tool's memory as argv.
  pass(args) {
    const encoder = new TextEncoder(), texts = args.map((arg) => encoder.encode(arg + '\0'));
    const n_bytes = texts.reduce((sum, text) => sum + text.length, 0), list = 4 * (args.length + 1);
    const argv = this.exports.web_alloc(list + n_bytes);
    if (!argv) throw new Error('out of memory');
    let at = argv + list;
    texts.forEach((text, i) => {
      this.wasi.bytes(at, text.length).set(text);
      this.wasi.view.setUint32(argv + 4 * i, at, true);
      at += text.length;
    });
    this.wasi.view.setUint32(argv + list - 4, 0, true);
    return argv;
  }

  // One command: its words without the program's name. {status, out, err}; status -1: the tool itself failed.
  run(args) {
    try {
      if (!this.exports) this.start();
      const argv = this.pass(['gnomon', ...args]);
      const status = this.exports.web_run(args.length + 1, argv);
      this.exports.web_free(argv);
      return {status, ...this.wasi.takeOutput()};
    } catch (error) {
      const said = this.wasi ? this.wasi.takeOutput() : {out: '', err: ''};
      this.exports = null;
      if (error instanceof WasiExit) return {status: error.status, ...said};
      return {status: -1, out: '', err: `${said.err}gnomon: the scene is too much for this page (${error.message})`};
    }
  }

  // A picture: the words of `gnomon render` behind it, without -o. {status, err, info, rgba}
  draw(args) {
    const said = this.run(['draw', ...args]);
    if (said.status !== 0) return said;
    const info = JSON.parse(said.out), n = info.width * info.height;
    const rgb = this.wasi.bytes(this.exports.web_pixels(), 3 * n), rgba = new Uint8ClampedArray(4 * n);
    for (let i = 0, from = 0, to = 0; i < n; i++) {
      rgba[to++] = rgb[from++];
      rgba[to++] = rgb[from++];
      rgba[to++] = rgb[from++];
      rgba[to++] = 255;
    }
    if (this.exports.memory.buffer.byteLength > MEMORY_KEPT_BYTES) this.exports = null;
    return {status: 0, err: said.err, info, rgba};
  }
}

if (typeof module !== 'undefined') module.exports = {Engine};
