// Opens the page in a browser without a window, moves the slider while it bakes and when it is done, and takes a picture
// of the page. Exit code 77: the browser is too old.
//
//     node visit.mjs BROWSER ADDRESS FOLDER-FOR-THE-PROFILE PICTURE.png

import { spawn } from "node:child_process";
import { writeFileSync } from "node:fs";

const [browser, address, profile, picture] = process.argv.slice(2);
const options = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--remote-debugging-pipe",
  "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-quic",
  `--user-data-dir=${profile}`, "--window-size=560,960"];
const chromium = spawn(browser, options, { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
const [, , , input, output] = chromium.stdio;
// A browser that answers no more must not keep anyone waiting.
setTimeout(() => {
  console.error("the browser does not answer");
  chromium.kill();
  process.exit(1);
}, 20 * 60 * 1000).unref();

// The debugging protocol: JSON with a zero byte behind each message.
const waiting = new Map();
let buffer = "";
let last = 0;
output.on("data", (bytes) => {
  buffer += bytes;
  const messages = buffer.split("\0");
  buffer = messages.pop();
  for (const { id, result, error } of messages.map((message) => JSON.parse(message))) {
    if (error) throw new Error(error.message);
    waiting.get(id)?.(result);
    waiting.delete(id);
  }
});
const call = (method, params = {}, sessionId = undefined) => new Promise((done) => {
  last += 1;
  waiting.set(last, done);
  input.write(`${JSON.stringify({ id: last, method, params, sessionId })}\0`);
});
const { targetId } = await call("Target.createTarget", { url: address });
const { sessionId } = await call("Target.attachToTarget", { targetId, flatten: true });
const evaluate = async (expression) =>
  (await call("Runtime.evaluate", { expression, returnByValue: true }, sessionId)).result.value;
const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));

// Waits until the page is where it shall be; every look at it needs a page that is alive.
async function reached(wanted) {
  for (let tenths = 0; tenths < 6000; tenths += 1) {
    await pause(100);
    const state = await evaluate("document.body?.dataset.state");
    if (state === wanted) return;
    if (state?.startsWith("no lightmaps")) throw Object.assign(new Error(state), { code: 77 });
  }
  throw new Error(`the page does not finish: ${await evaluate("document.getElementById('state')?.textContent")}`);
}

const mean = `(() => {
  const { data } = document.querySelector("canvas").getContext("2d").getImageData(0, 0, 512, 512);
  const sums = [0, 0, 0];
  for (let k = 0; k < data.length; k += 4) sums.forEach((_, band) => { sums[band] += data[k + band]; });
  return sums.map((sum) => sum / 512 / 512);
})()`;

const light = (warm) => evaluate(`lamp.value = ${warm}; lamp.dispatchEvent(new Event("input"))`);
const bluish = ([red, , blue]) => blue / red;

let failure = 0;
try {
  await reached("baking");
  const patches = await evaluate(mean);
  await light(100);
  const warmPatches = await evaluate(mean);
  if (await evaluate("document.body.dataset.state") !== "baking") throw new Error("the bake was over before it was looked at");
  await reached("done");
  const warm = await evaluate(mean);
  await light(50);
  const usual = await evaluate(mean);
  const { data } = await call("Page.captureScreenshot", { format: "png" }, sessionId);
  console.log(await evaluate("document.getElementById('state').textContent"));
  console.log(`mean color of patches ${patches.map(Math.round)}, of lightmaps ${usual.map(Math.round)}, warm ${warm.map(Math.round)}`);
  writeFileSync(picture, Buffer.from(data, "base64"));
  // Far above what slices should take: other programs run here too.
  const medians = (await evaluate("document.getElementById('state').textContent")).match(/median [\d.]+/g).map((text) => Number(text.slice(7)));
  if (medians.length < 2 || Math.max(...medians) > 50) throw new Error(`slices take ${medians} ms`);
  const isAlike = patches.every((band, k) => Math.abs(band - usual[k]) < 8);
  const isWarmer = bluish(warm) < 0.8 * bluish(usual) && bluish(warmPatches) < 0.8 * bluish(patches);
  if (!(Math.min(...usual) > 10 && isAlike && isWarmer)) throw new Error("the picture is wrong");
} catch (error) {
  console.error(error.message);
  failure = typeof error.code === "number" ? error.code : 1;
}
// The browser writes into its profile until it has ended, and whoever called wants to remove that folder.
const ended = new Promise((done) => chromium.once("exit", done));
call("Browser.close");
await Promise.race([ended, pause(10_000)]);
chromium.kill();
process.exit(failure);
