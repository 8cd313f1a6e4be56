// SPDX-License-Identifier: MIT
// Determines which textures and parameters of a primitive's materials are shaded in tangent space.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/mesh/surface/uvs.h"
#include "model/gltf/document.h"
#include "model/gltf/primitive_reader.h"
#include "model/scene/scene.h"
#include "tspace/generate.h"

namespace tspace::gltf {

/// Returns all uses of tangents in the primitive's materials; empty if there are none. Unlit materials (isUnlit) need
/// no tangents, regardless of their textures. The first use with a texture determines the UV set and transform of the
/// tangents.
///
/// The primitive's own material comes first, then those of KHR_materials_variants in the order of the mappings, each
/// material once. Within a material: normalTexture, clearcoatNormalTexture (KHR_materials_clearcoat), anisotropy
/// (KHR_materials_anisotropy: a texture, or only a nonzero strength, whose `place` is the extension). A strength takes
/// the UVs of its material's first use; uses before the first texture take the UVs of that texture. The image is set if
/// the texture refers to one. Fails with invalidFile.
std::vector<TangentUse> tangentUses(const Document& document, const Primitive& primitive);

/// Returns the textures of unknown material extensions whose name contains "normal", as uses whose `needed_by` names
/// the member and the extension. Malformed references are skipped.
std::vector<TangentUse> unknownNormalMaps(const Document& document, const Primitive& primitive);

/// Names something else that may read the primitive's tangents or suggests that an artist made them, such as "the
/// material extension EXT_hair": an unknown material extension, or an attribute, extension or entry of `extras` whose
/// name contains tangent, flow, hair etc. Returns an empty text if there is nothing.
std::string otherTangentReader(const Document& document, const Primitive& primitive);

/// Returns the materials that KHR_materials_variants can assign to the primitive, in the order of the mappings, each
/// once.
std::vector<std::size_t> variantMaterials(const Document& document, const Primitive& primitive);

/// Returns whether a material ignores normals and normal maps: it has KHR_materials_unlit, no extension that overrides
/// it (VRMC_materials_mtoon; VRM 0.x with a `_BumpMap`), and no extension unknown to tspace that names a normal or bump
/// map.
bool isUnlit(const Document& document, std::size_t material);

/// Returns the VRM 0.x properties of a material from the root of the file. VRM readers use them instead of the glTF
/// material, which is only a fallback. Null if there are none, or if they refer to the glTF material
/// (VRM_USE_GLTFSHADER).
const Json* vrmMaterial(const Document& document, std::size_t material);

/// Properties shared by all materials of a primitive, including those of variants. A primitive without materials has
/// the properties of the default material.
struct SurfaceKind {
    bool is_unlit = false;         ///< isUnlit: neither normals nor normal maps are used
    bool is_double_sided = false;  ///< back faces are drawn, with inverted normals
};
SurfaceKind surfaceKind(const Document& document, const Primitive& primitive);

/// Returns the name of the primitive's material; may be empty.
std::string materialName(const Document& document, const Primitive& primitive);

/// Reads a texture reference; `place` is its JSON pointer. The image is set if the texture refers to one. Fails with
/// invalidFile.
TextureReading readTexture(const Document& document, const Json& texture, const std::string& place);

// Notes for users about a primitive's textures and their transforms.

/// Returns the UV matrix that the tangents of a use follow.
UvMatrix uvMatrixOf(const TangentUse& use, TextureTransform reading);

/// Returns whether tangents for one use also fit the other: equal UV sets, and transforms that rotate and mirror UVs
/// alike.
bool haveSameTangents(const TangentUse& a, const TangentUse& b, TextureTransform reading);

/// Returns the JSON pointers that animations change (KHR_animation_pointer).
std::set<std::string> animatedPointers(const Document& document);

/// Prefix of the note on the transform that computed tangents follow.
inline constexpr const char* kTransformNote = "KHR_texture_transform ";
/// Prefix of the note on tangents that a repair fixes.
inline constexpr const char* kWrongNote = "its tangents were wrong: ";

/// Returns sentences about the `uses` of one primitive: textures whose tangents would have to differ from those of the
/// first, and animated transforms. `computed`: also about the transform that the new tangents follow or ignore.
std::vector<std::string> notesOf(const std::vector<TangentUse>& uses, const std::set<std::string>& animated,
                                 TextureTransform reading, bool computed);

}  // namespace tspace::gltf
