// SPDX-License-Identifier: MIT
// Files of bumpy sheets, in formats with more precision than floats.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/vec_math.h"

namespace tspace::test {

/// A part of a model: a solid of an STL file, or a geometry and its node in other formats.
struct Part {
    std::vector<DVec3> positions = {};
    std::vector<std::array<int, 3>> faces = {};
    std::optional<DVec3> translation = {};  ///< translation of the node, in COLLADA and FBX
};

/// Returns a sheet of `side` x `side` vertices, 0.15 apart, with its corner at `place`.
Part sheet(int side, const DVec3& place);

enum class FarFormat { stlText, collada, fbxText };

/// Properties in which the files differ.
struct FileStyle {
    int decimals = 4;           ///< decimals of numbers in text
    const char* unit = "1";     ///< unit of lengths in COLLADA, in meters
    bool has_matrices = false;  ///< writes translations as matrices in COLLADA
};

std::string extensionOf(FarFormat format);
std::string fileOf(FarFormat format, const std::vector<Part>& parts, const FileStyle& style = {});

/// Returns a binary STL file, whose coordinates are floats.
std::string binaryStl(const Part& part);

}  // namespace tspace::test
