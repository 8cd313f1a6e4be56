// SPDX-License-Identifier: MIT
// What is wrong with the frames of a model file: signs, directions, seams, normals, UVs, morph targets, normal maps.
// CMake target tspace::asset. Reads what generate.h reads, and changes nothing. docs/reference/check.md explains every code.
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
    note = 0,     ///< worth knowing; it renders as it should
    warning = 1,  ///< it renders wrong in some renderers, in a small part, or only perhaps
    error = 2,    ///< it surely renders wrong
};
/// "note", "warning" or "error".
const char* severityName(Severity severity);

/// Kind of a finding. Names (findingName) and numbers are stable and never reused.
enum class FindingCode : std::uint32_t {
    positionsNotFinite = 0,
    uvsMissing = 1,  ///< a texture needs tangents along a UV set that the primitive does not have
    uvsNotFinite = 2,
    uvsDegenerate = 3,  ///< triangles without UV area: no direction can be had from them
    normalsMissing = 4,
    normalsNotFinite = 5,
    normalsNotUnit = 6,         ///< also those of length 0
    normalsAgainstWinding = 7,  ///< they point to the back of their triangles
    tangentsMissing = 8,
    tangentsUnused = 9,    ///< no material asks for them
    tangentsIgnored = 10,  ///< tangents without normals, which glTF tells readers to ignore
    tangentsNotFinite = 11,
    tangentsNotUnit = 12,          ///< also those of length 0
    tangentsNotOrthogonal = 13,    ///< they lean out of the plane of the surface
    signsNotOne = 14,              ///< w is not +1 or -1
    signsMixed = 15,               ///< w differs between the corners of a triangle
    signsInverted = 16,            ///< every sign is the opposite of what the UVs say
    signsWrong = 17,               ///< some signs are
    mirroredSeamAveraged = 18,     ///< one tangent serves both sides of a seam between mirrored and other triangles
    uvSeamAveraged = 19,           ///< one tangent serves both sides of a seam in the UV map
    directionsWrong = 20,          ///< tangents do not point where u grows
    uvSetWrong = 21,               ///< tangents follow another UV set than the texture
    textureTransformIgnored = 22,  ///< tangents follow the UVs before KHR_texture_transform
    splitFramesDiffer = 23,        ///< vertices that are equal but for their tangents: a seam without a cause
    morphTangentsMissing = 24,
    morphTangentsWrong = 25,
    texturesDisagree = 26,     ///< two textures of one primitive need different frames
    greenFlipped = 27,         ///< a normal map whose green points down (DirectX)
    normalMapUnreadable = 28,  ///< the image could not be looked at
    fileRemark = 29,           ///< a warning of the reader: data that were ignored, or treated as missing
    greenMixed = 30,           ///< a normal map whose green points down in one part and up in another
    /// An attribute of packed frames is not what its name promises (docs/concepts/pack.md).
    packedFramesUnreadable = 31,
    packedFramesDiffer = 32,      ///< packed frames are not those of NORMAL and TANGENT
    tangentsUnreadable = 33,      ///< TANGENT has a type or a number of elements that tangents cannot have
    positionsRounded = 34,        ///< positions are stored so coarsely that triangles do not say where tangents point
    normalSeam = 35,              ///< two primitives of one smooth surface, each with the normals of its own triangles
    normalsFarFromFaces = 36,     ///< normals that differ much from all triangles at their vertices
    morphNormalsMissing = 37,     ///< a morph target turns the surface and leaves the normals behind
    morphNormalsWrong = 38,       ///< a morph target turns normals in another way than the surface
    normalMapTwoChannels = 39,    ///< a normal map with x and y alone: blue says nothing of z
    normalMapUnsigned = 40,       ///< blue is z itself, and not (z + 1) / 2
    normalMapChannels = 41,       ///< x, y and z are in other channels, or inverted: z in red, x in alpha, ...
    normalMapIsSrgb = 42,         ///< the sRGB curve was put on the vectors, or taken off
    normalMapInObjectSpace = 43,  ///< directions in the coordinates of the mesh, or of the scene
    normalMapIsHeight = 44,       ///< the image is grey
    normalMapScale = 45,          ///< normalTexture.scale is 0 or below
    normalMapIsPicture = 46,      ///< colors, which are no unit vectors
    positionsNoisy = 47,          ///< positions that lie beside any smooth surface at random, as those of scans do
    normalMapLossy = 48,          ///< packed as pictures are (ETC1S, WebP with loss), which costs vectors degrees
    normalMapLevels = 49,         ///< a texture without smaller levels
    normalMapLengths = 50,        ///< an image alone: vectors that are far from unit length
    normalMapConstant = 51,       ///< an image alone: all texels are one color
    normalMapZero = 52,           ///< an image alone: flat parts are stored as 127, not 128
    attributeUnreadable = 53,     ///< an attribute but TANGENT has a type or a number of elements that it cannot have
};
inline constexpr std::uint32_t kFindingCodeCount = 54;

/// Stable lowerCamelCase name: the name of the enumerator.
const char* findingName(FindingCode code);

/// Short description that holds for every finding of the code: "Every sign is inverted."
const char* findingSummary(FindingCode code);

/// What a person sees where it is so, in one or two short sentences: "Bumps are lit from the wrong side."
const char* findingEffect(FindingCode code);

/// How it is usually mended: one or two sentences.
const char* findingRemedy(FindingCode code);

struct RemedyOption {
    std::string name = {};  ///< as on the command line, without dashes: "overwrite-normals"; "o": where the result goes
    std::string value = {};  ///< empty: a flag
};

/// A command of tspace that a remedy names. Programs spell it as their users write it, or run it.
struct RemedyCommand {
    std::string verb = {};                   ///< "generate", "convert-map", ...
    std::vector<std::string> inputs = {};    ///< files; empty: the model that was checked
    std::vector<RemedyOption> options = {};  ///< in the order of the command line
    std::vector<std::string> placeholders =
        {};  ///< words among inputs and values that the user replaces: "OUT.png", "HIGH"
};

/// The command as it is typed, without the model and without an output where the command has none:
/// "tspace generate --overwrite-normals --crease 60".
std::string commandLine(const RemedyCommand& command);

struct Finding {
    FindingCode code = FindingCode::positionsNotFinite;
    Severity severity = Severity::note;
    std::string place = {};  ///< JSON pointer (OBJ: "usemtl NAME"); empty: the whole file
    std::uint32_t mesh = 0;
    std::uint32_t primitive = 0;     ///< in its mesh
    std::string mesh_name = {};      ///< may be empty
    std::string material_name = {};  ///< may be empty
    std::string unit = {};           ///< what is counted: "vertices", "triangles", "blocks" (of an image), ...
    std::uint64_t count = 0;         ///< number of elements with the fault
    std::uint64_t total = 0;         ///< number of candidates
    double surface_share = 0;        ///< their part of the primitive's surface, 0 to 1; 0 where that says nothing
    double worst_deg = 0;            ///< the largest angle, for findings about angles; else 0
    double confidence = 1;           ///< 0 to 1; below 1 for findings that rest on statistics
    std::vector<std::uint32_t> vertices = {};  ///< the first of them, at most 8
    std::string message = {};                  ///< one plain sentence
    std::string remedy = {};                   ///< how to mend it here; usually findingRemedy(code)
    std::vector<RemedyCommand> commands = {};  ///< the commands that `remedy` spells as command lines, in its order
};

/// Tolerances and conventions of a check. Angles are in degrees; no number may be negative or not finite.
struct CheckOptions {
    /// Maximum angle of a tangent outside the range of directions that its adjacent triangles span, 0 to 180. All common
    /// averages lie within that range, so the default exceeds the error of every method.
    double direction_deg = 10;
    /// From here on a direction is so wrong that it is an error, 0 to 180. The default is halfway to a right angle, where T
    /// says nothing of u.
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
    /// Sign convention of the data in the file. The default is that of glTF files.
    Convention convention = conventions::gltf;
    /// Look at normal maps (PNG, JPEG and WebP, where tspace was built with their decoders; KTX2 and DDS; TGA, but not in glTF).
    bool images = true;
    /// Images of more pixels are not looked at. The default is 8192 x 8192.
    std::uint64_t most_pixels = std::uint64_t{1} << 26;
    FileOptions file = {};
    /// Primitives are checked at the same time. An allocator is not used.
    Execution execution = {};
    /// Faces that tangents are compared with. automatic: triangles, or quads where the tangents clearly fit those better;
    /// quads: pairs of triangles that look like one. Blender computes tangents on quads.
    Faces faces = Faces::automatic;
    /// Positions within this distance are one for winding, borders of primitives and noise: as NormalOptions has it.
    float weld_distance = NormalOptions::weld_auto;
    /// Called by the thread of the call: for each primitive where that is the only thread, else before and after all.
    Progress progress = {};
};

/// An attribute of packed frames (GenerateOptions::pack), read back and compared with NORMAL and TANGENT beside it.
struct PackedFramesInfo {
    std::string place = {};      ///< JSON pointer of the attribute
    std::string attribute = {};  ///< "_FRAME32"; of two that hold one frame the first
    FrameFormat format = FrameFormat::frame32;
    std::uint32_t mesh = 0;
    std::uint32_t primitive = 0;  ///< in its mesh
    std::uint64_t vertex_count = 0;
    bool is_readable = false;  ///< if not, a finding says why
    /// NORMAL and TANGENT are there, and what follows is about all vertices. They are taken as packing takes them: unit,
    /// at right angles, and mended where they are broken.
    bool is_compared = false;
    double worst_normal_deg = 0;
    double worst_tangent_deg = 0;
    std::uint64_t differing_sign_count = 0;
};

/// The result of checking an image without a model.
struct CheckedImage {
    std::uint32_t width = 0, height = 0;
    /// "normals" (in tangent space, as glTF reads them), "twoChannels", "unsignedZ", "xInAlpha", "exchanged", "encoded" (sRGB),
    /// "hemiOctahedral", "objectSpace", "height", "picture" or "constant".
    std::string content = {};
    /// Direction of green, or of y where that is in another channel, if x is right: "up" (OpenGL, glTF), "down" (DirectX), "mixed", or
    /// "unknown". A map with x and y inverted has the slopes of the same surface with dents for bumps, so no image tells these apart.
    std::string green = {};
    double green_confidence = 0;  ///< 0 to 1
};

struct CheckReport {
    std::string format =
        {};  ///< as Inspection::format; of an image "png", "jpeg", "webp", "exr", "ktx2", "dds" or "tga"
    std::string generator = {};          ///< the program that wrote the file; may be empty
    std::vector<Finding> findings = {};  ///< errors first; among equals in file order, then by code
    std::uint64_t error_count = 0;
    std::uint64_t warning_count = 0;
    std::uint64_t note_count = 0;
    std::uint64_t primitive_count = 0;  ///< in the file
    std::uint64_t tangents_count = 0;   ///< primitives of those whose tangents were examined
    std::uint64_t image_count = 0;      ///< normal maps that were looked at: what their channels hold
    std::uint64_t green_count = 0;      ///< normal maps of these whose relief shows the direction of green
    std::vector<PackedFramesInfo> packed_frames = {};  ///< in file order
    std::optional<CheckedImage> image = {};            ///< content of an image that was checked alone
};

/// Reads a model and says what is wrong with its frames; or an image (by its extension, or by the first bytes of file.content), and
/// says what is wrong with it as a normal map: by the same tests as those of a model, without the mesh. Near-linear in the size of the model. Memory: the model as
/// floats, and about 150 bytes per triangle of the primitives at work. Thread-safe; the report does not depend on the
/// number of threads. Errors as generateFile; also invalidOption (an angle or share that is negative or not finite).
Result<CheckReport> checkFile(const std::string& input, const CheckOptions& options = {});

}  // namespace tspace
