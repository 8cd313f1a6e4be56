#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Flags non-standard wording in texts that users read: literals of four words or more in src/, tools/ and web/src/.

usage: words.py SOURCE_FOLDER
A reminder, not a style checker: CONTRIBUTING.md has the rules, and the replacements are suggestions.
"""
import pathlib
import re
import sys

FLAGGED = {  # pattern -> replacement
    r"\banew\b": "recompute, regenerate, rewrite",
    r"\bmend(s|ed|ing)?\b": "fix, repair",
    r"\b(is|are|was|were) (not )?(left out|looked at|asked for|told)\b": "ignored, skipped; examined; requested; declared",
    r"\bwhat (is|are|was) there\b": "existing data",
    r"\b(any|no|some)body\b": "the reader, the program, another tool",
    r"\b(stays? as (it|they)|as it (was|is)|is not there|asks? for|no longer knows|leans?|which way)\b": "unchanged, kept; missing; requests; tilts; direction",
    r"\b(in the mean|without a say|have no say)\b": "on average, mean; ignored",
    r"(?:^|[.:;] )(What|Of|Those|Whose|Such|Behind|Beside|Which) ": "a sentence with a subject and a verb",
    r"\b\w*(colour|neighbour|grey|centre|normalis|linearis|metres|(in|out|to|up|down)wards)\w*": "American spelling",
}
LITERALS = re.compile(r'//[^\n]*|\'(?:\\.|[^\'\\\n])\'|R"(\w*)\(.*?\)\1"|((?:"(?:\\.|[^"\\\n])*"\s*)+)', re.S)

found = 0
root = pathlib.Path(sys.argv[1])
for path in sorted(path for top in ("src", "tools", "web/src") for path in (root / top).rglob("*") if path.suffix in (".h", ".cpp", ".ts")):
    source = path.read_text(encoding="utf-8")
    for match in LITERALS.finditer(source):
        text = re.sub(r'"\s*"', "", match.group(2) or "").strip().strip('"')
        if len(text.split()) < 4:
            continue
        for pattern, instead in FLAGGED.items():
            for wrong in re.finditer(pattern, text):
                line = source.count("\n", 0, match.start()) + 1
                print(f'{path.relative_to(root)}:{line}: "{wrong.group().strip()}" in "{text[:80]}"; use: {instead}')
                found += 1
sys.exit(1 if found else 0)
