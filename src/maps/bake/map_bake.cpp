// SPDX-License-Identifier: MIT
#include "tspace/maps.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/border.h"
#include "maps/bake/solve_strips.h"
#include "maps/bake/texel_plan.h"
#include "maps/bake/trace_layers.h"
#include "maps/bake/trace_texels.h"
#include "maps/rays/map_surfaces.h"
#include "maps/rays/missed_cause.h"
#include "maps/solve/choose_lengths.h"
#include "maps/solve/solve_texels.h"
#include "maps/texels/quantize.h"

namespace tspace {
namespace {

constexpr std::uint32_t kMostSide = 16384;
constexpr std::uint32_t kMostPadding = 256;
/// Distance, in texels, within which the bilinear filter reads texels around a triangle for points inside it.
constexpr std::uint32_t kFilterTexels = 2;

class Baking {
  public:
    /// `layers`: layers to bake in addition to the normal map. `shared`: null, or receives the ray structure of the
    /// high poly. With null, a map without any hit is an error; otherwise such a map stays empty.
    Baking(const LowPoly& low, const HighPoly& high, const BakeOptions& options, const LayerOptions& layers,
           const Execution& execution, const Progress& progress, SharedRays* shared)
        : low_(low), high_(high), options_(options), layers_(layers), shared_(shared), allocator_(execution.allocator),
          parallel_(execution), work_{execution.allocator, parallel_, progress} {}

    Result<BakedMaps> run() {
        Result<MapSurfaces> surfaces = MapSurfaces::make(low_, high_, options_.reach, options_.rays, parallel_,
                                                         allocator_, shared_ == nullptr ? nullptr : shared_->surface);
        if (!surfaces) return std::move(surfaces).error();
        if (shared_ != nullptr) shared_->surface = surfaces->surface();
        reportStage("tracing");
        const std::uint32_t padding = std::max(options_.padding, kFilterTexels);
        std::optional<TexelTriangles> triangles = findTexelTriangles(uvTriangles(low_.uvs, options_), options_.width,
                                                                     options_.height, padding, parallel_, allocator_);
        if (!triangles)
            return makeError(ErrorCode::tooLarge, kNoElement,
                             "the UVs of the low poly cover the image too many times; scale them down");
        if (triangles->counts.inside == 0)
            return makeError(ErrorCode::missingAttribute, kNoElement,
                             "the UVs of the low poly cover no texel of the map");
        traceTexels(*surfaces, *triangles, options_, work_, traced_);
        reportStage("tracing", 1);
        countOrigins(*triangles);
        if (map_.hit_count == 0 && shared_ == nullptr)
            return makeError(ErrorCode::missingAttribute, kNoElement, "no ray from the low poly hits the high poly");
        std::vector<BakedLayer> made;
        if (map_.hit_count > 0) made = traceLayers(*surfaces, *triangles, options_, layers_, work_);
        if (map_.hit_count == 0 || !layers_.has_normal) return BakedMaps{withoutTexels(*surfaces), std::move(made)};
        fillFromNeighbors(traced_, triangles->shape);
        if (solves()) {
            solve(*surfaces, *triangles);
        } else {
            reportStage("rounding");
            if (options_.bits == 8) takeNearest();
        }
        writeTexels();
        return BakedMaps{measured(*surfaces), std::move(made)};
    }

  private:
    [[nodiscard]] bool solves() const {
        return options_.fit == MapFit::solve && std::min(options_.width, options_.height) >= kLeastSolved;
    }

    void countOrigins(const TexelTriangles& triangles) {
        for (const TexelOrigin origin : traced_.origins) {
            map_.hit_count += origin == TexelOrigin::hit ? 1 : 0;
            map_.missed_count += origin == TexelOrigin::missed ? 1 : 0;
            map_.padding_count += origin == TexelOrigin::padding ? 1 : 0;
        }
        map_.overlaps.assign(triangles.overlaps.begin(), triangles.overlaps.end());
        map_.overlap_count = triangles.counts.overlapping;
        map_.conflict_count = traced_.conflict_count;
        map_.conflict_max_deg = traced_.conflict_max_deg;
        if (map_.conflict_count > 0)
            map_.conflict_mean_deg = traced_.conflict_sum_deg / static_cast<double>(map_.conflict_count);
        map_.degenerate_uv_count =
            triangles.counts.without_area + triangles.counts.not_finite + triangles.counts.too_far;
    }

    BakedMap withoutTexels(const MapSurfaces& surfaces) {
        map_.width = options_.width;
        map_.height = options_.height;
        map_.bits = options_.bits;
        map_.error.reach = surfaces.reach();
        map_.error.cage_offset = surfaces.cageOffset();
        map_.origins.assign(traced_.origins.begin(), traced_.origins.end());
        return std::move(map_);
    }

    void reportStage(const char* what, std::uint64_t done = 0, std::uint64_t total = 1) const {
        if (work_.progress) work_.progress(what, done, total);
    }

    /// Solves the texels. Releases the memory of `triangles` before the system is allocated.
    void solve(const MapSurfaces& surfaces, TexelTriangles& triangles) {
        const bool has_integers = options_.bits == 8;
        const CellSampling sampling = samplingOf(options_);
        const TexelPlan plan = planTexels(traced_, triangles, sampling.tolerance, has_integers, parallel_, allocator_);
        triangles = {};
        solveInStrips(surfaces, plan, sampling.points, options_, work_, traced_);
        reportStage("rounding");
        if (has_integers) return;
        const std::span<Vec3> texels(traced_.wanted.data(), traced_.wanted.size());
        // Background texels are skipped here, and rounded when the map is written.
        Buffer<bool> background(allocator_, texels.size(), false);
        for (std::size_t i = 0; i < texels.size(); ++i) background[i] = traced_.origins[i] == TexelOrigin::background;
        StepCallback report_row;
        if (work_.progress)
            report_row = [&](std::uint64_t done, std::uint64_t total) { reportStage("rounding", done, total); };
        roundTexels(texels, options_.width,
                    {.keeps_lengths = options_.reading.two_channels, .keeps = {background.data(), background.size()}},
                    parallel_, allocator_, report_row);
        if (options_.reading.two_channels) completeThirds(texels);
    }

    /// Recomputes z of unit vectors from x and y. Keeps z where (x, y) is longer than 1.
    void completeThirds(std::span<Vec3> texels) {
        for (Vec3& texel : texels) {
            const float flat = texel.x * texel.x + texel.y * texel.y;
            if (flat <= 1) texel.z = std::sqrt(1 - flat);
        }
    }

    void takeNearest() {
        const IntegerVectors numbers{.least_length = static_cast<double>(integerChoice(options_.lengths).least_length),
                                     .is_two_channel = options_.reading.two_channels};
        Buffer<Vec3>& texels = traced_.wanted;
        parallel_.forRanges(texels.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                texels[i] = toFloat(nearestIntegers(numbers, toDouble(texels[i])));
        });
    }

    void writeTexels() {
        map_.width = options_.width;
        map_.height = options_.height;
        map_.bits = options_.bits;
        map_.texels.resize(traced_.wanted.size());
        const double most = options_.bits == 8 ? 255 : 65535;
        parallel_.forRanges(map_.texels.size(), Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
            const auto rounded = [&](double channel) {
                return static_cast<float>(std::floor(std::clamp(channel, 0.0, 1.0) * most + 0.5) / most);
            };
            for (std::size_t i = begin; i < end; ++i) {
                const DVec3 texel = encodeTexel(toDouble(traced_.wanted[i]), options_.reading);
                map_.texels[i] = {rounded(texel.x), rounded(texel.y), rounded(texel.z)};
            }
        });
        map_.origins.assign(traced_.origins.begin(), traced_.origins.end());
    }

    BakedMap measured(const MapSurfaces& surfaces) {
        reportStage("measuring");
        if (options_.rays.target == RayTarget::outermost || !low_.cage.empty()) {
            map_.error = errorAgainst(surfaces, options_.heat);
            return std::move(map_);
        }
        map_.own_error = errorAgainst(surfaces, false);
        reportStage("measuring");
        RayOptions seen = options_.rays;
        seen.target = RayTarget::outermost;
        map_.error = errorAgainst(surfaces.withRays(seen, 0, parallel_, allocator_), options_.heat);
        return std::move(map_);
    }

    MapError errorAgainst(const MapSurfaces& surfaces, bool heat) {
        const MeasurePoints points = MeasurePoints::spread(surfaces, MapErrorOptions{}.point_count, work_);
        const MapImage image{map_.width, map_.height, map_.texels, options_.wrap_u, options_.wrap_v};
        const MapCandidate candidate{.space = options_.space, .reading = options_.reading, .axes = options_.axes};
        MapError error = points.measure(image, surfaces, candidate, parallel_);
        if (heat) error.heat = heatOf(image, surfaces, candidate, work_);
        return error;
    }

    LowPoly low_;
    HighPoly high_;
    const BakeOptions& options_;
    const LayerOptions& layers_;
    SharedRays* shared_;
    const Allocator* allocator_;
    Parallel parallel_;
    MapWork work_;
    TracedTexels traced_ = {};
    BakedMap map_ = {};
};

/// Returns whether the axes are finite, orthogonal and of unit length, within a rounding tolerance.
bool areAxes(const MapAxes& axes) {
    constexpr double kSame = 1e-4;
    const DVec3 all[3] = {toDouble(axes.x), toDouble(axes.y), toDouble(axes.z)};
    for (std::size_t i = 0; i < 3; ++i) {
        if (!(std::fabs(dot(all[i], all[i]) - 1) < kSame) || !(std::fabs(dot(all[i], all[(i + 1) % 3])) < kSame))
            return false;
    }
    return true;
}

}  // namespace

Error checkBakeOptions(const BakeOptions& options, std::size_t low_triangles, std::size_t high_triangles) {
    const auto wrong = [](const char* what) { return makeError(ErrorCode::invalidOption, kNoElement, "%s", what); };
    if (options.width == 0 || options.height == 0 || options.width > kMostSide || options.height > kMostSide)
        return makeError(ErrorCode::invalidOption, kNoElement,
                         "the width and height of a map must be from 1 to %u texels", kMostSide);
    if (options.bits != 8 && options.bits != 16) return wrong("the number of bits per channel must be 8 or 16");
    if (options.padding > kMostPadding) return wrong("the padding must not exceed 256 texels");
    if (options.reading.scale != 1) return wrong("the scale of the map must be 1 when a map is baked");
    if (!areAxes(options.axes))
        return wrong("the axes of a map must have unit length and be perpendicular to each other");
    if (options.space == MapSpace::object && options.reading.two_channels)
        return wrong("normals in object space need three channels");
    if (Error error = checkRays(options.rays, options.reach); error.code != ErrorCode::ok) return error;
    const std::uint64_t bytes = bakeBytes(low_triangles, high_triangles, options);
    if (options.memory_limit_bytes != 0 && bytes > options.memory_limit_bytes) {
        return makeError(ErrorCode::tooLarge, kNoElement,
                         "a map of %u x %u texels needs %zu MB of memory, but the limit is %zu MB", options.width,
                         options.height, static_cast<std::size_t>(bytes >> 20),
                         static_cast<std::size_t>(options.memory_limit_bytes >> 20));
    }
    return {ErrorCode::ok};
}

std::uint64_t bakeBytes(std::uint64_t low_triangles, std::uint64_t high_triangles, const BakeOptions& options) {
    // Bytes per texel: triangles, target vectors with votes, and the result. For texels of a strip also the system and
    // the memory for solving it.
    constexpr std::uint64_t kPlain = 26 + 16 + 13, kStrip = sizeof(TexelRow) + 60 + 24, kHeat = 6;
    const std::uint64_t texel = kPlain + (options.heat ? kHeat : 0);
    const std::uint64_t strip_rows = std::min(options.height, kStripRows + 2 * (kRowsAround + 1));
    const std::uint64_t strip = options.fit == MapFit::solve ? kStrip * options.width * strip_rows : 0;
    // Bytes per triangle for ray directions and the bounding boxes of Embree, and bytes for measured points.
    constexpr std::uint64_t kLow = 120 + 400, kHigh = 200, kPoints = 100000 * 64;
    return texel * options.width * options.height + strip + kLow * low_triangles + kHigh * high_triangles + kPoints;
}

namespace {

Result<BakedMaps> bake(const LowPoly& low, const HighPoly& high, const BakeOptions& options, const LayerOptions& layers,
                       const Execution& execution, const Progress& progress, SharedRays* shared) {
    return atBorder([&]() -> Result<BakedMaps> {
        const std::size_t high_triangles = high.corners.size() / 3;
        Error error = checkBakeOptions(options, low.positions.count / 3, high_triangles);
        if (error.code == ErrorCode::ok) error = checkLayers(layers, options, low.positions.count / 3, high_triangles);
        if (error.code == ErrorCode::ok) error = checkSurfaces(low, high, options.space == MapSpace::tangent);
        if (error.code != ErrorCode::ok) return error;
        return Baking(low, high, options, layers, execution, progress, shared).run();
    });
}

Result<BakedMap> normalMapOf(Result<BakedMaps> maps) {
    if (!maps) return std::move(maps).error();
    return std::move(maps->normal);
}

}  // namespace

Result<BakedMap> bakeMap(const LowPoly& low, const HighPoly& high, const BakeOptions& options,
                         const Execution& execution, const Progress& progress) {
    return normalMapOf(bake(low, high, options, {}, execution, progress, nullptr));
}

Result<BakedMaps> bakeMaps(const LowPoly& low, const HighPoly& high, const BakeOptions& options,
                           const LayerOptions& layers, const Execution& execution, const Progress& progress) {
    return bake(low, high, options, layers, execution, progress, nullptr);
}

Result<BakedMaps> bakeAllowingMisses(const LowPoly& low, const HighPoly& high, const BakeOptions& options,
                                     const LayerOptions& layers, const Execution& execution, const Progress& progress,
                                     SharedRays& shared) {
    return bake(low, high, options, layers, execution, progress, &shared);
}

}  // namespace tspace
