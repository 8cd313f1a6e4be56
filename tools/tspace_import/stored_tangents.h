// SPDX-License-Identifier: MIT
// Whether a file has tangents of its own; Assimp does not say so.
#pragma once

#include <string>

namespace tspace::import {

enum class StoredTangents {
    none,            ///< the format names its tangents, and the file does not have that name
    withBitangents,  ///< Assimp's tangents are those of the file
    unknown,  ///< Assimp does not read them from this format, or the file lacks the bitangents: then their sign is
              ///< not known, and Assimp makes one up
};

/// Looks for names in the bytes of the file.
StoredTangents storedTangents(const std::string& path);

}  // namespace tspace::import
