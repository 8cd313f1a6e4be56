// SPDX-License-Identifier: MIT
// Determines whether a file contains tangents; Assimp does not report this.
#pragma once

#include <string>

namespace tspace::import {

enum class StoredTangents {
    none,            ///< the format names its tangents, and the name does not occur in the file
    withBitangents,  ///< Assimp's tangents are those of the file
    unknown,  ///< Assimp does not read them from this format, or the file lacks the bitangents: then their sign is
              ///< not known, and Assimp makes one up
};

/// Searches for names in the bytes of the file.
StoredTangents storedTangents(const std::string& path);

}  // namespace tspace::import
