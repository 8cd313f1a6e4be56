# SPDX-License-Identifier: MIT
"""What c_headers.py cannot know by itself: where the two APIs differ, and why they may."""

C_HEADERS = ("tspace.h", "tspace_files.h")
FILE_HEADERS = ("bake_file.h", "check.h", "file_options.h", "generate.h", "inspect.h", "map_files.h")

# Name in C -> name in C++, where it is no other by rule.
TWINS = {
    "tspace_Mesh": "MeshView",
    "tspace_Indices": "IndexView",
    "tspace_ConstSpan": "StridedSpan",
    "tspace_cornerCount": "MeshView::cornerCount",
    "tspace_faceCount": "MeshView::faceCount",
    "tspace_arenaAllocator": "Arena::allocator",
    "tspace_arenaHeldBytes": "Arena::heldBytes",
    "tspace_generateTangentsOfMeshes": "generateTangents(jobs)",  # an overload, by its first parameter
    "tspace_trimArena": "Arena::trim",
    "tspace_TangentPlanInfo": "TangentPlan",
    "tspace_arenaUsedBytes": "Arena::usedBytes",
    "tspace_flipGreenBytes": "flipGreen",
}

# Only in C (regular expressions; a type stands for its fields) -> why.
C_ALONE = {
    r"tspace_init\w+": "constructors",
    r"tspace_version": "C++ programs read version.h: they are linked with the library that they were compiled with",
    r"\w+\.(struct_size|reserved(_end)?)": "old programs with newer libraries",
    r"tspace_(Byte)?Span": "a StridedSpan of what is not const",
    r"tspace_(Mesh\.face|NormalOptions\.smoothing_group|IndexedFramesOptions\.keep_apart)_count": "a span has its length",
    r"tspace_((SplitResult|IndexedFrames)\.corner|Triangulation\.triangle|PlanBuffers\.word)_count": "a vector has its length",
    r"tspace_PlanBufferOptions\.(index|source_corner)_count": "a span has its length",
    r"tspace_PlanBuffers\.result_count": "PlanBuffers gives words of its header by their names",
    r"tspace_MeshJob\.(report|error)": "the results that C++ returns in a list",
    r"tspace_createArena|tspace_destroy(?!Bytes)\w+": "constructors and destructors",
    r"tspace_describeTangentPlan|tspace_TangentPlanInfo": "TangentPlan has a function for each field",
    r"tspace_IndexedFrames\.\w+_report": "members of IndexedFramesReport; null stands for normals_made",
    r"tspace_Bytes|tspace_destroyBytes|tspace_Model|tspace_FindFile": "FileOptions::content and find_file, Sink",
    r"tspace_(generate|check|inspect|identify|diff|compressMap)Bytes": "in C++ those on files take bytes: FileOptions::content",
}

# Only in C++ (regular expressions; a type stands for its members) -> why.
CPP_ALONE = {
    r"conventions::\w+": "tspace_findConvention gives them by their names",
    r"TexelDecode": "C takes its fields as parameters",
    r"IndexedFramesReport|IndexedFrames::report": "three reports in tspace_IndexedFrames",
    r"MeshView::(vertexCount|hasOwnLists)|\w+::empty|\w+Result::vertexCount": "shorthand for what fields say",
    r"vec[234]Span|cornerAttribute|xyz": "shorthand for C++ types",
    r"Result|Done|Error::place": "C returns a code, and the place is part of the message",
    r"State|TangentPlan::state": "private",
    r"(Faces|VectorFormat)(::\w+)?": "options of files, which are in tspace_files.h",
    r"(action|faces|frameFormat|severity|signReading)Name|finding\w+|commandLine": "reports of files have these names and texts in their JSON",
    r"NormalOptions::(crease|denoise|weld)_auto": "-1 in C",
    r"removeAbandonedFiles": "a matter of the tool",
    r"[tT]extureError\w+": "a part of `tspace map-error`, which is for C++ and the tool",
    r"Cancelled": "C has no function that is told of progress",
    r"mapErrorFile": "`tspace map-error`, which is for C++ and the tool",
    r"MapLayout|MapComponent|readTexel": "of maps in arrays, which C does not have",
    r"PlanBuffers::kVersion": "the first word",
    r"allMaps": "the default of FinishOptions::bake",
}

# Fields whose default in C is zero (regular expressions) -> how it is that of C++.
OTHER_DEFAULTS = {
    r"tspace_Mesh\.face_size": "0 means 3",
    r"tspace_Execution\.thread_count": "0 and 1 are the same",
}

# Regular expressions -> how C says it.
PHRASES = {
    r"`?conventions::(\w+)`?": r'"\1"',
    r"those of convertMap and of readers of models": "those of readers of models",
    r"those of heightToNormal and of convertMapFile": "those of tspace_convertMapFile",
    r"those of bakeMap, but for rays that meet nothing, which are findings; and": "MISSING_ATTRIBUTE (a low poly without "
    "UVs), INVALID_OPTION, OUT_OF_MEMORY; rays that meet nothing are findings. Also",
    r"Error::element is a BakeInput: `high` for the input and `low` for the low poly\.": "tspace_Error.element is 1 where "
    "it is about the input, and 0 where about the low poly.",
    r"`?(crease|denoise|weld)_auto`?": "-1",
    r"mesh\.vertexCount\(\)": "mesh->positions.count",
    r"Returns null for any other name\.": "INVALID_OPTION for any other name.",
}

# Words that look like names of C++ and are none.
WORDS = {"glTF", "lowerCamelCase", "normalTexture"}
