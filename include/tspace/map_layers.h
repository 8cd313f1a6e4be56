// SPDX-License-Identifier: MIT
// What a bake can make beside the normal map, from the same rays: ambient occlusion, bent normals, curvature, heights,
// positions, thickness, ids, and what the materials of the high poly show. CMake target tspace::maps.
//
// A texel of a layer stands for the point of the high poly that the ray of its centre meets, which is the point whose normal the
// normal map shows there; colours are means over the rays of a texel. Where several triangles of the low poly share a
// texel, colours are the mean over all of them, and the other layers are those of the first.
#pragma once

#include <array>
#include <functional>

#include "tspace/map_bake.h"

namespace tspace {

enum class MapLayer : std::uint32_t {
    ao = 0,    ///< the part of the sky over the point that nothing hides, by the cosine: 1 is all of it
    bent = 1,  ///< the mean of the directions that nothing hides, unit, told as BakeOptions tell normals
    curvature =
        2,  ///< mean curvature of the high poly in 1 / length: that of a sphere of radius r is 1 / r; above 0 is convex
    height = 3,    ///< from the low poly to the high poly along the ray, outwards
    position = 4,  ///< of the high poly
    /// The mean depth under the point at which rays into the solid leave it, by the cosine: of a slab its height, of a ball its
    /// radius. Rays that leave nothing (an open sheet) count as deep as white is.
    thickness = 5,
    id = 6,       ///< a colour for each number of LayerOptions::ids (idColor)
    color = 7,    ///< ShownMaterial::color: linear light
    orm = 8,      ///< occlusion (`ao`, where it is made; else 1), roughness, metalness
    emission = 9  ///< ShownMaterial::emission: linear light
};
inline constexpr std::uint32_t kMapLayerCount = 10;
inline constexpr std::uint32_t kMostLayerRays = 4096;

/// What a material shows at a point.
struct ShownMaterial {
    Vec3 color{1, 1, 1};  ///< linear
    float roughness = 1, metalness = 0;
    Vec3 emission{0, 0, 0};  ///< linear
};

/// What the high poly shows at a point of a triangle, of which the weights of the corners are given. Threads call at once.
using MaterialAt = std::function<ShownMaterial(std::uint32_t triangle, const std::array<double, 3>& weights)>;

struct LayerOptions {
    std::vector<MapLayer> layers = {};  ///< each at most once; may be empty
    bool has_normal = true;             ///< also the normal map itself
    /// Rays from each point for `ao`, `bent` and `thickness`: 1 to kMostLayerRays. The same ones for all three.
    std::uint32_t ray_count = 64;
    double sky_distance = 0;  ///< what is further away hides nothing of the sky; 0: everything hides
    /// What white stands for, in lengths (`curvature`: 1 / length); black is minus that for `height` and `curvature`. 0: the
    /// largest that is met; of `curvature` what 99 % are below.
    double height_range = 0, curvature_range = 0, thickness_range = 0;
    /// The box of `position`, black to white. Where `least` is not below `most`: that of the high poly.
    std::array<double, 3> position_least = {}, position_most = {};
    std::span<const std::uint32_t> ids = {};  ///< one per triangle of the high poly, for `id`
    MaterialAt material = {};                 ///< for `color`, `orm` and `emission`
};

/// A layer of a map.
struct BakedLayer {
    MapLayer layer = MapLayer::ao;
    std::uint32_t channel_count = 1;  ///< 1 or 3
    std::vector<float> values = {};   ///< from 0 to 1, channel_count per texel; row 0 is v = 0
    /// What 0 and 1 of each channel stand for, in units of the meshes.
    std::array<double, 3> least = {0, 0, 0}, most = {1, 1, 1};
};

struct BakedMaps {
    /// Without texels and without errors where there is no normal map.
    BakedMap normal = {};
    std::vector<BakedLayer> layers = {};  ///< in the order of LayerOptions::layers
};

/// "ao", "bent" and so on; empty for what is none.
const char* layerName(MapLayer layer);

/// Three channels from 0 to 1, which eight bits hold. Of two numbers below 2^24 - 1 they differ; of the first eight by a half, of the
/// first 64 by a quarter, in a channel at least. None is black.
Vec3 idColor(std::uint32_t id);

/// The peak memory of the layers, about, beside bakeBytes.
std::uint64_t layerBytes(std::uint64_t high_triangles, const BakeOptions& options, const LayerOptions& layers);

/// bakeMap with layers. The same texels for any thread count. Time: one ray a texel, and `ray_count` more for `ao`
/// and `bent`, and as many for `thickness`; 1 to 9 a texel for colours. Errors as bakeMap; also invalidOption and countMismatch.
Result<BakedMaps> bakeMaps(const LowPoly& low, const HighPoly& high, const BakeOptions& options,
                           const LayerOptions& layers, const Execution& execution = {}, const Progress& progress = {});

}  // namespace tspace
