// SPDX-License-Identifier: MIT
#include "commands/shared/axes_option.h"

#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace tspace::options {
namespace {

/// Parses "x", "+x" or "-x"; returns nothing for other words.
std::optional<Vec3> axisOf(std::string_view word) {
    float sign = 1;
    if (!word.empty() && (word.front() == '-' || word.front() == '+')) {
        if (word.front() == '-') sign = -1;
        word.remove_prefix(1);
    }
    if (word == "x") return Vec3{sign, 0, 0};
    if (word == "y") return Vec3{0, sign, 0};
    if (word == "z") return Vec3{0, 0, sign};
    return {};
}

std::optional<MapAxes> axesOf(std::string_view text) {
    if (text == "y-up") return MapAxes{};
    if (text == "z-up") return kMapAxesZUp;
    std::array<Vec3, 3> axes{};
    Vec3 seen{};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t comma = text.find(',');
        if ((comma == text.npos) != (i == 2)) return {};
        const std::optional<Vec3> axis = axisOf(text.substr(0, comma));
        if (!axis) return {};
        axes[i] = *axis;
        seen = {seen.x + axis->x * axis->x, seen.y + axis->y * axis->y, seen.z + axis->z * axis->z};
        if (comma != text.npos) text.remove_prefix(comma + 1);
    }
    if (!(seen == Vec3{1, 1, 1})) return {};
    return MapAxes{axes[0], axes[1], axes[2]};
}

}  // namespace

Option axesOption(std::function<void(const MapAxes&)> give) {
    const auto take = [give = std::move(give)](const std::string& text) -> std::string {
        const std::optional<MapAxes> taken = axesOf(text);
        if (!taken)
            return "must be y-up, z-up, or the model axes that x, y and z of the map point along, such as x,-z,y";
        give(*taken);
        return {};
    };
    Option axes =
        option("--axes", "AXES", take,
               "Axes of a map that is not in tangent space. y-up: as in glTF; z-up: as in Blender and 3ds Max, the "
               "same as x,-z,y; or three comma-separated signed axes of the model, for x, y and z of the map.");
    axes.default_text = "y-up";
    return axes;
}

}  // namespace tspace::options
