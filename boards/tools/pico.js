// Boots the UF2 of a Raspberry Pi Pico in rp2040js, with an ST7789 of 320x240 pixels on SPI0, wired as in
// boards/pico/screen/lcd.c.
//   node pico.js IMAGE.uf2 IMAGE.symbols N [OUT.ppm]
// IMAGE.symbols is what nm says of the image. The run ends after N frames (each begins with scene_frame), or with
// board_exit; then OUT.ppm is what the glass shows. Printed: what the firmware sends over UART0, and each frame's
// instructions and cycles. Flash takes no time here, the serial bus does. Exit status: the firmware's; 1: the run failed, stderr
// says why.
'use strict';
const fs = require('fs');

const SYSTEM_HZ = 125e6, BYTE_BITS = 8;
const FLASH = 0x10000000, FLASH_END = 0x10200000, RAM_END = 0x20042000, BOOT_BYTES = 256;
const PIN_COMMAND = 16, PIN_SELECT = 17;

function fail(text) {
  throw new Error(text);
}

// ---- The glass ------------------------------------------------------------------------------------------------------

const SWRESET = 0x01, SLPOUT = 0x11, INVON = 0x21, DISPOFF = 0x28, DISPON = 0x29;
const CASET = 0x2a, RASET = 0x2b, RAMWR = 0x2c, MADCTL = 0x36, COLMOD = 0x3a;
const MADCTL_MV = 0x20, COLMOD_16_BITS = 0x55;

// The glass lies on its side (MADCTL_MV), so that windows are in what is seen. What the set-up owes is checked when
// pixels come; tests/firmware/panel_model_st7789.c knows more.
class Glass {
  constructor() {
    this.width = 320;
    this.height = 240;
    this.pixels = new Uint16Array(this.width * this.height);
    this.reset();
  }

  reset() {
    this.awake = this.shown = this.inverted = false;
    this.turn = this.colours = 0;
    this.columns = [0, this.width - 1];
    this.rows = [0, this.height - 1];
    this.command(0);
  }

  command(code) {
    this.code = code;
    this.parameters = [];
    this.high = -1;
    if (code === SWRESET) this.reset();
    else if (code === SLPOUT) this.awake = true;
    else if (code === INVON) this.inverted = true;
    else if (code === DISPON || code === DISPOFF) this.shown = code === DISPON;
    else if (code === RAMWR) this.begin();
  }

  begin() {
    [this.x, this.y] = [this.columns[0], this.rows[0]];
    const set_up = this.awake && this.inverted && this.turn & MADCTL_MV && this.colours === COLMOD_16_BITS;
    if (!set_up) fail('the panel gets pixels before it is set up');
    if (this.columns[1] >= this.width || this.rows[1] >= this.height) fail('a window beyond the glass');
    if (this.columns[0] > this.columns[1] || this.rows[0] > this.rows[1]) fail('a window inside out');
  }

  data(byte) {
    if (this.code === RAMWR) return this.pixelByte(byte);
    this.parameters.push(byte);
    if (this.code === MADCTL) this.turn = byte;
    else if (this.code === COLMOD) this.colours = byte;
    else if (this.code === CASET) this.columns = this.range();
    else if (this.code === RASET) this.rows = this.range();
  }

  range() {
    const [a, b, c, d] = this.parameters;
    return [(a << 8) | b, (c << 8) | d];
  }

  // Two bytes of a pixel, the high one first; windows are filled row by row, and then again.
  pixelByte(byte) {
    if (this.high < 0) {
      this.high = byte;
      return;
    }
    this.pixels[this.y * this.width + this.x] = (this.high << 8) | byte;
    this.high = -1;
    if (++this.x <= this.columns[1]) return;
    this.x = this.columns[0];
    if (++this.y > this.rows[1]) this.y = this.rows[0];
  }

  // Bits are replicated, so that white stays white. A display that is off is black.
  ppm() {
    const rgb = Buffer.alloc(3 * this.pixels.length);
    if (this.shown) {
      this.pixels.forEach((p, i) => {
        const r = p >> 11, g = (p >> 5) & 63, b = p & 31;
        rgb.set([(r << 3) | (r >> 2), (g << 2) | (g >> 4), (b << 3) | (b >> 2)], 3 * i);
      });
    }
    return Buffer.concat([Buffer.from(`P6\n${this.width} ${this.height}\n255\n`), rgb]);
  }
}

// ---- The chip -------------------------------------------------------------------------------------------------------

function loadUf2(chip, path) {
  const uf2 = fs.readFileSync(path);
  for (let at = 0; at < uf2.length; at += 512) {
    if (uf2.readUInt32LE(at) !== 0x0a324655) fail(`${path} is not a UF2 file`);
    const address = uf2.readUInt32LE(at + 12), n = uf2.readUInt32LE(at + 16);
    if (address < FLASH || address + n > FLASH_END) fail(`${path} goes beyond the flash`);
    chip.flash.set(uf2.subarray(at + 32, at + 32 + n), address - FLASH);
  }
}

// As the boot ROM does: the first 256 bytes of flash run from the end of RAM.
function boot(chip) {
  const start = RAM_END - BOOT_BYTES;
  for (let i = 0; i < BOOT_BYTES; i++) chip.writeUint8(start + i, chip.flash[i]);
  chip.core.SP = start;
  chip.core.PC = start;
}

// A byte takes eight periods of the bus; its level of data/command is that of its first bit.
function connect(chip, glass) {
  const spi = chip.spi[0], sent = chip.clock.createAlarm(() => spi.completeTransmit(0));
  spi.onTransmit = (byte) => {
    if (!chip.gpio[PIN_SELECT].outputValue) {
      if (chip.gpio[PIN_COMMAND].outputValue) glass.data(byte);
      else glass.command(byte);
    }
    sent.schedule((1e9 * BYTE_BITS) / spi.clockFrequency);
  };
}

function makeChip(glass) {
  let rp2040js;
  try {
    rp2040js = require('rp2040js');
  } catch {
    fail('the package rp2040js is not there: NODE_PATH says where');
  }
  const chip = new rp2040js.RP2040();
  const silent = () => {}, broken = (part, text) => fail(`${part}: ${text}`);
  // Peripherals warn of registers that they lack: those of the stack's guard and of a DMA abort.
  const warn = (part, text) => ['RP2040', 'CortexM0Core'].includes(part) && broken(part, text);
  chip.logger = { debug: silent, info: silent, warn, error: broken };
  connect(chip, glass);
  chip.uart[0].onByte = (byte) => process.stdout.write(String.fromCharCode(byte));
  return chip;
}

// ---- The run --------------------------------------------------------------------------------------------------------

function readSymbols(path) {
  const symbols = {};
  for (const line of fs.readFileSync(path, 'utf8').split('\n')) {
    const [address, , name] = line.split(' ');
    if (name) symbols[name] = parseInt(address, 16);
  }
  return symbols;
}

function million(n) {
  return (n / 1e6).toFixed(1) + ' million';
}

class Run {
  constructor(chip, symbols, nFrames) {
    Object.assign(this, { chip, nFrames, cycles: 0, instructions: 0, frame: -1, status: -1 });
    this.exit = symbols.board_exit;
    this.scene = symbols.scene_frame; // undefined: an app without frames
  }

  // The firmware enters a function that is watched.
  enter(pc) {
    const { registers } = this.chip.core;
    if (pc === this.exit) this.end(registers[0]);
    else if (this.frame + 1 === this.nFrames) this.end(0);
    else this.begin();
  }

  begin() {
    this.report();
    this.frame++;
    this.began = { cycles: this.cycles, instructions: this.instructions };
  }

  end(status) {
    this.report();
    this.status = status;
  }

  report() {
    if (this.frame < 0) return;
    const cycles = this.cycles - this.began.cycles, instructions = this.instructions - this.began.instructions;
    const counts = `${million(instructions)} instructions, ${million(cycles)} cycles`;
    console.log(`frame ${this.frame}: ${counts}, ${(SYSTEM_HZ / cycles).toFixed(2)} per second`);
  }

  toEnd() {
    const { core, clock } = this.chip, nsPerCycle = 1e9 / SYSTEM_HZ;
    const { exit, scene } = this;
    while (this.status < 0) {
      if (core.waiting) fail('the firmware sleeps, and nothing wakes it');
      const pc = core.PC;
      if (pc === scene || pc === exit) this.enter(pc);
      const cycles = core.executeInstruction();
      this.cycles += cycles;
      this.instructions++;
      clock.tick(cycles * nsPerCycle);
    }
    return this.status;
  }
}

function main([image, symbols, nFrames, out]) {
  if (!(nFrames > 0)) fail('usage: node pico.js IMAGE.uf2 IMAGE.symbols N [OUT.ppm]');
  const glass = new Glass(), chip = makeChip(glass);
  loadUf2(chip, image);
  boot(chip);
  const status = new Run(chip, readSymbols(symbols), Number(nFrames)).toEnd();
  if (out) fs.writeFileSync(out, glass.ppm());
  return status;
}

try {
  process.exitCode = main(process.argv.slice(2));
} catch (error) {
  console.error(`pico: ${error.message}`);
  process.exitCode = 1;
}
