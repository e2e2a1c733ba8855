// What a WASI program needs of a system, and no more: files in memory, output as text, a clock. One flat folder "/".
'use strict';

const WASI = {OK: 0, BADF: 8, EXIST: 20, INVAL: 28, ISDIR: 31, NOENT: 44, NOSYS: 52, NOTDIR: 54};
const WASI_DIRECTORY = 3, WASI_FILE = 4, WASI_TERMINAL = 2, WASI_PREOPENED = 3;
const WASI_CREATE = 1, WASI_DIRECTORY_ONLY = 2, WASI_EXCLUSIVE = 4, WASI_TRUNCATE = 8, WASI_FIRST_FREE = 4;

// Thrown by exit().
class WasiExit extends Error {
  constructor(status) {
    super(`exit ${status}`);
    this.status = status;
  }
}

class Wasi {
  // files: a Map of paths without a leading slash to Uint8Array. What the program writes goes there, too.
  constructor(files) {
    this.files = files;
    this.folders = new Set(['']);
    for (const path of files.keys()) this.addFolders(path);
    this.open = new Map();
    this.numbers = new Map(); // of paths: the program tells files apart by them
    this.output = ['', '', ''];
    this.decoders = [1, 2].map(() => new TextDecoder());
  }

  addFolders(path) {
    for (let at = path.lastIndexOf('/'); at > 0; at = path.lastIndexOf('/', at - 1)) this.folders.add(path.slice(0, at));
  }

  takeOutput() {
    const [, out, err] = this.output;
    this.output = ['', '', ''];
    return {out, err};
  }

  get view() {
    return new DataView(this.memory.buffer);
  }

  bytes(at, n) {
    return new Uint8Array(this.memory.buffer, at, n);
  }

  path(at, n) {
    const parts = [];
    for (const part of new TextDecoder().decode(this.bytes(at, n).slice()).split('/')) {
      if (part === '..') parts.pop();
      else if (part !== '' && part !== '.') parts.push(part);
    }
    return parts.join('/');
  }

  // name: a path, or the number of a stream.
  writeStat(at, name, type, size) {
    if (!this.numbers.has(name)) this.numbers.set(name, this.numbers.size + 1);
    this.bytes(at, 64).fill(0);
    this.view.setBigUint64(at + 8, BigInt(this.numbers.get(name)), true);
    this.view.setUint8(at + 16, type);
    this.view.setBigUint64(at + 24, 1n, true);
    this.view.setBigUint64(at + 32, BigInt(size), true);
  }

  write(fd, chunk) {
    if (fd === 1 || fd === 2) {
      this.output[fd] += this.decoders[fd - 1].decode(chunk, {stream: true});
      return;
    }
    const file = this.open.get(fd), end = file.at + chunk.length;
    const old = this.files.get(file.path);
    if (end > file.room.length) {
      file.room = new Uint8Array(Math.max(end, 2 * file.room.length, 4096));
      file.room.set(old);
    }
    file.room.set(chunk, file.at);
    this.files.set(file.path, file.room.subarray(0, Math.max(end, old.length)));
    file.at = end;
  }

  // Calls back for every buffer of a list; it returns how many bytes it took or gave.
  vectors(list, n, each) {
    let done = 0;
    for (let i = 0; i < n; i++) {
      const at = this.view.getUint32(list + 8 * i, true), length = this.view.getUint32(list + 8 * i + 4, true);
      const now = each(this.bytes(at, length));
      done += now;
      if (now < length) break;
    }
    return done;
  }

  openPath(path, how, out) {
    const isFolder = this.folders.has(path), exists = this.files.has(path);
    if (how & WASI_DIRECTORY_ONLY && !isFolder) return exists ? WASI.NOTDIR : WASI.NOENT;
    if (isFolder) return WASI.ISDIR;
    if (exists && how & WASI_EXCLUSIVE) return WASI.EXIST;
    if (!exists && !(how & WASI_CREATE)) return WASI.NOENT;
    if (!this.folders.has(path.slice(0, Math.max(0, path.lastIndexOf('/'))))) return WASI.NOENT;
    if (!exists || how & WASI_TRUNCATE) this.files.set(path, new Uint8Array(0));
    let fd = WASI_FIRST_FREE;
    while (this.open.has(fd)) fd++;
    this.open.set(fd, {path, at: 0, room: new Uint8Array(0)});
    this.view.setUint32(out, fd, true);
    return WASI.OK;
  }

  seek(fd, offset, whence, out) {
    const file = this.open.get(fd);
    if (!file) return WASI.BADF;
    const base = [0, file.at, this.files.get(file.path).length][whence];
    if (base === undefined || base + Number(offset) < 0) return WASI.INVAL;
    file.at = base + Number(offset);
    this.view.setBigUint64(out, BigInt(file.at), true);
    return WASI.OK;
  }

  read(fd, list, n, out) {
    const file = this.open.get(fd);
    if (!file) return WASI.BADF;
    const data = this.files.get(file.path);
    const done = this.vectors(list, n, (buffer) => {
      const part = data.subarray(file.at, file.at + buffer.length);
      buffer.set(part);
      file.at += part.length;
      return part.length;
    });
    this.view.setUint32(out, done, true);
    return WASI.OK;
  }

  stat(path, out) {
    if (this.folders.has(path)) this.writeStat(out, path, WASI_DIRECTORY, 0);
    else if (this.files.has(path)) this.writeStat(out, path, WASI_FILE, this.files.get(path).length);
    else return WASI.NOENT;
    return WASI.OK;
  }

  rename(from, to) {
    if (!this.files.has(from)) return WASI.NOENT;
    this.files.set(to, this.files.get(from));
    this.files.delete(from);
    return WASI.OK;
  }

  typeOf(fd) {
    if (fd <= 2) return WASI_TERMINAL;
    return fd === WASI_PREOPENED ? WASI_DIRECTORY : this.open.has(fd) ? WASI_FILE : 0;
  }

  streamStat(fd, out) {
    this.bytes(out, 24).fill(0);
    this.view.setUint8(out, this.typeOf(fd));
    this.bytes(out + 8, 16).fill(0xff); // every right
    return this.typeOf(fd) ? WASI.OK : WASI.BADF;
  }

  // The functions that the program imports, by name; all others refuse.
  imports() {
    const known = {
      clock_time_get: (id, precision, out) => {
        this.view.setBigUint64(out, BigInt(Math.round(1e6 * performance.now())), true);
        return WASI.OK;
      },
      fd_close: (fd) => (this.open.delete(fd) ? WASI.OK : WASI.BADF),
      fd_fdstat_get: (fd, out) => this.streamStat(fd, out),
      fd_fdstat_set_flags: () => WASI.OK,
      fd_filestat_get: (fd, out) => {
        const file = this.open.get(fd);
        this.writeStat(out, file ? file.path : fd, this.typeOf(fd), file ? this.files.get(file.path).length : 0);
        return WASI.OK;
      },
      fd_prestat_get: (fd, out) => {
        if (fd !== WASI_PREOPENED) return WASI.BADF;
        this.view.setUint32(out, 0, true);
        this.view.setUint32(out + 4, 1, true);
        return WASI.OK;
      },
      fd_prestat_dir_name: (fd, at) => {
        this.view.setUint8(at, '/'.charCodeAt(0));
        return WASI.OK;
      },
      fd_read: (fd, list, n, out) => this.read(fd, list, n, out),
      fd_seek: (fd, offset, whence, out) => this.seek(fd, offset, whence, out),
      fd_write: (fd, list, n, out) => {
        if (fd !== 1 && fd !== 2 && !this.open.has(fd)) return WASI.BADF;
        const done = this.vectors(list, n, (buffer) => {
          this.write(fd, buffer.slice());
          return buffer.length;
        });
        this.view.setUint32(out, done, true);
        return WASI.OK;
      },
      path_create_directory: (fd, at, n) => {
        const path = this.path(at, n);
        if (this.folders.has(path) || this.files.has(path)) return WASI.EXIST;
        this.folders.add(path);
        return WASI.OK;
      },
      path_filestat_get: (fd, flags, at, n, out) => this.stat(this.path(at, n), out),
      path_open: (fd, flags, at, n, how, rights, inherited, more, out) => this.openPath(this.path(at, n), how, out),
      path_rename: (fd, at, n, toFd, to, toN) => this.rename(this.path(at, n), this.path(to, toN)),
      path_unlink_file: (fd, at, n) => (this.files.delete(this.path(at, n)) ? WASI.OK : WASI.NOENT),
      proc_exit: (status) => {
        throw new WasiExit(status);
      },
    };
    return {wasi_snapshot_preview1: new Proxy(known, {get: (all, name) => all[name] || (() => WASI.NOSYS)})};
  }
}

if (typeof module !== 'undefined') module.exports = {Wasi, WasiExit};
