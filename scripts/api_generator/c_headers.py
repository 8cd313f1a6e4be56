# SPDX-License-Identifier: MIT
"""C: comments and defaults of the C headers, values of enumerations, and new fields of sized structs, from the C++ headers.

Names are converted to those of C. Text after "In C:" describes only the C API and is kept. Declarations that only one of
the two APIs has and that twins.py does not list, and enumerators with different numbers or names, are reported as problems.
"""
import re
import textwrap

import c_model
import cpp as cpp_headers
import twins
from names import camel, pascal, snake

WIDTH = 117  # keeps columns free for the end of a comment
DEFAULTS = "/* == defaults == */"
C_TYPES = {"bool": "uint32_t", "std::uint32_t": "uint32_t", "std::uint64_t": "uint64_t", "float": "float", "double": "double"}
problems = []


def listed(name, table):
    """Returns whether a pattern in this table of exceptions matches the name."""
    return any(re.fullmatch(pattern, name) for pattern in table.values())


def twin_type(owner):
    return twins.TWINS.get(owner, owner.removeprefix("tspace_"))


def cpp_entities(read):
    """Returns (comments at the tops of headers, entities by name) of all C++ headers that have a C counterpart."""
    heads, entities = {}, {}
    for header in [*re.findall(r'#include "tspace/(\w+\.h)"', read("tspace.hpp")), *twins.FILE_HEADERS]:
        heads[header], declared = cpp_headers.parse(read(header))
        for entity in declared:
            if header in twins.FILE_HEADERS and entity.kind != "function":
                continue  # in C, options and reports of the calls on files are JSON
            entity.header = header
            parameter = re.search(r"\(.*?(\w+)(?: = [^,]*)?[,)]", entity.type)  # distinguishes overloads
            overload = f"{entity.name}({parameter[1]})" if entity.kind == "function" and parameter else ""
            entity.name = overload if overload in twins.TWINS.values() else entity.name
            if entity.name not in entities or entity.doc:
                entities[entity.name] = entity
    return heads, entities


class Pairs:
    """Maps declarations of the C API to those of the C++ API."""

    def __init__(self, entities, declared):
        self.entities, self.twin, self.c_name, self.c_only = entities, {}, {}, set()
        for item in declared:
            full, name = item.full(), self.find(item)
            if name in entities and not (item.kind == "type" and listed(full, twins.C_ALONE)):
                self.twin[full] = entities[name]
                self.c_name.setdefault(name, full)
                continue
            self.c_only.add(full)
            if not listed(full, twins.C_ALONE) and not listed(item.owner or full, twins.C_ALONE):
                problems.append(f"{full} has no twin in C++, and twins.py does not say why")
        for name in entities:
            if name not in self.c_name and not listed(name.partition("::")[0], twins.CPP_ALONE) and not listed(name, twins.CPP_ALONE):
                problems.append(f"{name} has no twin in C, and twins.py does not say why")

    def find(self, item):
        full, owner = item.full(), twin_type(item.owner)
        if full in twins.TWINS:
            return twins.TWINS[full]
        if item.kind == "enumerator":
            same = next((entity for entity in members(self.entities, owner, "enumerator") if entity.value == item.value), None)
            if same and not full.endswith("_" + snake(same.member()).upper()):
                problems.append(f"{full} is {same.name} in C++: another name for one number")
            return same.name if same else ""
        if item.kind == "field":
            method = f"{owner}::{camel(item.name)}"
            return method if method in self.entities and not listed(full, twins.C_ALONE) else f"{owner}::{item.name}"
        if item.kind == "constant":
            return "k" + pascal(item.name.removeprefix("TSPACE_"))
        return item.name.removeprefix("tspace_")

    def is_sized(self, owner):
        return f"{owner}.struct_size" in self.c_only


def members(entities, owner, *kinds):
    return [entity for entity in entities.values() if entity.owner == owner and entity.kind in kinds]


class Words:
    """Rewrites sentences of the C++ headers with the names of the C API."""

    NAME = re.compile(r"(?<!\w)(`?)([A-Za-z]\w*)(?:(::|\.)(\w+))?(\(\))?(`?)")
    LEFT = re.compile(r"\*/|/\*|\w*::\w+|\bstd\b|\bk[A-Z]\w+|(?<![\"_A-Za-z])[a-z]{2,}[A-Z][a-z]\w+(?!\")\b")

    def __init__(self, pairs):
        self.pairs = pairs
        self.enumerators, self.methods, self.codes = {}, {}, {}
        for name, c in pairs.c_name.items():
            entity = pairs.entities[name]
            if entity.owner == "ErrorCode" and entity.member() not in ("ok", "internal"):
                self.codes[entity.member()] = c.replace("TSPACE_ERROR_", "")
            elif entity.kind == "enumerator":
                self.enumerators.setdefault(entity.member(), []).append((entity.header, c))
            elif entity.kind == "method" and "." not in c:
                self.methods[entity.member()] = c

    def of(self, text, entity):
        for phrase, c in twins.PHRASES.items():
            text = re.sub(phrase, c, text)
        text = self.NAME.sub(lambda found: self.word(found, entity), text).replace("an tspace_", "a tspace_")
        left = self.LEFT.search(text)
        if left and left[0] not in twins.WORDS:
            problems.append(f"{entity.name}: what is \"{left[0]}\" in C?")
        return text

    def word(self, found, entity):
        """Converts one name: name, Type::member, name(), object.name(), or any of these in backticks."""
        tick, name, between, member, call, _ = found.groups()
        before, after = found.string[: found.start()], found.string[found.end():]
        c_name, entities = self.pairs.c_name, self.pairs.entities
        if between == "." and call and member in self.methods:
            return f"{self.methods[member]}({name})"
        if between:
            return c_name.get(f"{name}::{member}", found[0]) if between == "::" else found[0]
        own = f"{entity.name if entity.kind == 'type' else entity.owner}::{name}"
        if call and own in c_name and entities[own].kind == "method":
            return c_name[own].rpartition(".")[2]
        if name in c_name:
            is_prose = re.fullmatch("[A-Za-z][a-z]+", name)  # an ordinary English word as well
            is_type = entities[name].kind == "type"
            if not is_prose or tick or (re.search("[a-z] $", before) if is_type else call or after[:1] == "("):
                return f"{tick}{c_name[name]}{tick}"
        if name in self.codes and not before.endswith('"'):
            return self.codes[name]
        if tick and entity.header not in twins.FILE_HEADERS:
            # The enumerator of this name in the same header, or the only one in all headers.
            found_there = self.enumerators.get(name, [])
            near = [c for header, c in found_there if header == entity.header] or [c for _, c in found_there]
            return near[0] if len(near) == 1 else found[0]
        return {"true": "1", "false": "0"}.get(name, found[0])


def wrapped(parts, indent):
    """Returns the lines of a comment, each of at most WIDTH columns."""
    lines = []
    widest = max((len(names) for kind, names, _ in parts if kind == "parameter"), default=0)
    for kind, name, text in parts:
        start = name.ljust(max(widest + 2, 10)) if kind == "parameter" else ""
        lines += [text] if kind in ("verbatim", "blank") else textwrap.wrap(
            text, WIDTH - indent - 3, initial_indent=start, subsequent_indent=" " * len(start), break_long_words=False,
            break_on_hyphens=False)
    return lines


def written(lines, indent):
    """Returns the lines of a comment above a declaration."""
    margin = " " * indent
    made = [(margin + ("/* " if i == 0 else " * ") + line).rstrip() for i, line in enumerate(lines)]
    return "\n".join(made) + (" */" if len(made[-1]) <= 120 - 3 else f"\n{margin} */")


def floats(declaration, name=r"\w+"):
    """Returns the element type of a span, which the C type does not show."""
    found = re.search(rf"(?:StridedSpan|vector)<(?:const )?(?:Vec([234])|float)>(?: {name}\b|$)", declaration)
    return f"{found[1] or 1} float{'s' if found[1] else ''} each" if found else ""


def own_lines(comment):
    """Returns the lines of a comment that describe only the C API."""
    lines = re.sub(r"^\s*/\* ?|\s*\*/\s*$", "", comment).split("\n")
    text = "\n".join(re.sub(r"^\s*\* ?", "", line) if i else line for i, line in enumerate(lines))
    found = re.search(r"(?:^|(?<=[\s.]))In C: ", text)
    return text[found.start():].split("\n") if found else []


def comment_parts(item, entity, words, default):
    """Returns the parts of an item's comment that come from C++."""
    parts = [(kind, names, words.of(text, entity)) for kind, names, text in cpp_headers.blocks(entity.doc, entity.indent)]
    if item.kind == "function":
        for at, (kind, names, text) in enumerate(parts):
            for name in filter(None, names.split(", ")):
                if not re.search(rf"\b{name}\b", item.code):
                    problems.append(f"{item.name} has no parameter \"{name}\", which {entity.name} describes")
                if floats(entity.type, name):
                    parts[at] = (kind, names, f"{floats(entity.type, name)}: {text}")
    if item.kind != "field":
        return parts
    (kind, names, text), *others = parts or [("text", "", "")]
    each = floats(entity.type)
    if entity.type == "bool":
        text = f"0 or 1. {text[:1].upper()}{text[1:]}"
    elif each:
        text = f"{each}: {text[:1].lower()}{text[1:]}" if text else each
    if default:
        text += f"{'.' if re.search('[^.]$', text) else ''} Default: {default}."
    return [(kind, names, text.strip()), *others] if text.strip() else []


def rewritten(item, pairs, words, defaults):
    """Returns an item with its generated comment."""
    entity = pairs.twin[item.full()]
    indent = len(item.code) - len(item.code.lstrip())
    parts, own = comment_parts(item, entity, words, defaults.get(item.full())), own_lines(item.comment)
    if own and parts and not parts[-1][2].endswith("."):
        parts[-1] = (*parts[-1][:2], parts[-1][2] + ".")
    lines = wrapped(parts, indent) + own
    line = f"{item.code} /* {' '.join(lines)} */"
    if not lines:
        return item.code
    is_short = item.kind in ("field", "enumerator") and len(line) <= WIDTH and len(parts) <= 1
    return line if is_short else f"{written(lines, indent)}\n{item.code}"


def defaults_of(pairs, words):
    """Returns type.field -> value for the fields of sized structs with a nonzero default."""
    found = {}
    for full, entity in pairs.twin.items():
        if entity.kind != "field" or not pairs.is_sized(full.partition(".")[0]) or listed(full, twins.OTHER_DEFAULTS):
            continue
        enumerator = pairs.entities.get(entity.value)
        if not re.fullmatch(r"|\{\}|nullptr|false|0(\.0f)?", enumerator.value if enumerator else entity.value):
            found[full] = words.of(re.sub(r"\.0f$|f$", "", entity.value), entity)
    return found


def defaults_code(defaults, pairs):
    """Returns the end of the header: the functions that TSPACE_INIT calls."""
    types = {full.partition(".")[0]: "" for full in defaults}
    types = {kind: f"tspace_set{kind[len('tspace_'):].removesuffix('Options')}Defaults" for kind in types}
    lines = [DEFAULTS, "/* For TSPACE_INIT: the defaults that are not zero. */",
             "static inline void tspace_setNoDefaults(void* object) { (void)object; }"]
    for kind, setter in types.items():
        lines.append(f"static inline void {setter}({kind}* options) {{")
        for full, value in defaults.items():
            owner, _, field = full.partition(".")
            if owner == kind:
                suffix = ("f" if "." in value else ".0f") if pairs.twin[full].type == "float" else ""
                lines.append(f"    options->{field} = {value}{suffix};")
        lines.append("}")
    lines += ["", "#ifdef __cplusplus", "}", "", "inline void tspace_setDefaults(void*) noexcept {}"]
    lines += [f"inline void tspace_setDefaults({kind}* options) noexcept {{ {setter}(options); }}" for kind, setter in types.items()]
    lines += ["#define TSPACE_SET_DEFAULTS(object) tspace_setDefaults(&(object))", "#else", "/* clang-format off */",
              "#define TSPACE_SET_DEFAULTS(object) \\", "    _Generic((object), \\"]
    lines += [f"        {kind}: {setter}, \\" for kind, setter in types.items()]
    lines += ["        default: tspace_setNoDefaults)((void*)&(object))", "/* clang-format on */", "#endif"]
    return "\n".join(lines)


def completed(text, entities):
    """Adds enumerators and fields that C++ has and C lacks to the ends of their types in a header."""
    groups = {}
    for item in c_model.items(text):
        if item.owner:
            groups.setdefault(item.owner, []).append(item)
    for owner, there in reversed(groups.items()):
        last, twin, lines = there[-1], twin_type(owner), []
        if last.kind == "enumerator":
            declared, values = members(entities, twin, "enumerator"), {item.value for item in there}
            first = next((entity for entity in declared if entity.value == there[0].value), None)
            for entity in declared if first else []:
                if entity.value not in values:
                    prefix = there[0].name.removesuffix(snake(first.member()).upper())
                    lines.append(f"    {prefix}{snake(entity.member()).upper()} = {entity.value},")
        elif there[0].name == "struct_size":
            enums = {entity.owner for entity in entities.values() if entity.kind == "enumerator"}
            for entity in members(entities, twin, "field"):
                kind = f"tspace_{entity.type}" if entity.type in enums else C_TYPES.get(entity.type)
                is_there = any(item.name == entity.member() for item in there)
                if kind and not is_there and not listed(entity.name, twins.CPP_ALONE):
                    lines.append(f"    {kind} {entity.member()};")
        if lines:
            before = text[last.start: last.end].replace(last.code, last.code.rstrip(",") + "," * (last.kind == "enumerator"), 1)
            text = text[: last.start] + "\n".join([before, *lines]) + text[last.end:]
    return text


def plain(text):
    """Removes differences that scripts/format decides."""
    return "".join(text.replace("\\\n", "").split())


class Headers:
    """Generates the C headers (`texts`, by name), and maps C declarations to C++ declarations (`pairs`)."""

    def __init__(self, read):
        heads, entities = cpp_entities(read)
        self.texts = {name: completed(read(name).partition(DEFAULTS)[0], entities) for name in twins.C_HEADERS}
        self.items = {name: list(c_model.items(text)) for name, text in self.texts.items()}
        self.pairs = pairs = Pairs(entities, sum(self.items.values(), []))
        words = Words(pairs)
        defaults = defaults_of(pairs, words)

        def section(found):
            """Replaces a comment that begins with "== frame.h ==" by the comment at the top of this C++ header."""
            entity = cpp_headers.Entity(found[1], "head", header=found[1])
            parts = [(kind, names, words.of(part, entity)) for kind, names, part in cpp_headers.blocks(heads[found[1]])]
            return written([f"== {found[1]} ==", *wrapped(parts, 0)], 0)

        for name, declared in self.items.items():
            text = self.texts[name]
            for item in {item.start: item for item in reversed(declared)}.values():  # last line first, and the first item of each line
                if item.full() in pairs.twin and not item.code.startswith("enum {"):
                    text = text[: item.start] + rewritten(item, pairs, words, defaults) + text[item.end:]
            end = read(name).partition(DEFAULTS)[2]
            if end:
                text += defaults_code(defaults, pairs) + end[end.rindex("\n#if defined(__GNUC__)"):]
            self.texts[name] = re.sub(r"/\* == (\w+\.h) ==.*?\*/", section, text, flags=re.S)
        known = {*pairs.c_only, *pairs.twin, *entities, *(entity.owner for entity in entities.values())}
        for table in (twins.C_ALONE, twins.CPP_ALONE, twins.OTHER_DEFAULTS):
            problems.extend(f"twins.py: nothing is \"{pattern}\"" for pattern in table.values()
                            if not any(re.fullmatch(pattern, name) for name in known))
