// SPDX-License-Identifier: MIT
// Model files: read one, put normals and tangents where its materials need them, write it with everything else in
// it untouched. CMake target tspace::asset. Reads glTF 2.0 (.glb, .gltf) and Wavefront OBJ; writes glTF.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tspace/normals.h"
#include "tspace/result.h"
#include "tspace/sanitize.h"
#include "tspace/tangents.h"

namespace tspace {

/// How files are opened.
struct FileOptions {
    /// URIs in a model may lead only to files in its own folder (and below). true: anywhere.
    bool allow_external = false;
};

/// Called now and then during long work. `done` of `total` steps; `what` names the step ("computing tangents").
using Progress = std::function<void(const char* what, std::uint64_t done, std::uint64_t total)>;

struct GenerateOptions {
    bool all = false;        ///< also primitives whose material needs no tangents
    bool overwrite = false;  ///< replace tangents that are there; false: only add missing ones
    /// Its execution serves the whole file: primitives are computed at the same time, and normals and sanitize run where
    /// their primitive does. With an allocator one primitive follows the other.
    TangentOptions tangents{.convention = conventions::gltf};
    /// For primitives without normals. The default is what glTF asks of a client.
    NormalOptions normals{.weighting = NormalWeighting::flat};
    /// OBJ files with `s` lines: missing normals follow those groups with angle weights (faces in group 0 are flat).
    /// false, or a file without `s` lines: `normals` alone decides.
    bool use_smoothing_groups = true;
    bool sanitize = true;
    SanitizeOptions sanitize_options = {};
    FileOptions file = {};
    Progress progress = {};
};

/// What was done to one primitive.
enum class PrimitiveAction : std::uint32_t {
    generated = 0,    ///< tangents were added
    replaced = 1,     ///< tangents were there and were computed anew
    unchanged = 2,    ///< computed anew with the same bits as those in the file
    kept = 3,         ///< tangents were there and stay (no overwrite)
    notNeeded = 4,    ///< the material needs no tangents (no `all`)
    notTriangles = 5, ///< points or lines
    impossible = 6,   ///< no UVs, no positions or nothing to compute; `reason` says which
};
/// Stable lowerCamelCase name, for JSON.
const char* actionName(PrimitiveAction action);

struct PrimitiveReport {
    std::uint32_t mesh = 0;
    std::uint32_t primitive = 0;
    std::string mesh_name = {};      ///< may be empty
    std::string material_name = {};  ///< may be empty
    PrimitiveAction action = PrimitiveAction::notNeeded;
    std::string reason = {};          ///< one sentence for a person: why this action
    std::int32_t uv_set = -1;    ///< n of TEXCOORD_n the tangents follow, or -1
    bool normals_generated = false;
    std::uint64_t triangle_count = 0;
    std::uint64_t vertices_before = 0;
    std::uint64_t vertices_after = 0;
    NormalReport normals = {};
    TangentReport tangents = {};
    SanitizeReport sanitize = {};
};

struct GenerateReport {
    std::vector<PrimitiveReport> primitives = {};  ///< in file order
    bool changed = false;                     ///< false: the output is byte for byte the input
    std::uint64_t input_bytes = 0;            ///< the model file and what it loads
    std::uint64_t output_bytes = 0;
    std::vector<std::string> output_files = {};    ///< everything that was written, the model first
    std::vector<std::string> warnings = {};
};

/// Reads `input`, adds or replaces normals and tangents, and writes `output` (.glb or .gltf; may be the same file).
/// All outputs appear at once or not at all: they are written beside the target under a temporary name, then renamed.
/// Errors: cannotRead (the input), invalidFile (also when a buffer file that it names cannot be read),
/// unsupportedFile, forbiddenPath, invalidOption, tooLarge, cannotWrite, outOfMemory. On error nothing on disk has
/// changed.
Result<GenerateReport> generateFile(const std::string& input, const std::string& output,
                                    const GenerateOptions& options = {});

/// What is in one primitive, as a person would want to know it before generating.
struct PrimitiveInfo {
    std::uint32_t mesh = 0;
    std::uint32_t primitive = 0;
    std::string mesh_name = {};
    std::string material_name = {};
    std::string mode = {};                      ///< "triangles", "triangle strip", "points", ...
    std::uint64_t triangle_count = 0;
    std::uint64_t vertex_count = 0;
    std::string index_type = {};                ///< "u8", "u16", "u32" or "none"
    std::vector<std::string> attributes = {};   ///< "POSITION float3", "NORMAL snorm16x3", ...
    std::uint32_t uv_set_count = 0;
    std::uint32_t morph_target_count = 0;
    bool skinned = false;
    bool has_normals = false;
    bool has_tangents = false;
    bool needs_tangents = false;
    std::string needed_by = {};                 ///< "normalTexture", "clearcoatNormalTexture", "anisotropy", ... or empty
    std::int32_t uv_set = -1;              ///< the UV set that tangents would follow, or -1
    std::uint64_t degenerate_uv_count = 0;       ///< triangles without UV area in that set
    std::uint64_t degenerate_triangle_count = 0; ///< triangles with two corners at one position
    std::uint64_t mirrored_triangle_count = 0;   ///< triangles that show the texture mirrored (V direction considered)
    std::uint32_t uv_island_count = 0;           ///< connected pieces of the UV map
    std::uint32_t mirrored_island_count = 0;     ///< those of which most of the area is mirrored
};

struct Inspection {
    std::string format = {};  ///< "glb", "gltf" or "obj"
    std::string generator = {};
    std::uint64_t file_bytes = 0;
    std::uint32_t mesh_count = 0;
    std::uint32_t material_count = 0;
    std::uint32_t node_count = 0;
    std::uint32_t animation_count = 0;
    std::uint32_t image_count = 0;
    std::vector<std::string> extensions_used = {};
    std::vector<std::string> extensions_required = {};
    std::vector<PrimitiveInfo> primitives = {};  ///< in file order
};

/// Reads a model and says what is in it. Changes nothing. Errors as generateFile.
Result<Inspection> inspectFile(const std::string& input, const FileOptions& options = {});

}  // namespace tspace
