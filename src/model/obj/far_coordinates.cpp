// SPDX-License-Identifier: MIT
#include "model/obj/far_coordinates.h"

#include <string>

#include "core/mesh/surface/float_loss.h"
#include "model/json/json.h"

namespace tspace::obj {
namespace {

/// As few digits as name the number, as JSON has them.
std::string spelled(double value) {
    const std::string text = Json(value).dump();
    return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

std::string spelled(const DVec3& v) { return "(" + spelled(v.x) + ", " + spelled(v.y) + ", " + spelled(v.z) + ")"; }

bool isNone(const DVec3& offset) { return offset.x == 0 && offset.y == 0 && offset.z == 0; }

/// "120 of 121 edges"
std::string changedEdges(const FloatLoss& loss) {
    return std::to_string(loss.changed_count) + " of " + std::to_string(loss.edge_count) + " edges of faces";
}

void warnOfOffset(const FloatLoss& loss, Model& model) {
    model.warnings.push_back("the coordinates are so far from the origin that 32-bit floats would change " +
                             changedEdges(loss) + "; " + spelled(model.offset) +
                             " was taken out of them first, and is the translation of the nodes in glTF "
                             "(generate --keep-coordinates leaves it in)");
}

void warnOfLoss(const FloatLoss& loss, bool could_be_mended, Model& model) {
    model.warnings.push_back(
        "the coordinates are too large for 32-bit floats, which glTF has: rounding changes " + changedEdges(loss) +
        (could_be_mended ? "; without --keep-coordinates an offset would be taken out of them"
                         : ", and no common offset mends that; split the model, and move each part to its own origin"));
}

}  // namespace

void takePositions(std::vector<DVec3> positions, const FileOptions& options, Model& model) {
    const VisitEdges edges = [&](const auto& visit) {
        for (const Face& face : model.faces) {
            const Corner* const corner = &model.corners[face.first_corner];
            for (std::uint32_t i = 0; i < face.corner_count; ++i)
                visit(positions[corner[i].position], positions[corner[(i + 1) % face.corner_count].position]);
        }
    };
    const FloatLoss before = floatLoss(edges, {});
    if (before.isNoticeable()) {
        const DVec3 offset = offsetForFloats(edges);
        if (!options.keep_coordinates) model.offset = offset;
        if (!isNone(model.offset)) warnOfOffset(before, model);
        const FloatLoss after = floatLoss(edges, model.offset);
        if (after.isNoticeable()) warnOfLoss(after, isNone(model.offset) && !isNone(offset), model);
    }
    model.positions.reserve(positions.size());
    for (const DVec3& position : positions) {
        const Vec3 rounded = toFloat(position - model.offset);
        model.positions.push_back(isFinite(rounded) ? rounded : Vec3{});
    }
}

}  // namespace tspace::obj
