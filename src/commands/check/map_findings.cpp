// SPDX-License-Identifier: MIT
// The finding on what a normal map holds, in words, with the commands that make a normal map of it.
#include <optional>
#include <string>

#include "commands/check/findings.h"
#include "commands/check/map_slopes.h"
#include "commands/check/scene_checks.h"

namespace tspace {
namespace {

constexpr const char* kDoubt =
    "; but as x and y these channels are the slopes of no height, so they may be in another encoding";

char letterOf(const MapComponent& component) {
    constexpr const char* kPlain = "rgba";
    constexpr const char* kInverted = "RGBA";
    return (component.is_inverted ? kInverted : kPlain)[static_cast<std::size_t>(component.channel)];
}

const char* channelName(MapChannel channel) {
    constexpr const char* kNames[] = {"red", "green", "blue", "alpha", "no channel"};
    return kNames[static_cast<std::size_t>(channel)];
}

std::string axisText(const char* axis, const MapComponent& component) {
    return std::string(axis) + (component.is_inverted ? " inverted in " : " in ") + channelName(component.channel);
}

FindingCode codeOf(MapContent content) {
    switch (content) {
        case MapContent::twoChannels:
            return FindingCode::normalMapTwoChannels;
        case MapContent::unsignedZ:
            return FindingCode::normalMapUnsigned;
        case MapContent::xInAlpha:
        case MapContent::exchanged:
            return FindingCode::normalMapChannels;
        case MapContent::encoded:
            return FindingCode::normalMapIsSrgb;
        case MapContent::objectSpace:
            return FindingCode::normalMapInObjectSpace;
        case MapContent::picture:
            return FindingCode::normalMapIsPicture;
        case MapContent::hemiOctahedral:
            return FindingCode::normalMapTwoChannels;
        case MapContent::normals:
        case MapContent::height:
            break;
    }
    return FindingCode::normalMapIsHeight;
}

std::string messageOf(const std::string& name, const MapLook& look) {
    const MapLayout& layout = look.layout;
    const bool is_srgb = layout.curve == MapCurve::srgb;
    switch (look.content) {
        case MapContent::twoChannels:
            return "the normal map " + name +
                   " holds only x and y, in red and green: its blue is the same everywhere and says nothing of z, "
                   "which glTF reads there" +
                   (look.is_doubtful ? kDoubt : "");
        case MapContent::unsignedZ:
            return "blue of the normal map " + name +
                   " is z itself, from 0 to 1, where glTF wants (z + 1) / 2: what leans is shown leaning too far";
        case MapContent::xInAlpha:
            if (layout.x.channel != MapChannel::alpha || layout.y.channel != MapChannel::green) {
                return "the normal map " + name + " holds only " + axisText("x", layout.x) + " and " +
                       axisText("y", layout.y) + ", and no z, which glTF reads in blue" +
                       (look.is_doubtful ? kDoubt : "");
            }
            return "the normal map " + name +
                   " holds x in alpha and y in green (as DXT5nm does), and no z: red and blue say nothing" +
                   (look.is_doubtful ? kDoubt : "");
        case MapContent::exchanged:
            if (layout.z == MapLayout{}.z) {
                return "red and green of the normal map " + name +
                       " are exchanged: its slopes are those of a height only where x is in green and y in red";
            }
            return "channels of the normal map " + name + " are exchanged: it has " + axisText("x", layout.x) + ", " +
                   axisText("y", layout.y) + " and " + axisText("z", layout.z) + ", where it points in the mean";
        case MapContent::encoded:
            return "the normal map " + name +
                   " was stored as a picture: its texels are unit vectors only once the sRGB "
                   "curve is " +
                   (is_srgb ? "taken off (flat is about 188, not 128)" : "put on (flat is about 55, not 128)");
        case MapContent::objectSpace:
            if (!look.follows_mesh) {
                return "the normal map " + name +
                       " is not in tangent space: its vectors point all around, as in object or world space, though "
                       "not along the normals of this mesh";
            }
            return "the normal map " + name +
                   (look.is_in_world ? " is in world space: its vectors point along the normals that nodes turn"
                                     : " is in object space: its vectors point along the normals of the mesh") +
                   (layout == MapLayout{} ? std::string()
                                          : ", with " + axisText("x", layout.x) + ", " + axisText("y", layout.y) +
                                                " and " + axisText("z", layout.z));
        case MapContent::picture:
            if (look.is_x_lost) {
                return name +
                       " is no normal map that can be used: only green varies, as y of a map with x in alpha (DXT5nm) "
                       "does, and alpha, with x, is not there";
            }
            return name +
                   " is a picture in colors, and no normal map: its texels are no unit vectors around one that points "
                   "out of the surface";
        case MapContent::hemiOctahedral:
            return "the normal map " + name + " is hemi-octahedrally encoded: " + channelName(layout.x.channel) +
                   " and " + channelName(layout.y.channel) +
                   " hold x + y and x - y of (x, y, z) / (|x| + |y| + z), as their slopes show, and glTF has no such "
                   "encoding";
        case MapContent::normals:
        case MapContent::height:
            break;
    }
    return name + " is grey, and no normal map: it is a height map, perhaps";
}

/// Commands for the image alone, by both readings that slopes cannot tell apart. No full stop stands behind the last command,
/// since it would be copied along.
std::string bothReliefs(const std::string& convert, const MapLayout& layout, const std::string& in_model) {
    return in_model + convert + layoutOptions(layout) +
           ". Slopes do not tell bumps from dents; if the relief is turned inside out then, convert the original image "
           "by " +
           convert + layoutOptions(invertedRelief(layout));
}

std::string remedyOf(const std::string& file, const MapLook& look, bool green_is_down) {
    const std::string flip = green_is_down ? " --flip-green" : "";
    const std::string in_model = "In the model: tspace generate --mend-maps" + flip + ". The image alone: ";
    const std::string convert = "tspace convert-map " + file + " -o OUT.png";
    if (look.is_x_lost) return "Export the map from its source again, with its alpha channel: x cannot be restored.";
    if (look.content == MapContent::picture) return findingRemedy(FindingCode::normalMapIsPicture);
    if (look.content == MapContent::hemiOctahedral) {
        return "Decode it with the program that encoded it, and export x, y and z. No command here does that, and "
               "reading the two channels as x and y gives another surface.";
    }
    if (look.content == MapContent::height) {
        return "Make a normal map of it: tspace height-to-normal " + file +
               " -o OUT.png --strength S, where S is how high white stands above black.";
    }
    if (look.content == MapContent::objectSpace && !look.follows_mesh) {
        return "Find out which model it was made for: " + convert +
               " --from object --mesh MODEL (or --from world, where the nodes of the scene counted). Or bake it anew.";
    }
    if (look.content == MapContent::objectSpace && look.is_in_world)
        return "Take it out of world space: " + convert + " --from world --mesh MODEL" + layoutOptions(look.layout);
    if (look.content == MapContent::objectSpace)
        return in_model + convert + " --from object --mesh MODEL" + layoutOptions(look.layout);
    if (look.is_doubtful) {
        return "If these channels do hold x and y: " + convert + layoutOptions(look.layout) +
               ". Otherwise decode the map with the program that encoded it.";
    }
    MapLayout layout = look.layout;
    const bool has_own_green = layout.y == MapLayout{}.y && layout.curve == MapCurve::none;
    if (green_is_down && !has_own_green) layout.y.is_inverted = !layout.y.is_inverted;
    if (isTurned(look, green_is_down)) {
        const MapLayout left = layout.x.is_inverted ? layout : invertedRelief(layout);
        return "Where the image was turned by 90 degrees counterclockwise: " + convert + layoutOptions(left) +
               ". Where it was turned clockwise: " + convert + layoutOptions(invertedRelief(left)) +
               ". Slopes do not tell the two apart: with the wrong one, bumps are dents.";
    }
    if ((look.content == MapContent::exchanged && !look.is_declared) || (green_is_down && !has_own_green))
        return bothReliefs(convert, layout, in_model);
    return in_model + convert + layoutOptions(look.layout) + flip;
}

}  // namespace

std::string layoutOptions(const MapLayout& layout) {
    std::string text;
    const MapLayout plain{.curve = layout.curve};
    if (!(layout == plain)) {
        text = std::string(" --channels ") + letterOf(layout.x) + letterOf(layout.y);
        if (layout.z.channel != MapChannel::none) text += letterOf(layout.z);
    }
    if (layout.curve == MapCurve::srgb) text += " --srgb";
    if (layout.curve == MapCurve::linearised) text += " --linearised";
    return text;
}

std::optional<Finding> contentFinding(const std::string& name, const std::string& file, const MapLook& look,
                                      bool green_is_down) {
    if (look.content == MapContent::normals) return {};
    const Tally texels{.count = look.count, .total = look.total};
    std::string message = messageOf(name, look);
    if (isTurned(look, green_is_down))
        message += ", and one of them is inverted, as in an image that was turned without its vectors";
    else if (green_is_down)
        message += "; and y is inverted besides";
    Finding finding = makeFinding(codeOf(look.content), Severity::warning, texels, "texels", std::move(message));
    finding.remedy = remedyOf(file, look, green_is_down);
    finding.confidence = texels.share();
    return finding;
}

}  // namespace tspace
