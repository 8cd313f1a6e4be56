// SPDX-License-Identifier: MIT
// Heads of Draco data, and encoding that loses nothing.
#include "model/gltf/codecs/draco.h"

#include <algorithm>
#include <string_view>

#include "model/gltf/codecs/draco_library.h"

namespace tspace::gltf {

namespace {

/// Of the head: "DRACO", major and minor version, kind of geometry, method, and two bytes of flags.
constexpr std::size_t kVersionAt = 5, kGeometryAt = 7, kMethodAt = 8, kHeadBytes = 11;
constexpr std::uint8_t kTriangularMesh = 1, kSequential = 0, kEdgebreaker = 1;

}  // namespace

std::string dracoHeaderFault(std::span<const std::uint8_t> data) {
    constexpr std::string_view kMark = "DRACO";
    const bool is_draco = data.size() >= kHeadBytes &&
                          std::equal(kMark.begin(), kMark.end(), data.begin(),
                                     [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
    if (!is_draco) return "these are no Draco data";
    const std::uint8_t major = data[kVersionAt], minor = data[kVersionAt + 1];
    if (major != 2 || minor != 2) {
        return "the Draco data have version " + std::to_string(major) + "." + std::to_string(minor) + ", not 2.2";
    }
    if (data[kGeometryAt] != kTriangularMesh) return "the Draco data are no mesh";
    if (data[kMethodAt] != kSequential && data[kMethodAt] != kEdgebreaker)
        return "the Draco data have an unknown method";
    return {};
}

bool isEdgebreaker(std::span<const std::uint8_t> data) { return data[kMethodAt] == kEdgebreaker; }

bool encodeDraco(DracoMesh& mesh, bool exact, Bytes& data) {
    if (!encodeDracoAsItIs(mesh, data)) return false;
    if (!exact) return true;
    DracoMesh back{.corners = {}, .point_count = 0, .attributes = mesh.attributes};
    const DracoLimits limits{mesh.corners.size(), mesh.point_count, ~std::size_t{0}};
    if (!decodeDraco(data, limits, back).empty() || back.corners != mesh.corners) return false;
    bool is_exact = true;
    for (std::size_t i = 0; i < mesh.attributes.size(); ++i) {
        if (back.attributes[i].values == mesh.attributes[i].values) continue;
        if (mesh.attributes[i].rounding.bits == 0) return false;
        mesh.attributes[i].rounding = {};
        is_exact = false;
    }
    return is_exact || encodeDraco(mesh, true, data);
}

}  // namespace tspace::gltf
