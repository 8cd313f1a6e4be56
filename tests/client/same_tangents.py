# SPDX-License-Identifier: MIT
"""same_tangents.py DIFF LEAST: in the output of `tspace diff --json`, at least LEAST of 1000 corners must have tangents
within one degree of each other, and no sign may differ."""
import json
import sys

with open(sys.argv[1], encoding="utf-8") as stream:
    diff = json.load(stream)
tangents = diff["tangents"]
near = sum(count for upper, count in zip(diff["histogramUpperDeg"], tangents["histogram"]) if upper <= 1)
print(f"{near} of {diff['corners']} corners within a degree, {diff['signChanges']} signs differ")
sys.exit(0 if near * 1000 >= int(sys.argv[2]) * diff["corners"] > 0 and diff["signChanges"] == 0 else 1)
