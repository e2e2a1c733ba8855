// Threads that hold an engine each: `live` draws what is seen, `slow` counts, compares and compiles.
'use strict';

class Thread {
  constructor(source, bytes, files) {
    Object.assign(this, {source, bytes, files, next: 1, waiting: new Map()});
    this.start();
  }

  start() {
    this.worker = new Worker(URL.createObjectURL(new Blob([this.source], {type: 'text/javascript'})));
    this.worker.onmessage = ({data}) => {
      const done = this.waiting.get(data.id);
      this.waiting.delete(data.id);
      if (done) done(data);
    };
    this.worker.onerror = (event) => this.restart(event.message);
    this.worker.postMessage({bytes: this.bytes, files: [...this.files]});
  }

  // What was asked for gets no other answer.
  restart(why) {
    this.worker.terminate();
    const given_up = [...this.waiting.values()];
    this.waiting.clear();
    this.start();
    for (const done of given_up) done({status: -1, out: '', err: `gnomon: ${why}`, files: [], given_up: true});
  }

  add(files) {
    this.worker.postMessage({files});
  }

  get busy() {
    return this.waiting.size > 0;
  }

  // request: {run or draw: words, take}
  ask(request) {
    return new Promise((done) => {
      const id = this.next++;
      this.waiting.set(id, done);
      this.worker.postMessage({id, ...request});
    });
  }
}

// Work for a thread, one piece at a time; what is queued and not begun can be given up.
class Queue {
  constructor(thread) {
    this.thread = thread;
    this.jobs = [];
    this.running = false;
  }

  async run() {
    if (this.running) return;
    this.running = true;
    while (this.jobs.length) {
      const job = this.jobs.shift();
      job.done(await this.thread.ask(job.request));
    }
    this.running = false;
  }

  add(request, done, first) {
    if (first) this.jobs.unshift({request, done});
    else this.jobs.push({request, done});
    this.run();
  }

  clear() {
    this.jobs = this.jobs.filter((job) => job.request.take);
  }

  get busy() {
    return this.running;
  }
}
