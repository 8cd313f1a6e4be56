#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""figures.py SOURCE_FOLDER: figures of README and of the pages about other libraries equal those of the tables they cite.

Every figure with a unit on these pages must be listed below, either with its source or as an original figure of that page.
"""
import pathlib
import re
import sys

docs = pathlib.Path(sys.argv[1])
PAGES = ["README.md", "docs/guides/from-mikktspace.md", "docs/guides/from-meshoptimizer.md",
         *sorted(str(page.relative_to(docs)) for page in (docs / "docs/problems").glob("*.md"))]
SOURCE = "docs/evidence/performance.md"

# Columns of the table "Comparison" in SOURCE.
LOOP, REFERENCE, MESHOPT, ONE, TWO, CORRECTED = range(1, 7)
# Claims: (page, pattern whose groups are figures, sources of these figures). A source is (row, column) of a table of
# SOURCE, or a pattern with one group.
MILLION = "torus, 1 million"
CLAIMS = [
    ("README.md", r"\| torus of 1 million triangles, one thread \| \*\*(\d+) ms\*\* \| (\d+) ms \| (\d+) ms",
     [(MILLION, ONE), (MILLION, MESHOPT), (MILLION, REFERENCE)]),
    ("README.md", r"\| GLB file of 496,000 triangles \| \*\*(\d+) ms\*\* \| (\d+) ms \| \| (\d+) ms",
     [("Market, 496,000", 1), ("Market, 496,000", 2), ("Market, 496,000", 3)]),
    ("README.md", r"0 of ([\d,]+) random meshes differ", [r"on ([\d,]+) small random ones, tspace differs from the reference at no"]),
    ("README.md", r"all \| (0\.1) to (3) %; most", [r"meshoptimizer differs at 97 to (99\.9) %", r"meshoptimizer differs at (97) to"]),
    ("docs/guides/from-mikktspace.md", r"adds (\d+) KB to a program, (\d+) KB with `-Wl,--gc-sections`",
     [r"`generateTangents` with all methods adds (\d+) KB", r"stripped, and (\d+) KB where the"]),
    ("docs/guides/from-mikktspace.md", r"`mikktspace.c` adds (\d+) KB", [r"mikktspace\.c (\d+) KB"]),
    ("docs/guides/from-mikktspace.md", r"with the same bits: (\d+) KB", [r"`generateTangents` add (\d+) KB"]),
    ("docs/guides/from-mikktspace.md", r"the reference takes (\d+) ns per triangle, and `generateTangents` on arrays (\d+) ns", [(MILLION, REFERENCE), (MILLION, ONE)]),
    ("docs/guides/from-mikktspace.md", r"compared on ([\d,]+) small random meshes", [r"on ([\d,]+) small random ones, tspace differs from the reference at no"]),
    ("docs/guides/from-meshoptimizer.md", r"(0\.1) to (3) % of the corners with the same bits, (0\.06) degrees at most",
     [r"meshoptimizer differs at 97 to (99\.9) %", r"meshoptimizer differs at (97) to", r"by at most (0\.06) degrees on clean meshes"]),
    ("docs/guides/from-meshoptimizer.md", r"torus of 1 million triangles \| (\d+) ns per triangle \| \*\*(\d+) ns\*\*, two threads (\d+)",
     [(MILLION, MESHOPT), (MILLION, ONE), (MILLION, TWO)]),
    ("docs/guides/from-meshoptimizer.md", r"models of up to 50 triangles \| \*\*(\d+) ns\*\* \| (\d+) ns",
     [("98 primitives of up to 50 triangles", MESHOPT), ("98 primitives of up to 50 triangles", ONE)]),
    ("docs/guides/from-meshoptimizer.md", r"models of 51 to 500 triangles \| (\d+) ns \| \*\*(\d+) ns\*\*", [("45 of 51 to 500", MESHOPT), ("45 of 51 to 500", ONE)]),
    ("docs/guides/from-meshoptimizer.md", r"without outputs \| (\d+) bytes per triangle \| \*\*(\d+)\*\*",
     [r"meshoptimizer (\d+), tspace \d+ \(", r"meshoptimizer \d+, tspace (\d+) \("]),
    ("docs/guides/from-meshoptimizer.md", r"\*\*(\d+) KB; less than (\d+) s\*\* \| (\d+) KB; (\d+) s of processor",
     [r"meshoptimizer's file adds (\d+) KB", r"file take less than (\d+) s each", r"`generateTangents` with all methods adds (\d+) KB", r"two-files\.md\) takes (\d+) s of"]),
]
# SOURCE states shares of corners that differ; pages state the complements, shares of equal corners (97 % differ, so 3 %
# are equal).
COMPLEMENTS = {("0.1", "99.9"), ("3", "97")}
# Figures of pages that need no source: properties of a format, or results whose measurement and command the page
# states.
OWN = {
    # sizes of one model; the page states the command
    "docs/problems/file-became-larger.md": {"23.0 MB", "32.6 MB", "25.5 MB", "13.0 MB"},
    "README.md": {"33.3 %", "100.0 %"},  # output of commands on the demo model
    "docs/guides/from-mikktspace.md": {"8 MB"},  # the size of a thread's stack
    "docs/guides/from-meshoptimizer.md": {"100 %"},  # `identify` on three models
}
UNIT = r"(?<![\w.,])(\d[\d,.]*\d|\d)\s?(ns|ms|s|KB|MB|GB|%|times|degrees)\b|(?<![\w.,])(\d[\d,.]*\d|\d)\s?%"

faults = []
text = {page: (docs / page).read_text(encoding="utf-8") for page in PAGES + [SOURCE]}


def cell(row, column):
    for line in text[SOURCE].splitlines():
        cells = [one.strip().strip("*") for one in line.strip().strip("|").split("|")]
        if cells[0] == row and column < len(cells):
            return re.match(r"[\d.,]+|", cells[column]).group()
    return None


def source_of(source):
    if isinstance(source, tuple):
        return cell(*source)
    found = re.search(source, text[SOURCE].replace("\n", " "))
    return found.group(1) if found else None


claimed = {page: [] for page in PAGES}
for page, pattern, sources in CLAIMS:
    found = re.search(pattern.replace(" ", r"\s+"), text[page])
    if not found:
        faults.append(f"{page}: no text like {pattern}")
        continue
    claimed[page].append(found.span())
    for figure, source in zip(found.groups(), sources, strict=True):
        expected = source_of(source)
        if expected != figure and (figure, expected) not in COMPLEMENTS:
            faults.append(f"{page}: {figure} where {SOURCE} has {expected} ({source})")
for page in PAGES:
    prose = re.sub(r"```.*?```", lambda code: " " * len(code.group()), text[page], flags=re.S)
    for found in re.finditer(UNIT, prose):
        if found.group() in OWN.get(page, ()) or any(begin <= found.start() < end for begin, end in claimed[page]):
            continue
        faults.append(f"{page}: '{found.group()}' has no source in tests/docs/figures.py")
print("\n".join(faults) or f"{sum(len(one[2]) for one in CLAIMS)} figures are those of {SOURCE}")
sys.exit(bool(faults))
