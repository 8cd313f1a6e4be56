// SPDX-License-Identifier: MIT
// Bumpy sheets as files of formats with more precision than floats.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/vec_math.h"

namespace tspace::test {

/// A part of a model: one solid of STL, or one geometry with its node in other formats.
struct Part {
    std::vector<DVec3> positions = {};
    std::vector<std::array<int, 3>> faces = {};
    std::optional<DVec3> translation = {};  ///< translation of its node, in COLLADA and FBX
};

/// Returns a sheet of `side` x `side` vertices, 0.15 apart, with its corner at `place`.
Part sheet(int side, const DVec3& place);

enum class FarFormat { stlText, collada, fbxText };

/// Properties that differ between the files.
struct FileStyle {
    int decimals = 4;           ///< decimals of numbers in text
    const char* unit = "1";     ///< COLLADA, in meters
    bool has_matrices = false;  ///< COLLADA: translations as matrices
};

std::string extensionOf(FarFormat format);
std::string fileOf(FarFormat format, const std::vector<Part>& parts, const FileStyle& style = {});

/// Returns a binary STL, which contains floats.
std::string binaryStl(const Part& part);

}  // namespace tspace::test
