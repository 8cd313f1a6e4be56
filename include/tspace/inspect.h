// SPDX-License-Identifier: MIT
// Questions about model files that change nothing: what is in one, how its tangents were made, and how two differ. CMake target
// tspace::asset. Reads what generate.h reads.
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
    std::string material_name = {};  ///< may be empty
    bool only_in_variant = false;    ///< used by one of KHR_materials_variants, not by the primitive's own material
    std::int32_t uv_set = 0;         ///< n of TEXCOORD_n
    double uv_offset[2] = {0, 0};    ///< KHR_texture_transform
    double uv_rotation_rad = 0;
    double uv_scale[2] = {1, 1};
    bool follows_first = true;  ///< tangents made for the first use of the primitive fit this one too
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
    std::uint32_t vertex_list = 0;             ///< equal numbers mean shared vertices
    std::string index_type = {};               ///< "u8", "u16", "u32" or "none"
    std::string compression = {};              ///< "meshopt", "draco" or "none"
    std::vector<std::string> attributes = {};  ///< "POSITION float3", "NORMAL snorm16x3", ...
    std::uint32_t uv_set_count = 0;
    std::uint32_t morph_target_count = 0;
    bool skinned = false;
    bool has_normals = false;
    bool has_tangents = false;
    std::vector<FrameFormat> packed_frames = {};  ///< formats of packed frames that it has and that can be read
    bool tangents_not_read = false;  ///< has_tangents is false, but the importer cannot tell that there are none
    bool needs_tangents = false;
    std::string needed_by = {};                     ///< "normalTexture", "anisotropy", ... or empty
    std::vector<TangentUseInfo> tangent_uses = {};  ///< everything that needs tangents; they follow the first
    std::uint32_t variant_material_count = 0;       ///< materials that KHR_materials_variants can put on it
    std::uint32_t node_count = 0;                   ///< nodes that draw its mesh
    std::uint64_t instance_count = 0;               ///< how often they draw it: EXT_mesh_gpu_instancing counts each
    std::int32_t uv_set = -1;                       ///< the UV set that tangents would follow, or -1
    std::uint64_t degenerate_uv_count = 0;          ///< triangles without UV area in that set
    std::uint64_t degenerate_triangle_count = 0;    ///< triangles with two corners at one position
    double position_noise = 0;  ///< PositionNoise::noise of its triangles: 0 where positions are not noisy
    /// Triangles that show the texture mirrored (V direction and KHR_texture_transform considered).
    std::uint64_t mirrored_triangle_count = 0;
    std::uint32_t uv_island_count = 0;        ///< connected pieces of the UV map
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
    std::vector<PrimitiveInfo> primitives = {};  ///< in file order
    std::vector<std::string> warnings = {};      ///< about the file as a whole: one sentence each
    double coordinate_offset[3] = {0, 0, 0};     ///< offset that generate would subtract, as in GenerateReport
};

/// Reads a model and says what is in it. Changes nothing. Errors as generateFile.
Result<Inspection> inspectFile(const std::string& input, const FileOptions& options = {});

// Which method and which convention made the tangents of a model: every known method is run on the file's own
// positions, normals and UVs, and compared with what the file has. CMake target tspace::asset. Changes nothing.

/// Meaning of the stored signs, over all corners.
enum class SignReading : std::uint32_t {
    none = 0,      ///< undetermined: no corner has an orientation
    gltf = 1,      ///< as in glTF, B against growing v: the method was given (u, 1 - v), or its sign was negated
    inverted = 2,  ///< the opposite: the method was fed the file's raw UVs and its sign was stored as it came
    mixed = 3,     ///< neither holds for 95 % of the corners
};
/// "none", "gltf", "inverted", "mixed".
const char* signReadingName(SignReading reading);

/// How well one method explains the tangents. Corners of triangles whose UVs say nothing (without area, or so little
/// that rounding decides) vote in nothing: they are in no count but the last.
struct Explanation {
    Method method = Method::mikktspace;  ///< `best` with as many steps (TangentOptions::refine) as explain most
    /// quads: the method ran on quads that triangles were paired to (mikktspace only). There is such an entry only where
    /// it explains clearly more than the triangles do.
    Faces faces = Faces::triangles;
    std::int32_t uv_set = -1;     ///< n of the TEXCOORD_n followed; -1 over several primitives: the texture's set
    bool is_textures_set = true;  ///< it is the set that the material's texture is read with
    /// The UVs were taken as the texture's transform (KHR_texture_transform) turns or mirrors them; false: as they are
    /// stored.
    bool is_transformed = false;
    std::uint64_t corner_count = 0;  ///< corners compared: those with a stored tangent that has a direction
    std::uint64_t near_count = 0;    ///< corners of these within the tolerance of the method's tangent
    /// Within the tolerance of the method's tangent at some corner of the same vertex: what remains when results per
    /// corner were written through the old index list, so that one corner's tangent serves all.
    std::uint64_t near_any_count = 0;
    double mean_deg = 0;                    ///< angle to the method's tangent at the corner
    std::uint64_t gltf_sign_count = 0;      ///< corners whose sign is what glTF wants for the method's orientation
    std::uint64_t inverted_sign_count = 0;  ///< corners whose stored sign is the opposite
    std::uint64_t undecided_count = 0;      ///< corners with a direction whose triangle's UVs say nothing

    [[nodiscard]] double nearShare() const { return corner_count == 0 ? 0 : double(near_count) / double(corner_count); }
    [[nodiscard]] double nearAnyShare() const {
        return corner_count == 0 ? 0 : double(near_any_count) / double(corner_count);
    }
    [[nodiscard]] SignReading signs() const;
};

struct PrimitiveIdentity {
    std::string place = {};  ///< JSON pointer (OBJ: "usemtl NAME")
    std::uint32_t mesh = 0;
    std::uint32_t primitive = 0;     ///< in its mesh
    std::string mesh_name = {};      ///< may be empty
    std::string material_name = {};  ///< may be empty
    std::string skipped = {};        ///< why it was not looked at, for a person; empty: it was
    /// The best first; every method with every UV set that has an area.
    std::vector<Explanation> explanations = {};
    /// The texture's transform changes frames, so that its UV set has two readings, and one explains more corners.
    bool has_two_readings = false;
};

struct IdentifyOptions {
    FileOptions file = {};
    /// Tangents nearer than this count as the same: degrees, 0 to 180. Storing in 8 bits turns them by less than the default.
    double tolerance_deg = 1;
    Execution execution = {};  ///< changes no figure
};

struct Identification {
    std::string format = {};                 ///< "glb", "gltf", "obj"
    std::string generator = {};              ///< may be empty
    std::vector<std::string> warnings = {};  ///< sentences about the file, found while it was read
    /// Over all primitives, the best first: every method, along the texture's set in the reading that explains more.
    std::vector<Explanation> explanations = {};
    std::vector<PrimitiveIdentity> primitives = {};  ///< in file order
    std::string verdict = {};                        ///< two or three plain sentences
};

/// Reads a model and compares its tangents with those of mikktspace, angle, area, uniform, lengyel, flat and the other
/// methods of tspace that follow UVs; mikktspace also on quads, where pairs of triangles explain clearly more. "The
/// best" is the one with the most near corners; of those within half a percent the nearest in the mean, where that is
/// more than rounding, else the better known (that order). `fast` and `best`, which only tspace has, must explain 5 % more
/// than any other. Errors: those of generateFile for reading.
/// Time: about that of generating with each method. Thread-safe; the same result for any number of threads.
Result<Identification> identifyFile(const std::string& input, const IdentifyOptions& options = {});

// How much the frames of two models differ, when the models show the same surface: before and after a tool, two
// methods, two exporters. CMake target tspace::asset. Reads what generate.h reads, and changes nothing.

/// Upper ends, in degrees, of the histogram's bins; each bin holds what is above the one before it.
inline constexpr std::array<double, 9> kAngleBins = {0.001, 0.01, 0.1, 1, 5, 10, 30, 90, 180};

/// Angles between two sets of directions, over pairs of corners.
struct AngleStatistics {
    std::uint64_t count = 0;           ///< pairs in which both directions are finite and not zero
    std::uint64_t unusable_count = 0;  ///< pairs in which one is not, and the other is not the same
    double mean_deg = 0;
    double median_deg = 0;  ///< half of the pairs differ by this or less
    double p95_deg = 0;     ///< 95 % of the pairs
    double max_deg = 0;
    std::array<std::uint64_t, kAngleBins.size()> histogram = {};  ///< pairs per bin of kAngleBins
};

/// One of the worst pairs.
struct FrameDifference {
    std::uint32_t mesh_a = 0, primitive_a = 0, vertex_a = 0;
    std::uint32_t mesh_b = 0, primitive_b = 0, vertex_b = 0;
    Vec3 position = {};  ///< in A
    double tangent_deg = 0;
    double normal_deg = 0;
    double bitangent_deg = 0;
    bool sign_differs = false;
};

/// Two primitives that show the same surface, or one without a partner.
struct PrimitiveDiff {
    std::string place_a = {}, place_b = {};  ///< JSON pointers (OBJ: "usemtl NAME"); empty: no partner
    std::uint32_t mesh_a = 0, primitive_a = 0;
    std::uint32_t mesh_b = 0, primitive_b = 0;
    std::string mesh_name = {};  ///< mesh name in A, or in B if there is no A; may be empty
    /// "geometry" (same triangles, in any order and split or not), "name", "order" (neither fits, but the counts do),
    /// or "none": it has no partner.
    std::string paired_by = {};
    std::uint64_t triangle_count_a = 0, triangle_count_b = 0;
    std::uint64_t paired_triangle_count = 0;
    bool has_tangents_a = false, has_tangents_b = false;
    /// It has none as it was read, but the importer cannot tell that there are none in the file.
    bool tangents_not_read_a = false, tangents_not_read_b = false;
    bool has_normals_a = false, has_normals_b = false;
    std::uint64_t sign_change_count = 0;  ///< pairs of corners whose signs differ
    AngleStatistics tangents = {};
    AngleStatistics normals = {};
    AngleStatistics bitangents = {};  ///< sign * cross(N, T), rebuilt as a shader does it
};

struct DiffOptions {
    FileOptions file = {};
    std::optional<FileOptions> file_b = {};  ///< how B is opened, where that is not how A is
    std::size_t worst_count = 8;             ///< number of worst places to list
};

struct FrameDiff {
    std::vector<PrimitiveDiff> primitives = {};  ///< primitives of A in file order, then those of B without a match
    AngleStatistics tangents = {};               ///< over all pairs of the file
    AngleStatistics normals = {};
    AngleStatistics bitangents = {};
    std::uint64_t corner_count = 0;  ///< pairs of corners that were looked at
    std::uint64_t sign_change_count = 0;
    std::uint64_t unpaired_triangle_count = 0;  ///< triangles of A and B without a partner
    std::uint64_t missing_count = 0;            ///< paired primitives of which only one has tangents
    std::vector<FrameDifference> worst = {};    ///< the largest angle of T, B or N first; equal vertices once
    std::vector<std::string> warnings =
        {};  ///< sentences about A, then B, found while they were read; each names its file

    /// True when every triangle has a partner, no sign differs, and no angle is above `tolerance_deg`.
    [[nodiscard]] bool isWithin(double tolerance_deg) const;
};

/// Reads two models and compares their frames corner by corner.
///
/// Primitives are paired by their triangles: as sets of corner positions (and UVs), so that the order of triangles and
/// vertices, split vertices and other indices do not matter. What is left is paired by name, then by place in the file
/// when it has as many triangles; its triangles are paired where they lie at the same place but for rounding (1/1000 of
/// the primitive's size) once both primitives are scaled to one box, as after quantisation. Errors: those of
/// generateFile for reading; `element` is 0 when A is at fault, 1 when B is. Expected time n log n in the number of
/// corners. Thread-safe.
Result<FrameDiff> diffFiles(const std::string& a, const std::string& b, const DiffOptions& options = {});

}  // namespace tspace
