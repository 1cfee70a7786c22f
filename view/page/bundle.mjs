// Puts src/ and its libraries into page.html; see bundle.sh.
import { buildSync } from "esbuild";
import { readFileSync, writeFileSync } from "node:fs";

const read = (path) => readFileSync(path, "utf8");
const bundled = (entry, loader) => {
  const result = buildSync({
    entryPoints: [entry], bundle: true, minify: true, write: false, format: "iife", target: "es2020", loader,
    legalComments: "none", charset: "ascii",
  });
  return result.outputFiles[0].text.trim();
};

const licences = ["three", "uplot"].map((name) => {
  const { version } = JSON.parse(read(`node_modules/${name}/package.json`));
  return `${name} ${version}\n\n${read(`node_modules/${name}/LICENSE`).trim().replaceAll("\u00a9", "(c)")}`;
});
const notice = `<!-- This page contains:\n\n${licences.join("\n\n")}\n-->`;
// No text of a script may end it.
const script = bundled("src/main.js").replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
const style = bundled("src/all.css");
const page = read("src/page.html")
  .replace("/*STYLE*/", () => style)
  .replace("/*SCRIPT*/", () => script)
  .replace("<html", () => `${notice}\n<html`);
if (/[^\x00-\x7f]/.test(page)) throw new Error("page.html must be ASCII: write other characters as entities");
writeFileSync("page.html", page);
console.log(`page.html: ${Math.round(page.length / 1024)} KiB`);
