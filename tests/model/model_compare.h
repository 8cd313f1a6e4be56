// SPDX-License-Identifier: MIT
// Compares a model before and after generate: everything except the allowed edits must be equal.
#pragma once

#include <string>
#include <vector>

#include "model/gltf/document.h"
#include "tspace/generate.h"

namespace tspace::test {

/// Returns the unexpected differences, or an empty list. Compares the JSON including the order of members, every
/// accessor of an unchanged primitive by its bytes, every attribute and morph target of a changed primitive corner by
/// corner, and every image by its bytes. `report` says which primitives were computed. `is_repacked`: the lists of
/// extensions may differ too.
std::vector<std::string> differences(const gltf::Document& before, const gltf::Document& after,
                                     const GenerateReport& report, bool is_repacked = false);

}  // namespace tspace::test
