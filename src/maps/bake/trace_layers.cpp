// SPDX-License-Identifier: MIT
// Traces the layers of a bake. The steps, in the order of this file:
//
//   1. prepareLayers: background values
//   2. traceMeans: materials inside of triangles, as means over the rays of each texel (without a fit)
//   3. traceCenters: all layers, with one ray per texel, from its center
//   4. fitMaterial: materials by least squares (with a fit)
//   5. finish: range and missing texels of each layer, then setOcclusion
#include "maps/bake/trace_layers.h"

#include <algorithm>

#include "core/base/border.h"
#include "maps/bake/layer_texels.h"
#include "maps/bake/occlusion.h"
#include "maps/bake/surface_curvature.h"
#include "maps/bake/texel_plan.h"
#include "maps/error/measure_points.h"
#include "maps/rays/map_surfaces.h"
#include "maps/solve/solve_texels.h"

namespace tspace {
namespace {

constexpr std::size_t kNoLayer = ~std::size_t{0};

bool isMaterial(MapLayer layer) {
    return layer == MapLayer::color || layer == MapLayer::orm || layer == MapLayer::emission;
}

std::uint32_t channelsOf(MapLayer layer) {
    switch (layer) {
        case MapLayer::ao:
        case MapLayer::curvature:
        case MapLayer::height:
        case MapLayer::thickness: return 1;
        default: return 3;
    }
}

/// Returns the background value of a layer, which is used where no triangle is near.
Vec3 backgroundOf(MapLayer layer) {
    switch (layer) {
        case MapLayer::ao: return {1, 1, 1};
        case MapLayer::bent: return {0, 0, 1};
        case MapLayer::orm: return {1, 1, 0};
        default: return {0, 0, 0};
    }
}

struct GridPlace {
    std::uint32_t row = 0, column = 0;
};

/// Layers of one bake, with values in their own units until the range of each layer is known.
struct LayerTracing {
    [[nodiscard]] bool has(MapLayer layer) const { return numbers[static_cast<std::size_t>(layer)] != kNoLayer; }
    /// Returns the values of a layer that is baked.
    [[nodiscard]] std::vector<float>& valuesOf(MapLayer layer) {
        return made[numbers[static_cast<std::size_t>(layer)]].values;
    }
    void set(MapLayer layer, std::size_t texel, double value) {
        if (has(layer)) valuesOf(layer)[texel] = static_cast<float>(value);
    }
    void set(MapLayer layer, std::size_t texel, const Vec3& value) {
        if (!has(layer)) return;
        float* const to = valuesOf(layer).data() + 3 * texel;
        to[0] = value.x;
        to[1] = value.y;
        to[2] = value.z;
    }
    [[nodiscard]] bool fits() const {
        return options.fit == MapFit::solve && std::min(options.width, options.height) >= kLeastSolved;
    }
    [[nodiscard]] bool hasMean(std::size_t texel) const { return !sample_count.empty() && sample_count[texel] > 0; }

    const MapSurfaces& surfaces;
    const TexelTriangles& triangles;
    const BakeOptions& options;
    const LayerOptions& layers;
    const MapWork& work;
    std::array<std::size_t, kMapLayerCount> numbers = {};  ///< index of each layer in `made`
    std::vector<BakedLayer> made = {};
    Buffer<TexelState> met = {};  ///< state of each texel, determined with the ray of its center
    bool has_material = false;
    Buffer<std::uint16_t> sample_count = {};
    Buffer<TexelRole> roles = {};
    Buffer<float> curvature = {};
    Buffer<float> solid = {};  ///< Occlusion::solid of each texel, the share of inward rays that hit something
};

// -- 1. backgrounds --

void prepareLayers(LayerTracing& tracing) {
    tracing.numbers.fill(kNoLayer);
    const std::size_t texels = tracing.triangles.kinds.size();
    for (const MapLayer layer : tracing.layers.layers) {
        tracing.numbers[static_cast<std::size_t>(layer)] = tracing.made.size();
        tracing.made.push_back({.layer = layer, .channel_count = channelsOf(layer)});
        std::vector<float>& values = tracing.made.back().values;
        values.resize(texels * tracing.made.back().channel_count);
        const Vec3 background = backgroundOf(layer);
        const float channels[] = {background.x, background.y, background.z};
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = channels[i % tracing.made.back().channel_count];
    }
    tracing.met = Buffer<TexelState>(tracing.work.allocator, texels, TexelState::empty);
    if (tracing.has(MapLayer::thickness)) tracing.solid = Buffer<float>(tracing.work.allocator, texels, 0.0F);
    tracing.has_material =
        tracing.has(MapLayer::color) || tracing.has(MapLayer::orm) || tracing.has(MapLayer::emission);
}

// -- 2. means of materials --

/// Calls take(place, hit) for each point of a band whose ray hits the high poly.
template <class Take>
void forHits(const LayerTracing& tracing, const SampleBands& bands, std::size_t band, const Take& take) {
    double guess = 0;
    const auto query = [&](std::span<const LowPoint> points, std::span<const GridPlace> places) {
        std::array<SurfaceHit, kLinesAtOnce> hits;
        const std::uint32_t met = tracing.surfaces.hitsAt(points, guess, hits);
        for (std::size_t i = 0; i < points.size(); ++i) {
            if ((met >> i & 1) != 0) take(places[i], hits[i]);
        }
    };
    queryInBatches<GridPlace>(query, [&](auto& together) {
        bands.forSamples(band, [&](const BandSample& sample) {
            together.add({sample.triangle, sample.weights()}, {sample.row, sample.column});
        });
    });
}

Vec3 shownBy(MapLayer layer, const ShownMaterial& shown) {
    if (layer == MapLayer::color) return shown.color;
    if (layer == MapLayer::emission) return shown.emission;
    return {1, shown.roughness, shown.metalness};
}

/// Updates the running mean of a texel with one more sample.
void addMaterial(LayerTracing& tracing, std::size_t texel, const ShownMaterial& shown) {
    const float part = 1 / static_cast<float>(++tracing.sample_count[texel]);
    for (const MapLayer layer : {MapLayer::color, MapLayer::orm, MapLayer::emission}) {
        if (!tracing.has(layer)) continue;
        const Vec3 value = shownBy(layer, shown);
        const float* const at = tracing.valuesOf(layer).data() + 3 * texel;
        const Vec3 mean{at[0], at[1], at[2]};
        tracing.set(layer, texel, tracing.sample_count[texel] == 1 ? value : mean + part * (value - mean));
    }
}

/// Computes the mean material over the rays of each texel.
void traceMeans(LayerTracing& tracing) {
    tracing.sample_count = Buffer<std::uint16_t>(tracing.work.allocator, tracing.met.size(), std::uint16_t{0});
    const std::uint32_t n = samplingOf(tracing.options).points;
    const SampleBands bands(uvTriangles(tracing.surfaces.low().uvs, tracing.options), tracing.options.width,
                            tracing.options.height, n, 0);
    const auto traceBand = [&](std::size_t band) {
        forHits(tracing, bands, band, [&](const GridPlace& at, const SurfaceHit& hit) {
            const std::size_t texel = std::size_t{at.row / n} * tracing.options.width + at.column / n;
            if (tracing.sample_count[texel] != 0xffff)
                addMaterial(tracing, texel, tracing.layers.material(hit.triangle, hit.weights));
        });
    };
    forTasksWithProgress(tracing.work, bands.bandCount(), "colors", traceBand);
}

// -- 3. texel centers --

Vec3 inMapSpace(const LayerTracing& tracing, const LowPoint& point, DVec3 direction) {
    if (tracing.options.space == MapSpace::tangent) {
        const CornerFrames corners = tracing.surfaces.corners(point.triangle, tracing.surfaces.low().tangents);
        direction = vectorFor(shadingFrame(corners, point.weights, tracing.options.reading), direction);
    }
    return toFloat(direction);
}

void setMaterial(LayerTracing& tracing, std::size_t texel, const ShownMaterial& shown) {
    for (const MapLayer layer : {MapLayer::color, MapLayer::orm, MapLayer::emission})
        tracing.set(layer, texel, shownBy(layer, shown));
}

void setLayers(LayerTracing& tracing, std::size_t texel, const LowPoint& point, const SurfaceHit& hit) {
    tracing.set(MapLayer::height, texel, hit.height);
    tracing.set(MapLayer::position, texel, toFloat(hit.place));
    if (tracing.has(MapLayer::curvature)) {
        double curvature = 0;
        for (std::size_t i = 0; i < 3; ++i)
            curvature += hit.weights[i] *
                         static_cast<double>(
                             tracing.curvature[tracing.surfaces.high().corners[3 * std::size_t{hit.triangle} + i]]);
        tracing.set(MapLayer::curvature, texel, curvature);
    }
    if (tracing.has(MapLayer::id)) tracing.set(MapLayer::id, texel, idColor(tracing.layers.ids[hit.triangle]));
    const OcclusionOptions look{.ray_count = tracing.layers.ray_count,
                                .sky_distance = tracing.layers.sky_distance,
                                .has_sky = tracing.has(MapLayer::ao) || tracing.has(MapLayer::bent),
                                .has_thickness = tracing.has(MapLayer::thickness)};
    if (look.has_sky || look.has_thickness) {
        const Occlusion around =
            occlusionAt(tracing.surfaces, hit, look, static_cast<std::uint32_t>(texel % tracing.options.width),
                        static_cast<std::uint32_t>(texel / tracing.options.width));
        tracing.set(MapLayer::ao, texel, around.open);
        if (tracing.has(MapLayer::bent)) tracing.set(MapLayer::bent, texel, inMapSpace(tracing, point, around.bent));
        tracing.set(MapLayer::thickness, texel, around.thickness);
        if (tracing.has(MapLayer::thickness)) tracing.solid[texel] = static_cast<float>(around.solid);
    }
    // Texels inside triangles may already have a mean over several rays.
    if (tracing.has_material && !tracing.hasMean(texel))
        setMaterial(tracing, texel, tracing.layers.material(hit.triangle, hit.weights));
}

void traceCenters(LayerTracing& tracing) {
    constexpr std::size_t kRows = 4;
    const TextureShape& shape = tracing.triangles.shape;
    const UvTriangles triangles = uvTriangles(tracing.surfaces.low().uvs, tracing.options);
    const auto trace = [&](std::size_t task) {
        double guess = 0;
        const auto query = [&](std::span<const LowPoint> points, std::span<const std::size_t> texels) {
            std::array<SurfaceHit, kLinesAtOnce> hits;
            const std::uint32_t met = tracing.surfaces.hitsAt(points, guess, hits);
            for (std::size_t i = 0; i < points.size(); ++i) {
                const bool is_hit = (met >> i & 1) != 0;
                tracing.met[texels[i]] = is_hit ? TexelState::known : TexelState::missing;
                if (is_hit) setLayers(tracing, texels[i], points[i], hits[i]);
            }
        };
        queryInBatches<std::size_t>(query, [&](auto& together) {
            const std::size_t end = std::min<std::size_t>((task + 1) * kRows * shape.width, tracing.met.size());
            for (std::size_t texel = task * kRows * shape.width; texel < end; ++texel) {
                if (tracing.triangles.kinds[texel] == TexelCoverage::none) continue;
                const TexelPlace& place = tracing.triangles.places[texel];
                together.add({place.triangle, weightsAt(triangles, shape, place)}, texel);
            }
        });
    };
    forTasksWithProgress(tracing.work, (shape.height + kRows - 1) / kRows, "layers", trace);
}

// -- 4. fit of materials --

/// Returns the role of each texel. Unknown texels are those that a filter reads inside a triangle and whose center ray
/// hit something.
const Buffer<TexelRole>& rolesOf(LayerTracing& tracing) {
    if (!tracing.roles.empty()) return tracing.roles;
    tracing.roles = Buffer<TexelRole>(tracing.work.allocator, tracing.met.size(), TexelRole::excluded);
    for (std::size_t i = 0; i < tracing.roles.size(); ++i) {
        const bool is_read = tracing.triangles.kinds[i] == TexelCoverage::inside || tracing.triangles.is_read[i];
        if (is_read && tracing.met[i] == TexelState::known) tracing.roles[i] = TexelRole::unknown;
    }
    return tracing.roles;
}

void solveLayer(LayerTracing& tracing, MapLayer layer, const TexelSystem& system) {
    std::vector<float>& values = tracing.valuesOf(layer);
    std::vector<Vec3> texels(tracing.met.size());
    for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    solveLeastSquares(system, texels, tracing.work.parallel, tracing.work.allocator,
                      [&tracing](std::uint64_t done, std::uint64_t total) {
                          if (tracing.work.progress) tracing.work.progress("solving colors", done, total);
                      });
    for (std::size_t i = 0; i < texels.size(); ++i) tracing.set(layer, i, texels[i]);
}

/// Computes texels by least squares over a grid of points, so that the filtered map is also correct between texel
/// centers.
void fitMaterial(LayerTracing& tracing, MapLayer layer) {
    const std::uint32_t n = samplingOf(tracing.options).points;
    TexelSystem system(tracing.work.allocator, tracing.options.width, tracing.options.height,
                       {rolesOf(tracing).data(), tracing.roles.size()});
    const SampleBands bands(uvTriangles(tracing.surfaces.low().uvs, tracing.options), tracing.options.width,
                            tracing.options.height, n, n / 2);
    const auto traceBand = [&](std::size_t band) {
        forHits(tracing, bands, band, [&](const GridPlace& at, const SurfaceHit& hit) {
            const BetweenTexels x = betweenTexels(at.column, n, tracing.options.width, tracing.options.wrap_u),
                                y = betweenTexels(at.row, n, tracing.options.height, tracing.options.wrap_v);
            constexpr SymmetricBlock kEqual{1, 0, 0, 1, 0, 1};
            const Vec3 shown = shownBy(layer, tracing.layers.material(hit.triangle, hit.weights));
            system.add(x.texel, y.texel, x.part, y.part, {kEqual, shown});
        });
    };
    // Adjacent bands share a row of texels, so they must not be processed at the same time.
    forNonAdjacent(bands.bandCount(), [&](std::size_t begin, std::size_t number) {
        forTasksWithProgress(tracing.work, number, "colors", [&](std::size_t i) { traceBand(begin + 2 * i); });
    });
    solveLayer(tracing, layer, system);
}

// -- 5. ranges and missing texels --

/// Returns the states of a layer's texels. Texels that have a mean are known even if their center ray hit nothing.
std::vector<TexelState> statesOf(const LayerTracing& tracing, const BakedLayer& layer) {
    std::vector<TexelState> states(tracing.met.begin(), tracing.met.end());
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (isMaterial(layer.layer) && tracing.hasMean(i)) states[i] = TexelState::known;
    }
    return states;
}

/// Maps the values of a layer from [0, range], or [-range, range] if `is_signed`, to [0, 1].
void normalizeRange(BakedLayer& layer, const std::vector<TexelState>& states, double range, bool is_signed) {
    const double least = is_signed ? -range : 0;
    layer.least = {least, least, least};
    layer.most = {range, range, range};
    const float zero = is_signed ? 0.5F : 0.0F;
    const double scale = range > 0 ? (is_signed ? 0.5 : 1) / range : 0;
    for (std::size_t i = 0; i < states.size(); ++i) {
        float& value = layer.values[i];
        const double at = static_cast<double>(zero) + scale * static_cast<double>(value);
        value = states[i] == TexelState::known ? static_cast<float>(std::clamp(at, 0.0, 1.0)) : zero;
    }
}

double largest(const BakedLayer& layer, const std::vector<TexelState>& states) {
    float most = 0;
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (states[i] == TexelState::known) most = std::max(most, std::fabs(layer.values[i]));
    }
    return static_cast<double>(most);
}

/// Returns the 99th percentile of the absolute values, or their maximum if that percentile is 0.
double percentile99(const BakedLayer& layer, const std::vector<TexelState>& states) {
    std::vector<float> sizes;
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (states[i] == TexelState::known) sizes.push_back(std::fabs(layer.values[i]));
    }
    if (sizes.empty()) return 0;
    const auto at = sizes.begin() + static_cast<std::ptrdiff_t>((sizes.size() - 1) * 99 / 100);
    std::nth_element(sizes.begin(), at, sizes.end());
    return *at > 0 ? *at : *std::max_element(sizes.begin(), sizes.end());
}

/// Sets the depth of rays that hit nothing to the full range. The default range is derived from the points where most
/// rays hit something.
void completeThickness(const LayerTracing& tracing, BakedLayer& layer, const std::vector<TexelState>& states) {
    double range = tracing.layers.thickness_range;
    for (std::size_t i = 0; tracing.layers.thickness_range == 0 && i < states.size(); ++i) {
        const bool is_solid = states[i] == TexelState::known && tracing.solid[i] > 0.5F;
        if (is_solid) range = std::max(range, static_cast<double>(layer.values[i]));
    }
    const auto deepest = static_cast<float>(range);
    for (std::size_t i = 0; i < states.size(); ++i)
        layer.values[i] = tracing.solid[i] * layer.values[i] + (1 - tracing.solid[i]) * deepest;
    normalizeRange(layer, states, range, false);
    // A range of zero means that the high poly has no solid part.
    for (std::size_t i = 0; range == 0 && i < states.size(); ++i) {
        if (states[i] == TexelState::known) layer.values[i] = 1;
    }
}

void placeInBox(const LayerTracing& tracing, BakedLayer& layer, const std::vector<TexelState>& states) {
    layer.least = tracing.layers.position_least;
    layer.most = tracing.layers.position_most;
    if (!(layer.least[0] < layer.most[0] || layer.least[1] < layer.most[1] || layer.least[2] < layer.most[2])) {
        const PositionBox box(tracing.surfaces.high().positions);
        layer.least = {box.least.x, box.least.y, box.least.z};
        layer.most = {box.most.x, box.most.y, box.most.z};
    }
    for (std::size_t i = 0; i < layer.values.size(); ++i) {
        const std::size_t axis = i % 3;
        const double side = layer.most[axis] - layer.least[axis];
        const double at = side > 0 ? (static_cast<double>(layer.values[i]) - layer.least[axis]) / side : 0.5;
        layer.values[i] = states[i / 3] == TexelState::known ? static_cast<float>(std::clamp(at, 0.0, 1.0)) : 0.0F;
    }
}

void clampAll(BakedLayer& layer) {
    for (float& value : layer.values) value = value > 0 ? std::min(value, 1.0F) : 0.0F;
}

/// Encodes vectors like texels of a normal map, with all three channels.
void encode(const LayerTracing& tracing, BakedLayer& layer) {
    layer.least = {-1, -1, -1};
    MapReading reading = tracing.options.reading;
    reading.two_channels = false;
    for (std::size_t i = 0; i + 2 < layer.values.size(); i += 3) {
        DVec3 vector{layer.values[i], layer.values[i + 1], layer.values[i + 2]};
        if (!normalize(vector)) vector = {0, 0, 1};
        const DVec3 texel = encodeTexel(vector, reading);
        layer.values[i] = static_cast<float>(std::clamp(texel.x, 0.0, 1.0));
        layer.values[i + 1] = static_cast<float>(std::clamp(texel.y, 0.0, 1.0));
        layer.values[i + 2] = static_cast<float>(std::clamp(texel.z, 0.0, 1.0));
    }
}

void finish(LayerTracing& tracing, BakedLayer& layer) {
    const std::vector<TexelState> states = statesOf(tracing, layer);
    switch (layer.layer) {
        case MapLayer::height:
            normalizeRange(layer, states,
                           tracing.layers.height_range > 0 ? tracing.layers.height_range : largest(layer, states),
                           true);
            break;
        case MapLayer::curvature:
            normalizeRange(
                layer, states,
                tracing.layers.curvature_range > 0 ? tracing.layers.curvature_range : percentile99(layer, states),
                true);
            break;
        case MapLayer::thickness: completeThickness(tracing, layer, states); break;
        case MapLayer::position: placeInBox(tracing, layer, states); break;
        case MapLayer::bent: break;
        default: clampAll(layer);
    }
    const bool is_apart = layer.layer == MapLayer::position || layer.layer == MapLayer::id;
    fillMissing(layer.values, layer.channel_count, states, tracing.triangles.shape,
                is_apart ? Filling::copy : Filling::mean);
    if (layer.layer == MapLayer::bent) encode(tracing, layer);
}

/// Sets the red channel of `orm` to the occlusion.
void setOcclusion(LayerTracing& tracing) {
    std::vector<float>& orm = tracing.valuesOf(MapLayer::orm);
    const float* const ao = tracing.has(MapLayer::ao) ? tracing.valuesOf(MapLayer::ao).data() : nullptr;
    for (std::size_t i = 0; 3 * i < orm.size(); ++i) orm[3 * i] = ao != nullptr ? ao[i] : 1.0F;
}

std::vector<BakedLayer> traceAll(LayerTracing& tracing) {
    prepareLayers(tracing);
    if (tracing.has(MapLayer::curvature))
        tracing.curvature = vertexCurvature(tracing.surfaces.high(), tracing.surfaces.rays().weld_distance,
                                            tracing.work.parallel, tracing.work.allocator);
    if (tracing.has_material && !tracing.fits()) traceMeans(tracing);
    traceCenters(tracing);
    if (tracing.has_material && tracing.fits()) {
        for (const MapLayer layer : {MapLayer::color, MapLayer::orm, MapLayer::emission}) {
            if (tracing.has(layer)) fitMaterial(tracing, layer);
        }
    }
    for (BakedLayer& layer : tracing.made) finish(tracing, layer);
    if (tracing.has(MapLayer::orm)) setOcclusion(tracing);
    return std::move(tracing.made);
}

}  // namespace

const char* layerName(MapLayer layer) {
    constexpr const char* kWords[kMapLayerCount] = {"ao",        "bent", "curvature", "height", "position",
                                                    "thickness", "id",   "color",     "orm",    "emission"};
    const auto number = static_cast<std::size_t>(layer);
    return number < kMapLayerCount ? kWords[number] : "";
}

Vec3 idColor(std::uint32_t id) {
    // Distributes the bits of the number over the channels: its three lowest bits become the highest bits of the
    // channels, the next three bits the second highest, and so on.
    std::uint32_t number = (id + 1) & 0xffffff;
    std::array<std::uint32_t, 3> bytes{};
    for (int bit = 7; bit >= 0 && number != 0; --bit) {
        for (std::uint32_t& byte : bytes) {
            byte |= (number & 1) << bit;
            number >>= 1;
        }
    }
    return {static_cast<float>(bytes[0]) / 255, static_cast<float>(bytes[1]) / 255, static_cast<float>(bytes[2]) / 255};
}

Error checkLayers(const LayerOptions& layers, const BakeOptions& options, std::size_t low_triangles,
                  std::size_t high_triangles) {
    const auto wrong = [](const char* what) { return makeError(ErrorCode::invalidOption, kNoElement, "%s", what); };
    std::array<bool, kMapLayerCount> is_requested{};
    for (const MapLayer layer : layers.layers) {
        const auto number = static_cast<std::size_t>(layer);
        if (number >= kMapLayerCount) return wrong("a layer is not a value of MapLayer");
        if (std::exchange(is_requested[number], true)) return wrong("a layer was requested twice");
        if (isMaterial(layer) && !layers.material)
            return wrong("the layers color, orm and emission need the materials of the high poly");
    }
    if (layers.layers.empty() && !layers.has_normal)
        return wrong("no map was requested; request the normal map or at least one layer");
    if (layers.ray_count == 0 || layers.ray_count > kMostLayerRays)
        return wrong("the number of rays per point must be from 1 to 4096");
    for (const double length :
         {layers.sky_distance, layers.height_range, layers.curvature_range, layers.thickness_range}) {
        if (!std::isfinite(length) || length < 0) return wrong("ranges and distances must be finite and not negative");
    }
    if (is_requested[static_cast<std::size_t>(MapLayer::id)] && layers.ids.size() != high_triangles)
        return makeError(ErrorCode::countMismatch, kNoElement, "ids must have one entry per triangle of the high poly");
    const std::uint64_t bytes =
        bakeBytes(low_triangles, high_triangles, options) + layerBytes(high_triangles, options, layers);
    if (options.memory_limit_bytes != 0 && bytes > options.memory_limit_bytes) {
        return makeError(ErrorCode::tooLarge, kNoElement,
                         "these maps of %u x %u texels need %zu MB of memory, but the limit is %zu MB", options.width,
                         options.height, static_cast<std::size_t>(bytes >> 20),
                         static_cast<std::size_t>(options.memory_limit_bytes >> 20));
    }
    return {ErrorCode::ok};
}

std::uint64_t layerBytes(std::uint64_t high_triangles, const BakeOptions& options, const LayerOptions& layers) {
    // Bytes per texel: values; states and sample counts; filling of one layer and its range; the system of one layer.
    std::uint64_t texel = layers.layers.empty() ? 0 : 1 + 2 + 12 + 4;
    const bool has_material = std::any_of(layers.layers.begin(), layers.layers.end(), isMaterial);
    if (has_material && options.fit == MapFit::solve) texel += sizeof(TexelRow) + 36 + sizeof(Vec3);
    for (const MapLayer layer : layers.layers) texel += sizeof(float) * channelsOf(layer);
    const bool has_curvature =
        std::find(layers.layers.begin(), layers.layers.end(), MapLayer::curvature) != layers.layers.end();
    // Bytes per vertex for curvature; a triangle may have three vertices of its own.
    constexpr std::uint64_t kCurvature = 3 * 64;
    return texel * options.width * options.height + (has_curvature ? kCurvature * high_triangles : 0);
}

std::vector<BakedLayer> traceLayers(const MapSurfaces& surfaces, const TexelTriangles& triangles,
                                    const BakeOptions& options, const LayerOptions& layers, const MapWork& work) {
    if (layers.layers.empty()) return {};
    LayerTracing tracing{
        .surfaces = surfaces, .triangles = triangles, .options = options, .layers = layers, .work = work};
    return traceAll(tracing);
}

}  // namespace tspace
