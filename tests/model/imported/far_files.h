// SPDX-License-Identifier: MIT
// Bumpy sheets as files of the formats that have more digits than floats.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/vec_math.h"

namespace tspace::test {

/// A part of a model: one solid of STL, one geometry and its node elsewhere.
struct Part {
    std::vector<DVec3> positions = {};
    std::vector<std::array<int, 3>> faces = {};
    std::optional<DVec3> translation = {};  ///< of its node, in COLLADA and FBX
};

/// A sheet of `side` x `side` vertices, 0.15 apart, with its corner at `place`.
Part sheet(int side, const DVec3& place);

enum class FarFormat { stlText, collada, fbxText, fbxRaw, fbxDeflated, fbxRaw7500, fbxDeflated7500 };

/// What differs from file to file.
struct FileStyle {
    int decimals = 4;                 ///< of numbers in text
    bool has_floats = false;          ///< FBX in binary: arrays of floats
    const char* up = "Y_UP";          ///< COLLADA
    const char* unit = "1";           ///< COLLADA, in metres
    bool has_matrices = false;        ///< COLLADA: translations as matrices
    std::uint32_t claimed_count = 0;  ///< FBX in binary: of numbers in the arrays; 0: as many as there are
};

std::string extensionOf(FarFormat format);
std::string fileOf(FarFormat format, const std::vector<Part>& parts, const FileStyle& style = {});

/// STL in binary, which has floats.
std::string binaryStl(const Part& part);

}  // namespace tspace::test
