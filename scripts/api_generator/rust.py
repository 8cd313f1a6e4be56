# SPDX-License-Identifier: MIT
"""Rust: the C API as sys.rs, in the style of rustfmt."""
from c_model import Function

SCALARS = {"uint32_t": "u32", "uint64_t": "u64", "uint8_t": "u8", "size_t": "usize", "int": "i32", "float": "f32",
           "double": "f64", "char": "c_char", "void": "c_void"}
WORDS = {"type": "kind"}
HEAD = """\
// SPDX-License-Identifier: MIT
//! The C API, as `tspace.h` declares it. Written by scripts/api. Sized structs are checked by the library: a layout that
//! differs is an error of every call, and `tests/` compares the sizes.
#![allow(dead_code)]

use std::os::raw::{c_char, c_void};
"""
INIT = 'pub type Init<Struct> = unsafe extern "C" fn(*mut Struct, u32, *mut Error) -> u32;'


def _type(kind, model):
    if isinstance(kind, Function):
        taken = ", ".join(_type(parameter, model) for _, parameter in kind.parameters)
        return f'Option<unsafe extern "C" fn({taken}){_result(kind, model)}>'
    made = SCALARS.get(kind.name, "u32" if kind.name in model.enums else kind.name)
    for is_const in kind.pointers:
        made = f"*{'const' if is_const else 'mut'} {made}"
    return f"[{made}; {kind.count}]" if kind.count else made


def _result(function, model):
    is_void = function.result.name == "void" and not function.result.pointers
    return "" if is_void else f" -> {_type(function.result, model)}"


def _variables(function, model):
    return ", ".join(f"{WORDS.get(name, name)}: {_type(kind, model)}" for name, kind in function.parameters)


def sys(model):
    lines = [HEAD]
    lines += [f"pub const {name}: {'u64' if number >> 32 else 'u32'} = {number:#x};" for name, number in model.constants.items()]
    lines += [f"pub const {name}: u32 = {number};" for name, number in model.values.items()]
    for struct, members in model.structs.items():
        fields = (f"    pub {WORDS.get(name, name)}: {_type(kind, model)}," for name, kind in members)
        lines += ["", "#[repr(C)]", "#[derive(Clone, Copy)]", f"pub struct {struct} {{", *fields, "}"]
    for name in sorted(model.opaque):
        lines += ["", "#[repr(C)]", f"pub struct {name} {{", "    _private: [u8; 0],", "}"]
    lines += ["", "/// The function that prepares a sized struct.", INIT, "", 'extern "C" {']
    for function in model.functions:
        line = f"    pub fn {function.name}({_variables(function, model)}){_result(function, model)};"
        if len(line) > 100:
            names = (f"        {part}," for part in _variables(function, model).split(", "))
            lines += [f"    pub fn {function.name}(", *names, f"    ){_result(function, model)};"]
        else:
            lines.append(line)
    return "\n".join([*lines, "}", ""])
