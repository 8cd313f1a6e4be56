// SPDX-License-Identifier: MIT
// Model files: read one, put normals and tangents where its materials need them, write it with everything else in
// it untouched. CMake target tspace::asset. Reads glTF 2.0 (.glb, .gltf) and Wavefront OBJ, and through the importer
// FBX, PLY, STL, DAE, 3DS and more; writes glTF.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tspace/callbacks.h"
#include "tspace/execution.h"
#include "tspace/normals.h"
#include "tspace/pack.h"
#include "tspace/result.h"
#include "tspace/sanitize.h"
#include "tspace/tangents.h"
#include "tspace/winding.h"

namespace tspace {

inline constexpr std::uint64_t kNoMemoryLimit = ~std::uint64_t{0};

/// Gives the bytes of a file that a model in memory names. `path` is relative to the model: escapes of the URI decoded, with
/// slashes. The bytes must stay as they are until the call that asks is over. cannotRead: there is no such file; any other
/// error ends the call. Called from the thread of the call, and perhaps more than once for a file.
using FindFile = std::function<Result<std::span<const std::uint8_t>>(const std::string& path)>;

/// How files are opened.
struct FileOptions {
    /// URIs in a model may lead only to files in its own folder (and below). true: anywhere.
    bool allow_external = false;
    /// Path of tspace-import, the program that reads .fbx, .ply, .stl, .dae, .3ds and others; empty: such files are
    /// refused. It runs as a process of its own, so that a crash or a runaway there is an error here (invalidFile).
    std::string importer = {};
    /// Files of more bytes are not given to the importer. The default is 2 GiB.
    std::uint64_t import_max_file_bytes = std::uint64_t{2} << 30;
    /// Address space of the importer, in bytes; a file gets 192 MiB and 256 times its size at most.
    std::uint64_t import_max_memory_bytes = std::uint64_t{16} << 30;
    /// What the importer may take of processor time, and on the clock. 0: by the size of the file, 2 s and one more for
    /// each MiB of it, and twice that on the clock.
    std::uint32_t import_max_seconds = 0;
    /// What working on one file may take of memory, about; what it would take is estimated first, and more is
    /// refused (tooLarge). 0: 64 MB, and 16 times the bytes of the file, of those it names, and of what its
    /// compressed geometry unpacks to. Other values stand for that, and for import_max_memory_bytes;
    /// kNoMemoryLimit: as much as there is.
    std::uint64_t memory_limit_bytes = 0;
    /// The model itself, where it is not in a file: GLB, glTF, or OBJ where the path, which is only what it is called,
    /// ends in .obj. Read during the call only. It has no folder: files that it names come from `find_file`.
    std::span<const std::uint8_t> content = {};
    /// Gives the files that `content` names; only those in the model's own folder (and below), unless `allow_external`.
    /// Without it they are an error (invalidFile) where they are needed.
    FindFile find_file = {};
    /// Told the path of each file that is read, at once, and of each image on the disk that a glTF names, read or not. Perhaps
    /// called by several threads at one time.
    std::function<void(const std::string& path)> opened = {};
    /// Told of the images that a glTF names, in the place of `opened`, where it is there: they need not be read.
    std::function<void(const std::string& path)> named = {};
    /// A written file is on the disk, and not in its cache alone, before it takes its name: after a power cut the old file is
    /// there or the new one, and never half of one. false: for many small files, where that takes most of the time.
    bool sync = true;
    /// OBJ, PLY and STL: coordinates so far from the origin (metres of a map) that 32-bit floats would not hold the shape are
    /// read in double, and an offset is taken out of them before they become floats. In glTF it is the translation of the
    /// nodes. true: no offset; the shape then loses what floats lose, and a warning says so.
    bool keep_coordinates = false;
};

/// What becomes of tangents that are there and needed.
enum class ExistingTangents : std::uint32_t {
    keep = 0,     ///< they stay; only missing ones are added
    replace = 1,  ///< they are computed anew
    repair = 2,   ///< what `check` calls an error is mended, vertex by vertex; everything else stays
};

/// Whether tangents follow the UVs before or after KHR_texture_transform. It matters for a rotation, and for a scale of
/// negative sign; docs/reference/gltf.md says what viewers do.
enum class TextureTransform : std::uint32_t {
    apply = 0,   ///< after it: T points where u grows in the image, as viewers want that use tangents as they are
    ignore = 1,  ///< before it: for viewers that turn tangents by the transform themselves
};

/// The faces that tangents are computed on. glTF has only triangles, but Blender and many bakers compute MikkTSpace on
/// the quads that these were cut from, along another diagonal in part; docs/concepts/quads.md has the whole story.
enum class Faces : std::uint32_t {
    triangles = 0,  ///< the triangles of the file
    quads = 1,      ///< two triangles that follow each other and share an edge are a quad, as far as they look like it
    /// Quads where the file's own tangents show it, or where it has none and Blender wrote it; else triangles.
    automatic = 2,
};
/// "triangles", "quads" or "auto".
const char* facesName(Faces faces);

/// How the geometry of a written glTF file is packed.
enum class Compression : std::uint32_t {
    keep = 0,     ///< what came in compressed goes out compressed the same way, new data in it; the rest stays plain
    none = 1,     ///< everything is unpacked
    meshopt = 2,  ///< EXT_meshopt_compression for vertices and indices; changes no value
    draco = 3,    ///< KHR_draco_mesh_compression for triangles; rounds positions, normals and UVs new to it
};

/// The numbers of written tangents and generated normals.
enum class VectorFormat : std::uint32_t {
    float32 = 0,  ///< the bits that the method gives
    snorm16 = 1,  ///< half the size; KHR_mesh_quantization is declared
    snorm8 = 2,   ///< a quarter; the same
};

/// "frame32", "snorm8_pair": the name that options and reports have; "" when `format` is none of the enumerators.
const char* frameFormatName(FrameFormat format);

/// What of NORMAL and TANGENT goes where a primitive has its frames packed.
enum class PackDrop : std::uint32_t {
    nothing = 0,
    tangents = 1,  ///< TANGENT
    all = 2,       ///< TANGENT and NORMAL: only readers of the packed attribute light the primitive as before
};

/// Which normal maps get their green channel inverted.
enum class FlipGreen : std::uint32_t {
    none = 0,
    /// Those whose green points down throughout, as checkFile finds them (greenFlipped). Not where tangents that stay have
    /// inverted signs: the two cancel out.
    down = 1,
    all = 2,  ///< every normal map and clearcoat normal map
};

/// What morph targets that move the surface get to add to normals that stay (NORMAL of a target).
enum class MorphNormals : std::uint32_t {
    keep = 0,     ///< what they have, or nothing
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

/// What was done to one primitive.
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
    std::uint64_t mended_vertex_count = 0;     ///< of vertices_before: those whose tangents were wrong (`repair`)
    std::uint32_t morph_target_count = 0;      ///< morph targets that the primitive has
    std::uint32_t morph_deltas_computed = 0;   ///< those whose tangent deltas were computed
    std::uint32_t morph_normals_computed = 0;  ///< those whose normal deltas were, for normals that stay
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
    Faces faces = Faces::triangles;  ///< what its tangents were computed on: triangles or quads
    std::uint64_t quad_count = 0;    ///< of those, the ones with four corners or more
};

/// What was done to the winding of one mesh (`mend_winding`); of OBJ, whose objects are one surface, of the file.
struct MendedWindingReport {
    std::uint32_t mesh = 0;
    std::string mesh_name = {};  ///< may be empty
    WindingReport winding = {};
};

/// What became of one image that is a normal map.
struct NormalMapReport {
    std::uint32_t image = 0;  ///< index in the input's images; for OBJ a running number
    std::string name = {};    ///< name or URI; may be empty
    bool flipped = false;     ///< its green channel was inverted
    /// It was written anew, because it held something else than glTF reads (mend_maps), or, from OBJ, heights.
    bool mended = false;
    std::string reason = {};  ///< why nothing was done, or what it held: half a sentence for a person
};

/// What became of one normal map as some primitives show it (`convert_maps`).
struct ConvertedMapReport {
    std::uint32_t image = 0;                    ///< index in the input's images
    std::string name = {};                      ///< name or URI; may be empty
    bool converted = false;                     ///< they have a new image
    std::uint32_t new_image = 0;                ///< index in the output's images, where it was converted
    std::string reason = {};                    ///< why not: half a sentence for a person
    std::vector<std::uint32_t> materials = {};  ///< of the input, which show the map
    std::uint32_t primitive_count = 0;          ///< that show it
    unsigned bits = 0;                          ///< of a channel, where it was converted
    std::uint64_t changed = 0;                  ///< texels that changed
    /// Angles between what the primitives show after and before, at the texels of all of their triangles: as it is, and as it
    /// would be with the old map.
    double mean_error_deg = 0, mean_error_unconverted_deg = 0;
    std::vector<std::string> notes = {};  ///< whole sentences
};

struct GenerateReport {
    std::vector<PrimitiveReport> primitives = {};         ///< in file order
    std::vector<NormalMapReport> normal_maps = {};        ///< with flip_green or mend_maps; from OBJ height maps too
    std::vector<ConvertedMapReport> converted_maps = {};  ///< of maps whose primitives got tangents (convert_maps)
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

/// One texture or parameter of a material that is shaded in tangent space.
struct TangentUseInfo {
    std::string needed_by = {};  ///< "normalTexture", "clearcoatNormalTexture" or "anisotropy"
    std::string place = {};      ///< JSON pointer of the texture reference or extension; empty for OBJ
    std::uint32_t material = 0;
    std::string material_name = {};  ///< may be empty
    bool only_in_variant = false;    ///< not the primitive's own material, but one of KHR_materials_variants
    std::int32_t uv_set = 0;         ///< n of TEXCOORD_n
    double uv_offset[2] = {0, 0};    ///< KHR_texture_transform
    double uv_rotation_rad = 0;
    double uv_scale[2] = {1, 1};
    bool follows_first = true;  ///< tangents made for the first use of the primitive fit this one too
};

/// What is in one primitive, as a person would want to know it before generating.
struct PrimitiveInfo {
    std::uint32_t mesh = 0;
    std::uint32_t primitive = 0;
    std::string mesh_name = {};
    std::string material_name = {};
    std::string mode = {};  ///< "triangles", "triangle strip", "points", ...
    std::uint64_t triangle_count = 0;
    std::uint64_t vertex_count = 0;
    std::uint32_t vertex_list = 0;             ///< the same number for primitives that share their vertices
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
    std::uint32_t mirrored_island_count = 0;  ///< those of which most of the area is mirrored
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
    double coordinate_offset[3] = {0, 0, 0};     ///< as in GenerateReport: what generate would take out
};

/// Removes the temporary files that killed runs of any call that writes left in a folder, and below it where that is asked
/// for. Their names tell which process on which machine made them; only those of processes of this machine that are gone are
/// removed. A file that such a run had set aside comes back where its place is empty. Returns how many files it was. What
/// cannot be read or removed is passed over. Linear in the number of files there; thread-safe.
std::uint64_t removeAbandonedFiles(const std::string& folder, bool with_folders_below = true);

/// Reads a model and says what is in it. Changes nothing. Errors as generateFile.
Result<Inspection> inspectFile(const std::string& input, const FileOptions& options = {});

}  // namespace tspace
