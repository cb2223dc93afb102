// Solves the box in patches, then bakes its lightmaps, both in slices between which the page stays alive, and draws what
// is there so far.

const SLICE_MS = 4;
const PAIRS = 100;

const canvas = document.getElementById("picture");
const context = canvas.getContext("2d");
const slider = document.getElementById("lamp");
const state = document.getElementById("state");

let start = 0;
const isOver = () => performance.now() - start >= SLICE_MS;

// Between two slices the browser does what else there is to do.
const channel = new MessageChannel();
const turn = () => new Promise((done) => {
  channel.port1.onmessage = done;
  channel.port2.postMessage(0);
});

// The durations of the slices of one kind of work.
class Slices {
  durations = [];

  open() {
    start = performance.now();
  }

  close() {
    this.durations.push(performance.now() - start);
  }

  toString() {
    const sorted = [...this.durations].sort((a, b) => a - b);
    const at = (share) => (sorted[Math.floor(share * (sorted.length - 1))] ?? 0).toFixed(1);
    return `${sorted.length} slices, median ${at(0.5)} ms, 99 of 100 below ${at(0.99)} ms, longest ${at(1)} ms`;
  }
}

const solving = new Slices();
const baking = new Slices();

// Called from the middle of a bake. JavaScript Promise Integration puts the module to sleep until the promise is kept.
async function rest() {
  baking.close();
  await turn();
  baking.open();
}

const canSleep = "Suspending" in WebAssembly;
const page = { is_over: isOver, rest: canSleep ? new WebAssembly.Suspending(rest) : () => {} };
const { instance } = await WebAssembly.instantiateStreaming(fetch("web.wasm"), { page });
const wasm = instance.exports;
const room = wasm.room_new(canvas.width);
let baked = 0;
let lamp = [1, 1, 1];
let relit = "";

// The picture lies in the memory of the module, which moves when it grows.
function draw() {
  const size = canvas.width * canvas.height * 4;
  const place = baked ? wasm.baked_draw(baked) : wasm.room_draw(room);
  const bytes = new Uint8ClampedArray(wasm.memory.buffer, place, size);
  context.putImageData(new ImageData(bytes, canvas.width, canvas.height), 0, 0);
}

function tell(what) {
  const lines = [`solved: ${solving}`, `baked: ${baking}`, relit];
  state.textContent = `${what}\n${lines.join("\n")}`;
  document.body.dataset.state = what;
}

// Shots and sweeps until nothing is left. A picture is drawn every 100 ms.
async function solve() {
  let drawn = 0;
  let more = true;
  while (more) {
    solving.open();
    while (more && !isOver()) more = wasm.room_step(room, PAIRS) === 1;
    solving.close();
    if (performance.now() - drawn > 100) {
      draw();
      tell(`solving ${(100 * wasm.room_progress(room)).toFixed(0)} %`);
      drawn = performance.now();
    }
    await turn();
  }
  draw();
}

// The whole bake, with a rest whenever a slice is over.
async function bake() {
  tell("baking");
  baking.open();
  const place = await WebAssembly.promising(wasm.baked_new)(canvas.width);
  baking.close();
  if (place === 0) throw new Error("the bake failed");
  baked = place;
  if (lamp.some((band) => band !== 1)) wasm.baked_relight(baked, ...lamp);
  draw();
}

slider.addEventListener("input", () => {
  const warm = slider.value / 100;
  lamp = [Math.min(1, 0.4 + 1.2 * warm), 1 - 0.4 * Math.abs(warm - 0.5), Math.min(1, 1.6 - 1.2 * warm)];
  const before = performance.now();
  if (baked) wasm.baked_relight(baked, ...lamp);
  else wasm.room_relight(room, ...lamp);
  const after = performance.now();
  draw();
  relit = `relit in ${(after - before).toFixed(1)} ms, drawn in ${(performance.now() - after).toFixed(1)} ms`;
  if (baked) tell("done");
});

await solve();
if (canSleep) await bake();
tell(canSleep ? "done" : "no lightmaps: this browser cannot put WebAssembly to sleep");
