// SPDX-License-Identifier: MIT
// Everything that depends only on the code of a finding: one row of a table per code.
#include <array>
#include <utility>

#include "commands/check/findings.h"
#include "commands/check/remedy.h"

namespace tspace {
namespace {

constexpr std::size_t kMaxCommands = 3;

struct CodeTexts {
    const char* name;
    const char* view;  ///< value of `tspace render --show` that makes the finding visible; empty if there is none
    const char* summary;
    const char* effect;  ///< symptom that a user sees in a picture
    const char* remedy;  ///< text in which each "{}" is replaced by the next command
    std::array<const char*, kMaxCommands> commands = {};
};

/// Rows are in the order of FindingCode.
constexpr std::array<CodeTexts, kFindingCodeCount> kCodes{{
    {"positionsNotFinite", "", "Positions are not finite.", "Parts of the mesh are missing, or stretched to infinity.",
     "Find the tool that wrote NaN or infinity as a position, and export the mesh again."},
    {"uvsMissing", "uv", "A texture uses a UV set that does not exist.",
     "The texture is missing, or shows one flat color.",
     "Unwrap the mesh, or make the texture use an existing UV set."},
    {"uvsNotFinite", "uv", "UVs are not finite.", "The texture is smeared or missing on some triangles.",
     "Find the tool that wrote NaN or infinity as a UV, and export the mesh again."},
    {"uvsDegenerate", "uv", "Triangles have no UV area.",
     "Some triangles show one stretched texel, so they have no bumps.",
     "Unwrap those triangles so that they cover an area of the texture. If they intentionally show a single color, "
     "keep them: any tangent in the plane of the surface is valid there."},
    {"normalsMissing", "normals", "A primitive has no normals.", "The surface looks faceted.",
     "No action is needed if flat shading is intended; otherwise export the mesh with normals."},
    {"normalsNotFinite",
     "normals",
     "Normals are not finite.",
     "Black or missing pixels.",
     "Export the normals again; or compute new ones, and tangents that fit them: {}.",
     {"generate --overwrite-normals"}},
    {"normalsNotUnit",
     "normals",
     "Normals do not have unit length.",
     "Shading and bumps are too strong or too weak in some viewers.",
     "Normalize the normals: {}. Their directions do not change, so correct tangents are kept; tangents with reported "
     "errors are repaired.",
     {"generate --repair"}},
    {"normalsAgainstWinding", "normals", "Normals point to the back of their triangles.",
     "Parts of the surface are lit as if the light came from behind them.",
     "Reverse either the normals or the winding (recalculate outside), whichever is wrong; then recompute the "
     "tangents."},
    {"tangentsMissing",
     "lit",
     "A material needs tangents, but the primitive has none.",
     "Bumps may look different in every viewer, with seams where its tangents differ from those of the bake.",
     "Run {}. Without tangents in the file each renderer computes its own, which may differ from those of the bake.",
     {"generate"}},
    {"tangentsUnused",
     "",
     "No material needs the tangents.",
     "Nothing is visible: the file is only larger than necessary.",
     "Remove the tangents to make the file smaller: {}. Or give the material the normal map that is missing.",
     {"generate --strip"}},
    {"tangentsIgnored",
     "lit",
     "A primitive has tangents but no normals.",
     "Bumps look as if the file had no tangents.",
     "Run {}, which adds normals too; or export the mesh with normals.",
     {"generate"}},
    {"tangentsNotFinite",
     "error",
     "Tangents are not finite.",
     "Pixels in the bumps are black or missing.",
     "Recompute those tangents: {}.",
     {"generate --repair"}},
    {"tangentsNotUnit",
     "error",
     "Tangents do not have unit length.",
     "Bumps are too strong or too weak along one direction.",
     "Normalize the tangents, and recompute those of length 0: {}.",
     {"generate --repair"}},
    {"tangentsNotOrthogonal",
     "error",
     "Tangents are not perpendicular to the normals.",
     "Bumps look too flat, or are lit from a slightly wrong direction.",
     "Make those tangents perpendicular to the normals of the file: {}.",
     {"generate --repair"}},
    {"signsNotOne",
     "sign",
     "Signs are neither +1 nor -1.",
     "Bumps are too weak along one direction, or missing.",
     "Store +1 or -1 in w: {}.",
     {"generate --repair"}},
    {"signsMixed",
     "sign",
     "Signs differ between the corners of a triangle.",
     "Bumps flatten to a streak along the mirror line.",
     "Split the vertices where mirrored and unmirrored triangles meet: {}.",
     {"generate --repair"}},
    {"signsInverted",
     "sign",
     "Every sign is inverted.",
     "Bumps look like dents along one direction, on the whole model.",
     "Negate the sign (w) of every tangent: {}. The exporter passed the top-down v of glTF to MikkTSpace, which "
     "expects v to point up, and did not negate the resulting sign.",
     {"generate --repair"}},
    {"signsWrong",
     "sign",
     "Some signs are inverted.",
     "Bumps look like dents on a part of the model, usually the mirrored half.",
     "Negate the sign (w) of those tangents: {}.",
     {"generate --repair"}},
    {"mirroredSeamAveraged",
     "sign",
     "Both sides of a mirrored seam share one tangent.",
     "A dark seam runs along the mirror line.",
     "Split the vertices along the seam, so that each side has its own tangent: {}.",
     {"generate --repair"}},
    {"uvSeamAveraged",
     "error",
     "Both sides of a UV seam share one averaged tangent.",
     "The lighting has seams along the borders of UV islands.",
     "Average tangents only over vertices that also have equal UVs: {}.",
     {"generate --repair"}},
    {"directionsWrong",
     "error",
     "Tangents do not point along increasing u.",
     "Bumps are lit from the wrong side.",
     "Recompute those tangents: {}.",
     {"generate --repair"}},
    {"uvSetWrong",
     "error",
     "Tangents follow another UV set than the texture.",
     "Bumps are lit from the wrong side, as if the normal map were rotated.",
     "Recompute the tangents for the UV set of the texture: {}.",
     {"generate --repair"}},
    {"textureTransformIgnored",
     "error",
     "Tangents follow the UVs before the texture transform.",
     "Bumps are lit from the wrong side in viewers that use the stored tangents.",
     "Apply the transform to the UVs and remove it from the texture, which works in every reader; or recompute the "
     "tangents: {}.",
     {"generate --overwrite"}},
    {"splitFramesDiffer",
     "error",
     "Equal vertices have different tangents.",
     "The lighting has edges where the surface is smooth.",
     "Weld equal vertices before tangents are computed: {}.",
     {"generate --overwrite"}},
    {"morphTangentsMissing",
     "",
     "Morph targets lack tangent deltas.",
     "Bumps are lit from the wrong side while the shape morphs.",
     "Write tangent deltas for morph targets too: {}.",
     {"generate --overwrite"}},
    {"morphTangentsWrong",
     "",
     "Tangent deltas of morph targets are wrong.",
     "Bumps are lit from the wrong side while the shape morphs.",
     "Compute the tangents of the base mesh and of all targets together: {}.",
     {"generate --repair"}},
    {"texturesDisagree", "", "Two textures need different tangents.",
     "The bumps of one of the textures are lit from the wrong side.",
     "Use the same UV set, rotation and mirroring for both textures; a vertex can have only one tangent."},
    {"greenFlipped",
     "mapped",
     "Green points down in a normal map.",
     "Bumps look like dents: they are lit from below instead of from above.",
     "If the map was made for DirectX, invert its green channel: {}. If bumps look like dents afterwards, red was "
     "inverted: {}. The map alone does not show which of the two cases it is, but a comparison with the high poly "
     "does: {}.",
     {"generate --flip-green", "convert-map MAP -o OUT.png --flip-red", "map-error MAP MODEL --high HIGH"}},
    {"normalMapUnreadable", "", "A normal map could not be examined.", "Unknown: the normal map could not be examined.",
     "Convert the image to PNG, JPEG or WebP so that check can examine it."},
    {"fileRemark", "", "Some data of the file was ignored.", "Unknown: a part of the file was ignored.",
     "Repair the file if you need the ignored data. The rest of this report covers the data that could be read."},
    {"greenMixed",
     "mapped",
     "Green points down in one part of a normal map and up in another.",
     "Bumps look like dents in one part of the texture.",
     "Bake the map again with one green direction ({}); or invert green in an image editor only where it points down. "
     "Inverting the whole map would break the other part.",
     {"bake MODEL --high HIGH -o MAP.png"}},
    {"packedFramesUnreadable",
     "",
     "Packed frames cannot be read.",
     "Programs that use the packed frames light the model incorrectly, or reject it.",
     "Pack the frames again in the format given by the attribute name: {}.",
     {"generate --pack FORMAT"}},
    {"packedFramesDiffer",
     "",
     "Packed frames differ from the normals and tangents.",
     "Programs that use the packed frames light the model differently.",
     "Pack the frames again from NORMAL and TANGENT in the format given by the attribute name: {}.",
     {"generate --pack FORMAT"}},
    {"tangentsUnreadable",
     "",
     "The tangent accessor has an invalid type.",
     "Programs reject the file, or light bumps incorrectly.",
     "Run {}: it computes tangents where a material needs them, and removes the attribute elsewhere.",
     {"generate"}},
    {"positionsRounded", "error", "Positions are rounded too coarsely for tangent directions.",
     "The lighting is rough or faceted on small details.",
     "Store the positions relative to a point near the mesh, and move the node to that point. Keep the existing "
     "tangents: they are better than tangents computed from these positions."},
    {"normalSeam",
     "normals",
     "Two primitives of one smooth surface have different normals at their border.",
     "The lighting has a visible line where the material changes.",
     "Compute the normals of both primitives together: {}. No action is needed if an edge is intended.",
     {"generate --overwrite-normals"}},
    {"normalsFarFromFaces",
     "normals",
     "Normals are far from those of all adjacent triangles.",
     "Flat faces are shaded as if they were round, so boxes look inflated.",
     "No action is needed if this is intended. Otherwise compute normals with hard edges: {}.",
     {"generate --overwrite-normals --crease 60"}},
    {"morphNormalsMissing",
     "",
     "Morph targets rotate the surface but have no normal deltas.",
     "The shape moves, but its lighting does not.",
     "Add normal deltas to the targets: {}.",
     {"generate --morph-normals missing"}},
    {"morphNormalsWrong",
     "",
     "Normal deltas of morph targets are wrong.",
     "The lighting jumps or turns dark while the shape morphs.",
     "Recompute the normal deltas of the targets: {}.",
     {"generate --morph-normals all"}},
    {"normalMapTwoChannels",
     "mapped",
     "A normal map does not store z in blue.",
     "Bumps are too weak, or the surface is lit from behind.",
     "To fix the map in the model: {}. To fix the image alone: {}",
     {"generate --fix-maps", "convert-map MAP -o OUT.png --channels rg"}},
    {"normalMapUnsigned",
     "mapped",
     "A normal map stores z unsigned in blue.",
     "Bumps are too strong.",
     "To fix the map in the model: {}. To fix the image alone: {}",
     {"generate --fix-maps", "convert-map MAP -o OUT.png --channels rg"}},
    {"normalMapChannels",
     "mapped",
     "Channels of a normal map are exchanged or inverted.",
     "Bumps are lit from the wrong side.",
     "To fix the map in the model: {}. To fix the image alone: {}, with the letters of the channels that hold x, y and "
     "z.",
     {"generate --fix-maps", "convert-map MAP -o OUT.png --channels LETTERS"}},
    {"normalMapIsSrgb",
     "mapped",
     "A normal map was stored as a color image (sRGB).",
     "Flat areas are lit as if they were tilted.",
     "To fix the map in the model: {}. To fix the image alone: {}; or, if the sRGB curve was removed by mistake: {}",
     {"generate --fix-maps", "convert-map MAP -o OUT.png --srgb", "convert-map MAP -o OUT.png --linearized"}},
    {"normalMapInObjectSpace",
     "mapped",
     "A normal map is not in tangent space.",
     "The lighting is wrong everywhere, in patches of different brightness.",
     "To fix the map in the model: {}. To fix the image alone: {}",
     {"generate --fix-maps", "convert-map MAP -o OUT.png --from object --mesh MODEL"}},
    {"normalMapIsHeight",
     "mapped",
     "A gray image is used as a normal map.",
     "The lighting is wrong everywhere: gray levels are read as directions.",
     "Make a normal map from the height map: {}",
     {"height-to-normal MAP -o OUT.png --strength S"}},
    {"normalMapScale", "mapped", "The scale of a normal map is 0 or negative.", "Bumps are missing or inverted.",
     "Set the scale of the texture to a value above 0, or remove the normal map if no relief is intended."},
    {"normalMapIsPicture", "mapped", "A color image is used as a normal map.",
     "The lighting is wrong everywhere: colors are read as directions.",
     "Use the intended normal map instead, or remove this image from the material; it may be the base color."},
    {"positionsNoisy",
     "normals",
     "Positions are noisy.",
     "The shading is rough where the surface should be smooth.",
     "No action is needed if the shading is smooth. Otherwise compute normals without the noise, which does not move "
     "vertices: {}.",
     {"generate --overwrite-normals --normals best --denoise auto"}},
    {"normalMapLossy", "", "A normal map has lossy color compression.",
     "Highlights show the blocks of a lossy image format.",
     "Convert the source again to PNG or lossless WebP, or to UASTC if it must be small. For engines, compress the "
     "source to a separate BC5 texture with tspace compress-map."},
    {"normalMapLevels", "", "A compressed normal map has no mip levels.", "The surface shimmers at a distance.",
     "Write all mip levels with the program that compressed the map. For engines, compress the source to a separate "
     "BC5 texture with all mip levels with tspace compress-map."},
    {"normalMapLengths", "", "Vectors of a normal map do not have unit length.",
     "Bumps change their strength with distance.",
     "Normalize the vectors, unless their lengths are intended. Renderers normalize after filtering, so lengths only "
     "matter between texels and in mip levels."},
    {"normalMapConstant", "", "A normal map is one color.", "No bumps are visible.",
     "Remove the map if it is flat: it uses memory and changes nothing. Otherwise find the intended map."},
    {"normalMapZero", "", "Flat areas of a normal map are stored as 127.",
     "Flat areas are tilted by a fraction of a degree.",
     "No action is needed for most uses. Otherwise write the map from its source with 128 for flat areas, or with 16 "
     "bits."},
    {"attributeUnreadable",
     "",
     "An attribute accessor has an invalid type.",
     "Programs reject the file, or draw the attribute incorrectly.",
     "Export the attribute again. Otherwise compute new normals: {}; or remove another attribute: {}.",
     {"generate --overwrite-normals", "generate --repair"}},
}};

/// Returns the row of a code; empty texts for other numbers.
const CodeTexts& textsOf(FindingCode code) {
    static constexpr CodeTexts kNone{"", "", "", "", ""};
    const auto number = static_cast<std::size_t>(code);
    return number < kCodes.size() ? kCodes[number] : kNone;
}

}  // namespace

const char* findingName(FindingCode code) { return textsOf(code).name; }
const char* findingView(FindingCode code) { return textsOf(code).view; }
const char* findingSummary(FindingCode code) { return textsOf(code).summary; }
const char* findingEffect(FindingCode code) { return textsOf(code).effect; }

const char* findingRemedy(FindingCode code) {
    static const std::vector<std::string> texts = [] {
        std::vector<std::string> all;
        for (std::uint32_t number = 0; number < kFindingCodeCount; ++number) {
            Finding finding;
            setRemedy(finding, usualRemedy(static_cast<FindingCode>(number)));
            formatRemedies({&finding, 1});
            all.push_back(std::move(finding.remedy));
        }
        return all;
    }();
    const auto number = static_cast<std::size_t>(code);
    return number < texts.size() ? texts[number].c_str() : "";
}

Remedy usualRemedy(FindingCode code) {
    const CodeTexts& text = textsOf(code);
    Remedy remedy{text.remedy, {}};
    for (const char* command : text.commands) {
        if (command != nullptr) remedy.commands.push_back(toCommand(command));
    }
    return remedy;
}

}  // namespace tspace
