// SPDX-License-Identifier: MIT
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
        case MapLayer::thickness:
            return 1;
        default:
            return 3;
    }
}

/// Background value, used where no triangle is near.
Vec3 backgroundOf(MapLayer layer) {
    switch (layer) {
        case MapLayer::ao:
            return {1, 1, 1};
        case MapLayer::bent:
            return {0, 0, 1};
        case MapLayer::orm:
            return {1, 1, 0};
        default:
            return {0, 0, 0};
    }
}

/// Layers of one bake; they hold unscaled values until their range is known.
class LayerTracing {
  public:
    LayerTracing(const MapSurfaces& surfaces, const TexelTriangles& triangles, const BakeOptions& options,
                 const LayerOptions& layers, const MapWork& work)
        : surfaces_(surfaces),
          triangles_(triangles),
          options_(options),
          layers_(layers),
          work_(work),
          uvs_(surfaces.low(), work.allocator) {
        at_.fill(kNoLayer);
        const std::size_t texels = triangles.kinds.size();
        for (const MapLayer layer : layers.layers) {
            at_[static_cast<std::size_t>(layer)] = made_.size();
            made_.push_back({.layer = layer, .channel_count = channelsOf(layer)});
            std::vector<float>& values = made_.back().values;
            values.resize(texels * made_.back().channel_count);
            const Vec3 background = backgroundOf(layer);
            const float channels[] = {background.x, background.y, background.z};
            for (std::size_t i = 0; i < values.size(); ++i) values[i] = channels[i % made_.back().channel_count];
        }
        met_ = Buffer<TexelState>(work.allocator, texels, TexelState::empty);
        if (has(MapLayer::thickness)) solid_ = Buffer<float>(work.allocator, texels, 0.0F);
        has_material_ = has(MapLayer::color) || has(MapLayer::orm) || has(MapLayer::emission);
    }

    std::vector<BakedLayer> run() {
        if (has(MapLayer::curvature))
            curvature_ =
                vertexCurvature(surfaces_.high(), surfaces_.rays().weld_distance, work_.parallel, work_.allocator);
        if (has_material_ && !fits()) traceMeans();
        traceCentres();
        if (has_material_ && fits()) {
            for (const MapLayer layer : {MapLayer::color, MapLayer::orm, MapLayer::emission}) {
                if (has(layer)) fitMaterial(layer);
            }
        }
        for (BakedLayer& layer : made_) finish(layer);
        if (has(MapLayer::orm)) setOcclusion();
        return std::move(made_);
    }

  private:
    [[nodiscard]] bool has(MapLayer layer) const { return at_[static_cast<std::size_t>(layer)] != kNoLayer; }

    void set(MapLayer layer, std::size_t texel, double value) {
        if (has(layer)) made_[at_[static_cast<std::size_t>(layer)]].values[texel] = static_cast<float>(value);
    }
    void set(MapLayer layer, std::size_t texel, const Vec3& value) {
        if (!has(layer)) return;
        float* const to = made_[at_[static_cast<std::size_t>(layer)]].values.data() + 3 * texel;
        to[0] = value.x;
        to[1] = value.y;
        to[2] = value.z;
    }

    void setMaterial(std::size_t texel, const ShownMaterial& shown) {
        for (const MapLayer layer : {MapLayer::color, MapLayer::orm, MapLayer::emission})
            set(layer, texel, shownBy(layer, shown));
    }

    void traceCentres() {
        constexpr std::size_t kRows = 4;
        const TextureShape& shape = triangles_.shape;
        const UvTriangles triangles = uvs_.triangles(options_.wrap_u, options_.wrap_v);
        const auto trace = [&](std::size_t task) {
            double guess = 0;
            const auto ask = [&](std::span<const LowPoint> points, std::span<const std::size_t> texels) {
                std::array<SurfaceHit, kLinesAtOnce> hits;
                const std::uint32_t met = surfaces_.hitsAt(points, guess, hits);
                for (std::size_t i = 0; i < points.size(); ++i) {
                    const bool is_hit = (met >> i & 1) != 0;
                    met_[texels[i]] = is_hit ? TexelState::known : TexelState::missing;
                    if (is_hit) show(texels[i], points[i], hits[i]);
                }
            };
            askTogether<std::size_t>(ask, [&](auto& together) {
                const std::size_t end = std::min<std::size_t>((task + 1) * kRows * shape.width, met_.size());
                for (std::size_t texel = task * kRows * shape.width; texel < end; ++texel) {
                    if (triangles_.kinds[texel] == TexelCoverage::none) continue;
                    const TexelPlace& place = triangles_.places[texel];
                    together.add({place.triangle, weightsAt(triangles, shape, place)}, texel);
                }
            });
        };
        forTasksTold(work_, (shape.height + kRows - 1) / kRows, "layers", trace);
    }

    void show(std::size_t texel, const LowPoint& point, const SurfaceHit& hit) {
        set(MapLayer::height, texel, hit.height);
        set(MapLayer::position, texel, toFloat(hit.place));
        if (has(MapLayer::curvature)) {
            double curvature = 0;
            for (std::size_t i = 0; i < 3; ++i)
                curvature +=
                    hit.weights[i] *
                    static_cast<double>(curvature_[surfaces_.high().corners[3 * std::size_t{hit.triangle} + i]]);
            set(MapLayer::curvature, texel, curvature);
        }
        if (has(MapLayer::id)) set(MapLayer::id, texel, idColor(layers_.ids[hit.triangle]));
        const OcclusionOptions look{.ray_count = layers_.ray_count,
                                    .sky_distance = layers_.sky_distance,
                                    .has_sky = has(MapLayer::ao) || has(MapLayer::bent),
                                    .has_thickness = has(MapLayer::thickness)};
        if (look.has_sky || look.has_thickness) {
            const Occlusion around =
                occlusionAt(surfaces_, hit, look, static_cast<std::uint32_t>(texel % options_.width),
                            static_cast<std::uint32_t>(texel / options_.width));
            set(MapLayer::ao, texel, around.open);
            if (has(MapLayer::bent)) set(MapLayer::bent, texel, told(point, around.bent));
            set(MapLayer::thickness, texel, around.thickness);
            if (has(MapLayer::thickness)) solid_[texel] = static_cast<float>(around.solid);
        }
        // Inside triangles, colors are means over several rays.
        if (has_material_ && !hasMean(texel)) setMaterial(texel, layers_.material(hit.triangle, hit.weights));
    }

    [[nodiscard]] Vec3 told(const LowPoint& point, DVec3 direction) const {
        if (options_.space == MapSpace::tangent) {
            const CornerFrames corners = surfaces_.corners(point.triangle, surfaces_.low().tangents);
            direction = vectorFor(shadingFrame(corners, point.weights, options_.reading), direction);
        }
        return toFloat(direction);
    }

    [[nodiscard]] bool fits() const {
        return options_.fit == MapFit::solve && std::min(options_.width, options_.height) >= kLeastSolved;
    }
    [[nodiscard]] bool hasMean(std::size_t texel) const { return !sample_count_.empty() && sample_count_[texel] > 0; }

    struct GridPlace {
        std::uint32_t row = 0, column = 0;
    };
    /// Calls take(place, hit) for each point of a band whose ray hits something.
    template <class Take>
    void forHits(const SampleBands& bands, std::size_t band, const Take& take) const {
        double guess = 0;
        const auto ask = [&](std::span<const LowPoint> points, std::span<const GridPlace> places) {
            std::array<SurfaceHit, kLinesAtOnce> hits;
            const std::uint32_t met = surfaces_.hitsAt(points, guess, hits);
            for (std::size_t i = 0; i < points.size(); ++i) {
                if ((met >> i & 1) != 0) take(places[i], hits[i]);
            }
        };
        askTogether<GridPlace>(ask, [&](auto& together) {
            bands.forSamples(band, [&](const BandSample& sample) {
                together.add({sample.triangle, sample.weights()}, {sample.row, sample.column});
            });
        });
    }

    /// Computes texels by least squares over a grid of points, so that the filtered map is also correct between texel
    /// centers.
    void fitMaterial(MapLayer layer) {
        const std::uint32_t n = samplingOf(options_).points;
        TexelSystem system(work_.allocator, options_.width, options_.height, {roles().data(), roles_.size()});
        const SampleBands bands(uvs_.triangles(options_.wrap_u, options_.wrap_v), options_.width, options_.height, n,
                                n / 2, work_.allocator);
        const auto traceBand = [&](std::size_t band) {
            forHits(bands, band, [&](const GridPlace& at, const SurfaceHit& hit) {
                const BetweenTexels x = betweenTexels(at.column, n, options_.width, options_.wrap_u),
                                    y = betweenTexels(at.row, n, options_.height, options_.wrap_v);
                constexpr SymmetricBlock kEqual{1, 0, 0, 1, 0, 1};
                const Vec3 shown = shownBy(layer, layers_.material(hit.triangle, hit.weights));
                system.add(x.texel, y.texel, x.part, y.part, {kEqual, shown});
            });
        };
        // Adjacent bands share a row of texels, so they must not run at the same time.
        forApart(bands.bandCount(), [&](std::size_t begin, std::size_t number) {
            forTasksTold(work_, number, "colours", [&](std::size_t i) { traceBand(begin + 2 * i); });
        });
        solveLayer(layer, system);
    }

    void solveLayer(MapLayer layer, const TexelSystem& system) {
        std::vector<float>& values = made_[at_[static_cast<std::size_t>(layer)]].values;
        std::vector<Vec3> texels(met_.size());
        for (std::size_t i = 0; i < texels.size(); ++i)
            texels[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
        solveLeastSquares(system, texels, work_.parallel, work_.allocator,
                          [this](std::uint64_t done, std::uint64_t total) {
                              if (work_.progress) work_.progress("solving colors", done, total);
                          });
        for (std::size_t i = 0; i < texels.size(); ++i) set(layer, i, texels[i]);
    }

    /// Unknown texels: those that a filter reads inside a triangle and whose center ray hit something.
    const Buffer<TexelRole>& roles() {
        if (!roles_.empty()) return roles_;
        roles_ = Buffer<TexelRole>(work_.allocator, met_.size(), TexelRole::apart);
        for (std::size_t i = 0; i < roles_.size(); ++i) {
            const bool is_read = triangles_.kinds[i] == TexelCoverage::inside || triangles_.is_read[i];
            if (is_read && met_[i] == TexelState::known) roles_[i] = TexelRole::unknown;
        }
        return roles_;
    }

    static Vec3 shownBy(MapLayer layer, const ShownMaterial& shown) {
        if (layer == MapLayer::color) return shown.color;
        if (layer == MapLayer::emission) return shown.emission;
        return {1, shown.roughness, shown.metalness};
    }

    /// Computes the mean over the rays of each texel.
    void traceMeans() {
        sample_count_ = Buffer<std::uint16_t>(work_.allocator, met_.size(), std::uint16_t{0});
        const std::uint32_t n = samplingOf(options_).points;
        const SampleBands bands(uvs_.triangles(options_.wrap_u, options_.wrap_v), options_.width, options_.height, n, 0,
                                work_.allocator);
        const auto traceBand = [&](std::size_t band) {
            forHits(bands, band, [&](const GridPlace& at, const SurfaceHit& hit) {
                const std::size_t texel = std::size_t{at.row / n} * options_.width + at.column / n;
                if (sample_count_[texel] != 0xffff) addMaterial(texel, layers_.material(hit.triangle, hit.weights));
            });
        };
        forTasksTold(work_, bands.bandCount(), "colours", traceBand);
    }

    /// Updates the running mean of a texel with one more sample.
    void addMaterial(std::size_t texel, const ShownMaterial& shown) {
        const float part = 1 / static_cast<float>(++sample_count_[texel]);
        for (const MapLayer layer : {MapLayer::color, MapLayer::orm, MapLayer::emission}) {
            if (!has(layer)) continue;
            const Vec3 value = shownBy(layer, shown);
            const float* const at = made_[at_[static_cast<std::size_t>(layer)]].values.data() + 3 * texel;
            const Vec3 mean{at[0], at[1], at[2]};
            set(layer, texel, sample_count_[texel] == 1 ? value : mean + part * (value - mean));
        }
    }

    /// Returns the states of a layer's texels; means can include texels whose center ray hit nothing.
    [[nodiscard]] std::vector<TexelState> statesOf(const BakedLayer& layer) const {
        std::vector<TexelState> states(met_.begin(), met_.end());
        for (std::size_t i = 0; i < states.size(); ++i) {
            if (isMaterial(layer.layer) && hasMean(i)) states[i] = TexelState::known;
        }
        return states;
    }

    void finish(BakedLayer& layer) {
        const std::vector<TexelState> states = statesOf(layer);
        switch (layer.layer) {
            case MapLayer::height:
                spread(layer, states, layers_.height_range > 0 ? layers_.height_range : largest(layer, states), true);
                break;
            case MapLayer::curvature:
                spread(layer, states, layers_.curvature_range > 0 ? layers_.curvature_range : usual(layer, states),
                       true);
                break;
            case MapLayer::thickness:
                completeThickness(layer, states);
                break;
            case MapLayer::position:
                placeInBox(layer, states);
                break;
            case MapLayer::bent:
                break;
            default:
                clampAll(layer);
        }
        const bool is_apart = layer.layer == MapLayer::position || layer.layer == MapLayer::id;
        fillMissing(layer.values, layer.channel_count, states, triangles_.shape,
                    is_apart ? Filling::copy : Filling::mean);
        if (layer.layer == MapLayer::bent) encode(layer);
    }

    static double largest(const BakedLayer& layer, const std::vector<TexelState>& states) {
        float most = 0;
        for (std::size_t i = 0; i < states.size(); ++i) {
            if (states[i] == TexelState::known) most = std::max(most, std::fabs(layer.values[i]));
        }
        return static_cast<double>(most);
    }

    /// Assigns the full range as depth to rays that hit nothing. The default range is derived from the points where
    /// most rays hit something.
    void completeThickness(BakedLayer& layer, const std::vector<TexelState>& states) const {
        double range = layers_.thickness_range;
        for (std::size_t i = 0; layers_.thickness_range == 0 && i < states.size(); ++i) {
            const bool is_solid = states[i] == TexelState::known && solid_[i] > 0.5F;
            if (is_solid) range = std::max(range, static_cast<double>(layer.values[i]));
        }
        const auto deepest = static_cast<float>(range);
        for (std::size_t i = 0; i < states.size(); ++i)
            layer.values[i] = solid_[i] * layer.values[i] + (1 - solid_[i]) * deepest;
        spread(layer, states, range, false);
        // A range of zero means that there is no solid part at all.
        for (std::size_t i = 0; range == 0 && i < states.size(); ++i) {
            if (states[i] == TexelState::known) layer.values[i] = 1;
        }
    }

    /// Returns the 99th percentile of the absolute values.
    static double usual(const BakedLayer& layer, const std::vector<TexelState>& states) {
        std::vector<float> sizes;
        for (std::size_t i = 0; i < states.size(); ++i) {
            if (states[i] == TexelState::known) sizes.push_back(std::fabs(layer.values[i]));
        }
        if (sizes.empty()) return 0;
        const auto at = sizes.begin() + static_cast<std::ptrdiff_t>((sizes.size() - 1) * 99 / 100);
        std::nth_element(sizes.begin(), at, sizes.end());
        return *at > 0 ? *at : *std::max_element(sizes.begin(), sizes.end());
    }

    /// Maps the values from [0, range], or [-range, range] if signed, to [0, 1].
    static void spread(BakedLayer& layer, const std::vector<TexelState>& states, double range, bool is_signed) {
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

    void placeInBox(BakedLayer& layer, const std::vector<TexelState>& states) const {
        layer.least = layers_.position_least;
        layer.most = layers_.position_most;
        if (!(layer.least[0] < layer.most[0] || layer.least[1] < layer.most[1] || layer.least[2] < layer.most[2])) {
            const PositionBox box(surfaces_.high().positions);
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

    static void clampAll(BakedLayer& layer) {
        for (float& value : layer.values) value = value > 0 ? std::min(value, 1.0F) : 0.0F;
    }

    /// Encodes vectors like texels of a normal map, with all channels that a reader might use.
    void encode(BakedLayer& layer) const {
        layer.least = {-1, -1, -1};
        MapReading reading = options_.reading;
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

    /// Sets the red channel of `orm` to the occlusion.
    void setOcclusion() {
        std::vector<float>& orm = made_[at_[static_cast<std::size_t>(MapLayer::orm)]].values;
        const float* const ao =
            has(MapLayer::ao) ? made_[at_[static_cast<std::size_t>(MapLayer::ao)]].values.data() : nullptr;
        for (std::size_t i = 0; 3 * i < orm.size(); ++i) orm[3 * i] = ao != nullptr ? ao[i] : 1.0F;
    }

    const MapSurfaces& surfaces_;
    const TexelTriangles& triangles_;
    const BakeOptions& options_;
    const LayerOptions& layers_;
    const MapWork& work_;
    LowUvs uvs_;
    std::array<std::size_t, kMapLayerCount> at_ = {};  ///< index of each layer in `made_`
    std::vector<BakedLayer> made_ = {};
    Buffer<TexelState> met_ = {};  ///< texel states by the ray of each center
    bool has_material_ = false;
    Buffer<std::uint16_t> sample_count_ = {};
    Buffer<TexelRole> roles_ = {};
    Buffer<float> curvature_ = {};
    Buffer<float> solid_ = {};  ///< Occlusion::solid of each texel
};

}  // namespace

const char* layerName(MapLayer layer) {
    constexpr const char* kWords[kMapLayerCount] = {"ao",        "bent", "curvature", "height", "position",
                                                    "thickness", "id",   "color",     "orm",    "emission"};
    const auto number = static_cast<std::size_t>(layer);
    return number < kMapLayerCount ? kWords[number] : "";
}

Vec3 idColor(std::uint32_t id) {
    // Distributes the bits of the number over the channels: the three lowest bits become the highest bits of the
    // channels, and so on.
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
    std::array<bool, kMapLayerCount> is_asked{};
    for (const MapLayer layer : layers.layers) {
        const auto number = static_cast<std::size_t>(layer);
        if (number >= kMapLayerCount) return wrong("unknown layer");
        if (std::exchange(is_asked[number], true)) return wrong("the same layer was requested twice");
        if (isMaterial(layer) && !layers.material)
            return wrong("the layers color, orm and emission need the materials of the high poly");
    }
    if (layers.layers.empty() && !layers.has_normal) return wrong("no map is requested");
    if (layers.ray_count == 0 || layers.ray_count > kMostLayerRays)
        return wrong("the number of rays per point must be from 1 to 4096");
    for (const double length :
         {layers.sky_distance, layers.height_range, layers.curvature_range, layers.thickness_range}) {
        if (!std::isfinite(length) || length < 0) return wrong("ranges and distances must be finite and not negative");
    }
    if (is_asked[static_cast<std::size_t>(MapLayer::id)] && layers.ids.size() != high_triangles)
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
    // Values; states and sample counts; filling of one layer and its range; the system of one layer.
    std::uint64_t texel = layers.layers.empty() ? 0 : 1 + 2 + 12 + 4;
    const bool has_material = std::any_of(layers.layers.begin(), layers.layers.end(), isMaterial);
    if (has_material && options.fit == MapFit::solve) texel += sizeof(TexelRow) + 36 + sizeof(Vec3);
    for (const MapLayer layer : layers.layers) texel += sizeof(float) * channelsOf(layer);
    const bool has_curvature =
        std::find(layers.layers.begin(), layers.layers.end(), MapLayer::curvature) != layers.layers.end();
    // Bytes per vertex; a triangle may have three vertices of its own.
    constexpr std::uint64_t kCurvature = 3 * 64;
    return texel * options.width * options.height + (has_curvature ? kCurvature * high_triangles : 0);
}

std::vector<BakedLayer> traceLayers(const MapSurfaces& surfaces, const TexelTriangles& triangles,
                                    const BakeOptions& options, const LayerOptions& layers, const MapWork& work) {
    if (layers.layers.empty()) return {};
    return LayerTracing(surfaces, triangles, options, layers, work).run();
}

}  // namespace tspace
