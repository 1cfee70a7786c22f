// Pictures of the models' runs for the gallery and the lecture, of pages that `dalembert-bench pages` wrote.
//
//   node docs/pictures.mjs <chromium> <folder of pages> <folder of pictures>
import { mkdirSync, readdirSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";

import { Browser, pause } from "../tests/page/browser.mjs";

const [, , executable, pages, pictures] = process.argv;
mkdirSync(pictures, { recursive: true });
const browser = await Browser.start(executable, { width: 640, height: 640 });
for (const file of readdirSync(pages).filter((name) => name.endsWith(".html") && name !== "index.html")) {
  await browser.open(`file://${resolve(pages)}/${file}`);
  const clip = await browser.evaluate(`(() => {
    const { player, run } = window.dalembert;
    player.seek(run.start + 0.37 * (run.end - run.start));
    document.getElementById("view-buttons").style.visibility = "hidden";
    const { x, y, width, height } = document.getElementById("stage").getBoundingClientRect();
    return { x, y, width, height, scale: 1 };
  })()`);
  await pause(200);
  const { data } = await browser.send("Page.captureScreenshot", { format: "png", clip });
  writeFileSync(`${pictures}/${file.replace(/html$/, "png")}`, Buffer.from(data, "base64"));
}
await browser.stop();
