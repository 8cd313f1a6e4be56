// SPDX-License-Identifier: MIT
// Names of the extensions that compress geometry.
#pragma once

#include "model/gltf/json_access.h"

namespace tspace::gltf {

inline constexpr const char* kExtMeshopt = "EXT_meshopt_compression";
inline constexpr const char* kKhrMeshopt = "KHR_meshopt_compression";
inline constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// Returns the name of the compression extension of a buffer view or buffer, or null.
inline const char* meshoptExtension(const Json& object) {
    for (const char* name : {kExtMeshopt, kKhrMeshopt}) {
        if (findExtension(object, name) != nullptr) return name;
    }
    return nullptr;
}

}  // namespace tspace::gltf
