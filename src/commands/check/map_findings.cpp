// SPDX-License-Identifier: MIT
// Creates the finding on the content of a normal map, with the commands that convert it.
#include <optional>
#include <string>
#include <utility>

#include "commands/check/findings.h"
#include "commands/check/map_slopes.h"
#include "commands/check/remedy.h"
#include "commands/check/scene_checks.h"
#include "images/texture_vectors.h"

namespace tspace {
namespace {

constexpr const char* kDoubt =
    "; but if the two channels are read as x and y, they are not the slopes of any height field, so they may use "
    "another encoding";

constexpr const char* kOctahedral =
    "; but the two channels fit the slopes of a height field better as octahedral encoding, x and y of (x, y, z) / "
    "(|x| + |y| + |z|), so they may store this encoding";

/// Returns the text that a message on two channels adds if x and y are only one of several interpretations.
const char* doubtOf(const MapAnalysis& analysis) {
    return !analysis.is_doubtful ? "" : analysis.may_be_octahedral ? kOctahedral : kDoubt;
}

char letterOf(const MapComponent& component) {
    constexpr const char* kPlain = "rgba";
    constexpr const char* kInverted = "RGBA";
    return (component.is_inverted ? kInverted : kPlain)[static_cast<std::size_t>(component.channel)];
}

std::string axisText(const char* axis, const MapComponent& component) {
    return std::string(axis) + (component.is_inverted ? " inverted in " : " in ") + channelName(component.channel);
}

FindingCode codeOf(MapContent content) {
    switch (content) {
        case MapContent::twoChannels: return FindingCode::normalMapTwoChannels;
        case MapContent::unsignedZ: return FindingCode::normalMapUnsigned;
        case MapContent::xInAlpha:
        case MapContent::exchanged: return FindingCode::normalMapChannels;
        case MapContent::encoded: return FindingCode::normalMapIsSrgb;
        case MapContent::objectSpace: return FindingCode::normalMapInObjectSpace;
        case MapContent::picture: return FindingCode::normalMapIsPicture;
        case MapContent::hemiOctahedral: return FindingCode::normalMapTwoChannels;
        case MapContent::normals:
        case MapContent::height: break;
    }
    return FindingCode::normalMapIsHeight;
}

FindingText textOf(const NamedImage& image, const MapAnalysis& analysis) {
    const std::string& name = image.name;
    const MapLayout& layout = analysis.layout;
    const bool is_srgb = layout.curve == MapCurve::srgb;
    switch (analysis.content) {
        case MapContent::twoChannels:
            return {.symptom = "the relief is lit incorrectly",
                    .cause = "the normal map " + name +
                             " holds only x and y, in red and green; its blue is constant, but glTF reads z there" +
                             doubtOf(analysis)};
        case MapContent::unsignedZ:
            return {
                .symptom = "the relief looks too steep",
                .cause = "blue of the normal map " + name + " stores z itself, from 0 to 1, instead of (z + 1) / 2"};
        case MapContent::xInAlpha:
            if (layout.x.channel != MapChannel::alpha || layout.y.channel != MapChannel::green) {
                return {.symptom = "the relief is lit incorrectly",
                        .cause = "the normal map " + name + " holds only " + axisText("x", layout.x) + " and " +
                                 axisText("y", layout.y) + ", and no z, which glTF reads in blue" + doubtOf(analysis)};
            }
            return {.symptom = "the relief is lit incorrectly",
                    .cause = "the normal map " + name +
                             " holds x in alpha and y in green (DXT5nm) and no z; red and blue are unused" +
                             doubtOf(analysis)};
        case MapContent::exchanged:
            if (layout.z == MapLayout{}.z) {
                return {.symptom = "the relief is lit from the wrong direction",
                        .cause =
                            "red and green of the normal map " + name +
                            " are exchanged: its slopes are those of a height field only with x in green and y in red"};
            }
            return {.symptom = "the relief is lit from the wrong direction",
                    .cause = "channels of the normal map " + name + " are exchanged: it has " +
                             axisText("x", layout.x) + ", " + axisText("y", layout.y) + " and " +
                             axisText("z", layout.z) + "; its vectors point along this z on average"};
        case MapContent::encoded:
            return {
                .symptom = "the relief looks tilted",
                .cause = "the normal map " + name +
                         " was stored as a color image: its texels are unit vectors only after the sRGB curve is " +
                         (is_srgb ? "removed (flat is about 188, not 128)" : "applied (flat is about 55, not 128)")};
        case MapContent::objectSpace:
            if (!analysis.follows_mesh) {
                return {
                    .symptom = "the whole model is lit incorrectly",
                    .cause =
                        "the normal map " + name +
                        " is not in tangent space: its vectors point in all directions, as in object or world space" +
                        (image.is_alone ? "" : ", though not along the normals of this mesh")};
            }
            return {.symptom = "the whole model is lit incorrectly",
                    .cause = "the normal map " + name +
                             (analysis.is_in_world
                                  ? " is in world space: its vectors follow the normals after node transforms"
                                  : " is in object space: its vectors follow the normals of the mesh") +
                             (layout == MapLayout{} ? std::string()
                                                    : ", with " + axisText("x", layout.x) + ", " +
                                                          axisText("y", layout.y) + " and " + axisText("z", layout.z))};
        case MapContent::picture:
            if (analysis.is_x_lost) {
                return {
                    .cause =
                        name +
                        " cannot be used as a normal map: only green varies, like y of a map with x in alpha (DXT5nm), "
                        "but the alpha channel is missing"};
            }
            if (analysis.holds_directions) {
                return {
                    .cause =
                        name +
                        " is not a normal map: red and green are directions in the surface, with length 1 and without "
                        "z, as in a flow or anisotropy map"};
            }
            return {.cause = name +
                             " is a color image, not a normal map: its texels do not decode to unit vectors that point "
                             "away from the surface"};
        case MapContent::hemiOctahedral:
            return {.symptom = "the relief is lit incorrectly",
                    .cause = "the normal map " + name + " is hemi-octahedrally encoded: " +
                             channelName(layout.x.channel) + " and " + channelName(layout.y.channel) +
                             " hold x + y and x - y of (x, y, z) / (|x| + |y| + z), as the slopes of the map show, and "
                             "glTF does not have this encoding"};
        case MapContent::normals:
        case MapContent::height: break;
    }
    return {.cause = name + " is gray, not a normal map; it may be a height map"};
}

RemedyCommand imageCommand(const char* verb, const NamedImage& image) {
    RemedyCommand command{.verb = verb, .inputs = {image.file}, .options = {{"o", "OUT.png"}}};
    if (image.file == kUnnamed) command.placeholders.push_back(image.file);
    command.placeholders.emplace_back("OUT.png");
    return command;
}

RemedyCommand convertCommand(const NamedImage& image) { return imageCommand("convert-map", image); }

RemedyCommand withLayout(RemedyCommand command, const MapLayout& layout) {
    const MapLayout plain{.curve = layout.curve};
    if (!(layout == plain)) {
        std::string letters{letterOf(layout.x), letterOf(layout.y)};
        if (layout.z.channel != MapChannel::none) letters += letterOf(layout.z);
        command = withOption(std::move(command), "channels", std::move(letters));
    }
    if (layout.curve == MapCurve::srgb) command = withOption(std::move(command), "srgb");
    if (layout.curve == MapCurve::linearized) command = withOption(std::move(command), "linearized");
    return command;
}

/// Returns a remedy with commands for the model and for the image alone. `behind`: text after the command for the
/// image; `more`: a command in that text. The text ends without a period after the last command, because a period would
/// be copied with the command.
Remedy inModelOrAlone(const NamedImage& image, bool flips_green, RemedyCommand convert, const std::string& behind = {},
                      std::optional<RemedyCommand> more = {}) {
    Remedy remedy{"Convert it: {}" + behind, {}};
    if (!image.is_alone) {
        remedy.text = "To fix the map in the model: {}. To fix the image alone: {}" + behind;
        RemedyCommand in_model = toCommand("generate --fix-maps");
        remedy.commands.push_back(flips_green ? withOption(std::move(in_model), "flip-green") : std::move(in_model));
    }
    remedy.commands.push_back(std::move(convert));
    if (more) remedy.commands.push_back(*std::move(more));
    return remedy;
}

Remedy objectSpaceRemedy(const NamedImage& image, const MapAnalysis& analysis, bool green_is_down) {
    const auto from = [&](const char* space) {
        return withOption(withOption(convertCommand(image), "from", space), "mesh", "MODEL");
    };
    const auto withModel = [](RemedyCommand command) {
        command.placeholders.emplace_back("MODEL");
        return command;
    };
    const RemedyCommand object = withModel(from("object")), world = withModel(from("world"));
    if (analysis.follows_mesh && analysis.is_in_world)
        return {"Convert the map from world space: {}", {withLayout(world, analysis.layout)}};
    if (analysis.follows_mesh) return inModelOrAlone(image, green_is_down, withLayout(object, analysis.layout));
    const std::string text = ": {} (or with --from world, if the map used the node transforms).";
    if (image.is_alone) return {"Convert the map with the model for which it was made" + text, {object}};
    return {"Find out for which model the map was made" + text + " Or bake it again.", {object}};
}

Remedy openOrderRemedy(const RemedyCommand& convert, const MapAnalysis& analysis, bool green_is_down) {
    MapLayout one = analysis.layout, other = analysis.layout;
    std::swap(other.x, other.y);
    one.y.is_inverted = other.y.is_inverted = green_is_down;
    return {"If x is in " + std::string(channelName(one.x.channel)) + ": {}. If x is in " +
                channelName(other.x.channel) +
                ": {}. The slopes do not show which of the two cases it is; with the wrong one, light seems to come "
                "from another direction.",
            {withLayout(convert, one), withLayout(convert, other)}};
}

Remedy remedyOf(const NamedImage& image, const MapAnalysis& analysis, bool green_is_down) {
    const RemedyCommand convert = convertCommand(image);
    if (analysis.is_x_lost)
        return {"Export the map again from its source with its alpha channel, because x cannot be restored."};
    if (analysis.holds_directions)
        return {"Use the intended normal map instead, and assign this image to the effect for which it was made."};
    if (analysis.content == MapContent::picture) return usualRemedy(FindingCode::normalMapIsPicture);
    if (analysis.content == MapContent::hemiOctahedral) {
        return {
            "Decode the map with the program that encoded it, and export x, y and z. Its encoding is not "
            "supported here, and reading the two channels as x and y results in a different surface."};
    }
    if (analysis.content == MapContent::height) {
        RemedyCommand command = withOption(imageCommand("height-to-normal", image), "strength", "S");
        command.placeholders.emplace_back("S");
        return {"Make a normal map from the height map: {}, where S is the height of white above black.",
                {std::move(command)}};
    }
    if (analysis.content == MapContent::objectSpace) return objectSpaceRemedy(image, analysis, green_is_down);
    if (analysis.is_order_open && !analysis.is_doubtful) return openOrderRemedy(convert, analysis, green_is_down);
    if (analysis.is_doubtful) {
        return {"If these channels hold x and y: {}. Otherwise decode the map with the program that encoded it.",
                {withLayout(convert, analysis.layout)}};
    }
    MapLayout layout = analysis.layout;
    const bool has_own_green = layout.y == MapLayout{}.y && layout.curve == MapCurve::none;
    const bool is_exchanged = analysis.content == MapContent::exchanged;
    if (green_is_down && (!has_own_green || is_exchanged)) layout.y.is_inverted = !layout.y.is_inverted;
    if (isRotated(analysis, green_is_down)) {
        const MapLayout left = layout.x.is_inverted ? layout : invertedRelief(layout);
        return {
            "If the image was rotated by 90 degrees counterclockwise: {}. If it was rotated clockwise: {}. The slopes "
            "do not show which of the two cases it is; with the wrong one, bumps look like dents.",
            {withLayout(convert, left), withLayout(convert, invertedRelief(left))}};
    }
    if ((is_exchanged && !analysis.is_declared) || (green_is_down && !has_own_green)) {
        // Slopes cannot distinguish a height field from its negative, so both layouts are offered.
        return inModelOrAlone(image, green_is_down, withLayout(convert, layout),
                              ". Slopes do not distinguish bumps from dents; if bumps look like dents afterwards, "
                              "convert the original image with {}",
                              withLayout(convert, invertedRelief(layout)));
    }
    RemedyCommand command = withLayout(convert, analysis.layout);
    if (green_is_down) command = withOption(std::move(command), "flip-green");
    return inModelOrAlone(image, green_is_down, std::move(command));
}

}  // namespace

Remedy conversionRemedy(const NamedImage& image, const MapAnalysis& analysis, bool green_is_down) {
    const bool is_only_green = analysis.content == MapContent::normals && green_is_down && image.is_alone;
    return is_only_green ? greenRemedy(image, analysis) : remedyOf(image, analysis, green_is_down);
}

Remedy greenRemedy(const NamedImage& image, const MapAnalysis& analysis) {
    const bool is_converted = analysis.content != MapContent::normals || analysis.is_marked_srgb;
    if (image.is_alone) {
        const RemedyCommand convert = withLayout(convertCommand(image), analysis.layout);
        return {
            "If the map was made for DirectX and is read as glTF or OpenGL, invert green: {}. If bumps look like dents "
            "afterwards, red was inverted: {}. The map alone does not show which of the two cases it is.",
            {is_converted ? withOption(convert, "flip-green") : imageCommand("flip-green", image),
             withOption(convert, "flip-red")}};
    }
    Remedy remedy = usualRemedy(FindingCode::greenFlipped);
    if (!is_converted) return remedy;
    remedy.commands[0] = withOption(remedy.commands[0], "fix-maps");
    remedy.commands[1] = withLayout(remedy.commands[1], analysis.layout);
    return remedy;
}

std::optional<Finding> contentFinding(const NamedImage& image, const MapAnalysis& analysis, bool green_is_down) {
    if (analysis.content == MapContent::normals) return {};
    const Tally texels{.count = analysis.count, .total = analysis.total};
    FindingText text = textOf(image, analysis);
    if (isRotated(analysis, green_is_down))
        text.cause += ", and one of them is inverted, as in an image that was rotated without its vectors";
    else if (green_is_down)
        text.cause += "; y is inverted as well";
    if (analysis.layout.curve != MapCurve::none && analysis.content != MapContent::encoded)
        text.cause += std::string(
                          "; the map was also stored as a color image: its vectors result only after the sRGB "
                          "curve is ") +
                      (analysis.layout.curve == MapCurve::srgb ? "removed" : "applied");
    Finding finding = makeFinding(codeOf(analysis.content), Severity::warning, texels, "texels", std::move(text));
    setRemedy(finding, remedyOf(image, analysis, green_is_down));
    finding.confidence = texels.share();
    return finding;
}

}  // namespace tspace
