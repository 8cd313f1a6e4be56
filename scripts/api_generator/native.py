# SPDX-License-Identifier: MIT
"""Generates the declarations of the C API in Python's _abi.py, Rust's sys.rs and C#'s Native.cs: structs, numbers and
functions."""
from names import pascal, plural, snake

PYTHON = {"uint32_t": "c_uint32", "uint64_t": "c_uint64", "uint8_t": "c_uint8", "size_t": "c_size_t", "int": "c_int",
          "float": "c_float", "double": "c_double", "char": "c_char"}
RUST = {"uint32_t": "u32", "uint64_t": "u64", "uint8_t": "u8", "size_t": "usize", "int": "i32", "float": "f32",
        "double": "f64", "char": "c_char", "void": "c_void"}
CSHARP = {"uint32_t": "uint", "uint64_t": "ulong", "uint8_t": "byte", "size_t": "UIntPtr", "char": "byte",
          "ConstSpan": "Span"}  # const is dropped from pointers here


def python_type(kind, model):
    """Returns the type of a pointer: typed for structs, an address for arrays."""
    if kind.result:
        return f"CFUNCTYPE({', '.join(python_type(each, model) for each in (kind.result, *(taken for _, taken in kind.parameters)))})"
    name = PYTHON.get(kind.name, "c_uint32" if kind.name in model.enums else kind.name)
    if not kind.pointers:
        return "None" if name == "void" else f"{name} * {kind.count}" if kind.count else name
    is_typed = kind.name in model.structs or kind.name == "size_t"
    made = "c_char_p" if name == "c_char" else f"POINTER({name})" if is_typed else "c_void_p"
    return f"POINTER({made})" if len(kind.pointers) == 2 else made


def python_abi(core, model, presets):
    """Returns _abi.py. `core` describes the core, whose functions are declared first; `model` describes everything."""
    def dictionary(name, rows):
        return [f"{name} = {{", *rows, "}"]

    def signatures(functions):
        for name, kind in functions:
            kinds = (kind.result, *(taken for _, taken in kind.parameters))
            yield from (f'    "{name}": (', *(f"        {python_type(each, model)}," for each in kinds), "    ),")

    lines = []
    for name, choices in core.enums.items():
        lines += dictionary(plural(snake(name)).upper(), (f'    "{snake(entity.member())}": {entity.value()},' for entity in choices))
    lines += ["CONVENTIONS = (", *(f'    "{preset}",' for preset in presets), ")"]
    lines += [f"{name} = {number}" for name, number in core.constants.items()]
    seen = {}
    for struct, members in model.structs.items():
        fields = [f'        ("{name}", {python_type(kind, model)}),' for name, kind in members.items()]
        same = seen.setdefault(tuple(fields), struct)
        lines += [f"\n{callback} = {python_type(kind, model)}" for callback, kind in model.callbacks.items()
                  if any(member.name == callback for member in members.values())]
        lines += [f"\n{struct} = {same}"] if same != struct else ["", "", f"class {struct}(Structure):", "    _fields_ = [", *fields, "    ]"]
    others = [function for function in model.functions.items() if function[0] not in core.functions]
    lines += ["", "", *dictionary("SIGNATURES", signatures(core.functions.items())), *dictionary("FILE_SIGNATURES", signatures(others)), "",
              'library = load("tspace")', "declare(library, SIGNATURES)"]
    return lines


def rust_type(kind, model):
    if kind.result:
        return f'Option<unsafe extern "C" fn({", ".join(rust_type(taken, model) for _, taken in kind.parameters)}){rust_result(kind, model)}>'
    made = RUST.get(kind.name, "u32" if kind.name in model.enums else kind.name)
    made = "".join(f"*{'const' if is_const else 'mut'} " for is_const in reversed(kind.pointers)) + made
    return f"[{made}; {kind.count}]" if kind.count else made


def rust_result(function, model):
    made = rust_type(function.result, model)
    return "" if made == "c_void" else f" -> {made}"


def rust_sys(model):
    def variables(members):
        return [f"{'kind' if name == 'type' else name}: {rust_type(kind, model)}" for name, kind in members]

    lines = []
    lines += [f"pub const {name}: {'u64' if number >> 32 else 'u32'} = {number:#x};" for name, number in model.constants.items()]
    lines += [f"pub const {name}: u32 = {number};" for name, number in model.values.items()]
    for struct, members in model.structs.items():
        lines += ["", "#[repr(C)]", "#[derive(Clone, Copy)]", f"pub struct {struct} {{",
                  *(f"    pub {variable}," for variable in variables(members.items())), "}"]
    for name in sorted(model.opaque):
        lines += ["", "#[repr(C)]", f"pub struct {name} {{", "    _private: [u8; 0],", "}"]
    return [*lines, "", 'extern "C" {', *(f"    pub fn {name}({', '.join(variables(kind.parameters))}){rust_result(kind, model)};"
                                       for name, kind in model.functions.items()), "}"]


def csharp_type(kind, model):
    if kind.result:
        return "IntPtr"
    if kind.name in model.opaque:
        return "IntPtr" + "*" * (len(kind.pointers) - 1)
    return CSHARP.get(kind.name, "uint" if kind.name in model.enums else kind.name) + "*" * len(kind.pointers)


def csharp_native(model):
    def field(name, kind):
        name, made = pascal(name), csharp_type(kind, model)
        if made == "byte" and kind.count:
            return f"            public fixed byte {name}[{kind.count}];"
        return f"            public {made} {', '.join(f'{name}{i}' for i in range(int(kind.count))) if kind.count else name};"

    lines = []
    for struct, members in model.structs.items():
        if struct not in CSHARP:
            lines += ["", "        [StructLayout(LayoutKind.Sequential)]", f"        internal partial struct {struct}",
                      "        {", *(field(*member) for member in members.items()), "        }"]
    lines.append("")
    for name, kind in model.functions.items():
        taken = ", ".join(f"{csharp_type(each, model)} @{parameter}" for parameter, each in kind.parameters)
        lines.append(f"        [DllImport(Library)] internal static extern {csharp_type(kind.result, model)} {name}({taken});")
    return [*lines, "    }", "}"]
