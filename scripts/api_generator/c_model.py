# SPDX-License-Identifier: MIT
"""The C API as data: enumerations, constants, structs and functions, from which other languages are written."""
import dataclasses
import os
import re


@dataclasses.dataclass(frozen=True)
class Type:
    """A C type: `name` without "tspace_", and for each pointer whether what it points to is const, the innermost first."""
    name: str
    pointers: tuple = ()
    count: str = ""  # of an array


@dataclasses.dataclass
class Struct:
    name: str
    fields: list  # (name, Type or Callback)

    @property
    def is_sized(self):
        return self.fields[0][0] == "struct_size"


@dataclasses.dataclass
class Function:
    name: str
    result: Type
    parameters: list  # (name, Type or Callback)


Callback = Function  # as the type of a field or parameter


class Model:
    """All that a C header declares, in its order."""

    def __init__(self, text):
        text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
        self.enums = {}  # name -> {"MIKKTSPACE": 0}, without what stands for a value that was forgotten
        self.values = {}  # "METHOD_MIKKTSPACE": 0
        for name, body in re.findall(r"typedef uint32_t tspace_(\w+);\s*enum \{(.*?)\};", text, re.S):
            values = re.findall(r"TSPACE_(\w+) = (\d+)", body)
            common = os.path.commonprefix([value for value, _ in values if value != "OK"])
            cut = len(common[: common.rfind("_") + 1])
            named = {value if value == "OK" else value[cut:]: int(number) for value, number in values}
            self.enums[name] = {value: number for value, number in named.items() if value != "UNSET"}
            self.values.update({value: int(number) for value, number in values})
        numbers = re.findall(r"#define TSPACE_(\w+) (?:UINT(\d+)_MAX|(0x\w+))", text)
        self.constants = {name: 2 ** int(bits) - 1 if bits else int(number, 16) for name, bits, number in numbers}
        self.opaque = set(re.findall(r"typedef struct tspace_(\w+) tspace_\1;", text))
        self.callbacks = {name: _function(name, result, parameters) for result, name, parameters in
                          re.findall(r"typedef (\w+) \(\*tspace_(\w+)\)\((.*?)\);", text, re.S)}
        self.structs = {name: Struct(name, list(_variables(body)))
                        for name, body in re.findall(r"typedef struct tspace_(\w+) \{(.*?)\} tspace_\w+;", text, re.S)}
        self.functions = [_function(name, result, parameters) for result, name, parameters in
                          re.findall(r"^(\w[\w ]*?\**)\s*\b(tspace_\w+)\(([^()]*)\) TSPACE_NOEXCEPT;", text, re.M)]


def _function(name, result, parameters):
    ends = re.sub(r",(?![^(]*\))", ";", parameters) + ";"  # commas between parameters, not those of callbacks
    return Function(name, _type(result)[1], [] if parameters == "void" else list(_variables(ends)))


def _variables(text):
    for code in filter(None, (" ".join(part.split()) for part in re.split(r";(?![^()]*\))", text))):
        callback = re.match(r"(.*?) ?\(\*(\w+)\)\((.*)\)$", code)
        if callback:
            yield callback[2], _function(callback[2], callback[1], callback[3])
            continue
        first, *others = code.split(", ")
        name, kind = _type(first)
        yield name, kind
        for other in others:
            yield other, kind


def _type(code):
    """(name, Type) of a declaration; the name is empty where it has none."""
    found = re.match(r"(const )?(?:tspace_)?(\w+)(\**)(?: (\w+)(?:\[(\w+)\])?)?$", code)
    pointers = tuple(bool(found[1]) and i == 0 for i in range(len(found[3])))
    return found[4] or "", Type(found[2], pointers, found[5] or "")


def snake(name):
    """CounterClockwise: counter_clockwise."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


def pascal(name):
    """counter_clockwise: CounterClockwise."""
    return "".join(part[:1].upper() + part[1:].lower() for part in name.split("_"))


def camel(name):
    made = pascal(name)
    return made[:1].lower() + made[1:]


def plural(name):
    return re.sub("iss$", "es", name + "s") if not name.endswith(("ness", "gons")) else name + "es" * name.endswith("ness")
