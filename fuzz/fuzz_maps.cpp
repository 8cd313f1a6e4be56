// SPDX-License-Identifier: MIT
// Functions behind convert-map, height-to-normal and map-error: any texels, frames and options result in an error, or
// in channels from 0 to 1, with equal results for one and two threads.
#include <cmath>
#include <cstring>
#include <vector>

#include "made_image.h"
#include "tspace/maps.h"

namespace {

using namespace tspace;

float value(ByteReader& in) {
    const std::uint8_t b = in.byte();
    return b == 255 ? in.any() : static_cast<float>(b % 17) / 8 - 1;
}

struct Corners {
    std::vector<Vec2> uvs = {};
    std::vector<Vec3> normals = {}, positions = {};
    std::vector<Vec4> tangents = {};
    std::vector<MapAxes> axes = {};

    Corners(ByteReader& in, std::size_t triangles) {
        const auto vector = [&in] { return Vec3{value(in), value(in), value(in)}; };
        for (std::size_t i = 0; i < 3 * triangles; ++i) {
            uvs.push_back({value(in), value(in)});
            normals.push_back(vector());
            positions.push_back(vector());
            const Vec3 direction = vector();
            tangents.push_back({direction.x, direction.y, direction.z, in.byte() % 2 == 0 ? 1.0F : -1.0F});
        }
        for (std::size_t i = 0; i < triangles; ++i) axes.push_back({vector(), vector(), vector()});
    }
};

MapReading readingOf(ByteReader& in) {
    const unsigned flags = in.byte();
    return {.green = (flags & 1) != 0 ? Green::down : Green::up,
            .bitangent = (flags & 2) != 0 ? BitangentPlace::perVertex : BitangentPlace::perPixel,
            .unit_vectors = (flags & 4) != 0,
            .two_channels = (flags & 8) != 0,
            .scale = (flags & 16) != 0 ? value(in) : 1.0F};
}

MapSide sideOf(ByteReader& in, const Corners& corners) {
    const unsigned flags = in.byte();
    MapSide side{.space = (flags & 1) != 0 ? MapSpace::object : MapSpace::tangent, .reading = readingOf(in)};
    if ((flags & 2) != 0) return side;
    side.uvs = corners.uvs;
    side.normals = corners.normals;
    side.tangents = corners.tangents;
    if ((flags & 4) != 0) side.positions = corners.positions;
    if ((flags & 8) != 0 && side.space == MapSpace::object) side.axes = corners.axes;
    return side;
}

/// Calls call(threads, out) with one thread and with two, and compares the outputs.
template <class Call>
void requireSame(std::size_t texels, Call&& call) {
    std::vector<Vec3> one(texels), two(texels);
    const auto first = call(1U, one), second = call(2U, two);
    require(first.ok() == second.ok(), "threads do not decide about success");
    if (!first) return require(!first.error().message.empty(), "an error has a message");
    require(std::memcmp(one.data(), two.data(), texels * sizeof(Vec3)) == 0, "two threads give the same texels");
    for (const Vec3& texel : one) {
        for (const float channel : {texel.x, texel.y, texel.z})
            require(channel >= 0 && channel <= 1, "a channel lies in 0 to 1");
    }
}

void requireMeasured(ByteReader& in, const MapImage& map, const Corners& low, const Corners& high) {
    std::vector<std::uint32_t> corners(high.positions.size());
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::uint32_t>(i);
    const LowPoly low_poly{
        .positions = low.positions, .normals = low.normals, .tangents = low.tangents, .uvs = low.uvs};
    const HighPoly high_poly{.positions = high.positions, .normals = high.normals, .corners = corners};
    const MapErrorOptions options{.reading = readingOf(in), .point_count = 50, .heat = true};
    const Result<MapError> error = measureMap(map, low_poly, high_poly, options, {.thread_count = 1});
    if (!error) return require(!error.error().message.empty(), "an error has a message");
    require(error->point_count + error->missed_count <= options.point_count, "points are counted once");
    require(error->mean_deg >= 0 && error->mean_deg <= error->max_deg + 1e-9 && error->max_deg <= 180.001,
            "angles are in order, and within 0 and 180");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    ByteReader in(data, size);
    const FloatImage image = fuzz::makeImage(in);
    const auto wrap = [&in] { return static_cast<TextureWrap>(in.byte() % 3); };
    const MapImage map{image.width, image.height, image.texels, wrap(), wrap()};
    const std::size_t triangles = 1 + in.byte() % 6U;
    const Corners from(in, triangles), to(in, triangles);
    const MapSide from_side = sideOf(in, from), to_side = sideOf(in, to);
    constexpr unsigned kBits[] = {8, 16, 32};
    const unsigned bits = kBits[in.byte() % 3], padding = in.byte() % 4U;
    requireSame(image.texels.size(), [&](unsigned threads, std::vector<Vec3>& out) {
        const ConvertMapOptions options{.bits = bits, .padding = padding};
        return convertMap(map, from_side, to_side, options, out, {.thread_count = threads});
    });
    std::vector<float> heights;
    for (const Vec3& texel : image.texels) heights.push_back(texel.x);
    const HeightMap height_map{image.width, image.height, heights, map.wrap_u, map.wrap_v};
    const double strength = static_cast<double>(value(in)) * 100;
    requireSame(image.texels.size(), [&](unsigned threads, std::vector<Vec3>& out) {
        const HeightToNormalOptions options{.strength = strength, .bits = bits};
        return heightToNormal(height_map, from_side, options, out, {.thread_count = threads});
    });
    requireMeasured(in, map, from, to);
    return 0;
}
