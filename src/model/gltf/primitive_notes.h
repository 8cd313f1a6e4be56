// SPDX-License-Identifier: MIT
// Notes for a person about a primitive's textures and their transforms.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/mesh/surface/uvs.h"
#include "model/gltf/document.h"
#include "model/scene/tangent_use.h"
#include "tspace/asset.h"

namespace tspace::gltf {

/// The matrix of UVs that the tangents of a use follow.
UvMatrix uvMatrixOf(const TangentUse& use, TextureTransform reading);

/// True when tangents for one use fit the other: equal UV sets, and transforms that turn UVs alike.
bool haveSameTangents(const TangentUse& a, const TangentUse& b, TextureTransform reading);

/// JSON pointers that animations move (KHR_animation_pointer).
std::set<std::string> animatedPointers(const Document& document);

/// Sentences about `uses`, those of one primitive: textures whose tangents would have to differ from the first's, and
/// animated transforms. `computed`: also about the transform that the new tangents follow, or do not.
/// The note on the transform that computed tangents follow begins so.
inline constexpr const char* kTransformNote = "KHR_texture_transform ";
/// How the note on tangents that a repair mends begins.
inline constexpr const char* kWrongNote = "its tangents were wrong: ";

std::vector<std::string> notesOf(const std::vector<TangentUse>& uses, const std::set<std::string>& animated,
                                 TextureTransform reading, bool computed);

}  // namespace tspace::gltf
