// SPDX-License-Identifier: MIT
// A model as arrays, of any format: what its primitives are, how their textures are read, how it is drawn.
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

// How a material reads a texture.

/// KHR_texture_transform: uv' = translation * rotation * scale * uv. `rotation` in radians, counter-clockwise as the
/// extension defines it.
struct UvTransform {
    double offset[2] = {0, 0};
    double rotation = 0;
    double scale[2] = {1, 1};

    /// true when it turns, mirrors or squeezes directions: an offset alone does not touch frames.
    [[nodiscard]] bool changesFrames() const { return rotation != 0 || scale[0] != 1 || scale[1] != 1; }
    [[nodiscard]] bool mirrors() const { return scale[0] * scale[1] < 0; }
};

struct TextureReading {
    std::size_t uv_set = 0;  ///< n of TEXCOORD_n; KHR_texture_transform's own texCoord goes first
    UvTransform transform = {};
    std::optional<std::size_t> image = {};  ///< index into the file's images
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
    bool reads_levels = true;  ///< false: the sampler asks for the largest level alone
};

// Why a primitive needs tangents: one texture or parameter of a material that is shaded in tangent space.

struct TangentUse {
    std::string needed_by = {};  ///< "normalTexture", "clearcoatNormalTexture" or "anisotropy"
    std::string place = {};      ///< JSON pointer of the texture reference, or of the extension
    /// False: a factor alone (KHR_materials_anisotropy), which tangents along any direction serve.
    bool has_texture = true;
    std::size_t uv_set = 0;  ///< n of TEXCOORD_n; KHR_texture_transform's own texCoord goes first
    UvTransform transform = {};
    std::optional<std::size_t> image = {};  ///< index into the file's images
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
    double scale = 1;               ///< factor of x and y of a normal map
    bool is_declared_down = false;  ///< the file says that green of its normal maps points down, as its readers know
    bool may_be_heights = false;    ///< the format takes a grey image for a height map there (map_bump of OBJ)
    bool reads_levels = true;       ///< like TextureReading::reads_levels
    std::size_t material = 0;
    std::string material_name = {};  ///< may be empty
    bool only_in_variant = false;    ///< the material is one of KHR_materials_variants, not the primitive's own
};

/// "normalTexture of material 'Paint' (a variant)"; a material without a name is named by its index.
inline std::string textureName(const TangentUse& use) {
    const std::string material = use.material_name.empty() ? std::to_string(use.material) : inQuotes(use.material_name);
    return use.needed_by + " of material " + material + (use.only_in_variant ? " (a variant)" : "");
}

// Contents of a model file that frames depend on, in one form for every format. Read-only: check, diff and identify examine it;
// generate decides by it, and edits the file's own document (gltf/model.h).

/// A read-only array that its copies share: files draw one accessor in many places.
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
    /// Expires when nobody has the array any more.
    [[nodiscard]] std::weak_ptr<const std::vector<T>> watch() const { return values_; }

  private:
    std::shared_ptr<const std::vector<T>> values_ = {};
};

/// Offsets of one morph target, one per vertex of its primitive. Empty: the target does not move this attribute.
struct SceneMorphTarget {
    SharedArray<Vec3> positions = {};
    SharedArray<Vec3> normals = {};
    SharedArray<Vec3> tangents = {};
};

/// A TANGENT that cannot be read.
struct SceneTangentFault {
    std::ptrdiff_t target = -1;  ///< index of the morph target; -1: the base primitive
    std::string why = {};        ///< "they do not have 4 components"
};

/// How a repair handles an attribute that cannot be read.
enum class AttributeRepair : std::uint8_t {
    resize,  ///< keeps the first components that it may have, and fills missing ones with zeros
    remove,
    none  ///< the primitive depends on the attribute, so no command can repair it
};

/// An attribute, other than TANGENT, that cannot be read, and so counts as absent.
struct SceneAttributeFault {
    std::string name = {};
    std::ptrdiff_t target = -1;  ///< morph target that has the attribute; -1: the primitive itself
    std::string why = {};        ///< "they do not have 3 components"
    AttributeRepair repair = AttributeRepair::remove;
    std::size_t vertex_count = 0;  ///< vertices of the primitive
};

/// "COLOR_0", or "NORMAL of morph target 2"; `target` -1: the primitive itself.
inline std::string attributeText(const std::string& name, std::ptrdiff_t target) {
    return target < 0 ? name : name + " of morph target " + std::to_string(target);
}

/// Packed frames in one format.
struct ScenePacked {
    FrameFormat format = FrameFormat::frame32;
    std::string attribute = {};  ///< the first that holds them, or the one that `fault` is about
    std::string fault = {};      ///< why they cannot be read, half a sentence about `attribute`; empty: they can
    SharedArray<std::uint8_t> words = {};  ///< without padding; empty where there is a fault
};

/// Factors that scale normals to length 1. Normal deltas of morph targets are multiplied by the same factors, so that all sums
/// keep their directions.
struct NormalScales {
    std::vector<double> of_vertices = {};  ///< 1 where the stored normal is unit within rounding, or has no direction
    std::size_t count = 0;                 ///< number of factors other than 1
    double least_length = 0, most_length = 0;  ///< range of the lengths of these normals
};

/// Prefix of warnings about normals of other lengths.
inline constexpr const char* kNormalLengths = "normals that do not have length 1";

struct ScenePrimitive {
    std::string place = {};  ///< JSON pointer (glTF), or "usemtl NAME" (OBJ)
    std::uint32_t mesh = 0;
    std::uint32_t primitive = 0;     ///< in its mesh
    std::string mesh_name = {};      ///< name of the mesh; may be empty
    std::string material_name = {};  ///< name of the material; may be empty
    std::string mode = {};           ///< "triangles", "triangle strip", "points", ...; OBJ: "triangles" or "polygons"
    /// Three vertices per triangle, every one smaller than positions.size(). Empty for points and lines.
    SharedArray<std::uint32_t> corners = {};
    SharedArray<Vec3> positions = {};
    double position_step = 0;        ///< quantization step, if positions are stored as integers; 0: floats
    SharedArray<Vec3> normals = {};  ///< one per vertex, scaled to length 1; empty: absent
    std::shared_ptr<const NormalScales> normal_scales = {};  ///< null: none had to be scaled
    SharedArray<Vec4> tangents = {};                         ///< one per vertex, or empty: absent
    std::vector<SceneTangentFault> tangent_faults = {};      ///< faults of tangents that are ignored
    std::vector<SceneAttributeFault> attribute_faults = {};
    bool tangents_not_read = false;               ///< they are empty, but the importer cannot tell that there are none
    std::vector<SharedArray<Vec2>> uv_sets = {};  ///< entry n: TEXCOORD_n, empty where absent; v runs down
    std::vector<SceneMorphTarget> morph_targets = {};
    std::vector<ScenePacked> packed = {};  ///< in the order of FrameFormat
    bool is_unlit = false;                 ///< every material of it is unlit: normals are not looked at
    bool is_double_sided = false;          ///< every material of it shows both sides
    /// Everything in the primitive's materials (variants too) that needs tangents; the first decides which UV set the
    /// tangents follow.
    std::vector<TangentUse> uses = {};
    /// Transforms of the primitive by the nodes of the scene; empty if not requested.
    std::vector<Affine> places = {};
    /// Another possible reader of the tangents, or a sign that they are authored: "the material extension EXT_hair". Empty:
    /// none.
    std::string other_reader = {};

    /// Its triangles, with these UVs.
    [[nodiscard]] MeshView view(std::span<const Vec2> uvs = {}) const {
        return {.positions = positions.span(), .normals = normals.span(), .uvs = uvs, .indices = corners.span()};
    }

    /// Whether a texture is read with the tangents, so that its UVs say where they must point.
    [[nodiscard]] bool uvsDecide() const {
        return std::any_of(uses.begin(), uses.end(), [](const TangentUse& use) { return use.has_texture; });
    }

    [[nodiscard]] const SceneAttributeFault* findFault(const std::string& name) const {
        const auto found =
            std::find_if(attribute_faults.begin(), attribute_faults.end(),
                         [&](const SceneAttributeFault& fault) { return fault.target < 0 && fault.name == name; });
        return found == attribute_faults.end() ? nullptr : &*found;
    }

    /// There are tangents that something may read, but no texture with them: somebody may have drawn them, along hair or
    /// brushed metal, and UVs are no authority on them.
    [[nodiscard]] bool hasFreeTangents() const {
        return !tangents.empty() && (uses.empty() ? !other_reader.empty() : !uvsDecide());
    }

    /// The packed frames that are the only ones it has, or null: `generate` then leaves it as it is.
    [[nodiscard]] const ScenePacked* packedAlone() const {
        if (!normals.empty() && !tangents.empty()) return nullptr;
        for (const ScenePacked& frames : packed) {
            if (frames.fault.empty()) return &frames;
        }
        return nullptr;
    }
};

/// Approximate temporary memory for checking a primitive: highest if tangents are computed for comparison.
inline std::uint64_t checkBytes(std::uint64_t corner_count, std::uint64_t vertex_count, bool has_tangents) {
    return corner_count * (has_tangents ? 96 : 24) + 48 * vertex_count;
}

struct SceneImage {
    std::string name = {};  ///< may be empty
    std::string uri = {};   ///< URI in the file; empty if embedded
    /// The encoded image (PNG, JPEG, ...); empty when it was not asked for or cannot be read.
    std::vector<std::uint8_t> bytes = {};
    bool is_unavailable = false;  ///< the file that the model names is not there, or may not be read
    std::string why_empty = "it cannot be read";
};

struct Scene {
    std::string format = {};                      ///< "glb", "gltf", "obj"
    std::string generator = {};                   ///< may be empty
    std::vector<ScenePrimitive> primitives = {};  ///< in file order
    std::vector<SceneImage> images = {};          ///< TangentUse::image points here
    std::vector<std::string> warnings = {};       ///< warnings of the reader
    DVec3 offset = {};                            ///< offset subtracted from all positions while reading (OBJ)
    std::shared_ptr<MemoryBudget> memory = {};    ///< remaining memory budget
};

// A scene with what a picture of it needs beside frames: where its primitives stand, and how they look.

/// Properties of a primitive's own material.
struct SurfaceLook {
    std::array<float, 4> base_color = {1, 1, 1, 1};  ///< linear color
    std::optional<TextureReading> base_texture = {};
    std::optional<TextureReading> normal_texture = {};
    double normal_scale = 1;
    double metalness = 0, roughness = 1;
    std::optional<TextureReading> metal_texture = {};  ///< green: roughness; blue: metalness
    std::array<double, 3> emission = {0, 0, 0};        ///< linear
    double emission_strength = 1;                      ///< KHR_materials_emissive_strength
    std::optional<TextureReading> emission_texture = {};
    /// The surface is absent where alpha is smaller; 0: it is present everywhere.
    double alpha_cutoff = 0;
    bool is_double_sided = false;
    bool is_unlit = false;
    bool is_blended = false;  ///< transparent by alpha
};

/// A primitive at one of its places.
struct ScenePlacement {
    std::size_t primitive = 0;  ///< index of the primitive in the scene
    Affine to_world = {};
    std::string node_name = {};            ///< name of the node that places it; may be empty
    std::optional<std::size_t> node = {};  ///< its index in the file (glTF)
};

struct DrawnScene {
    Scene scene = {};
    std::vector<SurfaceLook> looks = {};          ///< one per primitive
    std::vector<ScenePlacement> placements = {};  ///< in the order of nodes; never empty where there are primitives
    /// COLOR_0 as stored, one list per primitive, empty where it has none; no lists where they were not asked for.
    std::vector<SharedArray<Vec4>> colors = {};
};

/// Deformation of the vertices of a primitive by bones and morph weights, at one of its placements.
struct ScenePose {
    std::vector<Affine> bones = {};  ///< one per vertex, into the world; empty: no skin
    /// Weighted offsets of morph targets, one per vertex; empty: none.
    std::vector<Vec3> positions = {}, normals = {}, tangents = {};

    [[nodiscard]] bool empty() const {
        return bones.empty() && positions.empty() && normals.empty() && tangents.empty();
    }
};

/// A scene as the file poses it.
struct PosedScene {
    DrawnScene drawn = {};
    std::vector<ScenePose> poses = {};  ///< one per placement
};

}  // namespace tspace
