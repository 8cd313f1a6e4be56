# SPDX-License-Identifier: MIT
"""Parses the declarations and comments of the C++ headers, the single source of the C API and the bindings. Expects
headers formatted by scripts/format; it is not a general C++ parser."""
import dataclasses
import re


@dataclasses.dataclass
class Entity:
    name: str  # "generateNormals", "Method", "Method::best", "TangentOptions::refine"
    kind: str  # "type", "enumerator", "field", "method", "function" or "constant"
    owner: str = ""  # the type that a member belongs to
    type: str = ""  # type of a field; whole declaration of a function
    value: str = ""  # value of a field or an enumerator; "" if it has none
    doc: list = dataclasses.field(default_factory=list)  # lines of the comment, as written
    indent: int = 0  # indentation of the comment
    header: str = ""

    def member(self):
        """Returns the name without its type."""
        return self.name.rpartition("::")[2]


def parse(text):
    """Returns (head, entities): the lines of the comment at the top of a header, and all declarations."""
    lines = text.splitlines()
    head = []
    for line in lines[1:]:
        if not line.startswith("//"):
            break
        head.append(line[3:])
    return head, list(_entities(lines))


def _entities(lines):
    scopes = []  # (kind, name, indent); declarations inside the kind "body" are ignored
    doc, code = [], ""
    for line in lines:
        text = line.strip()
        indent = len(line) - len(line.lstrip())
        if not code and re.match(r"///(?!<)", text):
            doc.append(text[4:])
            continue
        if not code and (not text or text.startswith(("//", "#"))):
            doc = []
            continue
        if scopes and re.match(r"\}", text) and indent == scopes[-1][2]:
            scopes.pop()
            doc = []
            continue
        if text == "private:" and scopes:
            scopes[-1] = ("body", *scopes[-1][1:])
        if (scopes and scopes[-1][0] == "body") or text.endswith(":"):
            continue
        text, _, trailing = text.partition("  ///< ")
        text = text.partition("  // ")[0].rstrip()
        start, code = (indent, text) if not code else (start, f"{code} {text}")
        is_open = code.count("(") != code.count(")") or re.match(r"inline constexpr [^(]*\{$", code)
        if is_open or not (code.endswith((";", "{", "}", ",")) or _is(scopes, "enum")):
            continue
        doc = [trailing] if trailing else doc
        if code.endswith("{") or code.startswith("namespace"):
            scopes.append(_scope(code, start))
        for entity in _declared(re.sub(r"^template <.*?> ", "", code), scopes):
            entity.doc, entity.indent = ([] if code.endswith("};") and entity.kind == "enumerator" else doc), start
            yield entity
        doc, code = [], ""
    if scopes or code:
        raise ValueError(f"this header is written in a way that is not known here: {scopes} {code}")


def _is(scopes, kind):
    return bool(scopes) and scopes[-1][0] == kind


def _scope(code, indent):
    found = re.match(r"(?:template <.*?> )?(enum class|struct|class|namespace) (?:\[\[nodiscard\]\] )?(\w+)", code)
    if not found:
        return ("body", "", indent)
    return ({"enum class": "enum", "namespace": "namespace"}.get(found[1], "type"), found[2], indent)


def _declared(code, scopes):
    found = re.match(r"(enum class|struct|class) (?:\[\[nodiscard\]\] )?(\w+)", code)
    if found:
        yield Entity(found[2], "type")
        if code.endswith("};"):  # an enum on one line
            for name, value in re.findall(r"(\w+) = (\d+)", code):
                yield Entity(f"{found[2]}::{name}", "enumerator", found[2], "", value)
        return
    if re.match(r"(friend|explicit|static_assert|using|requires|~|.*\boperator\b)", code) or "= delete" in code:
        return
    owners = [name for kind, name, _ in scopes if kind in ("type", "enum", "namespace") and name != "tspace"]
    owner = owners[-1] if owners else ""
    prefix = f"{owner}::" if owner else ""
    if _is(scopes, "enum"):
        name, _, value = code.rstrip(",").partition(" = ")
        yield Entity(prefix + name, "enumerator", owner, "", value)
        return
    pointer = re.search(r"\(\*(\w+)\)\(", code)
    call = re.match(r"[^=({]*?(\w+)\(", code)
    constant = re.match(r"inline constexpr (.+?) (\w+)\b(?: = |\{)(.*?)\}?;", code)
    field = re.match(r"(.+?) (\w+)(?:\[\d+\])?(?: = (.*)|\{.*\})?;", code)
    if constant and not call:
        yield Entity(prefix + constant[2], "constant", owner, constant[1], constant[3])
    elif pointer:
        yield Entity(prefix + pointer[1], "field", owner, "function")
    elif call and call[1] != owner:
        yield Entity(prefix + call[1], "method" if owner else "function", owner, code)
    elif field and not call:
        names = re.findall(r"[, ](\w+) = [^,]+", code) if ", " in code and field[1] == "float" else [field[2]]
        for name in names:
            yield Entity(prefix + name, "field", owner, field[1], field[3] or "")


def blocks(entity_doc, indent=0):
    """Splits a comment into ("text", "", words), ("parameter", names, words), ("verbatim", "", line) and ("blank", "",
    ""). A line starts a new part if it describes a parameter, or if the previous line ends a sentence before the
    right margin."""
    made = []
    before = ""
    for line in entity_doc:
        parameter = re.match(r"((?:[a-z_]+, )*[a-z_]+) {2,}(\S.*)", line)
        kind = made[-1][0] if made else "blank"
        has_room = len(before) + indent + 5 + len(line.split(" ")[0]) <= 117 and before.endswith(".")
        if not line:
            made.append(["blank", "", ""])
        elif parameter:
            made.append(["parameter", parameter[1], parameter[2]])
        elif line.startswith("    ") and kind != "parameter":
            made.append(["verbatim", "", line])
        elif line.startswith("  ") or (kind == "text" and not has_room):
            made[-1][2] += " " + line.strip()
        else:
            made.append(["text", "", line])
        before = line
    return [tuple(part) for part in made]
