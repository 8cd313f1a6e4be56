// SPDX-License-Identifier: MIT
// JSON types of the members of a glTF file.
#pragma once

#include "model/json/json.h"

namespace tspace::gltf {

/// Checks the types of the members that glTF and the extensions known to tspace define, so that every command rejects
/// the same files. Fails with invalidFile at the first member of a wrong type. Numbers may be null, which JSON
/// libraries write for NaN. Ranges are not checked, nor is data of other extensions. Linear.
void checkMemberTypes(const Json& root);

}  // namespace tspace::gltf
