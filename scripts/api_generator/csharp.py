# SPDX-License-Identifier: MIT
"""C#: the C API as Native.cs."""
from c_model import Function
from names import pascal

SCALARS = {"uint32_t": "uint", "uint64_t": "ulong", "uint8_t": "byte", "size_t": "UIntPtr", "char": "byte",
           "ConstSpan": "Span"}  # pointers are never const here
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
        private const string Library = "tspace";
"""


def _type(kind, model):
    if isinstance(kind, Function):
        return "IntPtr"
    if kind.name in model.opaque:
        return "IntPtr" + "*" * (len(kind.pointers) - 1)
    return SCALARS.get(kind.name, "uint" if kind.name in model.enums else kind.name) + "*" * len(kind.pointers)


def _fields(members, model):
    for name, kind in members:
        name, made, count = pascal(name), _type(kind, model), getattr(kind, "count", "")
        if not count:
            yield f"            public {made} {name};"
        elif made == "byte":
            yield f"            public fixed byte {name}[{count}];"
        else:
            yield f"            public {made} {', '.join(f'{name}{i}' for i in range(int(count)))};"


def native(model):
    lines = [HEAD.rstrip("\n")]
    for struct, members in model.structs.items():
        if struct not in SCALARS:
            lines += ["", "        [StructLayout(LayoutKind.Sequential)]", f"        internal partial struct {struct}",
                      "        {", *_fields(members, model), "        }"]
    lines.append("")
    for function in model.functions:
        taken = ", ".join(f"{_type(kind, model)} @{name}" for name, kind in function.parameters)
        lines.append(f"        [DllImport(Library)] internal static extern {_type(function.result, model)} {function.name}({taken});")
    return "\n".join([*lines, "    }", "}", ""])
