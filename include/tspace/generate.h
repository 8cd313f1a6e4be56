// SPDX-License-Identifier: MIT
// Puts normals and tangents into a model file where its materials need them, and leaves everything else in it untouched.
// CMake target tspace::asset. Reads glTF 2.0 (.glb, .gltf) and Wavefront OBJ, and through the importer FBX, PLY, STL, DAE, 3DS and
// more; writes glTF.
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
    keep = 0,     ///< they stay; only missing ones are added
    replace = 1,  ///< they are computed anew
    repair = 2,   ///< repair what `check` reports as an error, vertex by vertex; keep everything else
};

/// Whether tangents follow the UVs before or after KHR_texture_transform. It matters for a rotation, and for a scale of
/// negative sign; docs/reference/gltf.md says what viewers do.
enum class TextureTransform : std::uint32_t {
    apply = 0,   ///< after it: T points where u grows in the image, as viewers want that use tangents as they are
    ignore = 1,  ///< before it: for viewers that turn tangents by the transform themselves
};

/// How the geometry of a written glTF file is packed.
enum class Compression : std::uint32_t {
    keep = 0,     ///< keep the compression of the input, for new data too; plain data stay plain
    none = 1,     ///< everything is unpacked
    meshopt = 2,  ///< EXT_meshopt_compression for vertices and indices; changes no value
    draco = 3,    ///< KHR_draco_mesh_compression for triangles; rounds positions, normals and UVs new to it
};

/// Attributes that are removed where a primitive has its frames packed.
enum class PackDrop : std::uint32_t {
    nothing = 0,
    tangents = 1,  ///< TANGENT
    all = 2,       ///< TANGENT and NORMAL: only readers of the packed attribute light the primitive as before
};

/// Normal maps whose green channel is inverted.
enum class FlipGreen : std::uint32_t {
    none = 0,
    /// Those whose green points down throughout, as checkFile finds them (greenFlipped). Not where tangents that stay have
    /// inverted signs: the two cancel out.
    down = 1,
    all = 2,  ///< every normal map and clearcoat normal map
};

/// Normal deltas of morph targets that move the surface, for normals that are kept (NORMAL of a target).
enum class MorphNormals : std::uint32_t {
    keep = 0,     ///< existing ones, or none
    missing = 1,  ///< targets without such offsets, or with zeros alone, get some; so do those not finite
    all = 2,      ///< all get new ones
};

/// How generateFile works. The defaults add what glTF needs and change nothing else.
struct GenerateOptions {
    bool all = false;    ///< also primitives whose material needs no tangents
    bool strip = false;  ///< take tangents away where no material needs them; not together with `all` (invalidOption)
    /// Also write the direction of dP/dv (TangentOutput::bitangents) where tangents are computed, as the attribute
    /// _BITANGENT (VEC3, in `format`). It takes part in the split. Morph targets get no deltas of it.
    bool bitangents = false;
    ExistingTangents existing = ExistingTangents::keep;
    TextureTransform texture_transform = TextureTransform::apply;
    TangentOptions tangents{.convention = conventions::gltf};
    /// For primitives without normals. The default is what glTF asks of a client.
    /// Its weld_distance also says which positions are one for winding, and for borders of primitives.
    NormalOptions normals{.weighting = NormalWeighting::flat, .weld_distance = NormalOptions::weld_auto};
    /// OBJ files with `s` lines: missing normals follow those groups with angle weights (faces in group 0 are flat).
    /// false, or a file without `s` lines: `normals` alone decides.
    bool use_smoothing_groups = true;
    /// Mend tangents that are not finite, zero, not unit, parallel to N, or of mixed sign inside a face. false: the file gets
    /// them as the method gives them.
    bool sanitize = true;
    SanitizeOptions sanitize_options = {};  ///< how, with `sanitize`
    /// PNG keeps its bits, JPEG is compressed once more, WebP is written without loss. An image that is something else as
    /// well, such as a base colour, stays, and the normal maps get one of their own; files beside a .gltf stay too, and
    /// the output names new ones.
    FlipGreen flip_green = FlipGreen::none;
    /// Normal maps (PNG, JPEG) that hold something else than glTF reads are written anew as PNG, with the bits that they have:
    /// those with two channels or channels exchanged, with x in alpha, encoded as colours, and in object space, as
    /// checkFile finds them. Together with flip_green the new ones are inverted where they need it.
    bool mend_maps = false;
    /// Triangles that are wound against their neighbours are turned, and parts that are inside out as a whole
    /// (mendWinding), before anything else is done. Primitives of one mesh are one surface, and so is an OBJ file. Normals
    /// that stay say which side is out where they agree among themselves. Only index lists change: attributes and morph
    /// targets keep their places; strips and fans become lists.
    bool mend_winding = false;
    /// Normal maps follow the tangents that are computed: with the new ones they show what they showed with the old. Missing
    /// tangents count as those that viewers make: mikktspace. New maps are PNGs with the bits of the old ones; a map or a
    /// material whose primitives need different ones is copied. glTF only, in its own convention, and neither with
    /// ExistingTangents::repair, TextureTransform::ignore nor flip_green (invalidOption).
    bool convert_maps = false;
    /// Read the pixels of normal maps where ExistingTangents::repair needs them. false: inverted signs stay, since green of the
    /// maps may point down too. Not together with flip_green, mend_maps and convert_maps (invalidOption).
    bool images = true;
    Compression compression = Compression::keep;
    VectorFormat format = VectorFormat::float32;
    /// Also write the whole frame of each vertex in this format, as attributes of its own: _FRAME32 and others, of which
    /// docs/concepts/pack.md has the accessors. Of every primitive that has NORMAL and TANGENT in the end, computed or not, as they
    /// are stored. Morph targets get nothing: packed frames are those of the base.
    std::optional<FrameFormat> pack = {};
    /// Attributes that morph targets add to stay. Without `pack` it must be `nothing` (invalidOption).
    PackDrop pack_drop = PackDrop::nothing;
    FileOptions file = {};
    /// Takes the output, a GLB, in place of a file, once everything is computed; the path of the output is only what it
    /// is called (NAME.glb). Files that the model names beside it are not written. Where it returns false: cannotWrite.
    Sink sink = {};
    bool dry_run = false;  ///< everything but writing; the report says what would be written
    /// Serves the whole file: primitives are computed at the same time. With an allocator one primitive follows the other.
    Execution execution = {};
    Progress progress = {};
    /// What mikktspace is computed on; other methods take triangles. Which pairs are quads is chosen by the file's own
    /// tangents where these show it, else by shape. Polygons of an OBJ file are known: `quads` takes them as they are.
    /// `repair` keeps tangents that are right on either, whatever is asked for here.
    Faces faces = Faces::triangles;
    /// Normals that are made, by any weighting but `flat`, are smooth over the border of two primitives of one mesh that are
    /// one surface: they share edges, by equal positions, as neighbouring triangles do. Where the other primitive has normals
    /// these stay, and new ones take them on at the border where they are within 30 degrees and within the crease angle.
    /// Tangents are computed for each primitive alone, as bakers do it. true: so are normals, and the border is a seam. OBJ:
    /// normals are smooth over the whole file, or, with true, over the faces of one object and material.
    bool normals_per_primitive = false;
    /// Normals that are there are made anew, by `normals`, in every primitive with triangles whose material is not unlit;
    /// those that have none get some too, whether or not they need tangents. Vertices that differ in nothing but what is
    /// computed (normals, tangents, what targets add to them) are one first, and are split where the new normals differ.
    /// Tangents that are there are computed anew with them, also with ExistingTangents::keep, because they would not fit;
    /// where that is impossible (no UVs) the normals stay. With `keep`, signs stay inverted where most were: normal maps may
    /// be made for that. Not together with convert_maps (invalidOption).
    bool overwrite_normals = false;
    /// For normals that stay: where those are made, so is what targets add to them. The base's normal is turned as the
    /// surface around the vertex turns. Offsets of tangents in these targets follow where the tangents are those that would
    /// be computed. glTF only.
    MorphNormals morph_normals = MorphNormals::keep;
};

/// Result for one primitive.
enum class PrimitiveAction : std::uint32_t {
    generated = 0,     ///< tangents were added
    replaced = 1,      ///< tangents were there and were computed anew
    unchanged = 2,     ///< computed anew with the same bits as those in the file
    kept = 3,          ///< tangents were there and stay (not to be replaced, or found good)
    notNeeded = 4,     ///< the material needs no tangents (no `all`)
    notTriangles = 5,  ///< points or lines
    impossible = 6,    ///< no UVs, no positions or nothing to compute; `reason` says which
    removed = 7,       ///< taken away: no material needs them (`strip`), or they could not be read
};
/// Stable lowerCamelCase name, for JSON.
const char* actionName(PrimitiveAction action);

/// Faces that follow one another.
struct FaceRange {
    std::uint64_t first = 0, count = 0;
};

/// The most ranges that a report lists of a primitive; its counts are of all.
inline constexpr std::size_t kMostMendedRanges = 256;

struct PrimitiveReport {
    std::uint32_t mesh = 0;
    std::uint32_t primitive = 0;
    std::string mesh_name = {};      ///< may be empty
    std::string material_name = {};  ///< may be empty
    PrimitiveAction action = PrimitiveAction::notNeeded;
    std::string reason = {};              ///< one sentence for a person: why this action
    std::vector<std::string> notes = {};  ///< further sentences: textures that want other tangents, transforms, repairs
    std::int32_t uv_set = -1;             ///< n of TEXCOORD_n the tangents follow, or -1
    bool normals_generated = false;
    bool bitangents_generated = false;  ///< _BITANGENT was computed
    bool frames_packed = false;         ///< the output has its frames packed (`pack`); if not, a note says why
    bool normals_dropped = false;       ///< NORMAL was taken away (`pack_drop`)
    bool tangents_dropped = false;      ///< TANGENT was
    std::uint64_t triangle_count = 0;
    std::uint64_t vertices_before = 0;
    std::uint64_t vertices_after = 0;
    /// Numbers of vertex lists: primitives with one `source_list` share their vertices in the input, and primitives with one
    /// `split_list` share the vertices that a split added. Sums over primitives count each list once.
    std::uint32_t source_list = 0, split_list = 0;
    std::uint64_t mended_vertex_count = 0;    ///< vertices of vertices_before whose tangents were wrong (`repair`)
    std::uint32_t morph_target_count = 0;     ///< morph targets that the primitive has
    std::uint32_t morph_deltas_computed = 0;  ///< morph targets whose tangent deltas were computed
    std::uint32_t morph_normals_computed =
        0;  ///< morph targets whose normal deltas were computed, for normals that are kept
    /// Corners, over all targets, at which the frame of the moved shape has the other sign, which glTF cannot morph.
    std::uint64_t morph_sign_flip_count = 0;
    NormalReport normals = {};
    /// Positions at which its normals were made with triangles of other primitives of its mesh (glTF).
    std::uint64_t normals_joined_count = 0;
    /// Corners whose new normal points behind their own triangle (beyond 90 degrees), on the base.
    std::uint64_t normals_behind_count = 0;
    bool normals_replaced = false;  ///< there were normals, and they were made anew (overwrite_normals)
    /// Triangles that are wound against most of those that they are connected with, over edges of two triangles. Counted
    /// where normals are made, and where vertices were split; else 0. So is the next one.
    std::uint64_t turned_triangle_count = 0;
    /// Triangles of sheets with two sides: others with the same positions are wound the other way.
    std::uint64_t two_sided_triangle_count = 0;
    std::uint64_t winding_mended_count = 0;  ///< faces that were turned (mend_winding)
    /// Which these are: ascending ranges, the first kMostMendedRanges of them. Triangles of the primitive, numbered from 0;
    /// from OBJ faces, numbered through the file.
    std::vector<FaceRange> winding_mended = {};
    TangentReport tangents = {};
    std::uint64_t negative_uv_count = 0;  ///< triangles with negative UV area, by the numbers in the file
    SanitizeReport sanitize = {};
    PackReport packing = {};         ///< frames that were mended before they were packed
    Faces faces = Faces::triangles;  ///< faces that its tangents were computed on: triangles or quads
    std::uint64_t quad_count = 0;    ///< number of those faces with four corners or more
};

/// Changes to the winding of one mesh (`mend_winding`); of the file for OBJ, whose objects are one surface.
struct MendedWindingReport {
    std::uint32_t mesh = 0;
    std::string mesh_name = {};  ///< may be empty
    WindingReport winding = {};
};

/// Result for one image that is a normal map.
struct NormalMapReport {
    std::uint32_t image = 0;  ///< index in the input's images; for OBJ a running number
    std::string name = {};    ///< name or URI; may be empty
    bool flipped = false;     ///< its green channel was inverted
    /// It was written anew, because it held something else than glTF reads (mend_maps), or, from OBJ, heights.
    bool mended = false;
    std::string reason = {};  ///< why nothing was done, or what it held: half a sentence for a person
};

/// Result for one normal map as used by some primitives (`convert_maps`).
struct ConvertedMapReport {
    std::uint32_t image = 0;                    ///< index in the input's images
    std::string name = {};                      ///< name or URI; may be empty
    bool converted = false;                     ///< they have a new image
    std::uint32_t new_image = 0;                ///< index in the output's images, where it was converted
    std::string reason = {};                    ///< why not: half a sentence for a person
    std::vector<std::uint32_t> materials = {};  ///< materials of the input that use the map
    std::uint32_t primitive_count = 0;          ///< number of primitives that use it
    unsigned bits = 0;                          ///< bits per channel, if it was converted
    std::uint64_t changed = 0;                  ///< texels that changed
    /// Angles between what the primitives show after and before, at the texels of all of their triangles: as it is, and as it
    /// would be with the old map.
    double mean_error_deg = 0, mean_error_unconverted_deg = 0;
    std::vector<std::string> notes = {};  ///< whole sentences
};

struct GenerateReport {
    std::vector<PrimitiveReport> primitives = {};         ///< in file order
    std::vector<NormalMapReport> normal_maps = {};        ///< with flip_green or mend_maps; from OBJ height maps too
    std::vector<ConvertedMapReport> converted_maps = {};  ///< maps whose primitives got tangents (convert_maps)
    std::vector<MendedWindingReport> windings = {};       ///< with mend_winding, of each mesh with triangles
    bool changed = false;                                 ///< false: the output is byte for byte the input
    std::uint64_t input_bytes = 0;                        ///< the model file and what it loads
    std::uint64_t output_bytes = 0;
    std::vector<std::string> input_files = {};   ///< everything that was read, the model first
    std::vector<std::string> output_files = {};  ///< everything that was written, the model first
    std::vector<std::string> warnings = {};
    /// What was taken out of the coordinates of a file far from the origin, in double (not of glTF), and is the translation of
    /// the output's nodes (FileOptions::keep_coordinates).
    double coordinate_offset[3] = {0, 0, 0};
};

/// Reads `input`, adds or replaces normals and tangents, and writes `output` (.glb or .gltf; may be the same file).
/// All outputs appear at once or not at all: they are written beside the target under a temporary name, then renamed.
/// Errors: cannotRead (the input), invalidFile (also when a buffer file that it names cannot be read),
/// unsupportedFile, forbiddenPath, invalidOption, tooLarge, cannotWrite, outOfMemory. On error nothing on disk has
/// changed.
Result<GenerateReport> generateFile(const std::string& input, const std::string& output,
                                    const GenerateOptions& options = {});

}  // namespace tspace
