#!/usr/bin/env python3
"""The table of docs/combinations.md from the file that `dalembert-fuzz --family products --pairs FILE` writes.

Usage: pairs.py FILE   (a cell: percent of the scenes with both features that ran; blank below ten scenes)
"""
import csv
import sys

pairs, features = {}, []
for row in csv.DictReader(open(sys.argv[1], encoding="utf-8")):
    a, b = row["feature"], row["with"]
    features += [name for name in dict.fromkeys((a, b)) if name not in features]
    pairs[a, b] = pairs[b, a] = row
    if int(row["faults"]):
        sys.exit(f"{a} with {b}: {row['faults']} faults")


def cell(a, b):
    row = pairs.get((a, b))
    if not row or int(row["scenes"]) < 10:
        return ""
    return str(round(100 * int(row["right"]) / int(row["scenes"])))


print("| |" + "|".join(features) + "|")
print("|---|" + "---|" * len(features))
for i, a in enumerate(features):
    print(f"| **{a}** |" + "|".join(cell(a, b) if j <= i else "" for j, b in enumerate(features)) + "|")
