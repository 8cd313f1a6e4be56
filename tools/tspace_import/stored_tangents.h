// SPDX-License-Identifier: MIT
// Determines whether a file contains tangents; Assimp does not report this.
#pragma once

#include <string>

namespace tspace::import {

enum class StoredTangents {
    none,            ///< the file has no tangents: the name that its format uses for them does not occur in it
    withBitangents,  ///< Assimp's tangents are those of the file
    /// Assimp does not read tangents from this format, or the file lacks bitangents. In the second case the sign of the
    /// tangents is unknown, and Assimp chooses an arbitrary one.
    unknown,
};

/// Determines whether a file contains tangents by searching its bytes for their names.
StoredTangents storedTangents(const std::string& path);

}  // namespace tspace::import
