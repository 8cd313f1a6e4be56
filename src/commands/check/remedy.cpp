// SPDX-License-Identifier: MIT
// Names, summaries and usual remedies of finding codes; remedies as text.
#include "commands/check/remedy.h"

#include <algorithm>
#include <array>

namespace tspace {
namespace {

constexpr std::size_t kMaxCommands = 3;

struct CodeText {
    const char* name;
    const char* remedy;  ///< text in which each "{}" is replaced by the next command
    std::array<const char*, kMaxCommands> commands = {};
};

/// Entries are in the order of FindingCode.
constexpr std::array<CodeText, kFindingCodeCount> kCodes{{
    {"positionsNotFinite", "Find the tool that wrote NaN or infinity as a position, and export the mesh again."},
    {"uvsMissing", "Unwrap the mesh, or make the texture use an existing UV set."},
    {"uvsNotFinite", "Find the tool that wrote NaN or infinity as a UV, and export the mesh again."},
    {"uvsDegenerate",
     "Unwrap those triangles so that they cover an area of the texture. If they intentionally show a single color, "
     "keep them: any tangent in the plane of the surface is valid there."},
    {"normalsMissing", "No action is needed if flat shading is intended; otherwise export the mesh with normals."},
    {"normalsNotFinite",
     "Export the normals again; or compute new ones, and tangents that fit them: {}.",
     {"generate --overwrite-normals"}},
    {"normalsNotUnit",
     "Normalize the normals: {}. Their directions do not change, so tangents are kept, except for errors that are "
     "reported too.",
     {"generate --repair"}},
    {"normalsAgainstWinding",
     "Reverse either the normals or the winding (recalculate outside), whichever is wrong; then recompute the "
     "tangents."},
    {"tangentsMissing",
     "Run {}. Without tangents in the file each renderer computes its own, which may differ from those of the bake.",
     {"generate"}},
    {"tangentsUnused",
     "Remove the tangents to make the file smaller: {}. Or give the material the normal map that is missing.",
     {"generate --strip"}},
    {"tangentsIgnored", "Run {}, which adds normals too; or export the mesh with normals.", {"generate"}},
    {"tangentsNotFinite", "Recompute those tangents: {}.", {"generate --repair"}},
    {"tangentsNotUnit", "Normalize the tangents, and recompute those of length 0: {}.", {"generate --repair"}},
    {"tangentsNotOrthogonal",
     "Make those tangents perpendicular to the normals of the file: {}.",
     {"generate --repair"}},
    {"signsNotOne", "Store +1 or -1 in w: {}.", {"generate --repair"}},
    {"signsMixed", "Split the vertices where mirrored and other triangles meet: {}.", {"generate --repair"}},
    {"signsInverted",
     "Negate the sign (w) of every tangent: {}. The exporter passed the top-down v of glTF to MikkTSpace, which "
     "expects "
     "v to point up, and did not negate the resulting sign.",
     {"generate --repair"}},
    {"signsWrong", "Negate the sign (w) of those tangents: {}.", {"generate --repair"}},
    {"mirroredSeamAveraged",
     "Split the vertices along the seam, so that each side has its own tangent: {}.",
     {"generate --repair"}},
    {"uvSeamAveraged", "Average tangents only over vertices that also have equal UVs: {}.", {"generate --repair"}},
    {"directionsWrong", "Recompute those tangents: {}.", {"generate --repair"}},
    {"uvSetWrong", "Recompute the tangents for the UV set of the texture: {}.", {"generate --repair"}},
    {"textureTransformIgnored",
     "Apply the transform to the UVs and remove it from the texture, which works in every reader; or recompute the "
     "tangents: {}.",
     {"generate --overwrite"}},
    {"splitFramesDiffer", "Weld equal vertices before tangents are computed: {}.", {"generate --overwrite"}},
    {"morphTangentsMissing", "Write tangent deltas for morph targets too: {}.", {"generate --overwrite"}},
    {"morphTangentsWrong",
     "Compute the tangents of the base mesh and of all targets together: {}.",
     {"generate --repair"}},
    {"texturesDisagree",
     "Use the same UV set, rotation and mirroring for both textures; a vertex can have only one tangent."},
    {"greenFlipped",
     "If the map was made for DirectX, invert its green channel: {}. If bumps look like dents afterwards, red was "
     "inverted: {}. The map alone does not show which of the two cases it is, but a comparison with the high poly "
     "does: {}.",
     {"generate --flip-green", "convert-map MAP -o OUT.png --flip-red", "map-error MAP MODEL --high HIGH"}},
    {"normalMapUnreadable", "Convert the image to PNG, JPEG or WebP so that check can examine it."},
    {"fileRemark",
     "Repair the file if you need the ignored data. The rest of this report covers the data that could be read."},
    {"greenMixed",
     "Bake the map again with one green direction ({}); or invert green in an image editor only where it points down. "
     "Inverting the whole map would break the other part.",
     {"bake MODEL --high HIGH -o MAP.png"}},
    {"packedFramesUnreadable",
     "Pack the frames again in the format given by the attribute name: {}.",
     {"generate --pack FORMAT"}},
    {"packedFramesDiffer",
     "Pack the frames again from NORMAL and TANGENT in the format given by the attribute name: {}.",
     {"generate --pack FORMAT"}},
    {"tangentsUnreadable",
     "Run {}: it computes tangents where a material needs them, and removes the attribute elsewhere.",
     {"generate"}},
    {"positionsRounded",
     "Store the positions relative to a point near the mesh, and move the node to that point. Keep the existing "
     "tangents: they are better than tangents computed from these positions."},
    {"normalSeam",
     "Compute the normals of both primitives together: {}. No action is needed if an edge is intended.",
     {"generate --overwrite-normals"}},
    {"normalsFarFromFaces",
     "No action is needed if this is intended. Otherwise compute normals with hard edges: {}.",
     {"generate --overwrite-normals --crease 60"}},
    {"morphNormalsMissing", "Add normal deltas to the targets: {}.", {"generate --morph-normals missing"}},
    {"morphNormalsWrong", "Recompute the normal deltas of the targets: {}.", {"generate --morph-normals all"}},
    {"normalMapTwoChannels",
     "To fix the map in the model: {}. To fix the image alone: {}",
     {"generate --fix-maps", "convert-map MAP -o OUT.png --channels rg"}},
    {"normalMapUnsigned",
     "To fix the map in the model: {}. To fix the image alone: {}",
     {"generate --fix-maps", "convert-map MAP -o OUT.png --channels rg"}},
    {"normalMapChannels",
     "To fix the map in the model: {}. To fix the image alone: {}, with the letters of the channels that hold x, y and "
     "z.",
     {"generate --fix-maps", "convert-map MAP -o OUT.png --channels LETTERS"}},
    {"normalMapIsSrgb",
     "To fix the map in the model: {}. To fix the image alone: {}; or, if the sRGB curve was removed by mistake: {}",
     {"generate --fix-maps", "convert-map MAP -o OUT.png --srgb", "convert-map MAP -o OUT.png --linearized"}},
    {"normalMapInObjectSpace",
     "To fix the map in the model: {}. To fix the image alone: {}",
     {"generate --fix-maps", "convert-map MAP -o OUT.png --from object --mesh MODEL"}},
    {"normalMapIsHeight",
     "Make a normal map from the height map: {}",
     {"height-to-normal MAP -o OUT.png --strength S"}},
    {"normalMapScale",
     "Set the scale of the texture to a value above 0, or remove the normal map if no relief is intended."},
    {"normalMapIsPicture",
     "Use the intended normal map instead, or remove this image from the material; it may be the base color."},
    {"positionsNoisy",
     "No action is needed if the shading is smooth. Otherwise compute normals without the noise, which does not move "
     "vertices: {}.",
     {"generate --overwrite-normals --normals best --denoise auto"}},
    {"normalMapLossy",
     "Convert the source again to PNG or lossless WebP, or to UASTC if it must be small. For engines, compress the "
     "source to a separate BC5 texture with tspace compress-map."},
    {"normalMapLevels",
     "Write all mip levels with the program that compressed the map. For engines, compress the source to a separate "
     "BC5 "
     "texture with all mip levels with tspace compress-map."},
    {"normalMapLengths",
     "Normalize the vectors, unless their lengths are intended. Renderers normalize after filtering, so lengths only "
     "matter between texels and in mip levels."},
    {"normalMapConstant",
     "Remove the map if it is flat: it uses memory and changes nothing. Otherwise find the intended map."},
    {"normalMapZero",
     "No action is needed for most uses. Otherwise write the map from its source with 128 for flat areas, or with 16 "
     "bits."},
    {"attributeUnreadable",
     "Export the attribute again; or compute new normals: {}. Other attributes are removed: {}.",
     {"generate --overwrite-normals", "generate --repair"}},
}};

}  // namespace

const char* findingName(FindingCode code) {
    const auto number = static_cast<std::size_t>(code);
    return number < kCodes.size() ? kCodes[number].name : "";
}

const char* findingSummary(FindingCode code) {
    // Entries are in the order of FindingCode.
    static constexpr std::array kSummaries{
        "Positions are not finite.",
        "A texture uses a UV set that does not exist.",
        "UVs are not finite.",
        "Triangles have no UV area.",
        "A primitive has no normals.",
        "Normals are not finite.",
        "Normals do not have unit length.",
        "Normals point to the back of their triangles.",
        "A material needs tangents, but the primitive has none.",
        "No material needs the tangents.",
        "A primitive has tangents but no normals.",
        "Tangents are not finite.",
        "Tangents do not have unit length.",
        "Tangents are not perpendicular to the normals.",
        "Signs are neither +1 nor -1.",
        "Signs differ between the corners of a triangle.",
        "Every sign is inverted.",
        "Some signs are inverted.",
        "Both sides of a mirrored seam share one tangent.",
        "Both sides of a UV seam share one averaged tangent.",
        "Tangents do not point along increasing u.",
        "Tangents follow another UV set than the texture.",
        "Tangents follow the UVs before the texture transform.",
        "Equal vertices have different tangents.",
        "Morph targets lack tangent deltas.",
        "Tangent deltas of morph targets are wrong.",
        "Two textures need different tangents.",
        "Green points down in a normal map.",
        "A normal map could not be examined.",
        "Some data of the file was ignored.",
        "Green points down in one part of a normal map and up in another.",
        "Packed frames cannot be read.",
        "Packed frames differ from the normals and tangents.",
        "The tangent accessor has an invalid type.",
        "Positions are rounded too coarsely for tangent directions.",
        "Two primitives of one smooth surface have different normals at their border.",
        "Normals are far from those of all adjacent triangles.",
        "Morph targets rotate the surface but have no normal deltas.",
        "Normal deltas of morph targets are wrong.",
        "A normal map does not store z in blue.",
        "A normal map stores z unsigned in blue.",
        "Channels of a normal map are exchanged or inverted.",
        "A normal map was stored as a color image (sRGB).",
        "A normal map is not in tangent space.",
        "A gray image is used as a normal map.",
        "The scale of a normal map is 0 or negative.",
        "A color image is used as a normal map.",
        "Positions are noisy.",
        "A normal map has lossy color compression.",
        "A compressed normal map has no mip levels.",
        "Vectors of a normal map do not have unit length.",
        "A normal map is one color.",
        "Flat areas of a normal map are stored as 127.",
        "An attribute accessor has an invalid type.",
    };
    static_assert(kSummaries.size() == kFindingCodeCount);
    const auto number = static_cast<std::size_t>(code);
    return number < kSummaries.size() ? kSummaries[number] : "";
}

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

std::string commandLine(const RemedyCommand& command) {
    std::string line = "tspace " + command.verb;
    for (const std::string& input : command.inputs) line += " " + input;
    for (const RemedyOption& option : command.options) {
        line += (option.name.size() == 1 ? " -" : " --") + option.name;
        if (!option.value.empty()) line += " " + option.value;
    }
    return line;
}

RemedyCommand toCommand(std::string_view words) {
    RemedyCommand command;
    while (!words.empty()) {
        const std::size_t end = std::min(words.find(' '), words.size());
        std::string word(words.substr(0, end));
        words.remove_prefix(std::min(end + 1, words.size()));
        const bool is_placeholder = word[0] >= 'A' && word[0] <= 'Z';
        if (is_placeholder) command.placeholders.push_back(word);
        if (command.verb.empty()) {
            command.verb = std::move(word);
        } else if (word[0] == '-') {
            command.options.push_back({word.substr(word.find_first_not_of('-')), {}});
        } else if (command.options.empty()) {
            command.inputs.push_back(std::move(word));
        } else {
            command.options.back().value = std::move(word);
        }
    }
    return command;
}

RemedyCommand withOption(RemedyCommand command, std::string name, std::string value) {
    command.options.push_back({std::move(name), std::move(value)});
    return command;
}

Remedy usualRemedy(FindingCode code) {
    const CodeText& text = kCodes[static_cast<std::size_t>(code)];
    Remedy remedy{text.remedy, {}};
    for (const char* command : text.commands) {
        if (command != nullptr) remedy.commands.push_back(toCommand(command));
    }
    return remedy;
}

void setRemedy(Finding& finding, Remedy remedy) {
    finding.remedy = std::move(remedy.text);
    finding.commands = std::move(remedy.commands);
}

void formatRemedies(std::span<Finding> findings) {
    constexpr std::string_view kPlace = "{}";
    for (Finding& finding : findings) {
        std::size_t at = 0;
        for (const RemedyCommand& command : finding.commands) {
            at = finding.remedy.find(kPlace, at);
            if (at == std::string::npos) break;
            const std::string line = commandLine(command);
            finding.remedy.replace(at, kPlace.size(), line);
            at += line.size();
        }
    }
}

}  // namespace tspace
