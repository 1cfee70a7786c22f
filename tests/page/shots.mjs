// Pictures of pages as a reader sees them, to be looked at.
//
//   node tests/page/shots.mjs <chromium> <folder of pages> <folder of pictures> [name ...]
import { mkdirSync, readdirSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";

import { Browser, pause } from "./browser.mjs";

const [, , executable, pages, pictures, ...wanted] = process.argv;
mkdirSync(pictures, { recursive: true });
const names = wanted.length > 0 ? wanted : readdirSync(pages).filter((f) => f.endsWith(".html")).map((f) => f.slice(0, -5));
const views = [["light", 1280, 800, "light"], ["dark", 1280, 800, "dark"], ["phone", 390, 844, "light"]];
for (const [view, width, height, scheme] of views) {
  const browser = await Browser.start(executable, { width, height, scheme });
  for (const name of names) {
    await browser.open(`file://${resolve(pages)}/${name}.html`);
    await browser.evaluate("{ const { player, run } = window.dalembert; player.seek(run.start + 0.37 * (run.end - run.start)); }");
    await pause(300);
    writeFileSync(`${pictures}/${name}-${view}.png`, await browser.screenshot());
    for (const complaint of browser.complaints) console.log(`${name}: ${complaint}`);
  }
  await browser.stop();
}
