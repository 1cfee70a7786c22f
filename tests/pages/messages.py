#!/usr/bin/env python3
"""The page of messages and the sources agree.  Usage: messages.py PAGE ROOT

On the page a message is the first cell of a table, as inline code; "..." in it stands for what varies.
1. Every message that the page quotes still occurs in the sources.
2. Every statement of the sources with a text of three words or more contains a part that the page quotes, of at
   least two words. Meanings of multipliers, file formats and numbers by name are no messages: see NONE.
"""
import pathlib
import re
import sys

NONE = [
    r"^core/analysis/describe\.cpp",  # the report of a scene, docs/redundancy.md
    r"^core/results/(audit|csv|statistics|event)\.cpp",  # names of laws, a file, a report, verbs
    r"^core/scene/system\.cpp: return",  # "one of the ...", a label
    r"^view/glb\.cpp: static_assert",  # of the machine
    r"^core/equations/constraint\.h: return",  # the meaning of multipliers in general
    r"^solvers/audit/ledger_keeper\.cpp",  # names of accounts
    r"^solvers/certificate/(statement|work_precision)\.cpp: (error_in|out <<)",  # a table and a file
    r"^solvers/ida/newton_matrix\.cpp: return",  # which linear algebra was used
    r"^solvers/lagrange/cross_check\.cpp: line",  # a table
    r"^(view|sweep)/.*(json\.member|account\(|constexpr char magic|OMPI_)",
    r"^sweep/csv_table\.cpp: .*line\.starts_with",  # bytes of an encoding
    r" meaning = ",
]
LITERAL = r'"(?:[^"\\\n]|\\.)*"'
RUN = re.compile(f"{LITERAL}(?:\\s*{LITERAL})*")  # neighbours are one text


def statements(source):
    """What ends at a semicolon or brace, comments and directives left out, texts as they are."""
    source = re.sub(rf"({LITERAL})|//[^\n]*", lambda found: found[1] or "", source)
    source = re.sub(r"^\s*#.*$", "", source, flags=re.M)
    one = ""
    for piece in re.split(f"({LITERAL})", source):
        first, *others = [piece] if piece.startswith('"') else re.split("[;{}]", piece)
        one += first
        for other in others:
            yield one
            one = other
    yield one


def texts_of(statement):
    return ["".join(text[1:-1] for text in re.findall(LITERAL, run)).replace('\\"', '"') for run in RUN.findall(statement)]


page, root = sys.argv[1], pathlib.Path(sys.argv[2])
all_texts, messages = [], []
for room in ("core", "constraints", "solvers", "view", "sweep"):
    for path in sorted((root / room).rglob("*")):
        if path.suffix not in (".h", ".cpp"):
            continue
        for statement in statements(path.read_text(encoding="utf-8")):
            texts = texts_of(statement)
            all_texts += texts
            where = f"{path.relative_to(root)}: {' '.join(statement.split())}"
            if any(len(re.findall("[A-Za-z]{2,}", text)) >= 3 for text in texts) and not any(re.search(none, where) for none in NONE):
                messages.append((where, texts))

quoted = []
for line in open(page, encoding="utf-8"):
    cell = re.match(r"\| (``?)(.*?)\1 \|", line)
    if cell and " " in cell[2]:
        quoted.append([piece.strip() for piece in cell[2].split("...") if piece.strip()])
everything = "\n".join(all_texts)
faults = [f'no source has "{piece}"' for pieces in quoted for piece in pieces if piece not in everything]
telling = [piece for pieces in quoted for piece in pieces if re.search(r"\w\W*\s\W*\w", piece)]
faults += [f"not on the page: {where}" for where, texts in messages if not any(piece in text for piece in telling for text in texts)]
print(f"{len(quoted)} messages of the page, {len(messages)} of the sources")
for fault in faults:
    print(fault, file=sys.stderr)
sys.exit(1 if faults or not quoted else 0)
