# SPDX-License-Identifier: MIT
"""C: comments and defaults of the C headers, from the C++ headers. Text after "In C:" describes only the C API and is kept."""
import re
import textwrap

WIDTH = 117  # keeps columns free for the end of a comment
# Regular expressions in C++ comments -> their replacements in C comments.
PHRASES = {
    r"`?conventions::(\w+)`?": r'"\1"',
    r"those of convertMap and of readers of models": "those of readers of models",
    r"those of heightToNormal and of convertMapFile": "those of tspace_convertMapFile",
    r"those of bakeMap, except that rays without a hit are reported as a finding; also": "MISSING_ATTRIBUTE (a low poly without "
    "UVs), INVALID_OPTION, OUT_OF_MEMORY; rays that hit nothing are reported as a finding. Also",
    r"Error::element is a BakeInput: `high` for the input and `low` for the low poly\.": "tspace_Error.element is 1 for "
    "errors about the input, and 0 for errors about the low poly.",
    r"`?(crease|denoise|weld)_auto`?": "-1",
    r"mesh\.vertexCount\(\)": "mesh->positions.count",
    r"mesh\.cornerCount\(\)": "tspace_cornerCount(mesh)",
    r"(?<=[a-z] )(Allocator|Arena)\b": r"tspace_\1",
    r"Returns null for any other name\.": "INVALID_OPTION for any other name.",
}
SETTER = re.compile(r"^(static inline void tspace_set\w+Defaults\((\w+)\* options\) \{).*?\}", re.M | re.S)
NAME = re.compile(r"(?<![\w\"])`?[A-Za-z]\w*(?:::\w+)?(?:\(\)?)?`?")
# What looks like a C++ name, with exceptions.
CPP_NAME = re.compile(r"\*/|/\*|\w*::\w+|\bstd\b|\bk[A-Z]\w+|(?<![\"_A-Za-z])(?!lowerCamelCase|normalTexture)[a-z]{2,}[A-Z][a-z]\w+(?!\")\b")


class Words:
    """Rewrites sentences of the C++ headers with the names of the C API."""

    def __init__(self, pairs):
        self.problems = pairs.problems
        self.forms = {("", "true"): "1", ("", "false"): "0"}  # (type, header or "", name as written in C++) -> name in C
        for name, c in pairs.c_name.items():
            entity = pairs.entities[name]
            member, is_prose = entity.member(), re.fullmatch("[A-Za-z][a-z]+", name)  # an ordinary English word as well
            forms = {("", name): c, ("", f"`{name}`"): f"`{c}`"}
            if entity.kind == "method":
                forms = {(entity.owner, f"{member}()"): c.rpartition(".")[2]}
            elif entity.kind == "function":
                forms |= {("", f"{name}("): f"{c}(", ("", f"{name}()"): c}
            elif entity.kind == "enumerator":
                forms[entity.header, f"`{member}`"] = c
            if entity.owner == "ErrorCode" and member not in ("ok", "internal"):
                forms["", member] = c.replace("TSPACE_ERROR_", "")
            if is_prose:
                del forms["", name]
            self.forms |= forms

    def of(self, text, entity):
        for phrase, c in PHRASES.items():
            text = re.sub(phrase, c, text)
        places = (entity.owner or entity.name, entity.header, "")
        text = NAME.sub(lambda found: next((self.forms[place, found[0]] for place in places if (place, found[0]) in self.forms), found[0]), text)
        left = CPP_NAME.search(text)
        if left:
            self.problems.append(f"{entity.name}: what is \"{left[0]}\" in C?")
        return text.replace("an tspace_", "a tspace_")


def generated(pairs):
    """Returns the C headers, by name."""
    words = Words(pairs)
    defaults, fields = defaults_of(pairs, words), {}
    for name, value in defaults.items():
        owner, _, field = name.partition(".")
        suffix = ("f" if "." in value else ".0f") if pairs.twin[name].type() == "float" else ""
        fields.setdefault(owner, []).append(f"    options->{field} = {value}{suffix};\n")

    def section(found):
        """Replaces a comment that begins with "== frame.h ==" by the comment at the top of this C++ header."""
        head = pairs.heads[found[1]]
        return above([f"== {found[1]} ==", *wrapped([(names, words.of(text, head)) for names, text in head.paragraphs()], 0)], 0)

    def setter(found):
        """Replaces the body of a function that sets the defaults of a struct."""
        return f"{found[1]}\n{''.join(fields.pop(found[2], ()))}}}"

    texts = {}
    for name, text in pairs.texts.items():
        for item in reversed(pairs.items[name]):
            if item.name in pairs.twin:
                text = text[: item.start] + rewritten(item, pairs, words, defaults) + text[item.end:]
        texts[name] = re.sub(r"/\* == (\w+\.h) ==.*?\*/", section, text, flags=re.S)
        texts[name] = SETTER.sub(setter, texts[name])
    pairs.problems += [f"{owner} has defaults, and tspace.h has no function that sets them" for owner in fields]
    return texts


def rewritten(item, pairs, words, defaults):
    """Returns a declaration with its generated comment, and the part of its present comment that describes only the C API."""
    present = re.sub(r"^[ /]*\* ?|\s*\*/\s*$", "", item.comment, flags=re.M)
    own = re.search(r"(?:^|(?<=[\s.]))In C: .*", present, re.S)
    paragraphs = described(item, pairs.twin[item.name], words, defaults.get(item.name))
    if own and paragraphs and not paragraphs[-1][1].endswith("."):
        paragraphs[-1] = (paragraphs[-1][0], paragraphs[-1][1] + ".")
    lines = wrapped(paragraphs, item.indent()) + (own[0].split("\n") if own else [])
    line = f"{item.code} /* {' '.join(lines)} */"
    is_short = item.kind in ("field", "enumerator") and len(line) <= WIDTH and len(paragraphs) <= 1
    return (line if is_short else f"{above(lines, item.indent())}\n{item.code}") if lines else item.code


def described(item, entity, words, default):
    """Returns the paragraphs of a comment that come from C++."""
    paragraphs = [(names, words.of(text, entity)) for names, text in entity.paragraphs()]
    if item.kind == "function":
        for name in filter(None, (name for names, _ in paragraphs for name in names.split(", "))):
            if not re.search(rf"\b{name}\b", item.code):
                words.problems.append(f"{item.name} has no parameter \"{name}\", which {entity.name} describes")
        return [(names, f"{floats(entity.code, names)}{text}") for names, text in paragraphs]
    if item.kind != "field":
        return paragraphs
    (names, text), *others = paragraphs or [("", "")]
    if entity.type() == "bool":
        text = f"0 or 1. {text[:1].upper()}{text[1:]}"
    elif floats(entity.code, r"\w+"):
        text = (floats(entity.code, r"\w+") + text[:1].lower() + text[1:]).removesuffix(": ")
    if default:
        text += f"{'.' if re.search('[^.]$', text) else ''} Default: {default}."
    return [(names, text.strip()), *others] if text else []


def floats(code, name):
    """Returns the element type of a span, which the C type does not show."""
    found = re.search(rf"(?:StridedSpan|vector)<(?:const )?(?:Vec([234])|float)> {name}\b", code) if name else None
    return f"{found[1] or 1} float{'s' if found[1] else ''} each: " if found else ""


def wrapped(paragraphs, indent):
    """Returns the lines of a comment, each of at most WIDTH columns."""
    lines, widest = [], max(len(names) for names, _ in paragraphs) if paragraphs else 0
    for names, text in paragraphs:
        start = names.ljust(max(widest + 2, 10)) if names else ""
        lines += [text] if text.startswith(" ") else textwrap.wrap(
            text, WIDTH - indent - 3, initial_indent=start, subsequent_indent=" " * len(start), break_long_words=False,
            break_on_hyphens=False) or [""]
    return lines


def above(lines, indent):
    """Returns the lines of a comment above a declaration."""
    margin = " " * indent
    text = "\n".join((margin + ("/* " if i == 0 else " * ") + line).rstrip() for i, line in enumerate(lines))
    return text + (" */" if len(text.split("\n")[-1]) <= 120 - 3 else f"\n{margin} */")


def defaults_of(pairs, words):
    """Returns name in C -> value for the fields of options with a nonzero default."""
    found = {}
    for name, entity in pairs.twin.items():
        if entity.kind == "field" and entity.owner.endswith("Options"):
            enumerator = pairs.entities.get(entity.value())
            if not re.fullmatch(r"|\{\}|nullptr|false|0(\.0f)?", enumerator.value() if enumerator else entity.value()):
                found[name] = words.of(re.sub(r"\.0f$|f$", "", entity.value()), entity)
    return found
