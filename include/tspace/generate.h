// SPDX-License-Identifier: MIT
// Adds normals and tangents to a model file if its materials need them, and keeps all other data unchanged. CMake
// target tspace::asset. Reads glTF 2.0 (.glb, .gltf) and Wavefront OBJ, and through the importer FBX, PLY, STL, DAE,
// 3DS and others; writes glTF.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tspace/callbacks.h"
#include "tspace/execution.h"
#include "tspace/file_options.h"
#include "tspace/mesh.h"
#include "tspace/normals.h"
#include "tspace/pack.h"
#include "tspace/result.h"
#include "tspace/tangents.h"
#include "tspace/winding.h"

namespace tspace {

/// Treatment of existing tangents that are needed.
enum class ExistingTangents : std::uint32_t {
    keep = 0,     ///< keep existing tangents, and add missing ones
    replace = 1,  ///< recompute existing tangents
    repair = 2,   ///< repair the tangents that `check` reports as errors, vertex by vertex; keep all others
};

/// Whether tangents use the UVs before or after KHR_texture_transform. It matters for rotations and negative scales;
/// docs/reference/gltf.md describes what viewers do.
enum class TextureTransform : std::uint32_t {
    /// UVs after the transform: T points along increasing u in the image, as required by viewers that use tangents
    /// unchanged.
    apply = 0,
    ignore = 1,  ///< UVs before the transform: for viewers that transform the tangents themselves
};

/// Compression of the geometry in a written glTF file.
enum class Compression : std::uint32_t {
    keep = 0,     ///< keep the compression of the input, also for new data; uncompressed data stays uncompressed
    none = 1,     ///< decompress everything
    meshopt = 2,  ///< EXT_meshopt_compression for vertices and indices; lossless
    draco = 3,    ///< KHR_draco_mesh_compression for triangles; quantizes positions, normals and UVs that are new to it
};

/// Attributes to remove from primitives with packed frames.
enum class PackDrop : std::uint32_t {
    nothing = 0,
    tangents = 1,  ///< TANGENT
    all = 2,       ///< TANGENT and NORMAL: only readers of the packed attribute can still light the primitive correctly
};

/// Which normal maps get their green channel inverted.
enum class FlipGreen : std::uint32_t {
    none = 0,
    /// Maps whose green points down throughout, as detected by checkFile (greenFlipped). Maps whose kept tangents have
    /// inverted signs are not inverted, because the two cancel out.
    down = 1,
    all = 2,  ///< every normal map and clearcoat normal map
};

/// Normal deltas (NORMAL of a target) of morph targets that move the surface, for normals that are kept.
enum class MorphNormals : std::uint32_t {
    keep = 0,     ///< keep existing deltas; add none
    missing = 1,  ///< compute deltas for targets that have none, only zeros, or values that are not finite
    all = 2,      ///< recompute all deltas
};

/// Options of generateFile. The defaults add what glTF requires and change nothing else.
struct GenerateOptions {
    /// Primitives that get tangents, and the treatment of existing tangents.
    struct Selection {
        bool all = false;    ///< also add tangents to primitives whose material needs none
        bool strip = false;  ///< remove tangents that no material needs; cannot be combined with `all` (invalidOption)
        ExistingTangents existing = ExistingTangents::keep;
    };

    /// Options for computing normals.
    struct Normals {
        /// Options for primitives without normals. Default: flat, as glTF requires. weld_distance also applies to
        /// winding and to borders of primitives.
        NormalOptions compute{.weighting = NormalWeighting::flat, .weld_distance = NormalOptions::weld_auto};
        /// true: missing normals of OBJ files with `s` lines follow these smoothing groups, with angle weights (faces
        /// in group 0 are flat). false, or a file without `s` lines: `compute` applies.
        bool use_smoothing_groups = true;
        /// false: computed normals, with any weighting except `flat`, are smooth across the border of two primitives of
        /// a mesh that form one surface (they share edges whose ends have equal positions, as neighboring triangles
        /// do). If the other primitive has normals, these are kept, and computed ones adopt them at the border within
        /// 30 degrees and the crease angle. Tangents are computed for each primitive separately, as bakers do. true:
        /// normals are also computed for each primitive separately, and the border is a seam. OBJ: normals are smooth
        /// over the whole file, or, with true, over the faces of one object and material.
        bool per_primitive = false;
        /// Recompute existing normals with `compute` in every primitive with triangles whose material is not unlit
        /// (unlit: only normals with an invalid type or without direction), and add missing ones, whether or not
        /// tangents are needed. Vertices that differ only in computed data (normals, tangents, their morph deltas) are
        /// first merged, and are split if the new normals differ. Existing tangents are recomputed too, even with
        /// ExistingTangents::keep, because they would not match; if that is impossible (no readable UVs), the normals
        /// are kept. With `keep`, signs stay inverted if most were: normal maps may depend on it. Cannot be combined
        /// with Maps::convert (invalidOption).
        bool overwrite = false;
        /// Treatment of normal deltas of morph targets for normals that are kept; computed normals always get
        /// computed deltas. The base normal is rotated as the surface around the vertex rotates. Tangent deltas of
        /// these targets are updated if the tangents equal computed ones. glTF only.
        MorphNormals morphs = MorphNormals::keep;
    };

    /// Options for computing tangents.
    struct Tangents {
        TangentOptions compute{.convention = conventions::gltf};
        TextureTransform texture_transform = TextureTransform::apply;
        /// Faces that mikktspace is computed on; other methods use triangles. `quads` merges pairs of triangles
        /// as the file's tangents indicate, or by shape if the tangents do not indicate pairs; for OBJ files it uses
        /// the polygons of the file. ExistingTangents::repair keeps tangents that are correct on either kind of face.
        Faces faces = Faces::triangles;
        /// Also write the direction of dP/dv (TangentOutput::bitangents) with computed tangents, as the attribute
        /// _BITANGENT (VEC3, in Storage::format). Its differences also cause splits. Morph targets get no deltas for
        /// it.
        bool bitangents = false;
        /// Repair tangents that contain NaN or infinity, are zero, do not have unit length, are parallel to N, or have
        /// different signs within a face. false: write the unmodified results of the method.
        bool sanitize = true;
        SanitizeOptions sanitize_options = {};  ///< options of the repair, with `sanitize`
    };

    /// Normal maps of the model.
    struct Maps {
        /// PNG keeps its bit depth, JPEG is recompressed, WebP is written losslessly. An image that has other uses,
        /// such as base color, is kept, and the normal maps get a copy; files next to a .gltf are kept too, and the
        /// output refers to new ones.
        FlipGreen flip_green = FlipGreen::none;
        /// Rewrite normal maps (PNG, JPEG) that glTF readers would misinterpret, as PNG with the same bit depth:
        /// maps with two channels, exchanged channels, x in alpha, sRGB encoding, or object-space vectors, as
        /// detected by checkFile. With flip_green, the new maps are inverted if needed.
        bool mend = false;
        /// Convert normal maps to the computed tangents, so that the shaded result is the same as with the old ones.
        /// Primitives without tangents are assumed to have been shown with mikktspace tangents, as viewers compute
        /// them. New maps are PNGs with the old bit depth; a map or a material is copied if its primitives need
        /// different ones. glTF only, in glTF's convention, and not with ExistingTangents::repair,
        /// TextureTransform::ignore or flip_green (invalidOption).
        bool convert = false;
        /// Read the pixels of normal maps if ExistingTangents::repair needs them. false: inverted signs are kept,
        /// because the green channel of the maps may also point down. Cannot be combined with flip_green, mend or
        /// convert (invalidOption).
        bool read = true;
    };

    /// Storage of the output.
    struct Storage {
        Compression compression = Compression::keep;
        VectorFormat format = VectorFormat::float32;
        /// Also write the whole frame of each vertex in this format, as separate attributes (_FRAME32, ...;
        /// accessors: see docs/concepts/pack.md), for every primitive that has NORMAL and TANGENT in the output,
        /// computed or not, from their stored values. Morph targets get none: packed frames are those of the base
        /// mesh.
        std::optional<FrameFormat> pack = {};
        /// Attributes to remove where frames were packed; those that morph targets modify are kept. Must be `nothing`
        /// if `pack` is empty (invalidOption).
        PackDrop pack_drop = PackDrop::nothing;
    };

    Selection selection = {};
    Normals normals = {};
    Tangents tangents = {};
    Maps maps = {};
    Storage storage = {};
    /// First flip triangles that are wound against their neighbors, and components that are inside out (mendWinding).
    /// Primitives of one mesh are one surface, and so is an OBJ file. Normals that are kept define the outside if they
    /// are consistent. Only index lists change: attributes and morph targets keep their order; strips and fans become
    /// lists.
    bool mend_winding = false;
    FileOptions file = {};
    /// Receives the output, a GLB, instead of a file, after all computations; the output path is then only a name
    /// (NAME.glb). Files that the model refers to are not written. If it returns false: cannotWrite.
    Sink sink = {};
    bool dry_run = false;  ///< true: nothing is written; the report states what would be written
    /// Threads for the whole file: primitives are processed in parallel, or, with an allocator, one after another.
    Execution execution = {};
    Progress progress = {};
};

/// Result for one primitive.
enum class PrimitiveAction : std::uint32_t {
    generated = 0,     ///< tangents were added
    replaced = 1,      ///< existing tangents were recomputed
    unchanged = 2,     ///< recomputed with the same bits as in the file
    kept = 3,          ///< existing tangents were kept (not to be replaced, or found correct)
    notNeeded = 4,     ///< the material needs no tangents (and `all` is not set)
    notTriangles = 5,  ///< points or lines
    impossible = 6,    ///< no UVs, no positions or nothing to compute; see `reason`
    removed = 7,       ///< removed: no material needs them (`strip`), or they could not be read
};
/// Returns the stable lowerCamelCase name, for JSON.
const char* actionName(PrimitiveAction action);

/// Range of consecutive faces.
struct FaceRange {
    std::uint64_t first = 0, count = 0;
};

/// Maximum number of ranges that a report lists per primitive; its counts include all.
inline constexpr std::size_t kMostMendedRanges = 256;

struct PrimitiveReport {
    std::uint32_t mesh = 0;
    std::uint32_t primitive = 0;
    std::string mesh_name = {};      ///< name in the file; may be empty
    std::string material_name = {};  ///< name in the file; may be empty
    PrimitiveAction action = PrimitiveAction::notNeeded;
    std::string reason = {};              ///< reason for the action, as one sentence
    std::vector<std::string> notes = {};  ///< further sentences: textures that need other tangents, transforms, repairs
    std::int32_t uv_set = -1;             ///< n of the TEXCOORD_n that was used for the tangents, or -1
    bool normals_generated = false;
    bool bitangents_generated = false;  ///< _BITANGENT was computed
    bool frames_packed = false;         ///< the output has packed frames (`pack`); if false, a note states the reason
    bool normals_dropped = false;       ///< NORMAL was removed (`pack_drop`)
    bool tangents_dropped = false;      ///< TANGENT was removed (`pack_drop`)
    std::uint64_t triangle_count = 0;
    std::uint64_t vertices_before = 0;
    std::uint64_t vertices_after = 0;
    /// IDs of vertex lists: primitives with one `source_list` share their vertices in the input, and primitives with
    /// one `split_list` share the vertices that a split added. Sums over primitives count each list once.
    std::uint32_t source_list = 0, split_list = 0;
    std::uint64_t mended_vertex_count = 0;    ///< vertices (of vertices_before) whose tangents were wrong (`repair`)
    std::uint32_t morph_target_count = 0;     ///< morph targets that the primitive has
    std::uint32_t morph_deltas_computed = 0;  ///< morph targets whose tangent deltas were computed
    /// Morph targets whose normal deltas were computed, for normals that are kept.
    std::uint32_t morph_normals_computed = 0;
    /// Corners, over all targets, at which the frame of the morphed shape has the opposite sign, which glTF cannot
    /// represent.
    std::uint64_t morph_sign_flip_count = 0;
    NormalReport normals = {};
    /// Positions whose computed normals include triangles of other primitives of the mesh (glTF).
    std::uint64_t normals_joined_count = 0;
    /// Corners whose new normal points to the back of their triangle (beyond 90 degrees), on the base mesh.
    std::uint64_t normals_behind_count = 0;
    bool normals_replaced = false;  ///< existing normals were recomputed (Normals::overwrite)
    /// Number of triangles wound opposite to the majority of their connected component (connected over edges that
    /// belong to exactly two triangles). 0 unless normals were computed, or splitting added more than 5 % to the
    /// vertices.
    std::uint64_t turned_triangle_count = 0;
    /// Triangles of two-sided sheets: another triangle with the same positions has the opposite winding. Counted under
    /// the same conditions as turned_triangle_count.
    std::uint64_t two_sided_triangle_count = 0;
    std::uint64_t winding_mended_count = 0;  ///< faces that were flipped (mend_winding)
    /// Ranges of flipped faces, ascending, at most kMostMendedRanges. Faces are triangles of the primitive, numbered
    /// from 0, or, for OBJ, faces of the file.
    std::vector<FaceRange> winding_mended = {};
    TangentReport tangents = {};
    std::uint64_t negative_uv_count = 0;  ///< triangles with negative UV area, for the UVs as stored
    SanitizeReport sanitize = {};
    PackReport packing = {};         ///< frames that were repaired before packing
    Faces faces = Faces::triangles;  ///< faces on which its tangents were computed: triangles or quads
    std::uint64_t quad_count = 0;    ///< number of these faces with four or more corners
};

/// Changes to the winding of one mesh (`mend_winding`), or of a whole OBJ file, whose objects are one surface.
struct MendedWindingReport {
    std::uint32_t mesh = 0;
    std::string mesh_name = {};  ///< name in the file; may be empty
    WindingReport winding = {};
};

/// Result for one image that is a normal map.
struct NormalMapReport {
    std::uint32_t image = 0;  ///< index in the input's images; for OBJ a sequential number
    std::string name = {};    ///< name or URI of the image; may be empty
    bool flipped = false;     ///< its green channel was inverted
    /// true: the image was rewritten, because glTF readers would misinterpret it (Maps::mend), or because it held
    /// heights (OBJ).
    bool mended = false;
    /// Reason why the image was not changed, or contents of the image that was rewritten; a sentence fragment.
    std::string reason = {};
};

/// Result for one normal map as used by some primitives (Maps::convert).
struct ConvertedMapReport {
    std::uint32_t image = 0;                    ///< index in the input's images
    std::string name = {};                      ///< name or URI of the image; may be empty
    bool converted = false;                     ///< true: the primitives got a new image
    std::uint32_t new_image = 0;                ///< index in the output's images, if the map was converted
    std::string reason = {};                    ///< reason, if the map was not converted: a sentence fragment
    std::vector<std::uint32_t> materials = {};  ///< materials of the input that use the map
    std::uint32_t primitive_count = 0;          ///< number of primitives that use the map
    unsigned bits = 0;                          ///< bits per channel, if the map was converted
    std::uint64_t changed = 0;                  ///< texels that changed
    /// Mean angles between the shading of the primitives before and after, at the texels of all their triangles: with
    /// the new map, and with the old map unchanged.
    double mean_error_deg = 0, mean_error_unconverted_deg = 0;
    std::vector<std::string> notes = {};  ///< further remarks, as whole sentences
};

struct GenerateReport {
    std::vector<PrimitiveReport> primitives = {};  ///< one entry per primitive, in file order
    /// normal maps of the model, with flip_green or Maps::mend; also height maps of OBJ files
    std::vector<NormalMapReport> normal_maps = {};
    std::vector<ConvertedMapReport> converted_maps = {};  ///< maps whose primitives got tangents (Maps::convert)
    std::vector<MendedWindingReport> windings = {};       ///< with mend_winding, for each mesh with triangles
    bool changed = false;                                 ///< false: the output is byte-identical to the input
    std::uint64_t input_bytes = 0;                        ///< size of the model file and the files it loads
    std::uint64_t output_bytes = 0;
    std::vector<std::string> input_files = {};   ///< all files that were read, the model first
    std::vector<std::string> output_files = {};  ///< all files that were written, the model first
    std::vector<std::string> warnings = {};
    /// Offset that was subtracted in double precision from coordinates far from the origin (not for glTF), and is the
    /// translation of the output's nodes (FileOptions::keep_coordinates).
    double coordinate_offset[3] = {0, 0, 0};
};

/// Reads `input`, adds or replaces normals and tangents, and writes `output` (.glb or .gltf; may be the same file). All
/// outputs appear at once or not at all: they are written next to the target with a temporary name, then renamed.
/// Errors: cannotRead (the input), invalidFile (also if a buffer file that it refers to cannot be read),
/// unsupportedFile, forbiddenPath, invalidOption, tooLarge, cannotWrite, outOfMemory. On error no file is changed.
Result<GenerateReport> generateFile(const std::string& input, const std::string& output,
                                    const GenerateOptions& options = {});

}  // namespace tspace
