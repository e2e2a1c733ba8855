// One engine in a thread of its own. In: {bytes, files} at first, {files} that are new, {id, run|draw: [words],
// take: [paths]}. Out: what the engine answers, with the id and the files that were to be taken.
'use strict';

let engine = null;

self.onmessage = ({data}) => {
  if (data.bytes) engine = new Engine(new WebAssembly.Module(data.bytes), new Map());
  for (const [path, bytes] of data.files || []) engine.files.set(path, bytes);
  if (data.files && engine.wasi) data.files.forEach(([path]) => engine.wasi.addFolders(path));
  if (data.id === undefined) return;
  const answer = data.draw ? engine.draw(data.draw) : engine.run(data.run);
  answer.id = data.id;
  answer.files = (data.take || []).filter((path) => engine.files.has(path)).map((path) => [path, engine.files.get(path).slice()]);
  for (const path of data.take || []) engine.files.delete(path);
  self.postMessage(answer, answer.rgba ? [answer.rgba.buffer] : []);
};
