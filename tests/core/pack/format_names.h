// SPDX-License-Identifier: MIT
// Names of the formats, in the order of their numbers.
#pragma once

namespace tspace::test {

inline constexpr const char* kFormatNames[] = {"frame32",      "frame48",     "frame64",
                                               "oct32",        "qtangent64",  "snorm8_pair",
                                               "snorm16_pair", "gltf_snorm8", "gltf_snorm16"};

}  // namespace tspace::test
