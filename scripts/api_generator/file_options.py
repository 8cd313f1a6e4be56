# SPDX-License-Identifier: MIT
"""Options of calls on files: their names in Python and JavaScript, and their types for type checkers, from the table of
options. Also the types of Python's calls on arrays."""
import ast
import re

from mirrors import js_comment, js_list
from names import camel

PATHS = ("match",)  # options whose value is a name or a path
# Options that the JavaScript module lacks, because it has no threads, disks or importers, and does not copy maps.
NOT_IN_JS = ("threads", "no-sync", "import-seconds", "convert-maps")
JS_CALLS = ("generate", "check", "inspect", "identify", "diff")


def name_of(option):
    return option["name"].replace("-", "_")


def python_name(option):
    return name_of(option) + "_" * (option["name"] == "from")


def python_names(options):
    lines = ["OPTIONS = {"]
    for call, taken in options.items():
        lines += [f'    "{call}": (', *(f'        "{python_name(option)}",' for option in taken), "    ),"]
    return [*lines, "}"]


def choices_of(option):
    """Returns the possible values of an option: its choices, or the alternatives of "up|down" in its help."""
    return option["choices"] or (option["value"].split("|") if "|" in option["value"] else [])


def python_type(option, aliases):
    choices, takes = choices_of(option), option["takes"]
    if not option["value"]:
        return "bool"
    if option["file"] or option["name"] in PATHS:
        return "PathLike"
    if choices:
        quoted = [choice if choice.isdigit() else f'"{choice}"' for choice in choices]
        named = next((name for name, values in aliases.items() if set(values) == set(choices)), "")
        kind = named or f"Literal[{', '.join(quoted)}]"
        return f"Union[str, Sequence[{kind if len(choices) < 20 else 'str'}]]" if option["list"] else kind
    if not takes or "text" in takes:
        return "str"
    if "0.5" in takes:
        return "DegreesOrAuto" if "auto" in takes else "float"
    return "int" if takes == ["1"] else "Size"


def parameters(function):
    """Returns the parameters of a Python function, one per line, with `...` for each default."""
    given = function.args
    given.defaults = [ast.Constant(...)] * len(given.defaults)
    given.kw_defaults = [default and ast.Constant(...) for default in given.kw_defaults]
    given.kwarg = None
    return [f"    {each.replace('=...', ' = ...')}," for each in re.split(r", (?![^[]*\])", ast.unparse(given))]


def functions(source):
    return [node for node in ast.parse(source).body if isinstance(node, ast.FunctionDef) and not node.name.startswith("_")]


def python_file_calls(options, source, aliases):
    lines = []
    for function in functions(source):
        call = camel(re.sub("_(file|bytes)$", "", function.name))
        lines += [f"def {function.name}(", *parameters(function), *([] if function.args.kwonlyargs else ["    *,"]),
                  *(f"    {python_name(option)}: {python_type(option, aliases)} = ...," for option in options[call]),
                  f") -> {ast.unparse(function.returns)}: ..."]
    return lines


def python_array_calls(*sources):
    """Returns functions of arrays as type checkers see them: what they return depends on their argument `full`."""
    lines = []
    for function in sum(map(functions, sources), []):
        full = next((each for each in function.args.kwonlyargs if each.arg == "full"), None)
        for choice, returned in zip((False, True), function.returns.slice.elts if full else ()):
            full.annotation = ast.parse(f"Literal[{choice}]").body[0].value
            lines += ["", "", "@overload", f"def {function.name}(", *parameters(function), f") -> {ast.unparse(returned)}: ..."]
            function.args.kw_defaults[function.args.kwonlyargs.index(full)] = None
    return lines


def js_options(options, call):
    common = {option["name"] for option in options["inspect"]}
    return [option for option in options[call] if option["name"] not in NOT_IN_JS and (option["name"] not in common) != (call == "inspect")]


def js_names(options):
    lines = ["export const optionNames = {"]
    for call in JS_CALLS:
        lines += [f"  {call}: [", *js_list([camel(name_of(option)) for option in js_options(options, call)], "    "), "  ],"]
    return [*lines, "};"]


def js_type(option):
    choices = choices_of(option)
    if not option["value"]:
        return "boolean"
    if option["list"]:
        return "string | readonly string[]"
    if choices:
        return " | ".join(f'"{choice}"' for choice in choices)
    return "number | string" if option["takes"] and "text" not in option["takes"] else "string"


def js_types(options):
    lines = []
    for call in JS_CALLS:
        name = "File" if call == "inspect" else call.capitalize()
        lines += ["", f"export interface {name}{'Options' if call == 'inspect' else 'FileOptions'} {{"]
        for option in js_options(options, call):
            text = re.sub(r"--([a-z][a-z-]+)", lambda found: f"`{camel(found[1].replace('-', '_'))}`", option["help"])
            if option["default"]:
                text += f" Default: {option['default']}."
            lines += [*js_comment(text, "  ", 116), f"  {camel(name_of(option))}?: {js_type(option)};"]
        lines.append("}")
    return lines
