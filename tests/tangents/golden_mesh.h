// SPDX-License-Identifier: MIT
// Reading the golden files of the MikkTSpace reference. The layout is described beside the files.
#pragma once

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tangents/shapes.h"

namespace tspace::test {

struct GoldenResult {
    Vec3 tangent, bitangent;
    float magnitude_s = 0, magnitude_t = 0;
    std::int32_t orientation = 0;
    float sign = 0;
};

struct GoldenMesh {
    Shape shape;
    float angular_threshold_deg = 180;
    std::vector<GoldenResult> results;
};

/// Reads words one after the other; running over the end gives zeros and clears `ok`.
class WordReader {
  public:
    explicit WordReader(const std::filesystem::path& path) {
        std::ifstream file(path, std::ios::binary);
        bytes_.assign(std::istreambuf_iterator<char>(file), {});
    }
    template <class T>
    T next() {
        static_assert(sizeof(T) == 4);
        T value{};
        if (at_ + 4 > bytes_.size()) {
            ok = false;
        } else {
            std::memcpy(&value, bytes_.data() + at_, 4);
            at_ += 4;
        }
        return value;
    }
    Vec3 vec3() {
        const float x = next<float>(), y = next<float>(), z = next<float>();
        return {x, y, z};
    }
    [[nodiscard]] bool atEnd() const { return at_ == bytes_.size(); }
    bool ok = true;

  private:
    std::vector<char> bytes_;
    std::size_t at_ = 0;
};

/// Returns false when the file is not a complete golden file.
inline bool readGolden(const std::filesystem::path& path, GoldenMesh& golden) {
    WordReader in(path);
    if (in.next<std::uint32_t>() != 0x31475354) return false;
    const auto faces = in.next<std::uint32_t>(), corners = in.next<std::uint32_t>();
    golden.angular_threshold_deg = in.next<float>();
    in.next<std::uint32_t>();
    for (std::uint32_t f = 0; f < faces && in.ok; ++f)
        golden.shape.face_sizes.push_back(in.next<std::uint32_t>());
    for (std::uint32_t c = 0; c < corners && in.ok; ++c) {
        const Vec3 position = in.vec3(), normal = in.vec3();
        const float u = in.next<float>(), v = in.next<float>();
        golden.shape.indices.push_back(golden.shape.vertex(position, normal, {u, v}));
    }
    for (std::uint32_t c = 0; c < corners && in.ok; ++c) {
        GoldenResult r;
        r.tangent = in.vec3();
        r.bitangent = in.vec3();
        r.magnitude_s = in.next<float>();
        r.magnitude_t = in.next<float>();
        r.orientation = in.next<std::int32_t>();
        r.sign = in.next<float>();
        golden.results.push_back(r);
    }
    return in.ok && in.atEnd();
}

/// Equal words; any NaN equals any NaN.
inline bool sameBits(float a, float b) { return (a != a && b != b) || std::memcmp(&a, &b, sizeof a) == 0; }
inline bool sameBits(const Vec3& a, const Vec3& b) {
    return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.z, b.z);
}
inline bool sameBits(const Vec4& a, const Vec4& b) { return sameBits(xyz(a), xyz(b)) && sameBits(a.w, b.w); }

inline bool sameBits(const Outputs& a, const Outputs& b) {
    bool same = a.tangents.size() == b.tangents.size();
    for (std::size_t c = 0; same && c < a.tangents.size(); ++c) {
        same = sameBits(a.tangents[c], b.tangents[c]) && sameBits(a.bitangents[c], b.bitangents[c]) &&
               sameBits(a.magnitudes_s[c], b.magnitudes_s[c]) &&
               sameBits(a.magnitudes_t[c], b.magnitudes_t[c]);
    }
    return same;
}

}  // namespace tspace::test
