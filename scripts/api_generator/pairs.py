# SPDX-License-Identifier: MIT
"""Maps the declarations of the C API to those of the C++ API. A declaration that exists only in C has no counterpart and
keeps its own comment; one that exists only in C++ must be listed here."""
import re

import declarations
from names import camel, pascal, snake

C_HEADERS = ("tspace.h", "tspace_files.h")
FILE_HEADERS = ("bake_file.h", "check.h", "file_options.h", "generate.h", "inspect.h", "map_files.h")

# Name in C -> name in C++, for names that do not follow the general rule.
TWINS = {
    "tspace_Mesh": "MeshView",
    "tspace_Indices": "IndexView",
    "tspace_ConstSpan": "StridedSpan",
    "tspace_cornerCount": "MeshView::cornerCount",
    "tspace_faceCount": "MeshView::faceCount",
    "tspace_arenaAllocator": "Arena::allocator",
    "tspace_arenaHeldBytes": "Arena::heldBytes",
    "tspace_arenaUsedBytes": "Arena::usedBytes",
    "tspace_trimArena": "Arena::trim",
    "tspace_generateTangentsOfMeshes": "generateTangents(jobs)",  # an overload, identified by its first parameter
    "tspace_TangentPlanInfo": "TangentPlan",
    "tspace_flipGreenBytes": "flipGreen",
}

# Reason why declarations exist only in C++ -> regular expression of their names; a type includes its members.
CPP_ALONE = {
    "C takes its fields as parameters": r"TexelDecode",
    "three reports in tspace_IndexedFrames": r"IndexedFramesReport|IndexedFrames::report",
    "shorthand": r"MeshView::(vertexCount|hasOwnLists)|\w+::empty|vec[234]Span|cornerAttribute|xyz",
    "C returns a code, and the place is part of the message": r"Result|Done|Error::place",
    "private": r"TangentPlan::state",
    "options of files, which are in tspace_files.h": r"Faces|VectorFormat",
    "reports of files have these in their JSON": r"(action|faces|frameFormat|severity|signReading)Name|finding\w+|commandLine",
    "-1 in C": r"NormalOptions::(crease|denoise|weld)_auto",
    "for C++ and the tool": r"removeAbandonedFiles|textureErrorFile|mapErrorFile|readTexel|allMaps",
    "the first word of PlanBuffers": r"PlanBuffers::kVersion",
}
# C types of fields that are added to sized structs.
C_TYPES = {"bool": "uint32_t", "std::uint32_t": "uint32_t", "std::uint64_t": "uint64_t", "float": "float", "double": "double"}


class Pairs:
    """`heads` and `entities`: comments at the tops of the C++ headers, and their declarations by name. `texts` and `items`: the C
    headers and their declarations, by header. `twin`: name in C -> declaration in C++. `c_name`: name in C++ -> name in C."""

    def __init__(self, read):
        self.problems, self.heads, self.entities, self.twin, self.c_name = [], {}, {}, {}, {}
        for header in [*re.findall(r'#include "tspace/(\w+\.h)"', read("tspace.hpp")), *FILE_HEADERS]:
            self._read_cpp(header, read(header))
        self.texts = {name: self._completed(declarations.one_per_line(read(name))) for name in C_HEADERS}
        self.items = {name: declarations.c(text) for name, text in self.texts.items()}
        for item in sum(self.items.values(), []):
            self._pair(item)
        self.enums = {}  # type -> its enumerators in C++, without those that mark a field as not set
        for entity in self.twin.values():
            if entity.kind == "enumerator" and entity.member() != "unset":
                self.enums.setdefault(entity.owner, []).append(entity)
        self.problems += [f"{name} has no twin in C, and pairs.py does not say why" for name in self.entities
                          if name not in self.c_name and not is_cpp_alone(name)]

    def _read_cpp(self, header, text):
        head = re.match(r".*\n((?://.*\n)*)", text)[1]
        self.heads[header] = declarations.Declaration("head", header, "", "", head, 0, 0, header)
        for entity in declarations.cpp(text, header):
            if header in FILE_HEADERS and entity.kind != "function":
                continue  # in C, options and reports of the calls on files are JSON
            overload = re.sub(r".*?(\w+)\([^,)]*?(\w+)[,)].*", r"\1(\2)", entity.code, flags=re.S)
            entity.name = overload if overload in TWINS.values() else entity.name
            if entity.name not in self.entities or entity.comment:
                self.entities[entity.name] = entity

    def _pair(self, item):
        entity = self.entities.get(self._twin_name(item))
        if not entity and not item.owner and "In C:" not in item.comment:
            self.problems.append(f"{item.name} has no twin in C++, and its comment does not say \"In C:\"")
        if entity and (entity.kind != "type" or entity.name not in self.c_name):
            self.twin[item.name] = entity
            self.c_name[entity.name] = item.name
            if item.kind == "enumerator" and not item.name.endswith("_" + snake(entity.member()).upper()):
                self.problems.append(f"{item.name} is {entity.name} in C++: another name for one number")

    def _twin_name(self, item):
        owner, member = cpp_name(item.owner), item.member()
        if item.kind == "enumerator":
            return next((entity.name for entity in self.members(owner, "enumerator") if entity.value() == item.value()), "")
        if item.kind == "field":
            method = f"{owner}::{camel(member)}"
            return method if method in self.entities and method not in TWINS.values() else f"{owner}::{member}"
        if item.kind == "constant":
            return "k" + pascal(member.removeprefix("TSPACE_"))
        return cpp_name(item.name)

    def _completed(self, text):
        """Adds what C++ has and C lacks: enumerators, and numbers of sized structs, to their ends."""
        def with_enumerators(found):
            there = re.findall(r"^ +(TSPACE_\w+) = (\d+)", found[0], re.M)
            declared = {entity.value(): snake(entity.member()).upper() for entity in self.members(cpp_name(found[1]), "enumerator")}
            added = {value: name for value, name in declared.items() if value not in dict(map(reversed, there))}
            if not added or there[-1][1] not in declared:
                return found[0]
            prefix = there[-1][0].removesuffix(declared[there[-1][1]])
            return re.sub(r"( = \d+)(.*)\n$", r"\1,\2\n", found[0]) + "".join(f"    {prefix}{name} = {value},\n" for value, name in added.items())

        def with_fields(found):
            there, added = re.findall(r"^ {4}\w.*?(\w+)(?:\[\d+\])?;", found[0], re.M), ""
            for entity in self.members(cpp_name(found[1]), "field"):
                kind = f"tspace_{entity.type()}" if self.members(entity.type(), "enumerator") else C_TYPES.get(entity.type())
                if kind and entity.member() not in there and not is_cpp_alone(entity.name):
                    added += f"    {kind} {entity.member()};\n"
            return found[0] + added

        text = re.sub(r"^typedef uint32_t (\w+);\nenum \{\n.*?(?=^\})", with_enumerators, text, flags=re.M | re.S)
        return re.sub(r"^typedef struct (\w+) \{\n +uint32_t struct_size;.*?(?=^\})", with_fields, text, flags=re.M | re.S)

    def members(self, owner, *kinds):
        return [entity for entity in self.entities.values() if entity.owner == owner and entity.kind in kinds]

    def is_sized(self, struct):
        return any(item.name == f"{struct}.struct_size" for item in self.items["tspace.h"])


def cpp_name(name):
    return TWINS.get(name, name.removeprefix("tspace_"))


def is_cpp_alone(name):
    return any(re.fullmatch(rf"({pattern})(::\w+)?", name) for pattern in CPP_ALONE.values())
