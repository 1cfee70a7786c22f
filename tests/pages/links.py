#!/usr/bin/env python3
"""Every link and picture within the built pages leads somewhere, and no markdown is left in them.  Usage: links.py DIRECTORY"""
import html.parser
import pathlib
import re
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.left, self.code = set(), [], [], 0
        self.feed(text)

    def handle_data(self, data):
        if not self.code and (re.search(r"\w\]\([\w./#-]+\)", data) or "`" in data or "**" in data):
            self.left.append(" ".join(data.split()))

    def handle_endtag(self, tag):
        self.code -= tag in ("code", "pre", "script")

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.code += tag in ("code", "pre", "script")
        for key in ("id", "name"):
            if attributes.get(key):
                self.anchors.add(attributes[key])
        for key in ("href", "src"):
            if attributes.get(key):
                self.links.append(attributes[key])


root = pathlib.Path(sys.argv[1])
pages = {path.relative_to(root).as_posix(): Page(path.read_text(encoding="utf-8", errors="replace"))
         for path in root.rglob("*.html") if "search" not in path.parts}
faults, checked = [], 0
for name, page in pages.items():
    if name == "index.html" or name.startswith("md_"):  # in single backticks an apostrophe ends code
        faults += [f"{name}: markdown is left in: {text}" for text in page.left]
    for link in page.links:
        url = urllib.parse.urlsplit(link)
        if url.scheme or url.netloc or link.startswith(("javascript:", "//")):
            continue
        target = name if not url.path else (pathlib.PurePosixPath(name).parent / urllib.parse.unquote(url.path)).as_posix()
        checked += 1
        if not (root / target).exists():
            faults.append(f"{name}: no file {target}")
        elif url.fragment and target in pages and urllib.parse.unquote(url.fragment) not in pages[target].anchors:
            faults.append(f"{name}: no place #{url.fragment} in {target}")
for fault in sorted(set(faults)):
    print(fault, file=sys.stderr)
print(f"{checked} links of {len(pages)} pages")
sys.exit(1 if faults or not pages else 0)
