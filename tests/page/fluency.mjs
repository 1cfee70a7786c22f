// How large a page is, how long a browser takes to show it, and how many frames it draws per second.
//
//   node tests/page/fluency.mjs <chromium> <page.html> ...
//
// Headless Chromium draws by the processor: a screen with a graphics card draws more.
import { statSync } from "node:fs";
import { resolve } from "node:path";

import { Browser } from "./browser.mjs";

const [, , executable, ...pages] = process.argv;
for (const page of pages) {
  const browser = await Browser.start(executable, { width: 1280, height: 800 });
  const before = Date.now();
  await browser.open(`file://${resolve(page)}`);
  const shown = (Date.now() - before) / 1000;
  const decoded = await browser.evaluate("window.dalembert.decoded / 1000");
  await browser.press("Home");
  await browser.press(" ");
  const frames = await browser.evaluate(`new Promise((done) => {
    const began = performance.now(); let count = 0;
    const tick = () => { ++count; if (performance.now() - began > 4000) done(count / 4); else requestAnimationFrame(tick); };
    requestAnimationFrame(tick);
  })`);
  const drawing = await browser.evaluate(`(() => {
    const p = window.dalembert, began = performance.now();
    for (let k = 0; k < 20; ++k) { p.player.seek(p.run.start + (k / 20) * (p.run.end - p.run.start)); p.update(); }
    return (performance.now() - began) / 20;
  })()`);
  console.log(`${page}: ${(statSync(page).size / 1e6).toFixed(2)} MB, first frame after ${shown.toFixed(2)} s (of these ${decoded.toFixed(2)} s in the page), ` +
    `${frames.toFixed(1)} frames/s, ${drawing.toFixed(1)} ms a frame; ${browser.complaints.length} complaints`);
  await browser.stop();
}
