// SPDX-License-Identifier: MIT
// Model of any format as arrays: its primitives, how their textures are read, and how it is drawn.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/vec_math.h"
#include "core/mesh/surface/affine.h"
#include "model/io/file_error.h"
#include "model/io/memory_budget.h"
#include "tspace/maps.h"
#include "tspace/mesh.h"
#include "tspace/pack.h"
#include "tspace/span.h"

namespace tspace {

// Texture references of materials.

/// KHR_texture_transform: uv' = translation * rotation * scale * uv. `rotation` in radians, counter-clockwise as the
/// extension defines it.
struct UvTransform {
    double offset[2] = {0, 0};
    double rotation = 0;
    double scale[2] = {1, 1};

    /// Returns whether the transform rotates, mirrors or scales directions: an offset alone does not affect frames.
    [[nodiscard]] bool changesFrames() const { return rotation != 0 || scale[0] != 1 || scale[1] != 1; }
    [[nodiscard]] bool mirrors() const { return scale[0] * scale[1] < 0; }
};

struct TextureReading {
    std::size_t uv_set = 0;  ///< n of TEXCOORD_n; texCoord of KHR_texture_transform has priority
    UvTransform transform = {};
    std::optional<std::size_t> image = {};  ///< index into the file's images
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
    bool reads_levels = true;  ///< false: the sampler uses only the largest mip level
};

// Reasons why a primitive needs tangents: one texture or parameter of a material that is shaded in tangent space.

struct TangentUse {
    std::string needed_by = {};  ///< "normalTexture", "clearcoatNormalTexture" or "anisotropy"
    std::string place = {};      ///< JSON pointer of the texture reference, or of the extension
    /// False if only a factor reads the tangents (KHR_materials_anisotropy), for which tangents in any direction
    /// suffice.
    bool has_texture = true;
    std::size_t uv_set = 0;  ///< n of TEXCOORD_n; texCoord of KHR_texture_transform has priority
    UvTransform transform = {};
    std::optional<std::size_t> image = {};  ///< index into the file's images
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
    double scale = 1;  ///< factor for x and y of a normal map
    /// The file declares that green of its normal maps points down, and readers of the file respect it.
    bool is_declared_down = false;
    bool may_be_heights = false;  ///< the format would interpret a gray image as a height map (map_bump of OBJ)
    bool reads_levels = true;     ///< false if the sampler uses only the largest mip level
    std::size_t material = 0;
    std::string material_name = {};  ///< name of the material; may be empty
    bool only_in_variant = false;    ///< the material is one of KHR_materials_variants, not the primitive's own
};

/// Returns a text such as "normalTexture of material 'Paint' (a variant)"; a material without a name is identified by
/// its index.
inline std::string textureName(const TangentUse& use) {
    const std::string material = use.material_name.empty() ? std::to_string(use.material) : inQuotes(use.material_name);
    return use.needed_by + " of material " + material + (use.only_in_variant ? " (a variant)" : "");
}

// Contents of a model file that affect frames, in the same form for every format. Read-only: check, diff and identify
// examine it; generate uses it for decisions, and edits the file's own document (gltf/model.h).

/// Read-only array shared by its copies: files use one accessor in many primitives.
template <class T>
class SharedArray {
  public:
    SharedArray() = default;
    SharedArray(std::vector<T> values) : values_(std::make_shared<const std::vector<T>>(std::move(values))) {}
    explicit SharedArray(std::shared_ptr<const std::vector<T>> values) : values_(std::move(values)) {}

    [[nodiscard]] const T* data() const { return values_ ? values_->data() : nullptr; }
    [[nodiscard]] std::size_t size() const { return values_ ? values_->size() : 0; }
    [[nodiscard]] bool empty() const { return size() == 0; }
    [[nodiscard]] const T* begin() const { return data(); }
    [[nodiscard]] const T* end() const { return data() + size(); }
    const T& operator[](std::size_t i) const { return (*values_)[i]; }
    [[nodiscard]] std::span<const T> span() const { return {data(), size()}; }
    /// Returns a weak pointer that expires when the array has no more users.
    [[nodiscard]] std::weak_ptr<const std::vector<T>> watch() const { return values_; }

  private:
    std::shared_ptr<const std::vector<T>> values_ = {};
};

/// Offsets of one morph target, one per vertex of its primitive. Empty: the target does not change the attribute.
struct SceneMorphTarget {
    SharedArray<Vec3> positions = {};
    SharedArray<Vec3> normals = {};
    SharedArray<Vec3> tangents = {};
};

/// TANGENT attribute that cannot be read.
struct SceneTangentFault {
    std::ptrdiff_t target = -1;  ///< index of the morph target; -1: the base primitive
    std::string why = {};        ///< reason, such as "they do not have 4 components"
};

/// How a repair handles an attribute that cannot be read.
enum class AttributeRepair : std::uint8_t {
    resize,  ///< keep the first components, and fill missing ones with zeros
    remove,
    none  ///< the primitive depends on the attribute, so no command can repair it
};

/// Attribute other than TANGENT that cannot be read and is treated as absent.
struct SceneAttributeFault {
    std::string name = {};
    std::ptrdiff_t target = -1;  ///< index of the morph target that has the attribute; -1: the primitive itself
    std::string why = {};        ///< reason, such as "they do not have 3 components"
    AttributeRepair repair = AttributeRepair::remove;
    std::size_t vertex_count = 0;  ///< number of vertices of the primitive
};

/// Attribute whose component type glTF does not allow, but which can be read.
struct SceneComponentFault {
    std::string name = {};
    std::string found = {};    ///< its components, such as "32-bit unsigned integers"
    std::string allowed = {};  ///< such as "floats"
    std::size_t vertex_count = 0;
};

/// Returns "COLOR_0", or "NORMAL of morph target 2"; `target` -1: the primitive itself.
inline std::string attributeText(const std::string& name, std::ptrdiff_t target) {
    return target < 0 ? name : name + " of morph target " + std::to_string(target);
}

/// Packed frames in one format.
struct ScenePacked {
    FrameFormat format = FrameFormat::frame32;
    std::string attribute = {};  ///< the first attribute of the format, or the one that `fault` is about
    /// Reason why the frames cannot be read, as a clause about `attribute`; empty if they can.
    std::string fault = {};
    SharedArray<std::uint8_t> words = {};  ///< packed frames, without padding; empty if there is a fault
};

/// Factors that scale normals to length 1. Normal deltas of morph targets are multiplied by the same factors, so that
/// all sums keep their directions.
struct NormalScales {
    std::vector<double> of_vertices = {};   ///< 1 if the stored normal is unit within rounding, or has no direction
    std::size_t count = 0;                  ///< number of factors other than 1
    double min_length = 0, max_length = 0;  ///< range of the lengths of the scaled normals
};

/// Normals without a direction, which cannot be scaled to length 1: of length 0, NaN or infinite.
struct InvalidNormals {
    bool are_all = false;                ///< every normal is invalid
    std::vector<bool> of_vertices = {};  ///< whether the normal is invalid; empty if are_all

    [[nodiscard]] bool contains(std::size_t vertex) const { return are_all || of_vertices[vertex]; }
};

struct ScenePrimitive {
    std::string place = {};  ///< JSON pointer (glTF), or "usemtl NAME" (OBJ)
    std::uint32_t mesh = 0;
    std::uint32_t primitive = 0;     ///< index of the primitive in its mesh
    std::string mesh_name = {};      ///< name of the mesh; may be empty
    std::string material_name = {};  ///< name of the material; may be empty
    std::string mode = {};           ///< "triangles", "triangle strip", "points", ...; OBJ: "triangles" or "polygons"
    /// Three vertices per triangle, each less than positions.size(). Empty for points and lines.
    SharedArray<std::uint32_t> corners = {};
    SharedArray<Vec3> positions = {};
    double position_step = 0;        ///< quantization step, if positions are stored as integers; 0: floats
    SharedArray<Vec3> normals = {};  ///< one per vertex, scaled to length 1; empty: absent
    /// factors by which normals were scaled; null if no normal had to be scaled
    std::shared_ptr<const NormalScales> normal_scales = {};
    SharedArray<Vec4> tangents = {};                     ///< one per vertex; empty: absent
    std::vector<SceneTangentFault> tangent_faults = {};  ///< faults of tangents that are ignored
    std::vector<SceneAttributeFault> attribute_faults = {};
    std::vector<SceneComponentFault> component_faults = {};
    /// `tangents` is empty, but the importer cannot tell whether the file has tangents.
    bool tangents_not_read = false;
    std::vector<SharedArray<Vec2>> uv_sets = {};  ///< entry n: TEXCOORD_n, empty if absent; v points down
    std::vector<SceneMorphTarget> morph_targets = {};
    std::vector<ScenePacked> packed = {};  ///< packed frame attributes, in the order of FrameFormat
    bool is_unlit = false;                 ///< every material of the primitive is unlit: normals are not used
    bool is_double_sided = false;          ///< every material of the primitive is double-sided
    /// All uses of tangents in the primitive's materials, including variants. The first use determines the UV set of
    /// the tangents.
    std::vector<TangentUse> uses = {};
    /// Textures of unknown material extensions that are named like normal maps. Tangents are not computed for them.
    std::vector<TangentUse> unknown_maps = {};
    /// Transforms of the primitive by the nodes of the scene; empty if not requested.
    std::vector<Affine> places = {};
    /// Description of another possible reader of the tangents, or of a sign that they are authored, such as "the
    /// material extension EXT_hair". Empty if there is none.
    std::string other_reader = {};

    /// Returns the primitive's triangles with the given UVs.
    [[nodiscard]] MeshView view(std::span<const Vec2> uvs = {}) const {
        return {.positions = positions.span(), .normals = normals.span(), .uvs = uvs, .indices = corners.span()};
    }

    /// Returns whether a texture is read with the tangents, so that its UVs determine their direction.
    [[nodiscard]] bool uvsDetermineDirection() const {
        return std::any_of(uses.begin(), uses.end(), [](const TangentUse& use) { return use.has_texture; });
    }

    [[nodiscard]] const SceneAttributeFault* findFault(const std::string& name) const {
        const auto found =
            std::find_if(attribute_faults.begin(), attribute_faults.end(),
                         [&](const SceneAttributeFault& fault) { return fault.target < 0 && fault.name == name; });
        return found == attribute_faults.end() ? nullptr : &*found;
    }

    /// Returns whether the primitive has tangents that something may read, but no texture that is read with them. An
    /// artist may have authored such tangents, along hair or brushed metal, so that UVs do not determine their
    /// direction.
    [[nodiscard]] bool mayHaveAuthoredTangents() const {
        return !tangents.empty() && (uses.empty() ? !other_reader.empty() : !uvsDetermineDirection());
    }

    /// Returns the first valid packed frames if NORMAL or TANGENT is missing, so that these are the primitive's only
    /// frames; otherwise null. `generate` does not change such a primitive.
    [[nodiscard]] const ScenePacked* packedAlone() const {
        if (!normals.empty() && !tangents.empty()) return nullptr;
        for (const ScenePacked& frames : packed) {
            if (frames.fault.empty()) return &frames;
        }
        return nullptr;
    }
};

/// Returns the approximate temporary memory for checking a primitive; it is highest if tangents are computed for
/// comparison.
inline std::uint64_t checkBytes(std::uint64_t corner_count, std::uint64_t vertex_count, bool has_tangents) {
    return corner_count * (has_tangents ? 96 : 24) + 48 * vertex_count;
}

struct SceneImage {
    std::string name = {};  ///< name of the image; may be empty
    std::string uri = {};   ///< URI in the file; empty if embedded
    /// The encoded image (PNG, JPEG, ...); empty if it was not requested or cannot be read.
    std::vector<std::uint8_t> bytes = {};
    bool is_unavailable = false;  ///< the referenced file does not exist or may not be read
    std::string why_empty = "it cannot be read";
};

struct Scene {
    std::string format = {};                      ///< "glb", "gltf", "obj"
    std::string generator = {};                   ///< program that wrote the file; may be empty
    std::vector<ScenePrimitive> primitives = {};  ///< primitives, in file order
    std::vector<SceneImage> images = {};          ///< referenced by TangentUse::image
    std::vector<std::string> warnings = {};       ///< warnings of the reader
    /// Indices, in `warnings`, of the warnings about scaled and invalid normals. Checks report these normals by
    /// findings on their primitives instead.
    std::vector<std::size_t> normals_warnings = {};
    [[nodiscard]] std::vector<std::string> normalsWarnings() const {
        std::vector<std::string> texts;
        for (const std::size_t number : normals_warnings) texts.push_back(warnings[number]);
        return texts;
    }
    DVec3 offset = {};                          ///< offset subtracted from all positions while reading (OBJ)
    std::shared_ptr<MemoryBudget> memory = {};  ///< remaining memory budget
};

// Scene with data for rendering in addition to frames: placements and looks of its primitives.

/// Properties of a primitive's own material.
struct SurfaceLook {
    std::array<float, 4> base_color = {1, 1, 1, 1};  ///< linear color and alpha
    std::optional<TextureReading> base_texture = {};
    std::optional<TextureReading> normal_texture = {};
    double normal_scale = 1;
    double metalness = 0, roughness = 1;
    std::optional<TextureReading> metal_texture = {};  ///< green: roughness; blue: metalness
    std::array<double, 3> emission = {0, 0, 0};        ///< linear color
    double emission_strength = 1;                      ///< factor of `emission` (KHR_materials_emissive_strength)
    std::optional<TextureReading> emission_texture = {};
    /// Alpha below which the surface is discarded; 0: no cutoff.
    double alpha_cutoff = 0;
    bool is_double_sided = false;
    bool is_unlit = false;
    bool is_blended = false;  ///< the surface is transparent where alpha is below 1
};

/// Placement of a primitive by a node.
struct ScenePlacement {
    std::size_t primitive = 0;  ///< index of the primitive in the scene
    Affine to_world = {};
    std::string node_name = {};            ///< name of the node that places it; may be empty
    std::optional<std::size_t> node = {};  ///< index of the node in the file (glTF)
    bool is_visible = true;                ///< false: hidden by the node or a parent (KHR_node_visibility)
};

struct DrawnScene {
    Scene scene = {};
    std::vector<SurfaceLook> looks = {};  ///< one per primitive
    /// placements of the meshes, in node order; never empty if there are primitives
    std::vector<ScenePlacement> placements = {};
    /// COLOR_0 as stored: one list per primitive, empty for primitives without it. No lists if colors were not
    /// requested.
    std::vector<SharedArray<Vec4>> colors = {};
};

/// Deformation of the vertices of a primitive by bones and morph weights, at one of its placements.
struct ScenePose {
    std::vector<Affine> bones = {};  ///< one per vertex, from rest pose to world space; empty: no skin
    /// Weighted offsets of morph targets, one per vertex; empty: none.
    std::vector<Vec3> positions = {}, normals = {}, tangents = {};

    [[nodiscard]] bool empty() const {
        return bones.empty() && positions.empty() && normals.empty() && tangents.empty();
    }
};

/// Scene in the pose stored in the file.
struct PosedScene {
    DrawnScene drawn = {};
    std::vector<ScenePose> poses = {};  ///< one per placement
};

}  // namespace tspace
