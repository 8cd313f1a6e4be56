# SPDX-License-Identifier: MIT
"""Enumerations for Rust and C#, and names of choices and of counts for JavaScript, with the comments of C++."""
import re
import textwrap

from names import camel, pascal
from cpp import blocks

SHOWN = ("Method", "Pairing", "Ngons", "OutputDomain", "FrameShape", "NormalWeighting", "FrameFormat", "VAxis", "Green",
         "StoredSign", "Handedness", "Winding")
IN_CSHARP = ("Method", "Pairing", "Ngons", "FrameShape", "NormalWeighting")
REPORTS = ("TangentReport", "SanitizeReport", "NormalReport", "PackReport", "WindingReport")


def _text(entity, own):
    """A comment as one paragraph, with `own` names of enumerators."""
    text = " ".join(part for kind, _, part in blocks(entity.doc) if kind == "text")
    text = re.sub(r"`(\w+)`", lambda found: f"`{own.get(found[1], found[1])}`", text)
    text = text[:1].upper() + text[1:] if re.match(r"[a-z]{2,}[ ,:]", text) else text  # a sentence, not a formula
    return text if not text or text.endswith(".") else f"{text}."


def _members(name, values, entities):
    """(name in C++, name in other languages, number, comment) of each, and the comment of the enumeration."""
    found = [(entity.name.partition("::")[2], pascal(c_name), number, entity) for c_name, number in values.items()
             for entity in entities.values() if entity.owner == name and entity.kind == "enumerator" and entity.value == str(number)]
    own = {cpp_name: shown for cpp_name, shown, _, _ in found}
    return [(*row, _text(entity, own)) for *row, entity in found], _text(entities[name], own)


def rust(model, entities):
    lines = ["// SPDX-License-Identifier: MIT", "//! Choices, with the numbers of the C API. Written by scripts/api."]
    for name in SHOWN:
        rows, text = _members(name, model.enums[name], entities)
        defaults = {entity.value.rpartition("::")[2] for entity in entities.values()
                    if entity.kind == "field" and entity.owner.endswith("Options") and entity.type == name}
        chosen = {row[0] for row in rows} & defaults
        lines += ["", *_wrapped(text, "/// "),
                  f"#[derive(Clone, Copy, Debug, {'Default, ' if chosen else ''}PartialEq, Eq, Hash)]", f"pub enum {name} {{"]
        for cpp_name, member, number, comment in rows:
            lines += _wrapped(comment, "    /// ")
            lines += ["    #[default]"] if cpp_name in chosen else []
            lines.append(f"    {member} = {number},")
        lines.append("}")
    return "\n".join([*lines, ""])


def csharp(model, entities):
    lines = ["// SPDX-License-Identifier: MIT", "// Choices, with the numbers of the C API. Written by scripts/api.", "namespace Tspace", "{"]
    for name in IN_CSHARP:
        rows, text = _members(name, model.enums[name], entities)
        lines += [*_summary(text, "    "), f"    public enum {name} : uint", "    {"]
        for _, member, number, comment in rows:
            lines += [*_summary(comment, "        "), f"        {member} = {number},"]
        lines += ["    }", ""]
    return "\n".join([*lines[:-1], "}", ""])


def _summary(text, indent):
    text = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return _wrapped(f"<summary>{text}</summary>", f"{indent}/// ") if text else []


def _wrapped(text, start):
    return textwrap.wrap(text, 117, initial_indent=start, subsequent_indent=start, break_long_words=False, break_on_hyphens=False)


def javascript(model, entities):
    """Names of choices in the order of their numbers, and of the numbers of reports in the order of their fields."""
    lines = ["// SPDX-License-Identifier: MIT", "// Names of choices, and of numbers of reports. Written by scripts/api."]
    for name in SHOWN[:7]:
        word = (lambda value: value.lower()) if name == "FrameFormat" else camel
        lines += _list(f"{camel_first(name)}Names", (word(value) for value in model.enums[name]))
    for name in REPORTS:
        fields = (entity.name.partition("::")[2] for entity in entities.values()
                  if entity.owner == name and entity.kind in ("field", "method"))
        lines += _list(f"{camel_first(name)}Names", (camel(field.removesuffix("_deg")) if "_" in field else field for field in fields))
    return "\n".join([*lines, ""])


def camel_first(name):
    return name[:1].lower() + name[1:]


def _list(name, words):
    text = ", ".join(f'"{word}"' for word in words) + ","
    return [f"export const {name} = [", *textwrap.wrap(text, 118, initial_indent="  ", subsequent_indent="  "), "];"]
