#!/usr/bin/env python3
"""Pictures of the built pages lead to the moving pages of the same runs, where these are.  Usage: moving.py DIRECTORY"""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
linked = 0


def link(found):
    global linked
    if not (root / "runs" / f"{found[1]}.html").exists():
        return found[0]
    linked += 1
    return f'<a class="moving" href="runs/{found[1]}.html" title="play this run">{found[0]}</a>'


for path in root.glob("md_*.html"):
    text = path.read_text(encoding="utf-8")
    path.write_text(re.sub(r'<img src="([\w.-]+)\.png"[^>]*>', link, text), encoding="utf-8")
print(f"{linked} pictures play")
