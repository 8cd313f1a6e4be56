// SPDX-License-Identifier: MIT
#include "maps/trace_texels.h"

#include "maps/sample_bands.h"

namespace tspace {

namespace {

constexpr std::uint32_t kGrid = 3;  // samples of a texel in a row
/// The cosine of half of two degrees: how short the mean of two unit vectors may be.
constexpr float kAgreeing = 0.99985F;
/// How much an error of the length counts beside one of the direction.
constexpr float kAlong = 0.02F;
/// Below 1, so that no channel of a texel around has to be more.
constexpr float kWantedLength = 0.98F;

class Tracing {
  public:
    Tracing(const MapSurfaces& surfaces, const TexelTriangles& triangles, const BakeOptions& options,
            Parallel& parallel, TracedTexels& traced, TexelSystem* system)
        : surfaces_(surfaces),
          triangles_(triangles),
          options_(options),
          parallel_(parallel),
          traced_(traced),
          system_(system),
          uvs_(surfaces.low(), options.execution.allocator) {}

    bool run() {
        const Allocator* const allocator = options_.execution.allocator;
        const std::size_t texels = std::size_t{options_.width} * options_.height;
        traced_.wanted = Buffer<Vec3>(allocator, texels, Vec3{});
        traced_.origins = Buffer<TexelOrigin>(allocator, texels, TexelOrigin::background);
        votes_ = Buffer<std::uint16_t>(allocator, texels, std::uint16_t{0});
        return traceInside() && traceBeside();
    }

  private:
    bool traceInside() {
        const std::uint32_t n = system_ != nullptr ? kGrid : 1;
        const Allocator* const allocator = options_.execution.allocator;
        const SampleBands bands(uvs_.triangles(), options_.width, options_.height, n, (n - 1) / 2, allocator);
        if (system_ != nullptr) spills_ = Buffer<TexelRow>(allocator, bands.bandCount() * options_.width, TexelRow{});
        const auto trace = [&](std::size_t band) { traceBand(bands, band, n); };
        if (!forTasksTold(parallel_, bands.bandCount(), "tracing", options_.progress, options_.stop, trace))
            return false;
        // What the last samples of a band ask of the row after it.
        for (std::size_t band = 0; system_ != nullptr && band < bands.bandCount(); ++band) {
            const auto next = static_cast<std::uint32_t>((band + 1) * SampleBands::kBandTexels);
            TexelRow* const row = system_->row(next < options_.height ? next : 0);
            for (std::uint32_t x = 0; x < options_.width; ++x) row[x].add(spills_[band * options_.width + x]);
        }
        settleVotes();
        return true;
    }

    void traceBand(const SampleBands& bands, std::size_t band, std::uint32_t n) {
        const std::uint32_t grid_width = options_.width * n, shift = (n - 1) / 2;
        const std::size_t first_row = band * SampleBands::kBandTexels;
        double guess = 0;
        std::uint32_t triangle = kNoTriangle;
        CornerFrames corners;
        bands.forSamples(band, [&](const BandSample& sample) {
            if (sample.triangle != triangle) {
                triangle = sample.triangle;
                corners = surfaces_.corners(triangle, surfaces_.low().tangents);
            }
            const std::uint32_t column = (sample.column + grid_width - shift) % grid_width;
            const std::uint32_t x = column / n, x_part = column % n;
            const auto row = static_cast<std::uint32_t>(sample.row);
            const std::uint32_t y = row / n, y_part = row % n;
            const std::size_t texel = (first_row + y) * options_.width + x;
            const bool is_centre = x_part == 0 && y_part == 0;
            Vec3 wanted;
            const bool is_hit = wantedAt(corners, triangle, sample.weights, guess, wanted);
            if (is_centre) vote(texel, is_hit, wanted);
            if (!is_hit || system_ == nullptr) return;
            TexelRow* const next = y + 1 < bands.rowCount(band)
                                       ? system_->row(static_cast<std::uint32_t>(first_row) + y + 1)
                                       : spills_.data() + band * options_.width;
            addSample(system_->row(static_cast<std::uint32_t>(first_row) + y), next, x, system_->right(x),
                      static_cast<float>(x_part) / static_cast<float>(n),
                      static_cast<float>(y_part) / static_cast<float>(n), sampleOf(wanted));
        });
    }

    [[nodiscard]] FitSample sampleOf(const Vec3& wanted) const {
        if (options_.reading.two_channels) return twoChannelSample(wanted);
        // Integers are chosen with any length; real numbers would shrink.
        return acrossSample(wanted, options_.bits == 8 ? 0.0F : kAlong, kWantedLength);
    }

    void vote(std::size_t texel, bool is_hit, const Vec3& wanted) {
        TexelOrigin& origin = traced_.origins[texel];
        if (origin != TexelOrigin::hit) origin = is_hit ? TexelOrigin::hit : TexelOrigin::missed;
        if (!is_hit || votes_[texel] == 0xffff) return;
        traced_.wanted[texel] = traced_.wanted[texel] + wanted;
        ++votes_[texel];
    }

    void settleVotes() {
        for (std::size_t i = 0; i < votes_.size(); ++i) {
            if (votes_[i] == 0) continue;
            const float size = length(traced_.wanted[i]);
            if (size < kAgreeing * static_cast<float>(votes_[i])) ++traced_.conflict_count;
            DVec3 mean = toDouble(traced_.wanted[i]);
            traced_.wanted[i] = normalize(mean) ? toFloat(mean) : Vec3{};
        }
    }

    bool traceBeside() {
        const TextureShape& shape = triangles_.shape;
        constexpr std::size_t kRows = 8;
        const auto trace = [&](std::size_t task) {
            double guess = 0;
            const std::size_t end = std::min<std::size_t>((task + 1) * kRows * shape.width, votes_.size());
            for (std::size_t texel = task * kRows * shape.width; texel < end; ++texel) {
                if (triangles_.kinds[texel] != TexelKind::beside || traced_.origins[texel] != TexelOrigin::background)
                    continue;
                const TexelPlace& place = triangles_.places[texel];
                traced_.origins[texel] = TexelOrigin::padding;
                Vec3 wanted;
                const CornerFrames corners = surfaces_.corners(place.triangle, surfaces_.low().tangents);
                if (wantedAt(corners, place.triangle, weightsAt(uvs_.triangles(), shape, place), guess, wanted))
                    traced_.wanted[texel] = wanted;
            }
        };
        const std::size_t tasks = (shape.height + kRows - 1) / kRows;
        return forTasksTold(parallel_, tasks, "padding", options_.progress, options_.stop, trace);
    }

    bool wantedAt(const CornerFrames& corners, std::uint32_t triangle, const std::array<double, 3>& weights,
                  double& guess, Vec3& wanted) const {
        DVec3 normal;
        if (!surfaces_.truthAt(triangle, weights, guess, normal)) return false;
        if (options_.space == MapSpace::tangent)
            normal = vectorFor(shadingFrame(corners, weights, options_.reading), normal);
        wanted = toFloat(normal);
        return isDirection(wanted);
    }

    const MapSurfaces& surfaces_;
    const TexelTriangles& triangles_;
    const BakeOptions& options_;
    Parallel& parallel_;
    TracedTexels& traced_;
    TexelSystem* system_;
    LowUvs uvs_;
    Buffer<std::uint16_t> votes_ = {};
    Buffer<TexelRow> spills_ = {};
};

}  // namespace

bool traceTexels(const MapSurfaces& surfaces, const TexelTriangles& triangles, const BakeOptions& options,
                 Parallel& parallel, TracedTexels& traced, TexelSystem* system) {
    return Tracing(surfaces, triangles, options, parallel, traced, system).run();
}

void fillFromNeighbours(TracedTexels& traced, std::uint32_t width, std::uint32_t height) {
    Buffer<Vec3>& wanted = traced.wanted;
    std::vector<std::size_t> empty, next;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (traced.origins[i] != TexelOrigin::background && isZero(wanted[i])) empty.push_back(i);
    }
    const auto meanAround = [&](std::size_t texel) {
        const std::size_t x = texel % width, y = texel / width;
        DVec3 sum{};
        for (std::size_t dy = 0; dy < 3; ++dy) {
            for (std::size_t dx = 0; dx < 3; ++dx) {
                const std::size_t row = (y + height + dy - 1) % height, column = (x + width + dx - 1) % width;
                sum = sum + toDouble(wanted[row * width + column]);
            }
        }
        return normalize(sum) ? toFloat(sum) : Vec3{};
    };
    std::vector<Vec3> means;
    while (!empty.empty()) {
        means.clear();
        for (const std::size_t texel : empty) means.push_back(meanAround(texel));
        next.clear();
        for (std::size_t i = 0; i < empty.size(); ++i) {
            wanted[empty[i]] = means[i];
            if (isZero(means[i])) next.push_back(empty[i]);
        }
        if (next.size() == empty.size()) break;
        empty.swap(next);
    }
    for (Vec3& vector : wanted) {
        if (isZero(vector)) vector = {0, 0, 1};
    }
}

}  // namespace tspace
