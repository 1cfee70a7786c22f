#!/usr/bin/env python3
"""Every message that the page quotes still occurs in the sources.  Usage: messages.py PAGE ROOT

A message is the first cell of a table, as inline code; "..." in it stands for what varies.
"""
import pathlib
import re
import sys

page, root = sys.argv[1:]
literal = r'"((?:[^"\\\n]|\\.)*)"'
texts = []
for room in ("core", "constraints", "solvers", "sweep"):
    for path in sorted((pathlib.Path(root) / room).rglob("*")):
        if path.suffix in (".h", ".cpp"):
            source = re.sub(r"^\s*//.*$", "", path.read_text(encoding="utf-8"), flags=re.M)
            for run in re.finditer(literal + r"(?:\s*" + literal + ")*", source):
                texts.append("".join(re.findall(literal, run[0])).replace('\\"', '"'))
everything = "\n".join(texts)

quoted, faults = 0, []
for line in open(page, encoding="utf-8"):
    message = re.match(r"\| ``?([^`]*)``? \|", line)
    if not message or " " not in message[1]:
        continue
    quoted += 1
    for piece in message[1].split("..."):
        if piece.strip() and piece.strip() not in everything:
            faults.append(f'no source has "{piece.strip()}"')
print(f"{quoted} messages")
for fault in faults:
    print(fault, file=sys.stderr)
sys.exit(1 if faults or not quoted else 0)
