# SPDX-License-Identifier: MIT
"""Generates choices, options and reports for Rust, C#, Python and JavaScript, with the comments of the C++ headers."""
import re
import textwrap

from cpp import blocks
from names import camel, pascal, snake
from twins import PHRASES

CHOICES = ("Method", "Pairing", "Ngons", "OutputDomain", "FrameShape", "NormalWeighting", "FrameFormat", "VAxis", "Green",
           "StoredSign", "Handedness", "Winding")
REPORTS = ("TangentReport", "NormalReport", "PositionNoise", "SanitizeReport", "WindingReport", "PackReport")
NOT_IN_CSHARP = ("domain", "smoothing_groups", "smoothing_groups_are_masks")  # options that only C# lists here
RUST = {"uint32_t": "u32", "uint64_t": "u64", "float": "f32", "double": "f64", "bool": "bool"}
CSHARP = {"uint32_t": "int", "uint64_t": "long", "float": "float", "bool": "bool"}


class Mirrors:
    """Structs of the C API as they appear in other languages: fields with their types and comments."""

    def __init__(self, model, pairs):
        self.model, self.pairs, self.entities = model, pairs, pairs.entities

    def fields(self, struct):
        """Returns (name, type, comment) of each field: a C type, "bool", a choice, "Convention" or "list"."""
        for name, kind in self.model.structs[struct]:
            entity = self.pairs.twin.get(f"tspace_{struct}.{name}")
            if entity:
                shown = "bool" if entity.type == "bool" else "list" if kind.pointers else kind.name
                yield name, shown, self.text(entity)

    def text(self, entity, own=()):
        """Returns a comment as one paragraph, with `own` names of enumerators."""
        text = " ".join(part for kind, _, part in blocks(entity.doc) if kind == "text")
        for phrase, said in PHRASES.items():
            text = re.sub(phrase, said, text)
        text = re.sub(r"`?\b[A-Z]\w+::(\w+)`?", r"`\1`", text)
        text = re.sub(r"`(\w+)`", lambda found: f"`{dict(own).get(found[1], found[1])}`", text)
        text = text[:1].upper() + text[1:] if re.match(r"(?!true\b|false\b)(a [a-z]|[a-z]{2,}[ ,:])", text) else text  # not for formulas
        return text if not text or text.endswith(".") else f"{text}."

    def choice(self, name):
        """Returns (C++ name, name in other languages, number, comment) of each enumerator, and the enumeration's comment."""
        by_number = {entity.value: entity for entity in self.entities.values() if entity.owner == name and entity.kind == "enumerator"}
        found = [(by_number[str(number)], pascal(c), number) for c, number in self.model.enums[name].items()]
        own = [(entity.member(), shown) for entity, shown, _ in found]
        return [(entity.member(), shown, number, self.text(entity, own)) for entity, shown, number in found], self.text(self.entities[name], own)


def _wrapped(text, start):
    return textwrap.wrap(text, 117, initial_indent=start, subsequent_indent=start, break_long_words=False, break_on_hyphens=False)


def _summary(text, indent):
    text = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return _wrapped(f"<summary>{text}</summary>", f"{indent}/// ") if text else []


def rust_choices(mirrors):
    lines = ["// SPDX-License-Identifier: MIT", "//! Choices, with the numbers of the C API. Written by scripts/api."]
    for name in CHOICES:
        rows, text = mirrors.choice(name)
        defaults = {entity.value.rpartition("::")[2] for entity in mirrors.entities.values()
                    if entity.kind == "field" and entity.owner.endswith("Options") and entity.type == name}
        chosen = {row[0] for row in rows} & defaults
        lines += ["", *_wrapped(text, "/// "),
                  f"#[derive(Clone, Copy, Debug, {'Default, ' if chosen else ''}PartialEq, Eq, Hash)]", f"pub enum {name} {{"]
        for cpp_name, member, number, comment in rows:
            lines += [*_wrapped(comment, "    /// "), *(["    #[default]"] if cpp_name in chosen else []), f"    {member} = {number},"]
        lines.append("}")
    rows, text = mirrors.choice("ErrorCode")
    lines += ["", *_wrapped(text, "/// "), "#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]", "#[non_exhaustive]", "pub enum ErrorCode {"]
    for _, member, _, comment in rows[1:]:  # without the code for success
        lines += [*_wrapped(comment, "    /// "), f"    {member},"]
    lines += ["    /// An error number that this crate does not know.", "    Other(u32),", "}", "", "impl ErrorCode {",
              "    pub(crate) fn of(code: u32) -> ErrorCode {", "        match code {",
              *(f"            {number} => ErrorCode::{member}," for _, member, number, _ in rows[1:]),
              "            other => ErrorCode::Other(other),", "        }", "    }", "}"]
    return "\n".join([*lines, ""])


RUST_HEAD = """\
// SPDX-License-Identifier: MIT
//! Options and reports, with the fields of the C API. Written by scripts/api.

use crate::enums::*;
use crate::options::{prepared, Convention, Execution};
use crate::sys;"""
# Fields of options in Rust: type, default from `raw`, and value passed to `raw`.
RUST_OPTIONS = {
    "list": ("&'a [u32]", "&[]", "if self.{0}.is_empty() {{ std::ptr::null() }} else {{ self.{0}.as_ptr() }}"),
    "Convention": ("Convention", "", "self.{0}.raw()"), "bool": ("bool", "raw.{0} != 0", "self.{0}.into()"),
    "uint32_t": ("u32", "raw.{0}", "self.{0}"), "float": ("f32", "raw.{0}", "self.{0}"),
}


def rust_structs(mirrors):
    lines = [RUST_HEAD]
    for name in ("TangentOptions", "NormalOptions", "WindingOptions"):
        rows = [(field, comment, *RUST_OPTIONS.get(kind, (kind, f"{kind}::default()", "self.{0} as u32")))
                for field, kind, comment in mirrors.fields(name)]
        has_list = any(kind.startswith("&") for _, _, kind, *_ in rows)
        lines += ["", *_wrapped(f"{mirrors.text(mirrors.entities[name])} [`{name}::new`] sets the defaults.".strip(), "/// "),
                  "#[derive(Clone, Copy, Debug, PartialEq)]", f"pub struct {name}{'<' + chr(39) + 'a>' if has_list else ''} {{"]
        for field, comment, kind, _, _ in rows:
            lines += [*_wrapped(comment, "    /// "), f"    pub {field}: {kind},"]
        lines += ["    /// Default: the calling thread.", "    pub execution: Execution,", "}", "",
                  f"impl {name}{'<' + chr(39) + '_>' if has_list else ''} {{", "    /// The defaults.",
                  "    pub fn new(convention: Convention) -> Self {", f"        let raw = prepared(sys::tspace_init{name});",
                  f"        {name} {{", *(f"            {field}{': ' * bool(default)}{default.format(field)}," for field, _, _, default, _ in rows),
                  "            execution: Execution::default(),", "        }", "    }", "",
                  f"    pub(crate) fn fields(&self) -> sys::{name} {{", f"        let mut raw = prepared(sys::tspace_init{name});",
                  *(f"        raw.{field} = {given.format(field)};" for field, _, _, _, given in rows),
                  *(f"        raw.{field.removesuffix('s')}_count = self.{field}.len();" for field, _, kind, *_ in rows if kind[0] == "&"),
                  "        raw", "    }", "}"]
    for name in REPORTS[:2] + REPORTS[3:4]:
        rows = [(field, RUST[kind], comment) for field, kind, comment in mirrors.fields(name)]
        lines += ["", *_wrapped(mirrors.text(mirrors.entities[name]), "/// "),
                  f"#[derive(Clone, Copy, Debug, Default, PartialEq{', Eq' if 'f32' not in (kind for _, kind, _ in rows) else ''})]",
                  "#[non_exhaustive]", f"pub struct {name} {{"]
        for field, kind, comment in rows:
            lines += [*_wrapped(comment, "    /// "), f"    pub {field}: {kind},"]
        lines += ["}", "", f"impl {name} {{", f"    pub(crate) fn of(raw: &sys::{name}) -> Self {{", f"        {name} {{",
                  *(f"            {field}: raw.{field}{' != 0' if kind == 'bool' else ''}," for field, kind, _ in rows), "        }", "    }", "}"]
    return "\n".join([*lines, ""])


def csharp_choices(mirrors):
    lines = ["// SPDX-License-Identifier: MIT", "// Choices, with the numbers of the C API. Written by scripts/api.", "namespace Tspace", "{"]
    for name in ("ErrorCode", "Method", "Pairing", "Ngons", "FrameShape", "NormalWeighting"):
        rows, text = mirrors.choice(name)
        lines += [*_summary(text, "    "), f"    public enum {name} : uint", "    {"]
        for _, member, number, comment in rows:
            lines += [*_summary(comment, "        "), f"        {member} = {number},"]
        lines += ["    }", ""]
    return "\n".join([*lines[:-1], "}", ""])


CSHARP_HEAD = """\
// SPDX-License-Identifier: MIT
// Options and reports, with the fields of the C API. Written by scripts/api.
namespace Tspace
{"""


def csharp_structs(mirrors):
    lines = [CSHARP_HEAD]
    for name in ("TangentOptions", "NormalOptions"):
        rows = [(field, pascal(field), CSHARP.get(kind, kind), comment) for field, kind, comment in mirrors.fields(name) if field not in NOT_IN_CSHARP]
        lines += [*_summary(f"{mirrors.text(mirrors.entities[name])} A new instance holds the defaults.".strip(), "    "),
                  f"    public sealed partial class {name}", "    {"]
        for _, member, kind, comment in rows:
            lines += [*_summary(comment, "        "), f"        public {kind} {member} {{ get; set; }}"]
        lines += [*_summary("Number of threads; int.MaxValue: one per core. Results have the same bits for any number.", "        "),
                  "        public int Threads { get; set; } = 1;", "", f"        public {name}(Convention convention)", "        {",
                  f"            Native.{name} raw = Prepared();"]
        for _, member, kind, _ in rows:
            value = {"Convention": "convention", "bool": f"raw.{member} != 0"}.get(kind, f"({kind})raw.{member}")
            lines.append(f"            {member} = {value};")
        lines += ["        }", "", f"        private static unsafe Native.{name} Prepared()", "        {", f"            Native.{name} raw;",
                  "            Native.Error error;",
                  f"            Native.Check(Native.tspace_init{name}(&raw, (uint)sizeof(Native.{name}), &error), ref error);",
                  "            return raw;", "        }", "", f"        private Native.{name} Fields()", "        {",
                  f"            Native.{name} raw = Prepared();"]
        for _, member, kind, _ in rows:
            value = {"Convention": f"{member}.Raw", "bool": f"{member} ? 1u : 0u", "float": member}.get(kind, f"(uint){member}")
            lines.append(f"            raw.{member} = {value};")
        lines += ["            return raw;", "        }", "    }", ""]
    rows = [(pascal(field), CSHARP[kind], comment) for field, kind, comment in mirrors.fields("TangentReport")]
    lines += [*_summary(mirrors.text(mirrors.entities["TangentReport"]), "    "), "    public readonly struct TangentReport", "    {"]
    for member, kind, comment in rows:
        lines += [*_summary(comment, "        "), f"        public readonly {kind} {member};"]
    lines += ["", "        internal TangentReport(in Native.TangentReport raw)", "        {"]
    lines += [f"            {member} = {f'raw.{member} != 0' if kind == 'bool' else f'({kind})raw.{member}'};" for member, kind, _ in rows]
    return "\n".join([*lines, "        }", "    }", "}", ""])


def python_reports(mirrors):
    lines = ["# SPDX-License-Identifier: MIT", '"""Reports of functions, as named tuples. Written by scripts/api."""', "", "from typing import NamedTuple"]
    for name in REPORTS:
        lines += ["", "", f"class {name}(NamedTuple):", f'    """{mirrors.text(mirrors.entities[name]) or "Report."}"""', ""]
        for field, kind, comment in mirrors.fields(name):
            lines += [*_wrapped(comment, "    #: "), f"    {field}: {'float' if kind in ('float', 'double') else 'bool' if kind == 'bool' else 'int'}"]
    return "\n".join([*lines, ""])


def python_names(model, presets):
    lines = ["# SPDX-License-Identifier: MIT", '"""Names of choices, for type checkers. Written by scripts/api."""', "", "from typing import Literal", ""]
    for name, values in {**model.enums, "Preset": presets}.items():
        lines += [f"{name}Name = Literal[", *(f'    "{value.lower()}",' for value in values), "]"]
    return "\n".join([*lines, ""])


def _report_members(mirrors, name):
    """Returns the fields in the order in which the WebAssembly modules store them: counts first."""
    members = [entity for entity in mirrors.entities.values() if entity.owner == name and entity.kind in ("field", "method")]
    return sorted(members, key=lambda entity: entity.type != "std::uint64_t")


def js_names(mirrors, choices, reports):
    """Returns names of choices in the order of their numbers, and names of the numbers in reports."""
    lines = ["// SPDX-License-Identifier: MIT", "// Names of choices, and of numbers of reports. Written by scripts/api."]
    lists = {name: [value.lower() if name == "FrameFormat" else camel(value) for value in mirrors.model.enums[name]] for name in choices}
    lists.update({name: [camel(snake(entity.member()).removesuffix("_deg")) for entity in _report_members(mirrors, name)] for name in reports})
    for name, words in lists.items():
        text = ", ".join(f'"{word}"' for word in words) + ","
        lines += [f"export const {name[:1].lower()}{name[1:]}Names = [", *textwrap.wrap(text, 118, initial_indent="  ", subsequent_indent="  "), "];"]
    return "\n".join([*lines, ""])


WASM_HEAD = """\
// SPDX-License-Identifier: MIT
// Stores the numbers of reports for JavaScript, in the order of their names in names.js. Each function starts at index
// `first`, and returns the index after its last number. Written by scripts/api.
#pragma once

#include "exports.h"
#include "tspace/tspace.hpp"

namespace tspace::js {
"""


def wasm_reports(mirrors):
    lines = [WASM_HEAD]
    for name in REPORTS:
        members = _report_members(mirrors, name)
        counts = [f"&{name}::{entity.member()}" for entity in members if entity.type == "std::uint64_t"]
        others = [f"{entity.member()}{'()' * (entity.kind == 'method')}" for entity in members[len(counts):]]
        lines.append(f"inline std::size_t keep(const {name}& from, std::size_t first = 0) {{")
        if counts:  # in WebAssembly, a loop over the counts is smaller than one statement for each
            lines += [f"    static constexpr std::uint64_t {name}::* kCounts[] = {{{', '.join(counts)}}};",
                      "    for (const auto count : kCounts) report[first++] = static_cast<double>(from.*count);"]
        lines += [*(f"    report[first++] = static_cast<double>(from.{other});" for other in others), "    return first;", "}", ""]
    return "\n".join([*lines, "}  // namespace tspace::js", ""])


def js_reports(mirrors):
    lines = ["// SPDX-License-Identifier: MIT", "// Reports of calls. Written by scripts/api."]
    for name in REPORTS:
        lines += ["", *_js_comment(mirrors.text(mirrors.entities[name]), ""), f"export interface {name} {{"]
        for field, _, comment in mirrors.fields(name):
            lines += [*_js_comment(comment, "  "), f"  {camel(field.removesuffix('_deg'))}: number;"]
        if name in ("TangentReport", "NormalReport"):
            lines += ["  /** Given options that the method or weighting does not use. */", "  ignoredOptions?: string[];"]
        lines.append("}")
    return "\n".join([*lines, ""])


def _js_comment(text, indent):
    lines = textwrap.wrap(text, 114)
    if len(lines) < 2:
        return [f"{indent}/** {line} */" for line in lines]
    return [f"{indent}/**", *(f"{indent} * {line}" for line in lines), f"{indent} */"]
