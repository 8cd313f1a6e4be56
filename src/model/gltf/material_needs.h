// SPDX-License-Identifier: MIT
// Which textures and parameters of a primitive's materials are shaded in tangent space.
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

/// Everything in the primitive's materials that needs tangents; empty: nothing does. Unlit materials (isUnlit) need
/// none, whatever textures they name. The first with a texture decides which UV set and transform the tangents follow.
///
/// The primitive's own material comes first, then those of KHR_materials_variants in the order of the mappings, each
/// material once. Of one material: normalTexture, clearcoatNormalTexture (KHR_materials_clearcoat), anisotropy
/// (KHR_materials_anisotropy: a texture, or only a strength that is not 0; that has the UVs of the material's first
/// use, those of the first texture where it is the first of all, and `place` is that of the extension). An image is named where the texture
/// leads to one. Fails with invalidFile.
std::vector<TangentUse> tangentUses(const Document& document, const Primitive& primitive);

/// A sentence on what may read the primitive's tangents beside the uses above, or suggests that an artist made them: an
/// unknown extension of a material, or an attribute, extension or entry of `extras` that names tangents, flow, hair and
/// the like. Empty: nothing does.
std::string otherTangentReader(const Document& document, const Primitive& primitive);

/// The materials that KHR_materials_variants can put on the primitive, in the order of the mappings, each once.
std::vector<std::size_t> variantMaterials(const Document& document, const Primitive& primitive);

/// Whether a material ignores normals and normal maps: it has KHR_materials_unlit, no extension that takes precedence over
/// it (VRMC_materials_mtoon; VRM 0.x with a `_BumpMap`), and no extension unknown to tspace that names a normal or bump map.
bool isUnlit(const Document& document, std::size_t material);

/// What VRM 0.x says of a material at the root of the file, and its readers take in place of the material, which is the
/// fallback; null where it says nothing, or that the material counts (VRM_USE_GLTFSHADER).
const Json* vrmMaterial(const Document& document, std::size_t material);

/// Properties that all materials of a primitive, its own and those of variants, share. Without any: the default
/// material's.
struct SurfaceKind {
    bool is_unlit = false;         ///< isUnlit: neither normals nor normal maps are looked at
    bool is_double_sided = false;  ///< back faces are drawn, with their normals turned round
};
SurfaceKind surfaceKind(const Document& document, const Primitive& primitive);

/// The name of the primitive's material, may be empty.
std::string materialName(const Document& document, const Primitive& primitive);

/// `texture`: the reference, at `place`. An image is named where the texture leads to one. Fails with invalidFile.
TextureReading readTexture(const Document& document, const Json& texture, const std::string& place);

// Notes for a person about a primitive's textures and their transforms.

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
