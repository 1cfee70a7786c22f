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
    const page = window.dalembert, { player, run, stage } = page;
    const seek = (part) => { player.seek(run.start + part * (run.end - run.start)); page.update(); };
    const arrows = () => stage.arrows.all.filter((one) => one.group.visible).reduce((sum, one) => sum + one.tip.distanceTo(one.tail), 0);
    // In the middle of the run, where the forces are larger than at three of four instants.
    const instants = Array.from({ length: 31 }, (_, k) => 0.2 + 0.02 * k).map((part) => { seek(part); return [arrows(), part]; });
    seek(instants.sort(([a], [b]) => a - b)[23][1]);
    document.getElementById("view-buttons").style.visibility = "hidden";
    const { x, y, width, height } = document.getElementById("stage").getBoundingClientRect();
    return { x, y, width, height, scale: 1 };
  })()`);
  await pause(200);
  const { data } = await browser.send("Page.captureScreenshot", { format: "png", clip });
  writeFileSync(`${pictures}/${file.replace(/html$/, "png")}`, Buffer.from(data, "base64"));
}
await browser.stop();
