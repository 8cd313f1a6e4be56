# SPDX-License-Identifier: MIT
"""Python: the C API as ctypes (_abi.py), and names of choices for type checkers (_names.py)."""
from c_model import Function
from names import plural, snake

SCALARS = {"uint32_t": "c_uint32", "uint64_t": "c_uint64", "uint8_t": "c_uint8", "size_t": "c_size_t", "int": "c_int",
           "float": "c_float", "double": "c_double", "char": "c_char"}


class Abi:
    def __init__(self, model):
        self.model = model

    def type(self, kind):
        """Pointers to structs are typed; others are addresses, as arrays give them."""
        if isinstance(kind, Function):
            return f"CFUNCTYPE({', '.join([self.type(kind.result), *(self.type(taken) for _, taken in kind.parameters)])})"
        name = SCALARS.get(kind.name, "c_uint32" if kind.name in self.model.enums else kind.name)
        if not kind.pointers:
            return "None" if name == "void" else f"{name} * {kind.count}" if kind.count else name
        is_typed = kind.name in self.model.structs or kind.name == "size_t"
        made = "c_char_p" if name == "c_char" else f"POINTER({name})" if is_typed else "c_void_p"
        return f"POINTER({made})" if len(kind.pointers) == 2 else made

    def signatures(self, functions):
        for function in functions:
            yield f'    "{function.name}": ('
            yield from (f"        {self.type(kind)}," for kind in (function.result, *(kind for _, kind in function.parameters)))
            yield "    ),"


def abi(model, file_model, presets):
    both = Abi(file_model)
    lines = ['"""The C API of tspace, as ctypes: structs, numbers of enumerations, functions. Written by scripts/api.', "",
             'ctypes lets go of the interpreter\'s lock for the time of each call.', '"""', "",
             "from ctypes import (", *(f"    {name}," for name in ("CFUNCTYPE", "POINTER", "Structure", *sorted(
                 {"c_char_p", "c_void_p", *SCALARS.values()} - {"c_uint8"}))), ")", "",
             "from ._library import declare, load", ""]
    for name, values in model.enums.items():
        lines += [f"{plural(snake(name)).upper()} = {{", *(f'    "{value.lower()}": {number},' for value, number in values.items()), "}"]
    lines += ["CONVENTIONS = (", *(f'    "{preset}",' for preset in presets), ")"]
    lines += [f"{name} = {number}" for name, number in model.constants.items()]
    seen = {}
    for struct, members in file_model.structs.items():
        fields = [f'        ("{name}", {both.type(kind)}),' for name, kind in members]
        same = seen.setdefault(tuple(fields), struct)
        if same != struct:
            lines += ["", f"{struct} = {same}"]
            continue
        for callback in {kind.name for _, kind in members if kind.name in file_model.callbacks}:
            lines += ["", f"{callback} = {both.type(file_model.callbacks[callback])}"]
        lines += ["", "", f"class {struct}(Structure):", "    _fields_ = [", *fields, "    ]", ""]
    core = {function.name for function in model.functions}
    lines += ["", "SIGNATURES = {", *both.signatures(model.functions), "}", "FILE_SIGNATURES = {",
              *both.signatures(function for function in file_model.functions if function.name not in core), "}", "",
              'library = load("tspace")', "declare(library, SIGNATURES)"]
    return squeezed(lines)


def squeezed(lines):
    """A text without more than two empty lines in a row, nor trailing ones."""
    text = "# SPDX-License-Identifier: MIT\n" + "\n".join(lines).rstrip() + "\n"
    while "\n\n\n\n" in text:
        text = text.replace("\n\n\n\n", "\n\n\n")
    return text


def names(model, presets):
    lines = ['"""Names of choices, for type checkers. Written by scripts/api."""', "",
             "try:", "    from typing import Literal", "except ImportError:  # pragma: no cover",
             "    from typing_extensions import Literal  # type: ignore", ""]
    choices = {**model.enums, "Preset": presets}
    for name, values in choices.items():
        lines += [f"{name}Name = Literal[", *(f'    "{value.lower()}",' for value in values), "]"]
    return squeezed(lines)
