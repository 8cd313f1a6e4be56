// SPDX-License-Identifier: MIT
// The contents of an image in words, with the command that makes a normal map of it.
#include "commands/check/map_findings.h"

#include "commands/check/findings.h"

namespace tspace {

namespace {

/// Whether only x and y are taken, and in which channels they are.
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
                   "which glTF reads there";
        case MapContent::unsignedZ:
            return "blue of the normal map " + name +
                   " is z itself, from 0 to 1, where glTF wants (z + 1) / 2: what leans is shown leaning too far";
        case MapContent::xInAlpha:
            if (layout.x.channel != MapChannel::alpha || layout.y.channel != MapChannel::green) {
                return "the normal map " + name + " holds only " + axisText("x", layout.x) + " and " +
                       axisText("y", layout.y) + ", and no z, which glTF reads in blue";
            }
            return "the normal map " + name +
                   " holds x in alpha and y in green (as DXT5nm does), and no z: red and blue say nothing";
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
            return name +
                   " is a picture in colors, and no normal map: its texels are no unit vectors around one that points "
                   "out of the surface";
        case MapContent::normals:
        case MapContent::height:
            break;
    }
    return name + " is grey, and no normal map: it is a height map, perhaps";
}

std::string remedyOf(const std::string& file, const MapLook& look, bool green_is_down, bool can_mend) {
    const std::string flip = green_is_down ? " --flip-green" : "";
    // No full stop behind a command, since it would be copied along.
    const std::string in_model =
        can_mend ? "In the model: tspace generate --mend-maps" + flip + " does it. The image alone: "
                 : "Give the model an image that has x, y and z: ";
    const std::string convert = "tspace convert-map " + file + " -o OUT.png";
    if (look.content == MapContent::picture) return findingRemedy(FindingCode::normalMapIsPicture);
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
                                      bool green_is_down, bool can_mend) {
    if (look.content == MapContent::normals) return {};
    const Tally texels{.count = look.count, .total = look.total};
    std::string message = messageOf(name, look);
    if (green_is_down) message += "; and y is inverted besides";
    Finding finding = makeFinding(codeOf(look.content), Severity::warning, texels, "texels", std::move(message));
    finding.remedy = remedyOf(file, look, green_is_down, can_mend);
    finding.confidence = texels.share();
    return finding;
}

}  // namespace tspace
