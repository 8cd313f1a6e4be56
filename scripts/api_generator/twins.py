# SPDX-License-Identifier: MIT
"""Exceptions that c_headers.py cannot derive: differences between the C and C++ APIs, and their reasons."""

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

# Reason why declarations exist only in C -> regular expressions of their names; a type includes its fields.
C_ALONE = {
    "constructors and destructors": r"tspace_init\w+|tspace_createArena|tspace_destroy\w+",
    "C++ programs are linked with the library that they were compiled with": r"tspace_version",
    "old programs with newer libraries": r"\w+\.(struct_size|reserved(_end)?)",
    "a StridedSpan of what is not const": r"tspace_(Byte)?Span",
    "spans and vectors have their lengths": r"tspace_(Mesh\.face|NormalOptions\.smoothing_group|IndexedFramesOptions\.keep_apart"
    r"|(SplitResult|IndexedFrames)\.corner|Triangulation\.triangle|PlanBuffers\.(word|result)|PlanBufferOptions\.(index|source_corner))_count",
    "results that C++ returns": r"tspace_MeshJob\.(report|error)|tspace_IndexedFrames\.\w+_report",
    "TangentPlan has a function for each field": r"tspace_describeTangentPlan|tspace_TangentPlanInfo",
    "in C++ the calls on files take bytes: FileOptions::content and find_file, Sink": r"tspace_(Bytes|Model|FindFile)"
    r"|tspace_(generate|check|inspect|identify|diff|compressMap)Bytes",
}

# Reason why declarations exist only in C++ -> regular expressions of their names.
CPP_ALONE = {
    "tspace_findConvention gives them by their names": r"conventions::\w+",
    "C takes its fields as parameters": r"TexelDecode",
    "three reports in tspace_IndexedFrames": r"IndexedFramesReport|IndexedFrames::report",
    "shorthand": r"MeshView::(vertexCount|hasOwnLists)|\w+::empty|\w+Result::vertexCount|vec[234]Span|cornerAttribute|xyz",
    "C returns a code, and the place is part of the message": r"Result|Done|Error::place",
    "private": r"State|TangentPlan::state",
    "options of files, which are in tspace_files.h": r"(Faces|VectorFormat)(::\w+)?",
    "reports of files have these in their JSON": r"(action|faces|frameFormat|severity|signReading)Name|finding\w+|commandLine",
    "-1 in C": r"NormalOptions::(crease|denoise|weld)_auto",
    "for C++ and the tool": r"removeAbandonedFiles|[tT]extureError\w+|mapErrorFile|MapLayout|MapComponent|readTexel|allMaps",
    "C has no function that is told of progress": r"Cancelled",
    "the first word of PlanBuffers": r"PlanBuffers::kVersion",
}

# Meaning of a zero default in C -> regular expression of the fields with that default.
OTHER_DEFAULTS = {"3": r"tspace_Mesh\.face_size", "the same as 1": r"tspace_Execution\.thread_count"}

# Regular expressions in C++ comments -> their replacements in C comments.
PHRASES = {
    r"`?conventions::(\w+)`?": r'"\1"',
    r"those of convertMap and of readers of models": "those of readers of models",
    r"those of heightToNormal and of convertMapFile": "those of tspace_convertMapFile",
    r"those of bakeMap, except that rays without a hit are reported as a finding; also": "MISSING_ATTRIBUTE (a low poly without "
    "UVs), INVALID_OPTION, OUT_OF_MEMORY; rays that hit nothing are reported as a finding. Also",
    r"Error::element is a BakeInput: `high` for the input and `low` for the low poly\.": "tspace_Error.element is 1 for "
    "errors about the input, and 0 for errors about the low poly.",
    r"`?(crease|denoise|weld)_auto`?": "-1",
    r"mesh\.vertexCount\(\)": "mesh->positions.count",
    r"Returns null for any other name\.": "INVALID_OPTION for any other name.",
}

# Words that look like C++ names but are not.
WORDS = {"glTF", "lowerCamelCase", "normalTexture"}
