// Drives a headless Chromium over its debugging pipe: pages, input, screenshots. Needs nothing but node and chromium.
'use strict';
const {spawn} = require('child_process');
const fs = require('fs');

class Browser {
  // folder: for what the browser keeps
  constructor(folder, command = 'chromium') {
    const flags = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--disable-background-networking', '--disable-sync', '--no-first-run', '--hide-scrollbars', '--remote-debugging-pipe', `--user-data-dir=${folder}`];
    this.process = spawn(command, flags, {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
    this.next = 1;
    this.waiting = new Map();
    this.errors = [];
    let text = '';
    this.process.stdio[4].setEncoding('utf8').on('data', (chunk) => {
      const messages = (text + chunk).split('\0');
      text = messages.pop();
      for (const message of messages) this.take(JSON.parse(message));
    });
    this.process.stdio[3].on('error', () => {}); // it ended: whoever waits is told below
    this.process.on('exit', () => this.waiting.forEach(({failed}) => failed(new Error('the browser ended'))));
  }

  take({id, error, result, method, params}) {
    const waits = this.waiting.get(id);
    this.waiting.delete(id);
    if (waits && error) waits.failed(new Error(error.message));
    else if (waits) waits.done(result);
    else if (method === 'Runtime.exceptionThrown') this.errors.push(params.exceptionDetails.exception.description || params.exceptionDetails.text);
    else if (method === 'Network.requestWillBeSent' && !/^(file|data|blob):/.test(params.request.url)) this.errors.push(`the page asks for ${params.request.url}`);
  }

  send(method, params = {}) {
    return new Promise((done, failed) => {
      const id = this.next++;
      this.waiting.set(id, {done, failed});
      this.process.stdio[3].write(JSON.stringify({id, method, params, sessionId: this.session}) + '\0');
    });
  }

  async open(url, width, height, phone = false) {
    const {targetId} = await this.send('Target.createTarget', {url: 'about:blank'});
    this.session = (await this.send('Target.attachToTarget', {targetId, flatten: true})).sessionId;
    for (const domain of ['Page', 'Runtime', 'Network']) await this.send(`${domain}.enable`);
    await this.resize(width, height, phone);
    await this.send('Page.navigate', {url});
  }

  async resize(width, height, phone = false) {
    await this.send('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: phone ? 2 : 1, mobile: phone});
    await this.send('Emulation.setTouchEmulationEnabled', {enabled: phone});
  }

  dark(yes) {
    return this.send('Emulation.setEmulatedMedia', {features: [{name: 'prefers-color-scheme', value: yes ? 'dark' : 'light'}]});
  }

  // The value of an expression in the page; promises are waited for.
  async value(expression) {
    const {result, exceptionDetails} = await this.send('Runtime.evaluate', {expression, awaitPromise: true, returnByValue: true});
    if (exceptionDetails) throw new Error(exceptionDetails.exception ? exceptionDetails.exception.description : exceptionDetails.text);
    return result.value;
  }

  async until(expression, seconds = 60) {
    for (const end = Date.now() + 1000 * seconds; Date.now() < end; await new Promise((done) => setTimeout(done, 60))) {
      if (await this.value(`(() => { try { return Boolean(${expression}); } catch { return false; } })()`)) return true;
    }
    return false;
  }

  async screenshot(path) {
    const {data} = await this.send('Page.captureScreenshot', {format: 'png'});
    fs.writeFileSync(path, Buffer.from(data, 'base64'));
  }

  mouse(type, x, y, more = {}) {
    return this.send('Input.dispatchMouseEvent', {type, x, y, button: 'left', buttons: type === 'mouseReleased' ? 0 : 1, clickCount: 1, ...more});
  }

  touch(type, points) {
    return this.send('Input.dispatchTouchEvent', {type, touchPoints: points.map(([x, y], id) => ({x, y, id}))});
  }

  async key(key) {
    const codes = {Tab: 9, Home: 36, ArrowLeft: 37, ArrowUp: 38, ArrowRight: 39, ArrowDown: 40, ' ': 32};
    const params = {key, code: key === ' ' ? 'Space' : key, windowsVirtualKeyCode: codes[key] || key.charCodeAt(0), text: key.length === 1 ? key : undefined};
    await this.send('Input.dispatchKeyEvent', {type: 'keyDown', ...params});
    await this.send('Input.dispatchKeyEvent', {type: 'keyUp', ...params});
  }

  close() {
    return new Promise((done) => {
      this.process.on('exit', done);
      this.send('Browser.close').catch(() => {});
      setTimeout(() => this.process.kill('SIGKILL'), 5000).unref();
    });
  }
}

module.exports = {Browser};
