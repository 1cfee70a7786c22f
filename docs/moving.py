#!/usr/bin/env python3
"""Pictures of the built pages lead to the moving pages of the same runs, where these are.  Usage: moving.py DIRECTORY

Fails if a page shows a picture of docs/pictures/runs that no moving page belongs to.
"""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
runs = root / "runs"
pictures = {path.stem for path in (pathlib.Path(__file__).resolve().parent / "pictures" / "runs").glob("*.png")}
linked, still = 0, []


def link(found):
    global linked
    run = found[1].removeprefix("page-")  # a picture of a whole page
    if not (runs / f"{run}.html").exists():
        if found[1] in pictures:
            still.append(found[1])
        return found[0]
    linked += 1
    return f'<a class="moving" href="runs/{run}.html" title="play this run">{found[0]}</a>'


for path in [root / "index.html", *sorted(root.glob("md_*.html"))]:
    text = path.read_text(encoding="utf-8")
    path.write_text(re.sub(r'<img src="([\w.-]+)\.png"[^>]*>', link, text), encoding="utf-8")
if still and runs.is_dir():
    sys.exit("no moving page for: " + ", ".join(f"{name}.png" for name in dict.fromkeys(still)))
print(f"{linked} pictures play")
