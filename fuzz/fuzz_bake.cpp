// SPDX-License-Identifier: MIT
// Baking and measuring: any low poly, high poly and options result in an error, or in a map whose channels are all from
// 0 to 1, with equal texels for one and two threads. Nothing is tested in builds without Embree.
#include <cmath>
#include <cstring>
#include <vector>

#include "byte_reader.h"
#include "tspace/maps.h"

namespace {

using namespace tspace;

class BakeReader : public ByteReader {
  public:
    using ByteReader::ByteReader;

    /// Returns a value: usually a multiple of a small step, so that surfaces intersect; sometimes a float with
    /// arbitrary bits.
    float value() {
        const std::uint8_t b = byte();
        return b == 255 ? any() : static_cast<float>(b % 17) / 8 - 1;
    }
    Vec3 vector() { return {value(), value(), value()}; }
};

struct Meshes {
    std::vector<Vec3> positions = {}, normals = {}, cage = {}, high_positions = {}, high_normals = {};
    std::vector<Vec4> tangents = {};
    std::vector<Vec2> uvs = {};
    std::vector<std::uint32_t> corners = {}, groups = {}, high_groups = {};

    explicit Meshes(BakeReader& in) {
        const unsigned kinds = in.byte();
        const std::size_t low_corners = 3 * (1 + in.byte() % 6u);
        for (std::size_t i = 0; i < low_corners; ++i) {
            positions.push_back(in.vector());
            normals.push_back(in.vector());
            const Vec3 direction = in.vector();
            tangents.push_back({direction.x, direction.y, direction.z, in.byte() % 2 == 0 ? 1.0F : -1.0F});
            uvs.push_back({in.value(), in.value()});
            if ((kinds & 1) != 0) cage.push_back(in.vector());
        }
        const std::size_t vertices = 3 + in.byte() % 12u;
        for (std::size_t i = 0; i < vertices; ++i) {
            high_positions.push_back(in.vector());
            if ((kinds & 2) != 0) high_normals.push_back(in.vector());
        }
        const std::size_t triangles = in.byte() % 12u;
        for (std::size_t i = 0; i < 3 * triangles; ++i)
            corners.push_back(in.byte() % static_cast<std::uint32_t>(vertices + ((kinds & 4) != 0 ? 1 : 0)));
        if ((kinds & 8) == 0) return;
        for (std::size_t i = 0; i < low_corners / 3; ++i) groups.push_back(in.byte() % 2);
        for (std::size_t i = 0; i < triangles; ++i) high_groups.push_back(in.byte() % 2);
    }
    [[nodiscard]] LowPoly low() const {
        return {.positions = positions,
                .normals = normals,
                .tangents = tangents,
                .uvs = uvs,
                .cage = cage,
                .groups = groups};
    }
    [[nodiscard]] HighPoly high() const {
        return {.positions = high_positions, .normals = high_normals, .corners = corners, .groups = high_groups};
    }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    BakeReader in(data, size);
    const unsigned flags = in.byte();
    BakeOptions options{.width = 1 + in.byte() % 24u, .height = 1 + in.byte() % 24u};
    options.bits = (flags & 1) != 0 ? 8 : 16;
    options.space = (flags & 2) != 0 ? MapSpace::object : MapSpace::tangent;
    options.fit = (flags & 4) != 0 ? MapFit::texel : MapFit::solve;
    options.reading.two_channels = (flags & 8) != 0;
    const unsigned wraps = in.byte();
    options.wrap_u = static_cast<TextureWrap>(wraps % 3);
    options.wrap_v = static_cast<TextureWrap>(wraps / 3 % 3);
    options.reading.green = (flags & 16) != 0 ? Green::down : Green::up;
    options.reading.bitangent = (flags & 32) != 0 ? BitangentPlace::perVertex : BitangentPlace::perPixel;
    options.reading.unit_vectors = (flags & 64) != 0;
    options.heat = (flags & 128) != 0;
    options.padding = in.byte() % 8u;
    const Meshes meshes(in);
    const Result<BakedMap> map = bakeMap(meshes.low(), meshes.high(), options);
    if (!map) return 0;
    for (const Vec3& texel : map->texels) {
        for (const float channel : {texel.x, texel.y, texel.z})
            require(channel >= 0 && channel <= 1, "a channel lies in 0 to 1");
    }
    require(std::isfinite(map->error.mean_deg) && std::isfinite(map->error.max_deg), "errors are finite");
    require(map->hit_count + map->missed_count + map->padding_count <= map->texels.size(), "texels are counted once");
    const Result<BakedMap> again = bakeMap(meshes.low(), meshes.high(), options, {.thread_count = 2});
    require(again && std::memcmp(again->texels.data(), map->texels.data(), map->texels.size() * sizeof(Vec3)) == 0,
            "two threads give the same texels");
    return 0;
}
