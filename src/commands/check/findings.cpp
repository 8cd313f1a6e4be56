// SPDX-License-Identifier: MIT
// Names, remedies and texts of findings; the findings about tangents.
#include "commands/check/findings.h"

#include <array>
#include <cmath>

#include "commands/check/frame_health.h"
#include "commands/check/scene_checks.h"

namespace tspace {
namespace {

struct CodeText {
    const char* name;
    const char* remedy;
};

constexpr const char* kRepair = "Compute those tangents anew: tspace generate --repair.";

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
    {"normalsNotUnit", "Make them unit: tspace generate --repair. Tangents that do not fit them are mended too."},
    {"normalsAgainstWinding",
     "Turn the normals round, or the triangles (recalculate outside), whichever is wrong; then compute the tangents "
     "anew."},
    {"tangentsMissing",
     "Run tspace generate. Without it each renderer makes its own tangents, and they may differ from those of the "
     "bake."},
    {"tangentsUnused",
     "Remove them, they make the file larger: tspace generate --strip. Or give the material the normal map that was "
     "meant."},
    {"tangentsIgnored", "Run tspace generate, which makes normals too; or export normals as well."},
    {"tangentsNotFinite", kRepair},
    {"tangentsNotUnit", "Make them unit, and compute those anew that have no length: tspace generate --repair."},
    {"tangentsNotOrthogonal",
     "Make those tangents perpendicular to the normals of the file: tspace generate --repair."},
    {"signsNotOne", "Store +1 or -1 in w: tspace generate --repair."},
    {"signsMixed", "Split the vertices where mirrored and other triangles meet: tspace generate --repair."},
    {"signsInverted",
     "Negate every w: tspace generate --repair. The tool that wrote them fed MikkTSpace with v as glTF stores it and "
     "forgot to negate the sign."},
    {"signsWrong", "Negate those w: tspace generate --repair."},
    {"mirroredSeamAveraged",
     "Split the vertices along the seam, so that each side has its own tangent: tspace generate --repair."},
    {"uvSeamAveraged", "Average only over vertices whose UVs are equal too: tspace generate --repair."},
    {"directionsWrong", kRepair},
    {"uvSetWrong", "Compute the tangents anew, along the UV set of the texture: tspace generate --repair."},
    {"textureTransformIgnored",
     "Apply the transform to the UVs and remove it from the texture, so that no reader can get it wrong; or compute "
     "the tangents anew: tspace generate --overwrite."},
    {"splitFramesDiffer", "Weld equal vertices before tangents are computed: tspace generate --overwrite."},
    {"morphTangentsMissing", "Write tangents for morph targets too: tspace generate --overwrite."},
    {"morphTangentsWrong", "Compute the tangents of the base and of all targets together: tspace generate --repair."},
    {"texturesDisagree",
     "Give both textures the same UV set and the same rotation and mirroring; a mesh can hold only one tangent per "
     "vertex."},
    {"greenFlipped",
     "If it was made for DirectX, invert its green channel: tspace generate --flip-green. If bumps look like dents "
     "then, it is red that is inverted: tspace convert-map MAP -o OUT.png --flip-red. The map alone does not tell the "
     "two apart; a comparison with the high poly does: tspace map-error MAP MODEL --high HIGH."},
    {"normalMapUnreadable", "Convert the image to PNG, JPEG or WebP to have it looked at."},
    {"fileRemark", "Mend the file where that matters. The rest of this report is about what could be read."},
    {"greenMixed",
     "Bake the map anew, all of it one way (tspace bake MODEL --high HIGH -o MAP.png); or invert green with an image "
     "editor where it points down, and nowhere else. To invert the whole map would spoil the other part."},
    {"packedFramesUnreadable",
     "Pack them again, in the format that the attribute names: tspace generate --pack FORMAT."},
    {"packedFramesDiffer",
     "Pack them again from NORMAL and TANGENT, in the format that the attribute names: tspace generate --pack FORMAT."},
    {"tangentsUnreadable",
     "Run tspace generate: it computes tangents where a material needs them, and takes the attribute away elsewhere."},
    {"positionsRounded",
     "Store the positions relative to a point near the mesh, and put that point into the node. Tangents that are there "
     "are better than what can be computed from these positions: keep them."},
    {"normalSeam",
     "Make the normals of the primitives together: tspace generate --overwrite-normals; or leave them if an edge is "
     "meant."},
    {"normalsFarFromFaces",
     "Nothing needs to be done if that is meant. Else make normals with hard edges: tspace generate "
     "--overwrite-normals "
     "--crease 60."},
    {"morphNormalsMissing", "Give the targets normals too: tspace generate --morph-normals missing."},
    {"morphNormalsWrong", "Compute what the targets add to normals anew: tspace generate --morph-normals all."},
    {"normalMapTwoChannels",
     "In the model: tspace generate --mend-maps. The image alone: tspace convert-map MAP -o OUT.png --channels "
     "rg"},
    {"normalMapUnsigned",
     "In the model: tspace generate --mend-maps. The image alone: tspace convert-map MAP -o OUT.png --channels "
     "rg"},
    {"normalMapChannels",
     "In the model: tspace generate --mend-maps. The image alone: tspace convert-map MAP -o OUT.png --channels "
     "LETTERS, with the channels that x, y and z are in."},
    {"normalMapIsSrgb",
     "In the model: tspace generate --mend-maps. The image alone: tspace convert-map MAP -o OUT.png --srgb; "
     "or, where the curve was taken off: tspace convert-map MAP -o OUT.png --linearised"},
    {"normalMapInObjectSpace",
     "In the model: tspace generate --mend-maps. The image alone: tspace convert-map MAP -o OUT.png --from "
     "object --mesh MODEL"},
    {"normalMapIsHeight", "Make a normal map of it: tspace height-to-normal MAP -o OUT.png --strength S"},
    {"normalMapScale", "Give the texture a scale above 0, or take the normal map away, if that is what is meant."},
    {"normalMapIsPicture", "Put the normal map there that is meant, or take this one away: it may be the base color."},
    {"positionsNoisy",
     "Nothing needs to be done if it is shaded smoothly. Else make normals without the noise, which leaves vertices "
     "where "
     "they are: tspace generate --overwrite-normals --normals best --denoise auto."},
    {"normalMapLossy",
     "Pack it again from the source: as PNG or lossless WebP, or as UASTC where it must stay small. For engines, "
     "compress-map packs the source as BC5 beside the glTF."},
    {"normalMapLevels",
     "Write all mip levels with the program that packed it. For engines, compress-map packs the source as BC5 with all "
     "levels beside the glTF."},
    {"normalMapLengths",
     "Make the vectors unit, unless their lengths are meant: renderers make each unit after the filter, so lengths "
     "count only "
     "between texels and in smaller levels."},
    {"normalMapConstant",
     "Remove the map where it is flat: it costs memory and changes nothing. Else find the map that is meant."},
    {"normalMapZero",
     "Nothing needs to be done for most uses. Else write the map from its source with 128 for flat parts, or with 16 "
     "bits."},
    {"attributeUnreadable",
     "Export the attribute again; or make new normals: tspace generate --overwrite-normals. Other attributes are "
     "removed: tspace generate --repair."},
}};

}  // namespace

const char* severityName(Severity severity) {
    switch (severity) {
        case Severity::note:
            return "note";
        case Severity::warning:
            return "warning";
        case Severity::error:
            return "error";
    }
    return "";
}

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
        "Normals, UVs or colors are stored in a form that they cannot have.",
    };
    static_assert(kSummaries.size() == kFindingCodeCount);
    const auto number = static_cast<std::size_t>(code);
    return number < kSummaries.size() ? kSummaries[number] : "";
}

const char* findingRemedy(FindingCode code) {
    const auto number = static_cast<std::size_t>(code);
    return number < kCodes.size() ? kCodes[number].remedy : "";
}

const char* findingLook(FindingCode code) {
    switch (code) {
        case FindingCode::signsNotOne:
        case FindingCode::signsMixed:
        case FindingCode::signsInverted:
        case FindingCode::signsWrong:
        case FindingCode::mirroredSeamAveraged:
            return "sign";
        case FindingCode::uvsMissing:
        case FindingCode::uvsNotFinite:
        case FindingCode::uvsDegenerate:
            return "uv";
        case FindingCode::normalsMissing:
        case FindingCode::normalsNotFinite:
        case FindingCode::normalsNotUnit:
        case FindingCode::normalsAgainstWinding:
        case FindingCode::normalSeam:
        case FindingCode::normalsFarFromFaces:
        case FindingCode::positionsNoisy:
            return "normals";
        case FindingCode::tangentsNotFinite:
        case FindingCode::tangentsNotUnit:
        case FindingCode::tangentsNotOrthogonal:
        case FindingCode::uvSeamAveraged:
        case FindingCode::directionsWrong:
        case FindingCode::uvSetWrong:
        case FindingCode::textureTransformIgnored:
        case FindingCode::splitFramesDiffer:
        case FindingCode::positionsRounded:
            return "error";
        case FindingCode::greenFlipped:
        case FindingCode::greenMixed:
        case FindingCode::normalMapTwoChannels:
        case FindingCode::normalMapUnsigned:
        case FindingCode::normalMapChannels:
        case FindingCode::normalMapIsSrgb:
        case FindingCode::normalMapInObjectSpace:
        case FindingCode::normalMapIsHeight:
        case FindingCode::normalMapScale:
        case FindingCode::normalMapIsPicture:
            return "mapped";
        case FindingCode::tangentsMissing:
        case FindingCode::tangentsIgnored:
            return "lit";
        default:
            return "";
    }
}

Finding makeFinding(FindingCode code, Severity severity, const Tally& tally, const char* unit, std::string message) {
    Finding finding;
    finding.code = code;
    finding.severity = severity;
    finding.unit = unit;
    finding.count = tally.count;
    finding.total = tally.total;
    finding.surface_share = tally.surface_share;
    finding.worst_deg = tally.worst_deg;
    finding.vertices = tally.vertices;
    finding.message = std::move(message);
    finding.remedy = findingRemedy(code);
    return finding;
}

void placeAt(const ScenePrimitive& primitive, const std::string& place, Finding& finding) {
    finding.place = place;
    finding.mesh = primitive.mesh;
    finding.primitive = primitive.primitive;
    finding.mesh_name = primitive.mesh_name;
    finding.material_name = primitive.material_name;
}

Severity onShare(Severity severity, double surface_share, const CheckOptions& options) {
    return severity == Severity::error && surface_share < options.error_share ? Severity::warning : severity;
}

std::string decimalText(double value) {
    // One digit behind the point, without the locale.
    const auto tenths = static_cast<std::uint64_t>(std::llround(value * 10));
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10);
}

std::string stepText(double value) {
    if (value >= 10) return std::to_string(static_cast<std::uint64_t>(std::llround(value)));
    int digits = 1;
    for (double scaled = value; scaled > 0 && scaled < 1 && digits < 12; scaled *= 10) ++digits;
    auto number = static_cast<std::uint64_t>(std::llround(value * std::pow(10, digits)));
    while (digits > 0 && number % 10 == 0) {
        number /= 10;
        --digits;
    }
    std::string text = std::to_string(number);
    if (digits == 0) return text;
    const auto behind = static_cast<std::size_t>(digits);
    if (text.size() <= behind) text = std::string(behind + 1 - text.size(), '0') + text;
    return text.substr(0, text.size() - behind) + "." + text.substr(text.size() - behind);
}

std::string countText(const Tally& tally, const char* unit) {
    const std::string total = std::to_string(tally.total) + " " + unit;
    if (tally.count == tally.total) return "all " + total;
    return std::to_string(tally.count) + " of " + total;
}

std::string shareText(double share) {
    if (share > 0 && share < 0.001) return "less than 0.1 %";
    return decimalText(share * 100) + " %";
}

// The findings on the tangents of one mesh.

namespace {

constexpr const char* kVertices = "vertices";
constexpr const char* kTriangles = "triangles";

std::string onSurface(const Tally& tally) { return " (" + shareText(tally.surface_share) + " of the surface)"; }

class FindingList {
  public:
    explicit FindingList(const CheckOptions& options) : options_(options) {}

    void add(FindingCode code, Severity severity, const Tally& tally, const char* unit, std::string message) {
        if (tally.count == 0) return;
        findings.push_back(
            makeFinding(code, onShare(severity, tally.surface_share, options_), tally, unit, std::move(message)));
    }

    /// A finding that counts vertices, on however little of the surface.
    void addWhole(FindingCode code, Severity severity, const Tally& tally, std::string message) {
        if (tally.count != 0) findings.push_back(makeFinding(code, severity, tally, kVertices, std::move(message)));
    }

    std::vector<Finding> findings = {};

  private:
    const CheckOptions& options_;
};

void addValues(const FrameHealth& health, const CheckOptions& options, FindingList& list) {
    const auto severity = [&](double bad_share) {
        return bad_share >= options.error_share ? Severity::error : Severity::warning;
    };
    list.addWhole(FindingCode::tangentsNotFinite, health.has_not_finite ? Severity::error : Severity::warning,
                  health.not_finite,
                  "the tangents of " + countText(health.not_finite, kVertices) + " are NaN or infinite");
    list.addWhole(FindingCode::tangentsNotUnit, health.has_zero ? Severity::error : severity(health.far_from_unit),
                  health.not_unit,
                  "the tangents of " + countText(health.not_unit, kVertices) + " are not unit" +
                      (health.has_zero ? ", some have no length at all" : "") + onSurface(health.not_unit));
    Tally leaning = health.not_orthogonal;
    if (health.parallel_apart) {
        list.addWhole(FindingCode::tangentsNotOrthogonal, Severity::error, health.parallel,
                      "the tangents of " + countText(health.parallel, kVertices) +
                          " lie along the normal, so that there is no bitangent" + onSurface(health.parallel));
    } else {
        leaning.include(health.parallel);
    }
    const bool is_parallel =
        !health.parallel_apart && health.parallel.surface_share >= options.error_share && health.parallel.count != 0;
    list.addWhole(FindingCode::tangentsNotOrthogonal, is_parallel ? Severity::error : Severity::warning, leaning,
                  "the tangents of " + countText(leaning, kVertices) +
                      " are not perpendicular to the normal, off by up to " + decimalText(leaning.worst_deg) +
                      " degrees" +
                      (is_parallel ? "; " + std::to_string(health.parallel.count) + " of them lie along it" : "") +
                      onSurface(leaning));
    list.addWhole(FindingCode::signsNotOne, health.sign_vanishes ? Severity::error : Severity::warning,
                  health.sign_not_one,
                  "the sign (w) of " + countText(health.sign_not_one, kVertices) + " is neither +1 nor -1");
}

void addSigns(const FrameHealth& health, FindingList& list) {
    if (health.all_signs_wrong) {
        list.add(FindingCode::signsInverted, Severity::error, health.signs_wrong, kVertices,
                 "every sign is inverted: w is the opposite of what the UVs ask for at " +
                     countText(health.signs_wrong, kVertices) + ", so bumps look like dents along v");
    } else {
        list.add(FindingCode::signsWrong, Severity::error, health.signs_wrong, kVertices,
                 "the sign (w) of " + countText(health.signs_wrong, kVertices) +
                     " is the opposite of what the UVs ask for" + onSurface(health.signs_wrong));
    }
    list.add(FindingCode::signsMixed, Severity::error, health.signs_mixed, kTriangles,
             "the corners of " + countText(health.signs_mixed, kTriangles) +
                 " have different signs, and the bitangent vanishes between them" + onSurface(health.signs_mixed));
    list.add(FindingCode::mirroredSeamAveraged, Severity::error, health.mirrored_seams, kVertices,
             "the two sides of a mirrored seam share one tangent at " + countText(health.mirrored_seams, kVertices) +
                 onSurface(health.mirrored_seams));
}

void addDirections(const FrameHealth& health, const CheckOptions& options, FindingList& list) {
    const auto severity = [&](const Tally& tally) {
        if (health.far_directions >= options.error_share) return Severity::error;
        return tally.surface_share >= options.error_share ? Severity::warning : Severity::note;
    };
    list.add(FindingCode::uvSeamAveraged, severity(health.uv_seams), health.uv_seams, kVertices,
             "the tangents of " + countText(health.uv_seams, kVertices) +
                 " are a mean over both sides of a UV seam, and fit neither, off by up to " +
                 decimalText(health.uv_seams.worst_deg) + " degrees" + onSurface(health.uv_seams));
    list.add(FindingCode::directionsWrong, severity(health.directions_wrong), health.directions_wrong, kVertices,
             "the tangents of " + countText(health.directions_wrong, kVertices) +
                 " do not point where u grows, off by up to " + decimalText(health.directions_wrong.worst_deg) +
                 " degrees" + onSurface(health.directions_wrong));
    list.add(FindingCode::splitFramesDiffer, Severity::warning, health.frames_differ, kVertices,
             countText(health.frames_differ, kVertices) +
                 " are equal to another in position, normal and UV but have another tangent, which shows as an edge");
}

}  // namespace

std::vector<Finding> tangentFindings(const FrameHealth& health, const CheckOptions& options) {
    FindingList list(options);
    addValues(health, options, list);
    addSigns(health, list);
    addDirections(health, options, list);
    return std::move(list.findings);
}

std::string whyTangentsAreWrong(const FrameHealth& health, const CheckOptions& options) {
    for (Finding& finding : tangentFindings(health, options)) {
        if (finding.severity == Severity::error) return std::move(finding.message);
    }
    return {};
}

}  // namespace tspace
