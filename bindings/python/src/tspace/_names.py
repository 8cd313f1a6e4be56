# SPDX-License-Identifier: MIT
"""Names of choices, for type checkers."""

from typing import Literal

# Everything below is written by scripts/api.
ErrorCodeName = Literal[
    "ok",
    "null_data",
    "count_mismatch",
    "index_out_of_range",
    "stride_too_small",
    "misaligned",
    "too_large",
    "missing_attribute",
    "invalid_option",
    "out_of_memory",
    "plan_mismatch",
    "internal",
    "cancelled",
    "invalid_file",
    "unsupported_file",
    "forbidden_path",
    "cannot_read",
    "cannot_write",
]
IndexTypeName = Literal[
    "none",
    "u8",
    "u16",
    "u32",
    "corners",
]
SimdTargetName = Literal[
    "best",
    "scalar",
    "sse2",
    "avx2",
    "avx512",
    "neon",
]
VAxisName = Literal[
    "up",
    "down",
]
GreenName = Literal[
    "up",
    "down",
]
StoredSignName = Literal[
    "as_is",
    "negated",
]
HandednessName = Literal[
    "right",
    "left",
]
WindingName = Literal[
    "counter_clockwise",
    "clockwise",
]
MethodName = Literal[
    "mikktspace",
    "lengyel",
    "uniform",
    "angle",
    "area",
    "flat",
    "basis",
    "fast",
    "best",
]
PairingName = Literal[
    "reference",
    "corrected",
]
NgonsName = Literal[
    "triangulate",
    "skip",
]
OutputDomainName = Literal[
    "corner",
    "vertex",
]
FrameShapeName = Literal[
    "gram_schmidt",
    "symmetric",
]
NormalWeightingName = Literal[
    "flat",
    "uniform",
    "area",
    "angle",
    "angle_area",
    "max",
    "best",
]
FrameFormatName = Literal[
    "frame32",
    "frame48",
    "frame64",
    "oct32",
    "qtangent64",
    "snorm8_pair",
    "snorm16_pair",
    "gltf_snorm8",
    "gltf_snorm16",
]
PresetName = Literal[
    "gltf",
    "opengl",
    "directx",
    "unreal",
    "unity",
    "blender",
    "godot",
]
