# SPDX-License-Identifier: MIT
"""C++: conversions between structs of the C API and their C++ counterparts, and checks that both have the same values
(c_fields.h)."""
from names import snake


def fields(pairs):
    structs = {}
    lines = []
    for full, entity in pairs.twin.items():
        owner, _, field = full.partition(".")
        if entity.kind == "enumerator":
            lines.append(f"static_assert({full} == static_cast<std::uint32_t>({entity.name}));")
        elif entity.kind == "constant":
            lines.append(f"static_assert({full} == {entity.name});")
        elif field and pairs.is_sized(owner):
            structs.setdefault(owner, []).append((field, entity))
    largest = {entity.owner: full for full, entity in pairs.twin.items() if entity.kind == "enumerator"}
    for owner, members in structs.items():
        twin = owner.removeprefix("tspace_")
        if owner.endswith(("Report", "Noise")):
            lines += ["", f"inline {owner} toReport(const {twin}& from) {{", f"    {owner} made;", "    TSPACE_INIT(made);",
                      *(f"    made.{field} = from.{_from_cpp(entity)};" for field, entity in members), "    return made;", "}"]
        elif owner.endswith("Options") and owner != "tspace_PlanBufferOptions":  # options of arrays and structs only
            kinds = [(field, kind) for field, entity in members for kind in [_kind(entity, largest)] if kind]
            lines += ["", f"inline void copyFields(const {owner}& from, {twin}& to) {{",
                      *(f"    to.{field} = {kind.format('from.' + field)};" for field, kind in kinds), "}",
                      "/// Returns an error for the first enumerator or flag that exceeds its largest value, or ok.",
                      f"inline Error checkFields(const {owner}& options) {{",
                      f"    return firstError({(',' + chr(10) + 22 * ' ').join(_checks(members, largest))});", "}"]
    return [*lines, "", "}  // namespace tspace::c_api"]


def _from_cpp(entity):
    name = entity.member()
    return f"{name}()" if entity.kind == "method" else f"{name} ? 1 : 0" if entity.type() == "bool" else name


def _kind(entity, enums):
    """Returns the C++ expression for the value of a field, or "" if the field is not a single number."""
    known = {"bool": "{} != 0", "Convention": "toConvention({})", "float": "{}", "std::uint32_t": "{}"}
    return f"static_cast<{entity.type()}>({{}})" if entity.type() in enums else known.get(entity.type(), "")


def _checks(members, largest):
    for field, entity in members:
        if entity.type() == "Convention":
            yield f"[&] {{ return checkConvention(options.{field}); }}"
        elif entity.type() == "bool" or entity.type() in largest:
            yield f'[&] {{ return checkChoice(options.{field}, {largest.get(entity.type(), 1)}, "{field}"); }}'


def visitors(model):
    """Generates functions that call visit(name, type, value) for each number in a struct."""
    lines = ["/// The numbers of enumerators, by type and name.",
             "inline const std::map<std::string, std::map<std::string, double>> kEnumerators = {"]
    for name, choices in model.enums.items():
        numbers = ", ".join(f'{{"{snake(entity.member())}", {entity.value()}}}' for entity in choices)
        lines.append(f'{{"{name}", {{{numbers}}}}},')
    lines.append("};")
    for struct, fields in model.structs.items():
        numbers = [(name, kind.name) for name, kind in fields.items() if kind.is_number() and name not in ("struct_size", "reserved", "code")
                   and (kind.name in model.enums or model.is_sized(struct) and kind.name in ("uint32_t", "uint64_t", "float", "double"))]
        if numbers:
            lines += ["", "template <class Visit>", f"void visitFields(tspace_{struct}& all, Visit visit) {{",
                      *(f'    visit("{name}", "{kind}", all.{name});' for name, kind in numbers), "}"]
    return [*lines, "", "}  // namespace tspace::test"]
