# SPDX-License-Identifier: MIT
"""Types, structs and functions of the C headers, for declarations in other languages."""
import dataclasses
import re


@dataclasses.dataclass(frozen=True)
class Type:
    """A C type: `name` without "tspace_", and for each pointer whether it points to const, innermost first."""
    name: str
    pointers: tuple = ()
    count: str = ""  # size of an array
    result: "Type" = None  # of a function or a pointer to one; others have none
    parameters: tuple = ()  # (name, Type)

    def is_number(self):
        return not (self.pointers or self.count or self.result)


class Model:
    """Declarations of C headers by their names without "tspace_" and "TSPACE_"."""

    def __init__(self, declared, enums):
        self.enums = enums  # name -> its enumerators in C++
        self.values, self.constants, self.callbacks, self.functions, self.structs, self.opaque = {}, {}, {}, {}, {}, set()
        for item in declared:
            name, owner = (re.sub("^(tspace|TSPACE)_", "", text) for text in (item.name, item.owner))
            code = re.sub("^typedef | TSPACE_NOEXCEPT|;$", "", " ".join(item.code.split()))
            if item.kind == "enumerator":
                self.values[name] = int(item.value())
            elif item.kind == "constant":
                bits = re.search(r"UINT(\d+)_MAX", code)
                self.constants[name] = 2 ** int(bits[1]) - 1 if bits else int(code.split()[-1], 16)
            elif item.kind == "function":
                self.functions[item.name] = variable(code)[1]
            elif item.kind == "callback":
                self.callbacks[name] = variable(code)[1]
            elif code.endswith("{"):
                self.structs[name] = {}  # field -> Type
            elif code.startswith("struct"):
                self.opaque.add(name)
            elif item.kind == "field":
                first, *others = [code] if "(" in code else code.split(", ")
                field, kind = variable(first)
                self.structs[owner].update(dict.fromkeys((field, *others), kind))

    def is_sized(self, struct):
        return "struct_size" in self.structs[struct]


def variable(code):
    """Returns (name, Type) of a variable, parameter or function; the name is empty if it has none."""
    function = re.match(r"(.*?) ?\(?\*?\b(\w+)\)?\((.*)\)$", code)
    if function:
        taken = re.split(r", (?![^(]*\))", function[3])  # commas inside parameters of callbacks are kept
        parameters = tuple(variable(parameter) for parameter in taken if parameter != "void")
        return function[2], Type("", result=variable(function[1])[1], parameters=parameters)
    is_const, kind, stars, name, count = re.match(r"(const )?(?:tspace_)?(\w+)(\**)(?: (\w+)(?:\[(\w+)\])?)?$", code).groups()
    return name or "", Type(kind, tuple(bool(is_const) and i == 0 for i in range(len(stars))), count or "")
