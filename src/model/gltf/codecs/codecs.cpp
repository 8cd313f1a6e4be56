// SPDX-License-Identifier: MIT
// Library-independent parts of the codecs: sizes and headers are checked before a library reads a byte.
#include "model/gltf/codecs/codecs.h"

#include <algorithm>
#include <string_view>

namespace tspace::gltf {

// Checks of Draco headers, and lossless encoding.

namespace {

/// Header layout: "DRACO", major and minor version, geometry kind, method, and two bytes of flags.
constexpr std::size_t kVersionAt = 5, kGeometryAt = 7, kMethodAt = 8, kHeadBytes = 11;
constexpr std::uint8_t kTriangularMesh = 1, kSequential = 0, kEdgebreaker = 1;

}  // namespace

std::string dracoHeaderFault(std::span<const std::uint8_t> data) {
    constexpr std::string_view kMark = "DRACO";
    const bool is_draco = data.size() >= kHeadBytes &&
                          std::equal(kMark.begin(), kMark.end(), data.begin(),
                                     [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
    if (!is_draco) return "the data is not Draco data";
    const std::uint8_t major = data[kVersionAt], minor = data[kVersionAt + 1];
    if (major != 2 || minor != 2)
        return "the Draco data has version " + std::to_string(major) + "." + std::to_string(minor) + ", not 2.2";
    if (data[kGeometryAt] != kTriangularMesh) return "the Draco data does not contain a triangle mesh";
    if (data[kMethodAt] != kSequential && data[kMethodAt] != kEdgebreaker)
        return "the Draco data uses an unknown encoding method";
    return {};
}

bool isEdgebreaker(std::span<const std::uint8_t> data) { return data[kMethodAt] == kEdgebreaker; }

bool encodeDraco(DracoMesh& mesh, bool exact, Bytes& data) {
    if (!encodeDracoUnchecked(mesh, data)) return false;
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

// Checks of meshopt data that its library does not perform, and lossless encoding.

namespace {

std::string attributeFault(const MeshoptCoding& coding) {
    if (coding.stride == 0 || coding.stride > 256 || coding.stride % 4 != 0)
        return "the stride of compressed attributes must be a multiple of 4 from 4 to 256 bytes, not " +
               std::to_string(coding.stride);
    const bool fits = coding.filter == MeshoptFilter::quaternion    ? coding.stride == 8
                      : coding.filter == MeshoptFilter::none        ? true
                      : coding.filter == MeshoptFilter::exponential ? true
                                                                    : coding.stride == 4 || coding.stride == 8;
    return fits ? "" : "the filter does not support a stride of " + std::to_string(coding.stride) + " bytes";
}

std::string indexFault(const MeshoptCoding& coding) {
    if (coding.stride != 2 && coding.stride != 4)
        return "compressed indices must have 2 or 4 bytes, not " + std::to_string(coding.stride);
    if (coding.filter != MeshoptFilter::none) return "the data has a filter, which is not allowed for indices";
    if (coding.mode == MeshoptMode::triangles && coding.count % 3 != 0)
        return "the number of triangle indices, " + std::to_string(coding.count) + ", is not a multiple of 3";
    return {};
}

bool comesBack(const MeshoptCoding& coding, std::span<const std::uint8_t> rows, const Bytes& data) {
    Bytes decoded(rows.size());
    return decodeMeshopt(coding, data, decoded) && std::equal(rows.begin(), rows.end(), decoded.begin());
}

}  // namespace

std::uint64_t meshoptRatio(bool is_khr) {
    // A vertex block uses 2 bits for 16 equal bytes of a column with codec 0, and for 256 equal bytes with codec 1.
    return is_khr ? 1024 : 64;
}

std::string meshoptFault(const MeshoptCoding& coding, std::size_t byte_count) {
    const bool is_attributes = coding.mode == MeshoptMode::attributes;
    std::string fault = is_attributes ? attributeFault(coding) : indexFault(coding);
    if (!fault.empty()) return fault;
    // A triangle takes at least one byte, and so does an index in the mode `indices`.
    const std::uint64_t most = coding.mode == MeshoptMode::triangles ? std::uint64_t{byte_count} * 3
                               : is_attributes ? byte_count * meshoptRatio(coding.is_khr) / coding.stride
                                               : byte_count;
    if (coding.count > most) {
        return std::to_string(byte_count) + " compressed bytes cannot hold " + std::to_string(coding.count) +
               " elements of " + std::to_string(coding.stride) + " bytes";
    }
    return {};
}

bool encodeMeshopt(MeshoptCoding& coding, std::span<const std::uint8_t> rows, Bytes& data) {
    data = encodeUnchecked(coding, rows);
    if (data.empty() || coding.mode == MeshoptMode::attributes) return !data.empty();
    if (coding.mode == MeshoptMode::triangles) {
        if (comesBack(coding, rows, data)) return true;
        // The triangle codec may rotate the corners of a triangle, which changes the order of floating-point sums over
        // corners.
        coding.mode = MeshoptMode::indices;
        data = encodeUnchecked(coding, rows);
    }
    return !data.empty() && comesBack(coding, rows, data);
}

}  // namespace tspace::gltf
