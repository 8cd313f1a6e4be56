# SPDX-License-Identifier: MIT
"""C: comments and defaults of the C headers, values of enumerations, and new fields of sized structs, from the C++ headers.

Names become those of C. Text about C alone stands behind "In C:" and is kept. Also a problem: what only one of the two APIs
has and twins.py does not name, and enumerators with other numbers or names.
"""
import dataclasses
import re
import textwrap

import cpp as cpp_headers
import twins

WIDTH = 117  # leaves room for the end of a comment
DEFAULTS = "/* == defaults == */"
C_TYPES = {"bool": "uint32_t", "std::uint32_t": "uint32_t", "std::uint64_t": "uint64_t", "float": "float", "double": "double"}
problems = []
used = set()  # patterns of twins.py that something is listed by


def listed(name, table):
    """Whether a pattern of this table of exceptions is the name; marks it as used."""
    for pattern in table:
        if re.fullmatch(pattern, name):
            used.add(pattern)
            return True
    return False


def capitals(name):
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).upper()


def camel(name):
    return re.sub(r"_(\w)", lambda found: found[1].upper(), name)


def first_parameter(declaration):
    """The name of the first parameter of a function, which tells overloads apart."""
    found = re.search(r"\(.*?(\w+)(?: = [^,]*)?[,)]", declaration)
    return found[1] if found else ""


class Cpp:
    """All that the C++ headers declare, by name."""

    def __init__(self, read):
        self.heads, self.entities = {}, {}
        for header in re.findall(r'#include "tspace/(\w+\.h)"', read("tspace.hpp")):
            self.heads[header], entities = cpp_headers.parse(read(header))
            self.add(entities, header)
        # In C, options and reports of the calls on files are JSON.
        for header in twins.FILE_HEADERS:
            self.add((entity for entity in cpp_headers.parse(read(header))[1] if entity.kind == "function"), header)

    def add(self, entities, header):
        for entity in entities:
            entity.header = header
            overload = f"{entity.name}({first_parameter(entity.type)})" if entity.kind == "function" else ""
            if overload in twins.TWINS.values():
                entity.name = overload
            if entity.name not in self.entities or entity.doc:
                self.entities[entity.name] = entity


@dataclasses.dataclass
class Item:
    """A declaration of a C header, with the comment above or behind it."""
    kind: str  # that of an Entity, or "enum" for one on a line
    name: str
    owner: str
    value: str = ""
    code: str = ""
    comment: str = ""
    text: str = ""  # comment and code as they stand there

    def full(self):
        return f"{self.owner}.{self.name.partition(',')[0]}" if self.kind == "field" else self.name


def comment_lines(text):
    """What stands in a comment, as lines."""
    text = re.sub(r"^\s*/\* ?|\s*\*/\s*$", "", text)
    return [re.sub(r"^\s*\* ?", "", line) if i else line for i, line in enumerate(text.split("\n"))]


def items(text):
    """The parts of a C header in their order: text to keep as it is, and items."""
    lines = text.split("\n")
    at, owner, typedef, above = 0, "", "", None
    while at < len(lines):
        line = lines[at]
        if line.strip().startswith("/*"):
            if above:
                yield above
            first = at
            while "*/" not in lines[at]:
                at += 1
            at += 1
            above = "\n".join(lines[first:at])
            continue
        first = at
        if re.match(r"\S", line) and not line.startswith(("#", "}", "static", "inline", "enum")):
            while not re.search(r"[;{}](\s*/\*.*\*/)?$", lines[at]):
                at += 1
        at += 1
        code = "\n".join(lines[first:at])
        behind = re.search(r"\s*(/\*.*\*/)$", code)
        bare = code[: behind.start()] if behind else code
        comment = above if above else behind[1] if behind else ""
        text = f"{above}\n{code}" if above else code
        found = _declared(bare, owner, typedef)
        yield Item(*found, bare, comment, text) if found else text
        above = None
        if re.match(r"typedef struct (tspace_\w+) \{", bare):
            owner = found[1]
        elif bare.startswith("enum {"):
            owner = "" if bare.endswith("};") else typedef
        elif bare.startswith("}"):
            owner = ""
        typedef = found[1] if found and found[0] == "type" else typedef
    if above:
        yield above


def _declared(code, owner, typedef):
    patterns = (
        ("type", r"typedef struct (tspace_\w+)(?: \{| tspace_\w+;)$"),
        ("type", r"typedef uint32_t (tspace_\w+);$"),
        ("function", r"typedef [^(]*\(\*(tspace_\w+)\)"),
        ("function", r"[^(]*?\b(tspace_\w+)\([^{}]*TSPACE_NOEXCEPT;$"),
        ("constant", r"#define (TSPACE_[A-Z_]+) (?:UINT|0x)"),
    )
    for kind, pattern in patterns:
        found = re.match(pattern, code, re.S)
        if found:
            return kind, found[1], "", ""
    if code.startswith("enum {"):
        return "enum", "", typedef, code
    if owner and code.startswith("    "):
        found = re.match(r" +(TSPACE_\w+) = (\d+),?$", code)
        if found:
            return "enumerator", found[1], owner, found[2]
        found = re.match(r".*?\(\*(\w+)\)\(", code, re.S) or re.match(r".*?((?:\w+, )*\w+)(\[\d+\])?;$", code)
        if found:
            return "field", found[1], owner, ""
    return None


class Pairs:
    """Which declaration of C is which of C++."""

    def __init__(self, cpp, all_items):
        self.cpp, self.twin, self.c_name, self.c_only = cpp, {}, {}, set()
        for item in all_items:
            if item.kind == "enum":  # on one line
                for name, value in re.findall(r"(TSPACE_\w+) = (\d+)", item.value):
                    self.pair(Item("enumerator", name, item.owner, value))
            else:
                self.pair(item)
        for name in cpp.entities:
            owner = name.partition("::")[0]
            if name not in self.c_name:
                if not listed(owner, twins.CPP_ALONE) and not listed(name, twins.CPP_ALONE):
                    problems.append(f"{name} has no twin in C, and twins.py does not say why")

    def pair(self, item):
        if ", " in item.name:  # several fields on a line
            for name in item.name.split(", "):
                self.pair(Item("field", name, item.owner))
            return
        full = item.full()
        name = self.find(item, full)
        if name in self.cpp.entities and not (item.kind == "type" and listed(full, twins.C_ALONE)):
            self.twin[full] = self.cpp.entities[name]
            self.c_name.setdefault(name, full)
            return
        self.c_only.add(full)
        if not listed(full, twins.C_ALONE) and not listed(item.owner or full, twins.C_ALONE):
            problems.append(f"{full} has no twin in C++, and twins.py does not say why")

    def find(self, item, full):
        if full in twins.TWINS:
            used.add(full)
            return twins.TWINS[full]
        owner = twins.TWINS.get(item.owner, item.owner[len("tspace_"):])
        if item.kind == "enumerator":
            for entity in self.cpp.entities.values():
                if entity.kind == "enumerator" and entity.owner == owner and entity.value == item.value:
                    if not full.endswith("_" + capitals(entity.name.partition("::")[2])):
                        problems.append(f"{full} is {entity.name} in C++: another name for one number")
                    return entity.name
            return ""
        if item.kind == "field":
            method = f"{owner}::{camel(item.name)}"
            is_method = method in self.cpp.entities and not listed(full, twins.C_ALONE)
            return method if is_method else f"{owner}::{item.name}"
        if item.kind == "constant":
            return "k" + camel("_" + item.name[len("TSPACE_"):].lower())
        return item.name[len("tspace_"):]


class Words:
    """Puts sentences of the C++ headers into the names of C."""

    NAME = re.compile(r"(?<!\w)(`?)([A-Za-z]\w*)(?:(::|\.)(\w+))?(\(\))?(`?)")
    LEFT = re.compile(r"\*/|/\*|\w*::\w+|\bstd\b|\bk[A-Z]\w+|(?<![\"_A-Za-z])[a-z]{2,}[A-Z][a-z]\w+(?!\")\b")

    def __init__(self, pairs):
        self.pairs = pairs
        self.enumerators, self.methods, self.codes = {}, {}, {}
        for name, c in pairs.c_name.items():
            owner, _, member = name.rpartition("::")
            kind = pairs.cpp.entities[name].kind
            if owner == "ErrorCode" and member not in ("ok", "internal"):
                self.codes[member] = c.replace("TSPACE_ERROR_", "")
            elif kind == "enumerator":
                self.enumerators.setdefault(member, []).append((pairs.cpp.entities[name].header, c))
            elif kind == "method" and "." not in c:
                self.methods[member] = c

    def of(self, text, entity):
        for phrase, c in twins.PHRASES.items():
            if re.search(phrase, text):
                used.add(phrase)
                text = re.sub(phrase, c, text)
        text = self.NAME.sub(lambda found: self.word(found, entity), text).replace("an tspace_", "a tspace_")
        left = self.LEFT.search(text)
        if left and left[0] not in twins.WORDS:
            problems.append(f"{entity.name}: what is \"{left[0]}\" in C?")
        return text

    def word(self, found, entity):
        """One name: name, Type::member, name(), object.name(), or any of them in backticks."""
        tick, name, between, member, call, _ = found.groups()
        before, after = found.string[: found.start()], found.string[found.end():]
        if between:
            if between == "." and call and member in self.methods:
                return f"{self.methods[member]}({name})"
            return self.pairs.c_name.get(f"{name}::{member}", found[0]) if between == "::" else found[0]
        own = f"{entity.name if entity.kind == 'type' else entity.owner}::{name}"
        if call and own in self.pairs.c_name and self.pairs.cpp.entities[own].kind == "method":
            return self.pairs.c_name[own].rpartition(".")[2]
        c = self.pairs.c_name.get(name)
        if c:
            kind = self.pairs.cpp.entities[name].kind
            is_prose = re.fullmatch("[A-Za-z][a-z]+", name)  # a word of prose too
            if not is_prose or tick or (re.search("[a-z] $", before) if kind == "type" else call or after[:1] == "("):
                return f"{tick}{c}{tick}"
        if name in self.codes and not before.endswith('"'):
            return self.codes[name]
        if tick and entity.header not in twins.FILE_HEADERS:
            return self.enumerator(name, entity.header) or found[0]
        return {"true": "1", "false": "0"}.get(name, found[0])

    def enumerator(self, name, header):
        """The one of this name that the header declares, or that all do."""
        found = self.enumerators.get(name, [])
        near = [c for place, c in found if place == header] or [c for _, c in found]
        return near[0] if len(near) == 1 else ""


def wrapped(parts, indent):
    """Lines of a comment, of at most WIDTH columns."""
    lines = []
    names = max((len(names) for kind, names, _ in parts if kind == "parameter"), default=0)
    for kind, name, text in parts:
        if kind == "parameter":
            start = name.ljust(max(names + 2, 10))
            lines += textwrap.wrap(text, WIDTH - indent - 3, initial_indent=start, break_long_words=False,
                                   subsequent_indent=" " * len(start), break_on_hyphens=False)
        elif kind == "text":
            lines += textwrap.wrap(text, WIDTH - indent - 3, break_long_words=False, break_on_hyphens=False)
        else:
            lines.append(text)
    return lines


def written(lines, indent):
    """A comment above a declaration."""
    margin = " " * indent
    made = [margin + ("/* " if i == 0 else " * ") + line for i, line in enumerate(lines)]
    made = [line.rstrip() for line in made]
    return "\n".join(made) + (" */" if len(made[-1]) <= 120 - 3 else f"\n{margin} */")


def floats(declaration, name=r"\w+"):
    """What an element of a span is, which C cannot say by a type."""
    found = re.search(rf"(?:StridedSpan|vector)<(?:const )?(?:Vec([234])|float)>(?: {name}\b|$)", declaration)
    return f"{found[1] or 1} float{'s' if found[1] else ''} each" if found else ""


def comment(item, entity, words, defaults):
    """The parts of an item's comment that come from C++, and the lines that are of C alone."""
    own = "\n".join(comment_lines(item.comment)) if item.comment else ""
    found = re.search(r"(?:^|(?<=[\s.]))In C: ", own)
    own = own[found.start():].split("\n") if found else []
    parts = [(kind, names, words.of(text, entity)) for kind, names, text in cpp_headers.blocks(entity.doc, entity.indent)]
    if item.kind == "function":
        for at, (kind, names, text) in enumerate(parts):
            for name in filter(None, names.split(", ")):
                if not re.search(rf"\b{name}\b", item.code):
                    problems.append(f"{item.name} has no parameter \"{name}\", which {entity.name} describes")
                if floats(entity.type, name):
                    parts[at] = (kind, names, f"{floats(entity.type, name)}: {text}")
    elif item.kind == "field":
        parts = parts or [("text", "", "")]
        kind, names, text = parts[0]
        if entity.type == "bool":
            text = f"0 or 1. {text[:1].upper()}{text[1:]}"
        elif floats(entity.type):
            text = f"{floats(entity.type)}: {text[:1].lower()}{text[1:]}"
        default = defaults.get((item.owner, item.name))
        if default:
            text += f"{'.' if re.search('[^.]$', text) else ''} Default: {default}."
        text = text.strip() if text.strip() != f"{floats(entity.type)}:" else floats(entity.type)
        parts = [(kind, names, text), *parts[1:]] if text else []
    if own and parts and not parts[-1][2].endswith("."):
        parts[-1] = (*parts[-1][:2], parts[-1][2] + ".")
    return parts, own


def defaults_of(pairs, words):
    """(type, field) -> value, of the fields of sized structs whose default is not zero."""
    found = {}
    for full, entity in pairs.twin.items():
        owner, _, field = full.partition(".")
        if entity.kind != "field" or f"{owner}.struct_size" not in pairs.c_only or listed(full, twins.OTHER_DEFAULTS):
            continue
        named = pairs.cpp.entities.get(entity.value)  # an enumerator
        zero = named.value if named else entity.value
        if zero not in ("", "{}", "nullptr", "false") and not re.fullmatch(r"0(\.0f)?", zero):
            found[owner, field] = words.of(re.sub(r"\.0f$|f$", "", entity.value), entity)
    return found


def defaults_code(defaults, pairs):
    """The end of the header: what TSPACE_INIT calls."""
    types = list(dict.fromkeys(owner for owner, _ in defaults))
    lines = [DEFAULTS, "/* For TSPACE_INIT: the defaults that are not zero. */",
             "static inline void tspace_setNoDefaults(void* object) { (void)object; }"]
    for kind in types:
        lines.append(f"static inline void {_setter(kind)}({kind}* options) {{")
        for (owner, field), value in defaults.items():
            if owner == kind:
                is_float = pairs.twin[f"{owner}.{field}"].type == "float"
                lines.append(f"    options->{field} = {value}{('f' if '.' in value else '.0f') if is_float else ''};")
        lines.append("}")
    lines += ["", "#ifdef __cplusplus", "}", "", "inline void tspace_setDefaults(void*) noexcept {}"]
    lines += [f"inline void tspace_setDefaults({kind}* options) noexcept {{ {_setter(kind)}(options); }}" for kind in types]
    lines += ["#define TSPACE_SET_DEFAULTS(object) tspace_setDefaults(&(object))", "#else", "/* clang-format off */",
              "#define TSPACE_SET_DEFAULTS(object) \\", "    _Generic((object), \\"]
    lines += [f"        {kind}: {_setter(kind)}, \\" for kind in types]
    lines += ["        default: tspace_setNoDefaults)((void*)&(object))", "/* clang-format on */", "#endif"]
    return "\n".join(lines)


def _setter(kind):
    return f"tspace_set{kind[len('tspace_'):].removesuffix('Options')}Defaults"


def completed(parts, cpp):
    """The parts of a header with the enumerators and fields at its ends that C++ has and it lacks."""
    owner, kind, seen = "", "", []
    for part in parts:
        if isinstance(part, Item):
            if part.kind in ("field", "enumerator"):
                owner, kind = part.owner, part.kind
                seen.append(part)
        elif seen and part.startswith("}"):
            twin = twins.TWINS.get(owner, owner[len("tspace_"):])
            if kind == "enumerator":
                yield from _missing_values(seen, owner, twin, cpp)
            elif seen[0].name == "struct_size":
                yield from _missing_fields(seen, owner, twin, cpp)
            seen = []
        yield part


def _missing_values(seen, owner, twin, cpp):
    there = {item.value for item in seen}
    wanted = [entity for entity in cpp.entities.values() if entity.kind == "enumerator" and entity.owner == twin]
    missing = [entity for entity in wanted if entity.value not in there]
    if not missing:
        return
    first = next(entity for entity in wanted if entity.value == seen[0].value)
    prefix = seen[0].name.removesuffix(capitals(first.name.partition("::")[2]))
    seen[-1].code = seen[-1].code.removesuffix(",") + ","
    for entity in missing:
        name = prefix + capitals(entity.name.partition("::")[2])
        yield Item("enumerator", name, owner, entity.value, f"    {name} = {entity.value},")


def _missing_fields(seen, owner, twin, cpp):
    there = {name for item in seen for name in item.name.split(", ")}
    for entity in cpp.entities.values():
        name = entity.name.rpartition("::")[2]
        is_wanted = entity.kind == "field" and entity.owner == twin and name not in there
        is_enum = any(other.kind == "enumerator" and other.owner == entity.type for other in cpp.entities.values())
        kind = f"tspace_{entity.type}" if is_enum else C_TYPES.get(entity.type)
        if is_wanted and kind and not listed(entity.name, twins.CPP_ALONE):
            yield Item("field", name, owner, code=f"    {kind} {name};")


def rewritten(item, pairs, words, defaults):
    """An item with the comment that it has to have."""
    entity = pairs.twin.get(item.full())
    if not entity:
        return item.text
    indent = len(item.code) - len(item.code.lstrip())
    parts, own = comment(item, entity, words, defaults)
    lines = wrapped(parts, indent) + own
    if not lines:
        return item.code
    line = f"{item.code} /* {' '.join(lines)} */"
    if item.kind in ("field", "enumerator") and len(line) <= WIDTH and len(parts) <= 1:
        return line
    return f"{written(lines, indent)}\n{item.code}"


def section(text, cpp, words):
    """A comment that begins with "== frame.h ==": that at the top of this C++ header."""
    found = re.match(r"/\* == (\w+\.h) ==", text)
    if not found:
        return text
    entity = cpp_headers.Entity(found[1], "head", header=found[1])
    parts = [(kind, names, words.of(part, entity)) for kind, names, part in cpp_headers.blocks(cpp.heads[found[1]])]
    return written([f"== {found[1]} ==", *wrapped(parts, 0)], 0) + text[text.index("*/") + 2:]


def plain(text):
    """Without what scripts/format decides."""
    return "".join(text.replace("\\\n", "").split())


class Headers:
    """The C headers as they have to be: `texts`, by name; and which declaration of C is which of C++: `pairs`."""

    def __init__(self, read):
        cpp = Cpp(read)
        parsed = {name: list(completed(items(read(name).partition(DEFAULTS)[0]), cpp)) for name in twins.C_HEADERS}
        self.items = [item for parts in parsed.values() for item in parts if isinstance(item, Item)]
        self.pairs = pairs = Pairs(cpp, self.items)
        words = Words(pairs)
        self.defaults = defaults_of(pairs, words)
        self.texts = {}
        for name, parts in parsed.items():
            made = "\n".join(rewritten(part, pairs, words, self.defaults) if isinstance(part, Item) else section(part, cpp, words)
                             for part in parts)
            end = read(name).partition(DEFAULTS)[2]
            if end:
                made += defaults_code(self.defaults, pairs) + end[end.rindex("\n#if defined(__GNUC__)"):]
            self.texts[name] = read(name) if plain(made) == plain(read(name)) else made
        tables = (twins.TWINS, twins.C_ALONE, twins.CPP_ALONE, twins.OTHER_DEFAULTS, twins.PHRASES)
        problems.extend(f"twins.py: nothing is \"{name}\"" for table in tables for name in table
                        if name not in used and name not in pairs.c_name.values() and name not in pairs.twin)
