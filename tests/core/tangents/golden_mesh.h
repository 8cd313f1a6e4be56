// SPDX-License-Identifier: MIT
// Golden files of the MikkTSpace reference as meshes, and bitwise comparison.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <vector>

#include "core/tangents/shapes.h"
#include "support/golden_file.h"

namespace tspace::test {

/// The results for one corner, laid out as in the file.
struct GoldenResult {
    Vec3 tangent, bitangent;
    float magnitude_s = 0, magnitude_t = 0;
    std::int32_t orientation = 0;
    float sign = 0;
};

struct GoldenMesh {
    SimpleMesh shape;
    float angular_threshold_deg = 180;
    std::vector<GoldenResult> results;
};

/// Returns false if the file is not a complete golden file.
inline bool readGolden(const std::filesystem::path& path, GoldenMesh& golden) {
    const GoldenFile file(path);
    if (file.face_sizes.empty()) return false;
    golden.angular_threshold_deg = file.angular_threshold_deg;
    golden.shape.face_sizes = file.face_sizes;
    for (std::size_t c = 0; c < file.inputs.size() / GoldenFile::kInputWords; ++c) {
        const auto word = [&](std::size_t k) { return std::bit_cast<float>(file.input(c)[k]); };
        golden.shape.indices.push_back(
            golden.shape.addVertex({word(0), word(1), word(2)}, {word(3), word(4), word(5)}, {word(6), word(7)}));
        GoldenResult& result = golden.results.emplace_back();
        static_assert(sizeof(GoldenResult) == 4 * GoldenFile::kResultWords);
        std::memcpy(static_cast<void*>(&result), file.result(c).data(), sizeof(result));
    }
    return true;
}

/// Returns whether `mikktspace` promises the reference's bits for a mesh.
inline bool hasPromisedBits(const SimpleMesh& shape) {
    const auto allFit = [&](const Vec3& v) {
        return hasPromisedBits(v.x) && hasPromisedBits(v.y) && hasPromisedBits(v.z);
    };
    return std::all_of(shape.indices.begin(), shape.indices.end(), [&](std::uint32_t v) {
        return allFit(shape.positions[v]) && allFit(shape.normals[v]) && hasPromisedBits(shape.uvs[v].x) &&
               hasPromisedBits(shape.uvs[v].y);
    });
}

/// Returns whether words are equal. Any two NaNs are equal.
inline bool sameBits(float a, float b) { return (a != a && b != b) || std::memcmp(&a, &b, sizeof a) == 0; }
inline bool sameBits(const Vec3& a, const Vec3& b) {
    return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.z, b.z);
}
inline bool sameBits(const Vec4& a, const Vec4& b) { return sameBits(xyz(a), xyz(b)) && sameBits(a.w, b.w); }

inline bool sameBits(const Outputs& a, const Outputs& b) {
    bool same = a.tangents.size() == b.tangents.size();
    for (std::size_t c = 0; same && c < a.tangents.size(); ++c) {
        same = sameBits(a.tangents[c], b.tangents[c]) && sameBits(a.bitangents[c], b.bitangents[c]) &&
               sameBits(a.magnitudes_s[c], b.magnitudes_s[c]) && sameBits(a.magnitudes_t[c], b.magnitudes_t[c]);
    }
    return same;
}

}  // namespace tspace::test
