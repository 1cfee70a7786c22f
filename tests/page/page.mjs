// Opens pages that dalembert-pages wrote in Chromium and uses them as a reader does.
//
//   node tests/page/page.mjs <chromium> <folder with pendulum.html and door.html>
import { strict as assert } from "node:assert";
import { statSync } from "node:fs";
import { resolve } from "node:path";

import { Browser, pause } from "./browser.mjs";

const [, , executable, folder] = process.argv;
const url = (name) => `file://${resolve(folder)}/${name}.html`;

// sn, cn, dn by the arithmetic-geometric mean (Abramowitz and Stegun 16.4).
function jacobi(u, k) {
  const a = [1], c = [k];
  let b = Math.sqrt(1 - k * k);
  while (Math.abs(c.at(-1)) > 1e-16) {
    const last = a.at(-1);
    a.push((last + b) / 2);
    c.push((last - b) / 2);
    b = Math.sqrt(last * b);
  }
  let phi = 2 ** (a.length - 1) * a.at(-1) * u, before = phi;
  for (let n = a.length - 1; n > 0; --n) {
    before = phi;
    phi = (phi + Math.asin((c[n] / a[n]) * Math.sin(phi))) / 2;
  }
  return { cn: Math.cos(phi), dn: Math.cos(phi) / Math.cos(before - phi) };
}
// The pendulum of pages.cpp from rest at a right angle: sin(phi/2) = k cd(sqrt(g/l) t, k), k = sin(pi/4), and by its
// energy the tension m (l phi'^2 + g cos phi) = 3 m g cos phi.
function pendulum(t) {
  const m = 2, l = 1.5, g = 9.81, k = Math.SQRT1_2, { cn, dn } = jacobi(Math.sqrt(g / l) * t, k);
  const half = Math.asin((k * cn) / dn), cosine = Math.cos(2 * half), sine = Math.sin(2 * half);
  return { place: [l * sine, -l * cosine], force: [-3 * m * g * cosine * sine, 3 * m * g * cosine * cosine] };
}

// The first arrow as it is drawn: from its tail to the tip of its head, in lengths of the scene and in pixels.
const drawn = `(() => {
  const { stage } = window.dalembert, arrow = stage.arrows.all[0];
  stage.scene.updateMatrixWorld(true);
  const tip = arrow.tip.clone().set(0, 1, 0).applyMatrix4(arrow.heads[0].matrixWorld);
  const tail = arrow.tail.clone().setFromMatrixPosition(arrow.group.matrixWorld);
  const legend = document.querySelector("#force-scale");
  return { tail: tail.toArray(), tip: tip.toArray(), scale: stage.arrows.forceScale,
           screen: [stage.project(tail), stage.project(tip)],
           legend: { pixels: Number(legend.querySelector("svg").getAttribute("width")) - 2,
                     force: parseFloat(legend.querySelector("span").textContent) } };
})()`;

async function arrowsAreTheForces(browser) {
  for (const row of [137, 401, 862]) {
    const t = await browser.evaluate(`{ const p = window.dalembert; p.player.seekRow(${row}); p.update(); p.player.t; }`);
    const arrow = await browser.evaluate(drawn), { place, force } = pendulum(t);
    const error = await browser.evaluate(`{ const { run } = window.dalembert; run.at(run.constraints[0].error, ${row}) }`);
    const size = Math.hypot(...force);
    assert.ok(size > 1, "an instant at which there is a force to see");
    assert.ok(error > 0 && error < 1e-5 * size, `the error of the force is known: ${error}`);
    // A true error is below five estimated ones (bench/checks/certificates.cpp finds all of them so); the direction is off by
    // that of the place, which is smaller, and doubles of the GPU's matrices are not used here.
    for (const k of [0, 1]) {
      assert.ok(Math.abs(arrow.tail[k] - place[k]) < 1e-6, `the arrow begins at the bob at t = ${t}`);
      const seen = (arrow.tip[k] - arrow.tail[k]) / arrow.scale;
      assert.ok(Math.abs(seen - force[k]) < 5 * error + 1e-12 * size, `component ${k} of the arrow at t = ${t}: ${seen}, not ${force[k]}`);
    }
    const [a, b] = arrow.screen, pixels = Math.hypot(b[0] - a[0], b[1] - a[1]);
    const byLegend = (pixels / arrow.legend.pixels) * arrow.legend.force;
    assert.ok(Math.abs(byLegend - size) < 1e-6 * size, `by its legend the arrow says ${byLegend}, not ${size}`);
    assert.ok(b[1] < a[1], "what holds the bob points up on the screen");
  }
}

async function plays(browser) {
  const time = () => browser.evaluate("window.dalembert.player.t");
  await browser.press("Home");
  assert.equal(await time(), 0);
  await browser.press(" ");
  await browser.until("window.dalembert.player.t > 0.2");
  await browser.press(" ");
  const stopped = await time();
  await pause(200);
  assert.equal(await time(), stopped, "the space key stops it");
  await browser.press("End");
  assert.equal(await time(), 10);
  await browser.press("ArrowLeft");
  const row = await browser.evaluate("window.dalembert.player.row");
  await browser.press("ArrowRight");
  assert.equal(await browser.evaluate("window.dalembert.player.row"), row + 1);
  const speed = await browser.evaluate("window.dalembert.player.speed");
  await browser.press("+");
  assert.equal(await browser.evaluate("window.dalembert.player.speed"), 2 * speed);
  await browser.press("-");
}

// It moves when it is opened, and begins again at its end.
async function startsByItself() {
  const own = await Browser.start(executable, { width: 800, height: 600, motion: "no-preference" });
  try {
    await own.open(url("pendulum"));
    await own.until("window.dalembert.player.t > 0.1");
    await own.evaluate("window.dalembert.player.seek(9.9)");
    await own.until("window.dalembert.player.t < 5");
    assert.ok(await own.evaluate("window.dalembert.player.playing"));
    await own.press("r");
    await own.evaluate("window.dalembert.player.seek(9.9)");
    await own.until("!window.dalembert.player.playing && window.dalembert.player.t === 10");
  } finally {
    await own.stop();
  }
}

async function scrubs(browser) {
  const middle = await browser.evaluate(`(() => { const r = document.getElementById("time").getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; })()`);
  await browser.click(...middle);
  const t = await browser.evaluate("window.dalembert.player.t");
  assert.ok(Math.abs(t - 5) < 0.1, `the middle of the slider is the middle of the run: ${t}`);
  const plot = await browser.evaluate(`(() => { const r = document.querySelector(".u-over").getBoundingClientRect(); return [r.x + 0.25 * r.width, r.y + r.height / 2]; })()`);
  await browser.click(...plot);
  const there = await browser.evaluate("window.dalembert.player.t");
  assert.ok(Math.abs(there - 2.5) < 0.1, `a click on a plot goes there: ${there}`);
}

async function stepsByEvent(browser) {
  await browser.press("Home");
  await browser.press("n");
  const { t, x, said } = await browser.evaluate(`(() => { const p = window.dalembert; p.update(); return { t: p.player.t, x: p.stage.frame.positions[0], said: document.getElementById("live").textContent }; })()`);
  assert.ok(t > 0.5 && t < 1 && Math.abs(x) < 1e-7, `at the first event the bob is at its lowest: x = ${x} at t = ${t}`);
  assert.match(said, /lowest/);
  await browser.press("p");
  assert.equal(await browser.evaluate("window.dalembert.player.row"), 0);
}

async function picks(browser) {
  const [x, y] = await browser.evaluate(`(() => {
    const p = window.dalembert; p.player.seekRow(862); p.update();
    const r = document.getElementById("stage").getBoundingClientRect(), one = p.stage.arrows.all[0];
    const a = p.stage.project(one.tail), b = p.stage.project(one.tip);
    return [r.x + (a[0] + b[0]) / 2, r.y + (a[1] + b[1]) / 2];
  })()`);
  await browser.click(x, y);
  await browser.until("document.getElementById('picked-name').textContent !== ''");
  const text = await browser.evaluate("document.getElementById('picked').textContent");
  assert.match(text, /rod.*\u03bb = .*\u00b1.* N; unique/s);
  await browser.press("Escape");
  await browser.until("document.getElementById('picked').hidden");
}

async function saysWhatIsNotUnique(browser) {
  await browser.open(url("door"));
  assert.equal(await browser.evaluate("document.title"), '</script><b>door & "hinges"');
  assert.equal(await browser.evaluate("document.querySelectorAll('h1 b, .label i').length"), 0, "names are no HTML");
  const row = await browser.evaluate(`(() => { const p = window.dalembert; p.select(p.run.constraints[0]); p.update(); return document.getElementById("picked").textContent; })()`);
  assert.match(row, /lower <hinge>.*not unique/s);
}

async function undeterminedIsNoZero(browser) {
  const seen = await browser.evaluate(`(() => {
    const p = window.dalembert, one = p.stage.arrows.all.findLast((a) => !a.arrow.torque);
    for (const column of [...one.arrow.force, ...one.constraint.lambda]) p.run.columns[column] = new Float64Array([NaN]);
    p.select(one.constraint); p.update();
    return { arrow: one.group.visible, marks: document.querySelectorAll(".unknown:not([hidden])").length,
             picked: document.getElementById("picked").textContent };
  })()`);
  assert.equal(seen.arrow, false);
  assert.equal(seen.marks, 1, "a question mark stands in its place");
  assert.match(seen.picked, /not determined/);
}

async function fitsOnAPhone(browser) {
  await browser.resize(390, 844);
  await pause(200);
  assert.ok(await browser.evaluate("document.documentElement.scrollWidth <= window.innerWidth"), "nothing sticks out");
}

async function hasTwoThemes(browser) {
  const theme = () => browser.evaluate("document.documentElement.dataset.theme");
  assert.equal(await theme(), "dark", "as the system asks for");
  await browser.press("d");
  assert.equal(await theme(), "light");
}

async function namesItsControls(browser) {
  const bare = await browser.evaluate(`[...document.querySelectorAll("button, input, select, canvas, [role=img]")]
    .filter((e) => !e.closest(".plot") || e.matches(".plot"))
    .filter((e) => !(e.textContent.trim() || e.getAttribute("aria-label"))).map((e) => e.outerHTML)`);
  assert.deepEqual(bare, []);
}

const browser = await Browser.start(executable, { width: 1200, height: 760, scheme: "dark" });
let failed = 0;
try {
  await browser.open(url("pendulum"));
  for (const test of [arrowsAreTheForces, plays, scrubs, stepsByEvent, picks, hasTwoThemes, namesItsControls, saysWhatIsNotUnique, undeterminedIsNoZero, fitsOnAPhone, startsByItself]) {
    try {
      await test(browser);
      assert.deepEqual(browser.complaints, [], "the console shows no error");
      console.log(`ok ${test.name}`);
    } catch (error) {
      ++failed;
      console.log(`FAILED ${test.name}: ${error.message}`);
    }
  }
  console.log(`the page of 1001 samples has ${statSync(resolve(folder, "pendulum.html")).size} bytes`);
} finally {
  await browser.stop();
}
process.exit(failed === 0 ? 0 : 1);
