#!/usr/bin/env python3
"""Measures the sentences of pages: half have at most 18 words, nine of ten at most 32.

Usage: prose.py [--headers] PAGE...   (--headers: comments `///` of C++ headers instead, measured only)
Code, tables and headings are no sentences; a piece of inline code, or a link, counts as one word.
"""
import re
import statistics
import sys

MEDIAN, NINETIETH = 18, 32

# Translated syntax that this project's texts once had; one line for each habit.
DIALECT = [
    r"\banew\b",
    r"\band so\b(?! on)",
    r"\bas it is\b",
    r"\b(hears?|heard)\b",
    r"\b(tells?|told)\b",
    r"\b(says?|said)\b",
    r"\b(its|their) own\s*[.,;:)]",
    r"(?<![.?!:] )(?<!^)\bwhat is\b",
    r"\bof no account\b",
    "\N{EM DASH}",
]


def paragraphs_of_page(text):
    text = re.sub(r"^---\n.*?^---\n", "", text, flags=re.S | re.M)
    text = re.sub(r"```.*?```", "\n\n", text, flags=re.S)
    text = re.sub(r"<[^>\n]*>", " ", text)
    for block in re.split(r"\n\s*\n", text):
        lines = block.split("\n")
        if all(line.startswith("    ") for line in lines if line.strip()):
            continue  # code
        text_of_item = ""
        for line in lines:
            if re.match(r"\s*(#|\|)", line):
                line = "\n"
            if re.match(r"\s*([-*]|\d+\.)\s", line):
                yield text_of_item
                text_of_item = re.sub(r"^\s*([-*]|\d+\.)\s", "", line)
            else:
                text_of_item += " " + line.strip()
        yield text_of_item


def paragraphs_of_header(text):
    block = []
    for line in text.split("\n") + [""]:
        comment = re.match(r"\s*(?:.*\S\s+)?///<?(.*)", line)
        if comment and comment[1].strip() and not comment[1].startswith("   "):
            block.append(comment[1].strip())
        else:
            yield " ".join(block)
            block = []


def sentences_of(paragraph):
    paragraph = re.sub(r"`[^`]*`", "X", paragraph)
    paragraph = re.sub(r"!\[[^\]]*\]\([^)]*\)", " ", paragraph)
    paragraph = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", paragraph)
    for sentence in re.split(r"(?<=[.!?])[)\"*]*\s+(?=[A-Z(\"*`])", paragraph):
        if len(re.findall(r"[A-Za-z]", sentence)) > 1:
            yield sentence.strip()


def main():
    headers = "--headers" in sys.argv
    files = [name for name in sys.argv[1:] if name != "--headers"]
    lengths, faults, longest = [], [], (0, "", "")
    for name in files:
        text = open(name, encoding="utf-8").read()
        of_file = []
        for paragraph in (paragraphs_of_header if headers else paragraphs_of_page)(text):
            for sentence in sentences_of(paragraph):
                words = len(re.findall(r"\S*\w\S*", sentence))
                of_file.append(words)
                longest = max(longest, (words, name, sentence))
                for habit in DIALECT:
                    found = re.search(habit, sentence, re.I)
                    if found:
                        faults.append(f'{name}: "{found[0]}" in: {sentence}')
        if of_file:
            of_file.sort()
            print(f"{name}: {len(of_file)} sentences, median {statistics.median(of_file):g}, "
                  f"90th percentile {of_file[int(0.9 * (len(of_file) - 1))]}, longest {of_file[-1]}")
        lengths += of_file
    lengths.sort()
    median, ninetieth = statistics.median(lengths), lengths[int(0.9 * (len(lengths) - 1))]
    print(f"all: {len(lengths)} sentences, median {median:g} words, 90th percentile {ninetieth}, longest {longest[0]}: "
          f"{longest[1]}: {longest[2]}")
    if headers:
        return 0
    if median > MEDIAN or ninetieth > NINETIETH:
        faults.append(f"sentences are too long: half may have {MEDIAN} words, nine of ten {NINETIETH}")
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


sys.exit(main())
