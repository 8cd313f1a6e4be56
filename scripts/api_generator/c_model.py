# SPDX-License-Identifier: MIT
"""Parses the declarations of C headers: items with their comments, and types, structs and functions for other languages."""
import dataclasses
import os
import re

ITEM = re.compile(r"""
    (?P<above>/\*(?:[^*]|\*(?!/))*\*/\n)?
    (?P<code>
      typedef\ struct\ (?P<struct>tspace_\w+)\ \{
    | typedef\ (?:uint32_t\ (?P<number>tspace_\w+)|struct\ (?P<opaque>tspace_\w+)\ \w+);
    | typedef\ [^;(]*\(\*(?P<callback>tspace_\w+)\)\([^;]*;
    | \w[\w\ *]*?(?P<function>tspace_\w+)\([^{};]*\)\ TSPACE_NOEXCEPT;
    | \#define\ (?P<constant>TSPACE_[A-Z_]+)\ (?:UINT\d+_MAX|0x\w+)
    | \ +(?P<enumerator>TSPACE_\w+)\ =\ (?P<value>\d+),?
    | enum\ \{\ (?P<enumerators>TSPACE_\w+\ =\ .*?)\ \};
    | \ {4}[\w\ *]*\(\*(?P<pointer>\w+)\)\([^;]*;
    | \ {4}\w[\w\ *]*?(?P<field>(?:\w+,\ )*\w+)(?:\[\d+\])?;
    )(?P<behind>\ */\*.*?\*/)?$""", re.X | re.M)
KINDS = {"struct": "type", "number": "type", "opaque": "type", "pointer": "field", "enumerators": "enumerator"}


@dataclasses.dataclass
class Item:
    """A declaration, with the positions of the declaration and its comment in the header."""
    kind: str  # a kind of Entity, or "callback"
    name: str
    owner: str  # the type that a member belongs to
    value: str  # value of an enumerator
    code: str
    comment: str
    start: int
    end: int

    def full(self):
        return f"{self.owner}.{self.name}" if self.kind == "field" else self.name


def items(text):
    owner = ""
    for found in ITEM.finditer(text):
        group = next(name for name in reversed(ITEM.groupindex) if found[name] and name not in ("above", "code", "behind", "value"))
        kind = KINDS.get(group, group)
        names = re.findall(r"TSPACE_\w+" if group == "enumerators" else r"\w+", found[group])
        values = re.findall(r"= (\d+)", found["code"]) if kind == "enumerator" else [""] * len(names)
        owner = found[group] if kind == "type" else owner
        for name, value in zip(names, values):
            yield Item(kind, name, owner if kind in ("field", "enumerator") else "", value, found["code"],
                       found["above"] or found["behind"] or "", found.start(), found.end())


@dataclasses.dataclass(frozen=True)
class Type:
    """A C type: `name` without "tspace_", and for each pointer whether it points to const, innermost first."""
    name: str
    pointers: tuple = ()
    count: str = ""  # size of an array

    def is_number(self):
        return not self.pointers and not self.count


@dataclasses.dataclass
class Function:
    """A function, or a callback as the type of a field or parameter."""
    name: str
    result: Type
    parameters: list  # (name, Type or Function)

    def is_number(self):
        return False


class Model:
    def __init__(self, declared):
        self.enums = {}  # name -> {"MIKKTSPACE": 0}, without the value that marks an uninitialized field
        self.values, self.constants, self.callbacks, self.structs = {}, {}, {}, {}  # structs: name -> [(field, Type or Function)]
        self.functions, self.opaque = [], set()
        for item in declared:
            name, owner = (re.sub("^tspace_|^TSPACE_", "", text) for text in (item.name, item.owner))
            if item.kind == "enumerator":
                self.values[name] = int(item.value)
                self.enums.setdefault(owner, {})[name] = int(item.value)
            elif item.kind == "constant":
                bits = re.search(r"UINT(\d+)_MAX", item.code)
                self.constants[name] = 2 ** int(bits[1]) - 1 if bits else int(item.code.split()[-1], 16)
            elif item.kind == "function":
                self.functions.append(_function(item.code.removesuffix(" TSPACE_NOEXCEPT;")))
            elif item.kind == "callback":
                self.callbacks[name] = _function(item.code[len("typedef "):-1])
            elif item.code.endswith("{"):
                self.structs[name] = []
            elif item.code.startswith("typedef struct"):
                self.opaque.add(name)
            elif item.kind == "field" and item.name not in (field for field, _ in self.structs[owner]):
                self.structs[owner] += _variables(" ".join(item.code.split()))
        for name, values in self.enums.items():
            common = os.path.commonprefix([value for value in values if value != "OK"])
            cut = len(common[: common.rfind("_") + 1])
            named = {value if value == "OK" else value[cut:]: number for value, number in values.items()}
            self.enums[name] = {value: number for value, number in named.items() if value != "UNSET"}

    def is_sized(self, struct):
        return self.structs[struct][0][0] == "struct_size"


def _function(code):
    result, name, parameters = re.match(r"(.*?) ?\(?\*?\b(\w+)\)?\((.*)\)$", " ".join(code.split())).groups()
    ends = re.sub(r",(?![^(]*\))", ";", parameters) + ";"  # separates parameters; commas inside callbacks are kept
    return Function(name, _variable(result)[1], [] if parameters == "void" else list(_variables(ends)))


def _variables(text):
    for code in filter(None, (part.strip() for part in re.split(r";(?![^()]*\))", text))):
        if "(*" in code:
            made = _function(code)
            yield made.name, made
            continue
        first, *others = code.split(", ")
        name, kind = _variable(first)
        yield from ((name, kind) for name in (name, *others))


def _variable(code):
    """Returns (name, Type) of a declaration; the name is empty if the declaration has none."""
    found = re.match(r"(const )?(?:tspace_)?(\w+)(\**)(?: (\w+)(?:\[(\w+)\])?)?$", code)
    return found[4] or "", Type(found[2], tuple(bool(found[1]) and i == 0 for i in range(len(found[3]))), found[5] or "")
