#!/usr/bin/env python3
"""Doxygen's filter. In headers: members that every element has by its concept are documented here, once.

A constraint or force states points(), its equation, and if it likes kind, meaning, singular and fault().
In pages: pictures are found by their names, and the sections of the front page are no part of the navigation.
"""
import re
import sys

ALIKE = [
    (r"static constexpr (std::string_view|const char\*) kind\b", "Its name in errors and reports."),
    (r"static constexpr std::string_view meaning\b", "Meaning and sign of its multipliers, for `report`."),
    (r"static constexpr std::string_view singular\b", "Why it may have no gradient somewhere, for errors."),
    (r"static constexpr bool velocity_level\b", "Its equation is one of velocities: nonholonomic."),
    (r"static constexpr bool turns\b", "It leaves a turn about its axis free, which `angle` reads."),
    (r"static constexpr bool slides\b", "It leaves a travel along its axis free, which `travel` reads."),
    (r"static constexpr bool internal\b", "Part of how a body is built."),
    (r"static constexpr int dimension\b", "Of its positions."),
    (r"static constexpr int inputs\b", "How many numbers an equation differentiates it by."),
    (r"static constexpr int coordinates\b", "How many coordinates of the scene it reads."),
    (r"static constexpr bool driven\b", "Whether its position depends on time by itself."),
    (r"(auto|decltype\(auto\)) points\(\) const", "The points that its equation is called with, in this order."),
    (r"auto operator\(\)\(const auto&", "Its equation, for any scalar type."),
    (r"auto energy\(const auto&", "Its potential energy, for any scalar type."),
    (r"auto force\(const auto&", "Its law, the force on each of its points, for any scalar type."),
    (r"auto friction\(const auto&", "Its law, the force on each of its points, for any scalar type."),
    (r"(static )?(auto|Vec<\w+>|VecOf<.*>) normal_at\(", "The normal of unit length."),
    (r"auto prepared\(\) const", "Its equation with everything computed that does not depend on position."),
    (r"(\[\[nodiscard\]\] )?std::string fault\(\) const", "Which of its parameters makes no sense, and why; empty if none."),
    (r"(auto|Sketch(<\w+>)?) sketch\(", "How a page that plays a run draws it."),
    (r"JointFrames<A, B> frames;", "The frames that it holds together, one on each body."),
    (r"[A-Z]\w*\(.*\) -> [A-Z]\w*<.*>;", "Deduces the types of its points."),
    (r"[A-Z]\w* (a|b|c|point|centre|start|end|bilateral|rigid|slip);", "As it was stated."),
]

# Variables of one declaration share its comment.
SEVERAL = re.compile(r"(\s*)((?:[\w:]+(?:<[^;=]*>)?) )(\w+[^,;()]*(?:, \w+[^,;()]*)+);\s*///< ?(.*)")

text = open(sys.argv[1], encoding="utf-8").read()
if sys.argv[1].endswith(".md"):
    text = text.replace("](../pictures/runs/", "](").replace("](pictures/runs/", "](")
    if sys.argv[1].endswith("/README.md") and "core/" not in sys.argv[1]:
        text = re.sub("^## (.*)$", r"<h1>\1</h1>", text, flags=re.M)
    print(text, end="")
    sys.exit()
# What is compiled in the library is documented where it is defined.
text = re.sub(r"^extern template [^;]*;", lambda found: "\n" * found[0].count("\n"), text, flags=re.M)
if sys.argv[1].endswith("core/results/readings.h"):
    ALIKE.append((r"(double|auto|bool|Multiplier<Rows>) \w+\(", "The function of this name of Sample, at the sample that the last "
                                                               "argument numbers."))
lines = text.split("\n")
for i, line in enumerate(lines):
    several = SEVERAL.fullmatch(line)
    if several:
        indent, kind, names, text = several.groups()
        lines[i] = indent + " ".join(f"/** {text} */ {kind}{name};" for name in names.split(", "))
        continue
    before = i
    while before and lines[before - 1].lstrip().startswith(("template", "requires")):
        before -= 1
    if not (before and lines[before - 1].lstrip().startswith("///")) and "///<" not in line:
        for pattern, text in ALIKE:
            if re.match(r"\s*(\[\[nodiscard\]\] )?" + pattern, line):
                # On the same line, so that the numbers of lines stay.
                lines[before] = f"/** {text} */ " + lines[before]
                break
print("\n".join(lines), end="")
