// SPDX-License-Identifier: MIT
// Checks the frames of a model file: signs, directions, seams, normals, UVs, morph targets, normal maps. CMake target
// tspace::asset. Reads the formats that generate.h reads, and changes nothing. docs/reference/check.md explains every
// code.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tspace/callbacks.h"
#include "tspace/convention.h"
#include "tspace/execution.h"
#include "tspace/file_options.h"
#include "tspace/mesh.h"
#include "tspace/normals.h"
#include "tspace/pack.h"
#include "tspace/result.h"

namespace tspace {

/// Importance of a finding.
enum class Severity : std::uint32_t {
    note = 0,     ///< worth knowing, although the model renders correctly
    warning = 1,  ///< the model renders incorrectly in some renderers, in a small area, or only possibly
    error = 2,    ///< the model certainly renders incorrectly
};
/// Returns "note", "warning" or "error".
const char* severityName(Severity severity);

/// Kind of a finding. Names (findingName) and numbers are stable and never reused.
enum class FindingCode : std::uint32_t {
    positionsNotFinite = 0,
    uvsMissing = 1,  ///< a texture needs tangents along a UV set that the primitive does not have
    uvsNotFinite = 2,
    uvsDegenerate = 3,  ///< triangles without UV area, from which no direction can be computed
    normalsMissing = 4,
    normalsNotFinite = 5,
    normalsNotUnit = 6,         ///< normals that are not of unit length, or have length 0
    normalsAgainstWinding = 7,  ///< normals point to the back side of their triangles
    tangentsMissing = 8,
    tangentsUnused = 9,    ///< tangents that no material needs
    tangentsIgnored = 10,  ///< tangents without normals, which glTF tells readers to ignore
    tangentsNotFinite = 11,
    tangentsNotUnit = 12,          ///< tangents that are not of unit length, or have length 0
    tangentsNotOrthogonal = 13,    ///< tangents are not in the plane of the surface
    signsNotOne = 14,              ///< w is not +1 or -1
    signsMixed = 15,               ///< w differs between the corners of a triangle
    signsInverted = 16,            ///< every sign is opposite to the UV orientation
    signsWrong = 17,               ///< some signs are opposite to the UV orientation
    mirroredSeamAveraged = 18,     ///< one tangent serves both sides of a seam between mirrored and other triangles
    uvSeamAveraged = 19,           ///< one tangent serves both sides of a seam in the UV map
    directionsWrong = 20,          ///< tangents do not point along increasing u
    uvSetWrong = 21,               ///< tangents follow another UV set than the texture
    textureTransformIgnored = 22,  ///< tangents follow the UVs before KHR_texture_transform
    splitFramesDiffer = 23,        ///< vertices that are equal except for their tangents: a seam without a cause
    morphTangentsMissing = 24,
    morphTangentsWrong = 25,
    texturesDisagree = 26,     ///< two textures of one primitive need different frames
    greenFlipped = 27,         ///< a normal map whose green points down (DirectX)
    normalMapUnreadable = 28,  ///< the image could not be read
    fileRemark = 29,           ///< a warning of the file reader: data that were ignored or treated as missing
    greenMixed = 30,           ///< a normal map whose green points down in one part and up in another
    /// An attribute of packed frames does not match the format that its name states (docs/concepts/pack.md).
    packedFramesUnreadable = 31,
    packedFramesDiffer = 32,  ///< packed frames differ from NORMAL and TANGENT
    tangentsUnreadable = 33,  ///< TANGENT has a type or an element count that is invalid for tangents
    /// positions are stored so coarsely that triangles no longer determine the tangent directions
    positionsRounded = 34,
    normalSeam = 35,  ///< two primitives of one smooth surface, each with normals computed from its own triangles only
    normalsFarFromFaces = 36,     ///< normals that differ strongly from all triangles at their vertices
    morphNormalsMissing = 37,     ///< a morph target rotates the surface but not the normals
    morphNormalsWrong = 38,       ///< a morph target rotates normals differently from the surface
    normalMapTwoChannels = 39,    ///< a normal map with x and y only: blue does not contain z
    normalMapUnsigned = 40,       ///< blue is z itself instead of (z + 1) / 2
    normalMapChannels = 41,       ///< x, y and z are in other channels, or inverted: z in red, x in alpha, ...
    normalMapIsSrgb = 42,         ///< the sRGB curve was applied to the vectors, or removed from them
    normalMapInObjectSpace = 43,  ///< the map contains directions in mesh or world coordinates
    normalMapIsHeight = 44,       ///< the image is gray
    normalMapScale = 45,          ///< normalTexture.scale is 0 or below
    normalMapIsPicture = 46,      ///< colors that are not unit vectors
    positionsNoisy = 47,          ///< positions that deviate randomly from any smooth surface, as in scans
    normalMapLossy = 48,          ///< lossy picture compression (ETC1S, lossy WebP), which causes errors of degrees
    normalMapLevels = 49,         ///< a texture without smaller mip levels
    normalMapLengths = 50,        ///< image without a model: vectors that are far from unit length
    normalMapConstant = 51,       ///< image without a model: all texels have the same color
    normalMapZero = 52,           ///< image without a model: flat parts are stored as 127, not 128
    attributeUnreadable = 53,     ///< an attribute other than TANGENT has an invalid type or element count
};
inline constexpr std::uint32_t kFindingCodeCount = 54;

/// Returns the stable lowerCamelCase name of a code: the name of the enumerator.
const char* findingName(FindingCode code);

/// Returns a short description that holds for every finding of the code: "Every sign is inverted."
const char* findingSummary(FindingCode code);

/// Returns the visible effect of a finding, in one or two short sentences: "Bumps are lit from the wrong side."
const char* findingEffect(FindingCode code);

/// Returns the usual fix, in one or two sentences.
const char* findingRemedy(FindingCode code);

struct RemedyOption {
    std::string name = {};   ///< option name without dashes: "overwrite-normals"; "o": output path
    std::string value = {};  ///< value of the option; empty if the option is a flag
};

/// A tspace command that a remedy refers to, in structured form: programs can format it for their users, or run it.
struct RemedyCommand {
    std::string verb = {};                   ///< subcommand: "generate", "convert-map", ...
    std::vector<std::string> inputs = {};    ///< files; empty: the model that was checked
    std::vector<RemedyOption> options = {};  ///< options of the command, in the order of the command line
    /// Placeholders among inputs and values, to be replaced by the user: "OUT.png", "HIGH".
    std::vector<std::string> placeholders = {};
};

/// Returns the command as typed, without the model, and without an output if the command has none: "tspace generate
/// --overwrite-normals --crease 60".
std::string commandLine(const RemedyCommand& command);

struct Finding {
    FindingCode code = FindingCode::positionsNotFinite;
    Severity severity = Severity::note;
    std::string place = {};  ///< JSON pointer (OBJ: "usemtl NAME"); empty: the whole file
    std::uint32_t mesh = 0;
    std::uint32_t primitive = 0;     ///< index of the primitive in its mesh
    std::string mesh_name = {};      ///< name in the file; may be empty
    std::string material_name = {};  ///< name in the file; may be empty
    std::string unit = {};           ///< counted elements: "vertices", "triangles", "blocks" (of an image), ...
    std::uint64_t count = 0;         ///< number of elements with the fault
    std::uint64_t total = 0;         ///< number of elements that were examined
    /// share of the primitive's surface that these elements cover, 0 to 1; 0 if not applicable
    double surface_share = 0;
    double worst_deg = 0;                      ///< largest angle, for findings about angles; otherwise 0
    double confidence = 1;                     ///< 0 to 1; below 1 for findings based on statistics
    std::vector<std::uint32_t> vertices = {};  ///< first affected vertices, at most 8
    /// One sentence: the symptom, a colon and `cause`; only `cause` if the sentence names no symptom.
    std::string message = {};
    std::string cause = {};                    ///< what is wrong with the data, with figures
    std::string remedy = {};                   ///< fix for this finding; usually findingRemedy(code)
    std::vector<RemedyCommand> commands = {};  ///< commands that `remedy` mentions, in the same order
};

/// Tolerances and conventions of a check. Angles are in degrees; all numbers must be finite and not negative.
struct CheckOptions {
    /// Maximum angle of a tangent outside the range of directions that its adjacent triangles span, 0 to 180. All
    /// common averages lie within that range, so the default exceeds the error of every method.
    double direction_deg = 10;
    /// Angle from which a wrong direction is an error, 0 to 180. The default is halfway to a right angle, where T no
    /// longer correlates with u.
    double error_deg = 45;
    /// Maximum tilt of a tangent out of the plane of the surface, 0 to 90. Quantized normals cause up to a degree.
    double orthogonal_deg = 3;
    /// Maximum angle between the tangents of equal vertices, 0 to 180. Storing in 8 bits causes less than the default.
    double split_deg = 2;
    /// Maximum deviation of lengths from 1. The default covers storing in 8 bits, and equals the tolerance of the glTF
    /// validator.
    double unit_tolerance = 0.00674;
    /// Errors become warnings if they affect less than this share of a primitive's surface, 0 to 1.
    double error_share = 0.001;
    /// Sign convention of the data in the file. Default: that of glTF files.
    Convention convention = conventions::gltf;
    /// Check normal maps: PNG, JPEG and WebP (if tspace was built with their decoders), KTX2 and DDS, and TGA (except
    /// in glTF).
    bool images = true;
    /// Images with more pixels are not checked. Default: 8192 x 8192.
    std::uint64_t most_pixels = std::uint64_t{1} << 26;
    FileOptions file = {};
    /// Primitives are checked in parallel. An allocator is not used.
    Execution execution = {};
    /// Faces whose tangents are the reference. automatic: triangles, or quads if the tangents clearly fit quads better;
    /// quads: pairs of triangles that look like a quad. Blender computes tangents on quads.
    Faces faces = Faces::automatic;
    /// Weld distance of positions for winding, borders of primitives and noise. Same meaning as
    /// NormalOptions::weld_distance.
    float weld_distance = NormalOptions::weld_auto;
    /// Called on the calling thread: for each primitive if it is the only thread, otherwise before and after all work.
    Progress progress = {};
};

/// Packed frames (GenerateOptions::Storage::pack) of a primitive, compared with its NORMAL and TANGENT.
struct PackedFramesInfo {
    std::string place = {};      ///< JSON pointer of the attribute
    std::string attribute = {};  ///< "_FRAME32"; the first one if two attributes hold one frame
    FrameFormat format = FrameFormat::frame32;
    std::uint32_t mesh = 0;
    std::uint32_t primitive = 0;  ///< index of the primitive in its mesh
    std::uint64_t vertex_count = 0;
    bool is_readable = false;  ///< false: the data are invalid, and a finding states the reason
    /// true: NORMAL and TANGENT exist, and the following values cover all vertices. They are compared after the repairs
    /// that packing applies: unit length, right angles, and replacement of invalid vectors.
    bool is_compared = false;
    double worst_normal_deg = 0;
    double worst_tangent_deg = 0;
    std::uint64_t differing_sign_count = 0;
};

/// Result of checking an image without a model.
struct CheckedImage {
    std::uint32_t width = 0, height = 0;
    /// "normals" (in tangent space, as in glTF), "twoChannels", "unsignedZ", "xInAlpha", "exchanged", "encoded" (sRGB),
    /// "hemiOctahedral", "objectSpace", "height", "picture" or "constant".
    std::string content = {};
    /// Direction of green (or of the channel with y), assuming that x is correct: "up" (OpenGL, glTF), "down"
    /// (DirectX), "mixed", or "unknown". A map with x and y both inverted shows the same surface with dents instead of
    /// bumps; images alone cannot distinguish the two.
    std::string green = {};
    double green_confidence = 0;  ///< confidence in `green`, 0 to 1
};

struct CheckReport {
    /// Format of the file, as in Inspection::format; for an image "png", "jpeg", "webp", "exr", "ktx2", "dds" or "tga".
    std::string format = {};
    std::string generator = {};          ///< the program that wrote the file; may be empty
    std::vector<Finding> findings = {};  ///< errors first, then in file order, then by code
    std::uint64_t error_count = 0;
    std::uint64_t warning_count = 0;
    std::uint64_t note_count = 0;
    std::uint64_t primitive_count = 0;  ///< primitives in the file
    std::uint64_t tangents_count = 0;   ///< primitives whose tangents were examined
    std::uint64_t image_count = 0;      ///< normal maps whose channels were examined
    std::uint64_t green_count = 0;      ///< examined normal maps whose relief shows the direction of green
    std::vector<PackedFramesInfo> packed_frames = {};  ///< packed frame attributes, in file order
    std::optional<CheckedImage> image = {};            ///< result for an image that was checked without a model
};

/// Reads a model and reports faults of its frames; or reads an image (recognized by its extension, or by the first
/// bytes of file.content) and reports its faults as a normal map, with the same tests but without a mesh. Near-linear
/// in the size of the model. Memory: the model as floats, and about 150 bytes per triangle of the primitives in
/// progress. Thread-safe; the report does not depend on the number of threads. Errors: those of generateFile, and
/// invalidOption (an angle or share that is negative or not finite).
Result<CheckReport> checkFile(const std::string& input, const CheckOptions& options = {});

}  // namespace tspace
