# SPDX-License-Identifier: MIT
"""Generates the declarations of the C API in Python's _abi.py, Rust's sys.rs and C#'s Native.cs: structs, numbers and
functions."""
from c_model import Function
from names import pascal, plural, snake

PYTHON = {"uint32_t": "c_uint32", "uint64_t": "c_uint64", "uint8_t": "c_uint8", "size_t": "c_size_t", "int": "c_int",
          "float": "c_float", "double": "c_double", "char": "c_char"}
RUST = {"uint32_t": "u32", "uint64_t": "u64", "uint8_t": "u8", "size_t": "usize", "int": "i32", "float": "f32",
        "double": "f64", "char": "c_char", "void": "c_void"}
CSHARP = {"uint32_t": "uint", "uint64_t": "ulong", "uint8_t": "byte", "size_t": "UIntPtr", "char": "byte",
          "ConstSpan": "Span"}  # const is dropped from pointers here


class Python:
    HEAD = '''\
# SPDX-License-Identifier: MIT
"""The C API of tspace, as ctypes: structs, numbers of enumerations, functions. Written by scripts/api.

ctypes releases the global interpreter lock during each call.
"""

from ctypes import CFUNCTYPE, POINTER, Structure
from ctypes import c_char, c_char_p, c_double, c_float, c_int, c_size_t, c_uint32, c_uint64, c_void_p

from ._library import declare, load
'''

    def __init__(self, model):
        self.model = model

    def type(self, kind):
        """Returns the type of a pointer: typed for structs, an address for arrays."""
        if isinstance(kind, Function):
            return f"CFUNCTYPE({', '.join(map(self.type, (kind.result, *(taken for _, taken in kind.parameters))))})"
        name = PYTHON.get(kind.name, "c_uint32" if kind.name in self.model.enums else kind.name)
        if not kind.pointers:
            return "None" if name == "void" else f"{name} * {kind.count}" if kind.count else name
        is_typed = kind.name in self.model.structs or kind.name == "size_t"
        made = "c_char_p" if name == "c_char" else f"POINTER({name})" if is_typed else "c_void_p"
        return f"POINTER({made})" if len(kind.pointers) == 2 else made

    def signatures(self, name, functions):
        lines = [f"{name} = {{"]
        for function in functions:
            kinds = (function.result, *(kind for _, kind in function.parameters))
            lines += [f'    "{function.name}": (', *(f"        {self.type(kind)}," for kind in kinds), "    ),"]
        return [*lines, "}"]

    def abi(self, model, presets):
        """Returns _abi.py. `model` describes the core, whose enumerations and functions are declared first."""
        lines = [self.HEAD]
        for name, values in model.enums.items():
            lines += [f"{plural(snake(name)).upper()} = {{", *(f'    "{value.lower()}": {number},' for value, number in values.items()), "}"]
        lines += ["CONVENTIONS = (", *(f'    "{preset}",' for preset in presets), ")"]
        lines += [f"{name} = {number}" for name, number in model.constants.items()]
        seen = {}
        for struct, members in self.model.structs.items():
            fields = [f'        ("{name}", {self.type(kind)}),' for name, kind in members]
            same = seen.setdefault(tuple(fields), struct)
            lines += [f"\n{callback} = {self.type(kind)}" for callback, kind in self.model.callbacks.items()
                      if any(kind.name == callback for _, kind in members)]
            lines += [f"\n{struct} = {same}"] if same != struct else ["", "", f"class {struct}(Structure):", "    _fields_ = [", *fields, "    ]"]
        others = [function for function in self.model.functions if function not in model.functions]
        lines += ["", "", *self.signatures("SIGNATURES", model.functions), *self.signatures("FILE_SIGNATURES", others), "",
                  'library = load("tspace")', "declare(library, SIGNATURES)", ""]
        return "\n".join(lines)


class Rust:
    HEAD = """\
// SPDX-License-Identifier: MIT
//! The C API, as `tspace.h` declares it. Written by scripts/api. Sized structs are checked by the library: a layout that
//! differs is an error of every call, and `tests/` compares the sizes.
#![allow(dead_code)]

use std::os::raw::{c_char, c_void};
"""
    INIT = """
/// The function that prepares a sized struct.
pub type Init<Struct> = unsafe extern "C" fn(*mut Struct, u32, *mut Error) -> u32;

extern "C" {"""

    def __init__(self, model):
        self.model = model

    def type(self, kind):
        if isinstance(kind, Function):
            taken = ", ".join(self.type(parameter) for _, parameter in kind.parameters)
            return f'Option<unsafe extern "C" fn({taken}){self.result(kind)}>'
        made = RUST.get(kind.name, "u32" if kind.name in self.model.enums else kind.name)
        made = "".join(f"*{'const' if is_const else 'mut'} " for is_const in reversed(kind.pointers)) + made
        return f"[{made}; {kind.count}]" if kind.count else made

    def result(self, function):
        is_void = function.result.name == "void" and not function.result.pointers
        return "" if is_void else f" -> {self.type(function.result)}"

    def variables(self, members):
        return [f"{'kind' if name == 'type' else name}: {self.type(kind)}" for name, kind in members]

    def sys(self):
        lines = [self.HEAD]
        lines += [f"pub const {name}: {'u64' if number >> 32 else 'u32'} = {number:#x};" for name, number in self.model.constants.items()]
        lines += [f"pub const {name}: u32 = {number};" for name, number in self.model.values.items()]
        for struct, members in self.model.structs.items():
            lines += ["", "#[repr(C)]", "#[derive(Clone, Copy)]", f"pub struct {struct} {{",
                      *(f"    pub {variable}," for variable in self.variables(members)), "}"]
        for name in sorted(self.model.opaque):
            lines += ["", "#[repr(C)]", f"pub struct {name} {{", "    _private: [u8; 0],", "}"]
        lines += [self.INIT, *(f"    pub fn {function.name}({', '.join(self.variables(function.parameters))}){self.result(function)};"
                               for function in self.model.functions), "}", ""]
        return "\n".join(lines)


class CSharp:
    HEAD = """\
// SPDX-License-Identifier: MIT
// The C API, as tspace.h declares it. Written by scripts/api. The library checks sizes of sized structs: a layout that differs
// is an error of every call.
using System;
using System.Runtime.InteropServices;

namespace Tspace
{
    internal static unsafe partial class Native
    {
        // libtspace.so, tspace.dll, libtspace.dylib.
        private const string Library = "tspace";"""

    def __init__(self, model):
        self.model = model

    def type(self, kind):
        if isinstance(kind, Function) or kind.name in self.model.opaque:
            return "IntPtr" + "*" * (0 if isinstance(kind, Function) else len(kind.pointers) - 1)
        return CSHARP.get(kind.name, "uint" if kind.name in self.model.enums else kind.name) + "*" * len(kind.pointers)

    def field(self, name, kind):
        name, made, count = pascal(name), self.type(kind), getattr(kind, "count", "")
        if made == "byte" and count:
            return f"            public fixed byte {name}[{count}];"
        return f"            public {made} {', '.join(f'{name}{i}' for i in range(int(count))) if count else name};"

    def native(self):
        lines = [self.HEAD]
        for struct, members in self.model.structs.items():
            if struct not in CSHARP:
                lines += ["", "        [StructLayout(LayoutKind.Sequential)]", f"        internal partial struct {struct}",
                          "        {", *(self.field(name, kind) for name, kind in members), "        }"]
        lines.append("")
        for function in self.model.functions:
            taken = ", ".join(f"{self.type(kind)} @{name}" for name, kind in function.parameters)
            lines.append(f"        [DllImport(Library)] internal static extern {self.type(function.result)} {function.name}({taken});")
        return "\n".join([*lines, "    }", "}", ""])
