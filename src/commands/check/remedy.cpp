// SPDX-License-Identifier: MIT
// Names, summaries and usual remedies of codes; remedies as text.
#include "commands/check/remedy.h"

#include <algorithm>
#include <array>

namespace tspace {
namespace {

constexpr std::size_t kMostCommands = 3;

struct CodeText {
    const char* name;
    const char* remedy;  ///< each "{}" stands for the next command
    std::array<const char*, kMostCommands> commands = {};
};

/// In the order of FindingCode.
constexpr std::array<CodeText, kFindingCodeCount> kCodes{{
    {"positionsNotFinite", "Find the tool that wrote NaN or infinity as a position, and export again."},
    {"uvsMissing", "Unwrap the mesh, or give the texture the number of a UV set that is there."},
    {"uvsNotFinite", "Find the tool that wrote NaN or infinity as a UV, and export again."},
    {"uvsDegenerate",
     "Unwrap those triangles so that they cover some of the texture. If they show one plain colour on purpose, leave "
     "them: any tangent in the plane of the surface will do there."},
    {"normalsMissing", "Nothing needs to be done if flat shading is meant; else export normals."},
    {"normalsNotFinite", "Export the normals again."},
    {"normalsNotUnit", "Make them unit: {}. Tangents that do not fit them are mended too.", {"generate --repair"}},
    {"normalsAgainstWinding",
     "Turn the normals round, or the triangles (recalculate outside), whichever is wrong; then compute the tangents "
     "anew."},
    {"tangentsMissing",
     "Run {}. Without it each renderer makes its own tangents, and they may differ from those of the bake.",
     {"generate"}},
    {"tangentsUnused",
     "Remove them, they make the file larger: {}. Or give the material the normal map that was meant.",
     {"generate --strip"}},
    {"tangentsIgnored", "Run {}, which makes normals too; or export normals as well.", {"generate"}},
    {"tangentsNotFinite", "Compute those tangents anew: {}.", {"generate --repair"}},
    {"tangentsNotUnit", "Make them unit, and compute those anew that have no length: {}.", {"generate --repair"}},
    {"tangentsNotOrthogonal",
     "Make those tangents perpendicular to the normals of the file: {}.",
     {"generate --repair"}},
    {"signsNotOne", "Store +1 or -1 in w: {}.", {"generate --repair"}},
    {"signsMixed", "Split the vertices where mirrored and other triangles meet: {}.", {"generate --repair"}},
    {"signsInverted",
     "Negate every w: {}. The tool that wrote them fed MikkTSpace with v as glTF stores it and forgot to negate the "
     "sign.",
     {"generate --repair"}},
    {"signsWrong", "Negate those w: {}.", {"generate --repair"}},
    {"mirroredSeamAveraged",
     "Split the vertices along the seam, so that each side has its own tangent: {}.",
     {"generate --repair"}},
    {"uvSeamAveraged", "Average only over vertices whose UVs are equal too: {}.", {"generate --repair"}},
    {"directionsWrong", "Compute those tangents anew: {}.", {"generate --repair"}},
    {"uvSetWrong", "Compute the tangents anew, along the UV set of the texture: {}.", {"generate --repair"}},
    {"textureTransformIgnored",
     "Apply the transform to the UVs and remove it from the texture, so that no reader can get it wrong; or compute "
     "the tangents anew: {}.",
     {"generate --overwrite"}},
    {"splitFramesDiffer", "Weld equal vertices before tangents are computed: {}.", {"generate --overwrite"}},
    {"morphTangentsMissing", "Write tangents for morph targets too: {}.", {"generate --overwrite"}},
    {"morphTangentsWrong", "Compute the tangents of the base and of all targets together: {}.", {"generate --repair"}},
    {"texturesDisagree",
     "Give both textures the same UV set and the same rotation and mirroring; a mesh can hold only one tangent per "
     "vertex."},
    {"greenFlipped",
     "If it was made for DirectX, invert its green channel: {}. If bumps look like dents then, it is red that is "
     "inverted: {}. The map alone does not tell the two apart; a comparison with the high poly does: {}.",
     {"generate --flip-green", "convert-map MAP -o OUT.png --flip-red", "map-error MAP MODEL --high HIGH"}},
    {"normalMapUnreadable", "Convert the image to PNG, JPEG or WebP to have it looked at."},
    {"fileRemark", "Mend the file where that matters. The rest of this report is about what could be read."},
    {"greenMixed",
     "Bake the map anew, all of it one way ({}); or invert green with an image editor where it points down, and "
     "nowhere else. To invert the whole map would spoil the other part.",
     {"bake MODEL --high HIGH -o MAP.png"}},
    {"packedFramesUnreadable",
     "Pack them again, in the format that the attribute names: {}.",
     {"generate --pack FORMAT"}},
    {"packedFramesDiffer",
     "Pack them again from NORMAL and TANGENT, in the format that the attribute names: {}.",
     {"generate --pack FORMAT"}},
    {"tangentsUnreadable",
     "Run {}: it computes tangents where a material needs them, and takes the attribute away elsewhere.",
     {"generate"}},
    {"positionsRounded",
     "Store the positions relative to a point near the mesh, and put that point into the node. Tangents that are there "
     "are better than what can be computed from these positions: keep them."},
    {"normalSeam",
     "Make the normals of the primitives together: {}; or leave them if an edge is meant.",
     {"generate --overwrite-normals"}},
    {"normalsFarFromFaces",
     "Nothing needs to be done if that is meant. Else make normals with hard edges: {}.",
     {"generate --overwrite-normals --crease 60"}},
    {"morphNormalsMissing", "Give the targets normals too: {}.", {"generate --morph-normals missing"}},
    {"morphNormalsWrong", "Compute what the targets add to normals anew: {}.", {"generate --morph-normals all"}},
    {"normalMapTwoChannels",
     "In the model: {}. The image alone: {}",
     {"generate --mend-maps", "convert-map MAP -o OUT.png --channels rg"}},
    {"normalMapUnsigned",
     "In the model: {}. The image alone: {}",
     {"generate --mend-maps", "convert-map MAP -o OUT.png --channels rg"}},
    {"normalMapChannels",
     "In the model: {}. The image alone: {}, with the channels that x, y and z are in.",
     {"generate --mend-maps", "convert-map MAP -o OUT.png --channels LETTERS"}},
    {"normalMapIsSrgb",
     "In the model: {}. The image alone: {}; or, where the curve was taken off: {}",
     {"generate --mend-maps", "convert-map MAP -o OUT.png --srgb", "convert-map MAP -o OUT.png --linearised"}},
    {"normalMapInObjectSpace",
     "In the model: {}. The image alone: {}",
     {"generate --mend-maps", "convert-map MAP -o OUT.png --from object --mesh MODEL"}},
    {"normalMapIsHeight", "Make a normal map of it: {}", {"height-to-normal MAP -o OUT.png --strength S"}},
    {"normalMapScale", "Give the texture a scale above 0, or take the normal map away, if that is what is meant."},
    {"normalMapIsPicture", "Put the normal map there that is meant, or take this one away: it may be the base color."},
    {"positionsNoisy",
     "Nothing needs to be done if it is shaded smoothly. Else make normals without the noise, which leaves vertices "
     "where they are: {}.",
     {"generate --overwrite-normals --normals best --denoise auto"}},
    {"normalMapLossy",
     "Pack it again from the source: as PNG or lossless WebP, or as UASTC where it must stay small. For engines, "
     "compress-map packs the source as BC5 beside the glTF."},
    {"normalMapLevels",
     "Write all mip levels with the program that packed it. For engines, compress-map packs the source as BC5 with all "
     "levels beside the glTF."},
    {"normalMapLengths",
     "Make the vectors unit, unless their lengths are meant: renderers make each unit after the filter, so lengths "
     "count only between texels and in smaller levels."},
    {"normalMapConstant",
     "Remove the map where it is flat: it costs memory and changes nothing. Else find the map that is meant."},
    {"normalMapZero",
     "Nothing needs to be done for most uses. Else write the map from its source with 128 for flat parts, or with 16 "
     "bits."},
    {"attributeUnreadable",
     "Export the attribute again; or make new normals: {}. Other attributes are removed: {}.",
     {"generate --overwrite-normals", "generate --repair"}},
}};

}  // namespace

const char* findingName(FindingCode code) {
    const auto number = static_cast<std::size_t>(code);
    return number < kCodes.size() ? kCodes[number].name : "";
}

const char* findingSummary(FindingCode code) {
    // In the order of FindingCode.
    static constexpr std::array kSummaries{
        "Positions are not finite.",
        "A texture is read with a UV set that is not there.",
        "UVs are not finite.",
        "Triangles have no UV area.",
        "There are no normals.",
        "Normals are not finite.",
        "Normals are not unit.",
        "Normals point to the back of their triangles.",
        "A material needs tangents, and there are none.",
        "No material asks for the tangents.",
        "There are tangents without normals.",
        "Tangents are not finite.",
        "Tangents are not unit.",
        "Tangents lean out of the surface.",
        "Signs are neither +1 nor -1.",
        "Signs differ between the corners of a triangle.",
        "Every sign is inverted.",
        "Some signs are inverted.",
        "One tangent serves both sides of a mirrored seam.",
        "One tangent serves both sides of a seam in the UV map.",
        "Tangents do not point where u grows.",
        "Tangents follow another UV set than the texture.",
        "Tangents follow the UVs before the texture transform.",
        "Equal vertices have different tangents.",
        "Morph targets lack tangent deltas.",
        "Tangent deltas of morph targets are wrong.",
        "Two textures need different tangents.",
        "Green points down in a normal map.",
        "A normal map could not be looked at.",
        "Reading the file left something out.",
        "Green points down in one part of a normal map and up in another.",
        "Packed frames cannot be read.",
        "Packed frames are not those of the normals and tangents.",
        "Tangents are stored in a form that tangents cannot have.",
        "Positions are rounded too coarsely for directions.",
        "Two primitives of one smooth surface have different normals at their border.",
        "Normals are far from all triangles around them.",
        "Morph targets turn the surface and leave the normals behind.",
        "What morph targets add to normals is wrong.",
        "Blue of a normal map says nothing of z.",
        "Blue of a normal map is z itself.",
        "Channels of a normal map are exchanged or inverted.",
        "A normal map was stored as a picture, by the sRGB curve.",
        "A normal map is not in tangent space.",
        "A grey image is used as a normal map.",
        "The scale of a normal map is 0 or below.",
        "A picture in colors is used as a normal map.",
        "Positions are noisy.",
        "A normal map is packed as pictures are.",
        "A texture of a normal map has no smaller levels.",
        "Vectors of a normal map are not unit.",
        "A normal map is one color.",
        "Flat parts of a normal map are stored as 127.",
        "Attributes are stored in a form that they cannot have.",
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
    constexpr std::string_view kPlace = "{}";
    std::size_t at = 0;
    for (const RemedyCommand& command : remedy.commands) {
        at = remedy.text.find(kPlace, at);
        if (at == std::string::npos) break;
        const std::string line = commandLine(command);
        remedy.text.replace(at, kPlace.size(), line);
        at += line.size();
    }
    finding.remedy = std::move(remedy.text);
    finding.commands = std::move(remedy.commands);
}

}  // namespace tspace
