// SPDX-License-Identifier: MIT
// Read-only analysis of model files: contents, method of the tangents, and differences between two models. CMake target
// tspace::asset. Reads the formats that generate.h reads.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tspace/execution.h"
#include "tspace/file_options.h"
#include "tspace/mesh.h"
#include "tspace/pack.h"
#include "tspace/result.h"
#include "tspace/span.h"
#include "tspace/tangents.h"

namespace tspace {

/// One texture or parameter of a material that is shaded in tangent space.
struct TangentUseInfo {
    std::string needed_by = {};  ///< "normalTexture", "clearcoatNormalTexture" or "anisotropy"
    std::string place = {};      ///< JSON pointer of the texture reference or extension; empty for OBJ
    std::uint32_t material = 0;
    std::string material_name = {};  ///< name in the file; may be empty
    /// True: only a KHR_materials_variants material uses it, not the primitive's own material.
    bool only_in_variant = false;
    std::int32_t uv_set = 0;       ///< n of TEXCOORD_n
    double uv_offset[2] = {0, 0};  ///< offset of KHR_texture_transform
    double uv_rotation_rad = 0;
    double uv_scale[2] = {1, 1};
    /// true: tangents that are computed for the first use of the primitive also fit this use
    bool follows_first = true;
};

/// Properties of one primitive that matter for generating tangents.
struct PrimitiveInfo {
    std::uint32_t mesh = 0;
    std::uint32_t primitive = 0;
    std::string mesh_name = {};
    std::string material_name = {};
    std::string mode = {};  ///< "triangles", "triangle strip", "points", ...
    std::uint64_t triangle_count = 0;
    std::uint64_t vertex_count = 0;
    /// number of the vertex list; primitives with equal numbers share vertices
    std::uint32_t vertex_list = 0;
    std::string index_type = {};               ///< "u8", "u16", "u32" or "none"
    std::string compression = {};              ///< "meshopt", "draco" or "none"
    std::vector<std::string> attributes = {};  ///< "POSITION float3", "NORMAL snorm16x3", ...
    std::uint32_t uv_set_count = 0;
    std::uint32_t morph_target_count = 0;
    bool skinned = false;
    bool has_normals = false;
    bool has_tangents = false;
    std::vector<FrameFormat> packed_frames = {};  ///< formats of its readable packed frames
    /// True: has_tangents is false, but the file may have tangents that the importer cannot read.
    bool tangents_not_read = false;
    bool needs_tangents = false;
    std::string needed_by = {};  ///< "normalTexture", "anisotropy", ...; empty: nothing needs tangents
    /// All uses that need tangents, which are computed for the first of them.
    std::vector<TangentUseInfo> tangent_uses = {};
    /// number of materials that KHR_materials_variants can assign to the primitive
    std::uint32_t variant_material_count = 0;
    std::uint32_t node_count = 0;                 ///< number of nodes that draw the primitive's mesh
    std::uint64_t instance_count = 0;             ///< instances drawn by these nodes, including EXT_mesh_gpu_instancing
    std::int32_t uv_set = -1;                     ///< the UV set that tangents would follow, or -1
    std::uint64_t degenerate_uv_count = 0;        ///< triangles without UV area in that set
    std::uint64_t degenerate_triangle_count = 0;  ///< triangles with two corners at one position
    double position_noise = 0;                    ///< PositionNoise::noise of the triangles; 0: positions are not noisy
    /// Triangles that show the texture mirrored (given the V direction and KHR_texture_transform).
    std::uint64_t mirrored_triangle_count = 0;
    std::uint32_t uv_island_count = 0;        ///< connected components of the UV map
    std::uint32_t mirrored_island_count = 0;  ///< islands whose area is mostly mirrored
};

struct Inspection {
    std::string format = {};  ///< "glb", "gltf", "obj", or the extension of an imported file ("fbx")
    std::string generator = {};
    std::uint64_t file_bytes = 0;
    std::uint32_t mesh_count = 0;
    std::uint32_t material_count = 0;
    std::uint32_t node_count = 0;
    std::uint32_t animation_count = 0;
    std::uint32_t image_count = 0;
    std::vector<std::string> extensions_used = {};
    std::vector<std::string> extensions_required = {};
    std::vector<std::string> variants = {};      ///< names of KHR_materials_variants
    std::vector<PrimitiveInfo> primitives = {};  ///< one entry per primitive, in file order
    std::vector<std::string> warnings = {};      ///< one sentence each, about the file as a whole
    /// offset that generate would subtract (GenerateReport::coordinate_offset)
    double coordinate_offset[3] = {0, 0, 0};
};

/// Reads a model and returns its properties. Errors: those of generateFile.
Result<Inspection> inspectFile(const std::string& input, const FileOptions& options = {});

// Identification of the method and the convention of a model's tangents: every known method is run on the file's own
// positions, normals and UVs, and compared with the stored tangents. CMake target tspace::asset. Read-only.

/// Meaning of the stored signs, over all corners.
enum class SignReading : std::uint32_t {
    none = 0,  ///< undetermined: no corner has an orientation
    gltf = 1,  ///< as in glTF, B against increasing v: the method was given (u, 1 - v), or its sign was negated
    /// inverted relative to glTF: the method was given the file's raw UVs, and its sign was stored unchanged
    inverted = 2,
    mixed = 3,  ///< neither `gltf` nor `inverted` holds for at least 95 % of the corners
};
/// Returns "none", "gltf", "inverted" or "mixed".
const char* signReadingName(SignReading reading);

/// Agreement of one method with the stored tangents. Corners of triangles whose UVs determine no direction (without
/// area, or with so little that rounding decides) are excluded: only undecided_count includes them.
struct Explanation {
    /// Method that was compared. For `best`, the number of refinement steps (TangentOptions::refine) is the one that
    /// fits most corners.
    Method method = Method::mikktspace;
    /// quads: the method ran on quads formed from pairs of triangles (mikktspace only). Such an entry exists only if it
    /// explains clearly more corners than triangles do.
    Faces faces = Faces::triangles;
    /// Index n of the TEXCOORD_n used. -1 in results over several primitives: each uses the UV set of its texture.
    std::int32_t uv_set = -1;
    bool is_textures_set = true;  ///< true: `uv_set` is the UV set that the material's texture uses
    /// True: UVs after the texture's transform (KHR_texture_transform); false: UVs as stored.
    bool is_transformed = false;
    std::uint64_t corner_count = 0;  ///< compared corners: those with a stored tangent that has a direction
    std::uint64_t near_count = 0;    ///< compared corners within the tolerance of the method's tangent
    /// Corners within the tolerance of the method's tangent at any corner of the same vertex: still high if per-corner
    /// results were written through the old index list, so that one corner's tangent is used by all.
    std::uint64_t near_any_count = 0;
    double mean_deg = 0;                    ///< mean angle to the method's tangent at the corner
    std::uint64_t gltf_sign_count = 0;      ///< corners whose sign is correct in glTF for the method's orientation
    std::uint64_t inverted_sign_count = 0;  ///< corners whose stored sign is the opposite of the correct sign in glTF
    std::uint64_t undecided_count = 0;      ///< corners with a direction whose triangle's UVs determine none

    [[nodiscard]] double nearShare() const { return corner_count == 0 ? 0 : double(near_count) / double(corner_count); }
    [[nodiscard]] double nearAnyShare() const {
        return corner_count == 0 ? 0 : double(near_any_count) / double(corner_count);
    }
    [[nodiscard]] SignReading signs() const;
};

struct PrimitiveIdentity {
    std::string place = {};  ///< JSON pointer (OBJ: "usemtl NAME")
    std::uint32_t mesh = 0;
    std::uint32_t primitive = 0;     ///< index of the primitive in its mesh
    std::string mesh_name = {};      ///< name in the file; may be empty
    std::string material_name = {};  ///< name in the file; may be empty
    /// reason why the primitive was not examined, as a sentence; empty: it was examined
    std::string skipped = {};
    /// Results of every method with every UV set that has an area, best first.
    std::vector<Explanation> explanations = {};
    /// The texture's transform changes frames, so its UV set has two interpretations, one of which explains more
    /// corners.
    bool has_two_readings = false;
};

struct IdentifyOptions {
    FileOptions file = {};
    /// Maximum angle between equal tangents: degrees, 0 to 180. Storing in 8 bits rotates them by less than the
    /// default.
    double tolerance_deg = 1;
    Execution execution = {};  ///< does not affect the result
};

struct Identification {
    std::string format = {};                 ///< "glb", "gltf", "obj"
    std::string generator = {};              ///< program that wrote the file; may be empty
    std::vector<std::string> warnings = {};  ///< warnings about the file, one sentence each
    /// Results over all primitives, best first: every method, with the texture's UV set in the interpretation that
    /// explains more.
    std::vector<Explanation> explanations = {};
    std::vector<PrimitiveIdentity> primitives = {};  ///< one entry per primitive, in file order
    std::string verdict = {};                        ///< summary in two or three sentences
};

/// Reads a model and compares its tangents with those of mikktspace, angle, area, uniform, lengyel, flat and the other
/// methods of tspace that use UVs; mikktspace also on quads, if pairs of triangles explain clearly more. The best
/// method is the one with the most corners whose tangents agree within the tolerance. Among methods within 0.5 % of it,
/// the smallest mean angle decides if the difference exceeds rounding, otherwise the better known method (in this
/// order). `fast` and `best`, which only tspace has, must explain 5 % more than any other. Errors: those of
/// generateFile for reading.
/// Time: about that of generating with each method. Thread-safe; the same result for any number of threads.
Result<Identification> identifyFile(const std::string& input, const IdentifyOptions& options = {});

// Comparison of the frames of two models that show the same surface: before and after a tool, two methods, two
// exporters. CMake target tspace::asset. Reads the formats that generate.h reads, and changes nothing.

/// Upper bounds of the histogram bins, in degrees; each bin starts at the bound of the previous one.
inline constexpr std::array<double, 9> kAngleBins = {0.001, 0.01, 0.1, 1, 5, 10, 30, 90, 180};

/// Angles between two sets of directions, over pairs of corners.
struct AngleStatistics {
    std::uint64_t count = 0;  ///< pairs in which both directions are finite and not zero
    /// Pairs in which one direction is zero or not finite, and the other is not equal to it.
    std::uint64_t unusable_count = 0;
    double mean_deg = 0;
    double median_deg = 0;  ///< median: half of the pairs differ by at most this
    double p95_deg = 0;     ///< 95th percentile
    double max_deg = 0;
    std::array<std::uint64_t, kAngleBins.size()> histogram = {};  ///< pairs per bin of kAngleBins
};

/// Pair of corners whose frames differ most.
struct FrameDifference {
    std::uint32_t mesh_a = 0, primitive_a = 0, vertex_a = 0;
    std::uint32_t mesh_b = 0, primitive_b = 0, vertex_b = 0;
    Vec3 position = {};  ///< position in A
    double tangent_deg = 0;
    double normal_deg = 0;
    double bitangent_deg = 0;
    bool sign_differs = false;
};

/// Two primitives that show the same surface, or one without a partner.
struct PrimitiveDiff {
    std::string place_a = {}, place_b = {};  ///< JSON pointers (OBJ: "usemtl NAME"); empty: unpaired
    std::uint32_t mesh_a = 0, primitive_a = 0;
    std::uint32_t mesh_b = 0, primitive_b = 0;
    std::string mesh_name = {};  ///< mesh name in A, or in B if there is no A; may be empty
    /// Rule by which the primitives were paired: "geometry" (same triangles, in any order and with any splits), "name",
    /// "order" (by position in the file, with equal counts), or "none": unpaired.
    std::string paired_by = {};
    std::uint64_t triangle_count_a = 0, triangle_count_b = 0;
    std::uint64_t paired_triangle_count = 0;
    bool has_tangents_a = false, has_tangents_b = false;
    /// No tangents were read, but the file may have tangents that the importer cannot read.
    bool tangents_not_read_a = false, tangents_not_read_b = false;
    bool has_normals_a = false, has_normals_b = false;
    std::uint64_t sign_change_count = 0;  ///< pairs of corners whose signs differ
    AngleStatistics tangents = {};
    AngleStatistics normals = {};
    AngleStatistics bitangents = {};  ///< sign * cross(N, T), as reconstructed by shaders
};

struct DiffOptions {
    FileOptions file = {};
    std::optional<FileOptions> file_b = {};  ///< options for opening B, if they differ from those for A
    std::size_t worst_count = 8;             ///< number of worst pairs to list
};

struct FrameDiff {
    std::vector<PrimitiveDiff> primitives = {};  ///< primitives of A in file order, then unpaired primitives of B
    AngleStatistics tangents = {};               ///< angles of all pairs of the file
    AngleStatistics normals = {};
    AngleStatistics bitangents = {};
    std::uint64_t corner_count = 0;  ///< pairs of corners that were compared
    std::uint64_t sign_change_count = 0;
    std::uint64_t unpaired_triangle_count = 0;  ///< unpaired triangles of A and B
    std::uint64_t missing_count = 0;            ///< paired primitives of which only one has tangents
    /// Pairs with the largest angle of T, B or N, in descending order; pairs of equal vertices are listed once.
    std::vector<FrameDifference> worst = {};
    std::vector<std::string> warnings = {};  ///< warnings about A, then B, one sentence each, with the file's name

    /// Returns true if every triangle is paired, no sign differs, and no angle exceeds `tolerance_deg`.
    [[nodiscard]] bool isWithin(double tolerance_deg) const;
};

/// Reads two models and compares their frames corner by corner.
///
/// Primitives are paired by their triangles, as sets of corner positions (and UVs): the order of triangles and
/// vertices, splits and indices do not matter. Other primitives are paired by name, then by position in the file if
/// triangle counts are equal; their triangles are paired if their positions agree within 1/1000 of the primitive's size
/// after both primitives are scaled to the same box, as after quantization. Errors: those of generateFile for reading;
/// `element` is 0 if A is at fault, 1 if B is. Expected time n log n in the number of corners. Thread-safe.
Result<FrameDiff> diffFiles(const std::string& a, const std::string& b, const DiffOptions& options = {});

}  // namespace tspace
