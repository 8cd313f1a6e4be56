# SPDX-License-Identifier: MIT
"""Generates choices, options and reports for Rust, C#, Python and JavaScript, with the comments of the C++ headers."""
import re
import textwrap

from c_headers import PHRASES
from names import camel, pascal, snake

CHOICES = ("Method", "Pairing", "Ngons", "OutputDomain", "FrameShape", "NormalWeighting", "FrameFormat", "VAxis", "Green",
           "StoredSign", "Handedness", "Winding")
REPORTS = ("TangentReport", "NormalReport", "PositionNoise", "SanitizeReport", "WindingReport", "PackReport")
NOT_IN_CSHARP = ("domain", "smoothing_groups", "smoothing_groups_are_masks")  # options that only C# lacks
RUST = {"uint32_t": "u32", "uint64_t": "u64", "float": "f32", "double": "f64", "bool": "bool"}
CSHARP = {"uint32_t": "int", "uint64_t": "long", "float": "float", "bool": "bool"}


class Mirrors:
    """Enumerations and structs of the C API as they appear in other languages."""

    def __init__(self, model, pairs):
        self.model, self.pairs = model, pairs

    def fields(self, struct):
        """Returns (name, type, comment) of each field: a C type, "bool", a choice, "Convention" or "list"."""
        for name, kind in self.model.structs[struct].items():
            entity = self.pairs.twin.get(f"tspace_{struct}.{name}")
            if entity:
                yield name, "bool" if entity.type() == "bool" else "list" if kind.pointers else kind.name, self.text(entity)

    def choices(self, name):
        """Returns (C++ declaration, name in other languages, comment) of each enumerator."""
        shown = self.shown(name)
        return [(entity, shown[entity.member()], self.text(entity, shown)) for entity in self.model.enums[name]]

    def shown(self, name):
        """Returns the names of enumerators in other languages, by their names in C++."""
        return {entity.member(): pascal(snake(entity.member())) for entity in self.model.enums.get(name, ())}

    def of_type(self, name, more=""):
        """Returns the comment of a type, followed by one more sentence."""
        return f"{self.text(self.pairs.entities[name], self.shown(name))} {more}".strip()

    def text(self, entity, shown={}):
        """Returns a comment as one paragraph, with `shown` names of enumerators."""
        text = " ".join(part for names, part in entity.paragraphs() if part and not names and not part.startswith(" "))
        for phrase, said in PHRASES.items():
            text = re.sub(phrase, said, text)
        text = re.sub(r"`?\b[A-Z]\w+::(\w+)`?", r"`\1`", text)
        text = re.sub(r"`(\w+)`", lambda found: f"`{shown.get(found[1], found[1])}`", text)
        text = text[:1].upper() + text[1:] if re.match(r"(?!true\b|false\b)(a [a-z]|[a-z]{2,}[ ,:])", text) else text  # not for formulas
        return text if not text or text.endswith(".") else f"{text}."

    def report_members(self, name):
        """Returns the fields in the order in which the WebAssembly modules store them: counts first."""
        return sorted(self.pairs.members(name, "field", "method"), key=lambda entity: entity.type() != "std::uint64_t")


def wrapped(text, start):
    return textwrap.wrap(text, 117, initial_indent=start, subsequent_indent=start, break_long_words=False, break_on_hyphens=False)


def rust_comment(text, indent=""):
    return wrapped(text, f"{indent}/// ")


def csharp_comment(text, indent=""):
    text = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return wrapped(f"<summary>{text}</summary>", f"{indent}/// ") if text else []


def python_comment(text, indent=""):
    return wrapped(text, f"{indent}#: ")


def js_comment(text, indent="", width=114):
    lines = textwrap.wrap(text, width)
    if len(lines) < 2:
        return [f"{indent}/** {line} */" for line in lines]
    return [f"{indent}/**", *(f"{indent} * {line}" for line in lines), f"{indent} */"]


def documented(comment, indent, rows):
    """Returns the lines of declarations: of each row, its comment above its lines of code."""
    return [line for text, *code in rows for line in (*comment(text, indent), *(indent + each for each in code))]


def rust_choices(mirrors):
    defaults = {entity.value() for entity in mirrors.pairs.entities.values() if entity.kind == "field" and entity.owner.endswith("Options")}
    lines = []
    for name in CHOICES:
        choices = mirrors.choices(name)
        rows = [(comment, *["#[default]"] * (entity.name in defaults), f"{shown} = {entity.value()},") for entity, shown, comment in choices]
        has_default = any(entity.name in defaults for entity, *_ in choices)
        lines += ["", *rust_comment(mirrors.of_type(name)),
                  f"#[derive(Clone, Copy, Debug, {'Default, ' if has_default else ''}PartialEq, Eq, Hash)]", f"pub enum {name} {{",
                  *documented(rust_comment, "    ", rows), "}"]
    errors = mirrors.choices("ErrorCode")[1:]  # without the code for success
    rows = [*((comment, f"{shown},") for _, shown, comment in errors), ("An error number that this crate does not know.", "Other(u32),")]
    lines += ["", *rust_comment(mirrors.of_type("ErrorCode")), "#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]", "#[non_exhaustive]",
              "pub enum ErrorCode {", *documented(rust_comment, "    ", rows), "}", "", "impl ErrorCode {",
              "    pub(crate) fn of(code: u32) -> ErrorCode {", "        match code {",
              *(f"            {entity.value()} => ErrorCode::{shown}," for entity, shown, _ in errors),
              "            other => ErrorCode::Other(other),", "        }", "    }", "}"]
    return lines


# Fields of options in Rust: type, default from `raw`, and value passed to `raw`.
RUST_OPTIONS = {
    "list": ("&'a [u32]", ": &[]", "if self.{0}.is_empty() {{ std::ptr::null() }} else {{ self.{0}.as_ptr() }}"),
    "Convention": ("Convention", "", "self.{0}.raw()"), "bool": ("bool", ": raw.{0} != 0", "self.{0}.into()"),
    "uint32_t": ("u32", ": raw.{0}", "self.{0}"), "float": ("f32", ": raw.{0}", "self.{0}"),
}


def rust_structs(mirrors):
    lines = []
    for name in ("TangentOptions", "NormalOptions", "WindingOptions"):
        rows = [(field, comment, *RUST_OPTIONS.get(kind, (kind, f": {kind}::default()", "self.{0} as u32")))
                for field, kind, comment in mirrors.fields(name)]
        lists = [field for field, _, kind, *_ in rows if kind.startswith("&")]
        declared, used = ("<'a>", "<'_>") if lists else ("", "")
        public = [*((comment, f"pub {field}: {kind},") for field, comment, kind, *_ in rows),
                  ("Default: the calling thread.", "pub execution: Execution,")]
        lines += ["", *rust_comment(mirrors.of_type(name, f"[`{name}::new`] sets the defaults.")), "#[derive(Clone, Copy, Debug, PartialEq)]",
                  f"pub struct {name}{declared} {{", *documented(rust_comment, "    ", public), "}", "",
                  f"impl {name}{used} {{", "    /// The defaults.",
                  "    pub fn new(convention: Convention) -> Self {", f"        let raw = prepared(sys::tspace_init{name});",
                  f"        {name} {{", *(f"            {field}{default.format(field)}," for field, _, _, default, _ in rows),
                  "            execution: Execution::default(),", "        }", "    }", "",
                  f"    pub(crate) fn fields(&self) -> sys::{name} {{", f"        let mut raw = prepared(sys::tspace_init{name});",
                  *(f"        raw.{field} = {given.format(field)};" for field, *_, given in rows),
                  *(f"        raw.{field.removesuffix('s')}_count = self.{field}.len();" for field in lists),
                  "        raw", "    }", "}"]
    for name in ("TangentReport", "NormalReport", "SanitizeReport"):
        rows = [(field, RUST[kind], comment) for field, kind, comment in mirrors.fields(name)]
        equal = "" if any(kind == "f32" for _, kind, _ in rows) else ", Eq"
        lines += ["", *rust_comment(mirrors.of_type(name)), f"#[derive(Clone, Copy, Debug, Default, PartialEq{equal})]", "#[non_exhaustive]",
                  f"pub struct {name} {{", *documented(rust_comment, "    ", ((comment, f"pub {field}: {kind},") for field, kind, comment in rows)),
                  "}", "", f"impl {name} {{", f"    pub(crate) fn of(raw: &sys::{name}) -> Self {{", f"        {name} {{",
                  *(f"            {field}: raw.{field}{' != 0' if kind == 'bool' else ''}," for field, kind, _ in rows), "        }", "    }", "}"]
    return lines


def csharp_choices(mirrors):
    lines = []
    for name in ("ErrorCode", "Method", "Pairing", "Ngons", "FrameShape", "NormalWeighting"):
        rows = [(comment, f"{shown} = {entity.value()},") for entity, shown, comment in mirrors.choices(name)]
        lines += [*csharp_comment(mirrors.of_type(name), "    "), f"    public enum {name} : uint", "    {",
                  *documented(csharp_comment, "        ", rows), "    }", ""]
    return [*lines[:-1], "}"]


# Properties of options in C#: value of a field of `fields`, and value written to it.
CSHARP_PROPERTIES = {"bool": ("fields.{0} != 0", "value ? 1u : 0u"), "Convention": ("new Convention(fields.{0})", "value.Raw"),
                     "float": ("fields.{0}", "value")}


def csharp_structs(mirrors):
    lines = []
    for name, kind in (("TangentOptions", "sealed partial class"), ("NormalOptions", "sealed partial class"),
                       ("TangentReport", "readonly partial struct")):
        rows = [(comment, csharp_property(field, kind, name.endswith("Options")))
                for field, kind, comment in mirrors.fields(name) if field not in NOT_IN_CSHARP]
        more = "A new instance holds the defaults." if name.endswith("Options") else ""
        lines += [*csharp_comment(mirrors.of_type(name, more), "    "), f"    public {kind} {name}", "    {",
                  *documented(csharp_comment, "        ", rows), "    }", ""]
    return [*lines[:-1], "}"]


def csharp_property(field, kind, is_option):
    kind, member = CSHARP.get(kind, kind), pascal(field)
    read, written = CSHARP_PROPERTIES.get(kind, (f"({kind})fields.{{0}}", "(uint)value"))
    setter = f" set => fields.{member} = {written};" if is_option else ""
    return f"public {kind} {member} {{ get => {read.format(member)};{setter} }}"


def python_reports(mirrors):
    lines = []
    for name in REPORTS:
        rows = [(comment, f"{field}: {'float' if kind in ('float', 'double') else 'bool' if kind == 'bool' else 'int'}")
                for field, kind, comment in mirrors.fields(name)]
        lines += ["", "", f"class {name}(NamedTuple):", f'    """{mirrors.of_type(name) or "Report."}"""', "",
                  *documented(python_comment, "    ", rows)]
    return lines


def python_names(model, presets):
    names = {name: [snake(entity.member()) for entity in choices] for name, choices in model.enums.items()}
    lines = []
    for name, values in {**names, "Preset": presets}.items():
        lines += [f"{name}Name = Literal[", *(f'    "{value}",' for value in values), "]"]
    return lines


def js_names(mirrors, choices, reports):
    """Returns names of choices in the order of their numbers, and names of the numbers in reports."""
    lines = []
    lists = {name: [entity.member() for entity in mirrors.model.enums[name]] for name in choices}
    if "FrameFormat" in lists:
        lists["FrameFormat"] = map(snake, lists["FrameFormat"])
    lists |= {name: [camel(snake(entity.member()).removesuffix("_deg")) for entity in mirrors.report_members(name)] for name in reports}
    for name, words in lists.items():
        lines += [f"export const {name[:1].lower()}{name[1:]}Names = [", *js_list(words, "  "), "];"]
    return lines


def js_list(words, indent):
    text = ", ".join(f'"{word}"' for word in words) + ","
    return textwrap.wrap(text, 120 - len(indent), initial_indent=indent, subsequent_indent=indent)


def js_reports(mirrors):
    lines = []
    for name in REPORTS:
        rows = [(comment, f"{camel(field.removesuffix('_deg'))}: number;") for field, _, comment in mirrors.fields(name)]
        if name in ("TangentReport", "NormalReport"):
            rows.append(("Given options that the method or weighting does not use.", "ignoredOptions?: string[];"))
        lines += ["", *js_comment(mirrors.of_type(name)), f"export interface {name} {{", *documented(js_comment, "  ", rows), "}"]
    return lines


def wasm_reports(mirrors):
    lines = []
    for name in REPORTS:
        members = mirrors.report_members(name)
        counts = [f"&{name}::{entity.member()}" for entity in members if entity.type() == "std::uint64_t"]
        others = [f"{entity.member()}{'()' * (entity.kind == 'method')}" for entity in members[len(counts):]]
        lines.append(f"inline std::size_t keep(const {name}& from, std::size_t first = 0) {{")
        if counts:  # in WebAssembly, a loop over the counts is smaller than one statement for each
            lines += [f"    static constexpr std::uint64_t {name}::* kCounts[] = {{{', '.join(counts)}}};",
                      "    for (const auto count : kCounts) report[first++] = static_cast<double>(from.*count);"]
        lines += [*(f"    report[first++] = static_cast<double>(from.{other});" for other in others), "    return first;", "}", ""]
    return [*lines, "}  // namespace tspace::js"]
