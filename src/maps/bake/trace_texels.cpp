// SPDX-License-Identifier: MIT
#include "maps/bake/trace_texels.h"

#include <optional>
#include <vector>

#include "core/base/fill_rings.h"
#include "core/base/vec_math.h"
#include "maps/bake/texel_plan.h"
#include "maps/error/measure_points.h"
#include "maps/layout/uv_pieces.h"
#include "maps/solve/solve_texels.h"

namespace tspace {
namespace {

/// Minimum length of the mean of two unit vectors that count as equal: the cosine of half of kApartDeg.
constexpr float kAgreeing = 0.99985F;
constexpr double kApartDeg = 2;
/// Value of TracedTexels::owners for a texel whose center no triangle covers.
constexpr std::uint32_t kNoOwner = 0xffffffff;
/// Weight of a length error relative to a direction error.
constexpr float kAlong = 0.02F;

/// Computes the target vectors at points of triangles.
class WantedVectors {
  public:
    WantedVectors(const MapSurfaces& surfaces, const BakeOptions& options) : surfaces_(surfaces), options_(options) {}

    /// Calls take(i, is_hit, wanted) for each of at most kLinesAtOnce points, where `wanted` is the target vector.
    template <class Take>
    void at(std::span<const LowPoint> points, const Take& take) {
        std::array<DVec3, kLinesAtOnce> normals;
        surfaces_.truthsAt(points, guess_, normals);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool is_met = dot(normals[i], normals[i]) > 0;
            const Vec3 wanted = is_met ? vectorOf(points[i], normals[i]) : Vec3{};
            take(i, is_met && isDirection(wanted), wanted);
        }
    }

  private:
    Vec3 vectorOf(const LowPoint& point, const DVec3& normal) {
        if (options_.space != MapSpace::tangent) return toFloat(alongAxes(options_.axes, normal));
        if (point.triangle != triangle_) {
            triangle_ = point.triangle;
            corners_ = surfaces_.corners(triangle_, surfaces_.low().tangents);
        }
        return toFloat(vectorFor(shadingFrame(corners_, point.weights, options_.reading), normal));
    }

    const MapSurfaces& surfaces_;
    const BakeOptions& options_;
    std::uint32_t triangle_ = kNoTriangle;
    CornerFrames corners_ = {};
    double guess_ = 0;
};

FitSample sampleOf(const BakeOptions& options, const Vec3& wanted) {
    if (options.reading.two_channels) return twoChannelSample(wanted);
    // Integer texels may have any length. Real numbers need an error term for the length; otherwise they would shrink.
    return acrossSample(wanted, options.bits == 8 ? 0.0F : kAlong, kWantedLength);
}

FitSample weighted(float weight, FitSample sample) {
    for (float& part : sample.metric) part *= weight;
    sample.side = weight * sample.side;
    return sample;
}

/// Returns whether the targets of a cell come from rays.
bool isTraced(TexelCell cell) { return cell == TexelCell::sampled || cell == TexelCell::rough; }

class Tracing {
  public:
    Tracing(const MapSurfaces& surfaces, const TexelTriangles& triangles, const BakeOptions& options,
            const MapWork& work, TracedTexels& traced)
        : surfaces_(surfaces), triangles_(triangles), options_(options), work_(work), traced_(traced) {}

    void run() {
        const Allocator* const allocator = work_.allocator;
        const std::size_t texels = std::size_t{options_.width} * options_.height;
        traced_.wanted = Buffer<Vec3>(allocator, texels, Vec3{});
        traced_.origins = Buffer<TexelOrigin>(allocator, texels, TexelOrigin::background);
        votes_ = Buffer<std::uint16_t>(allocator, texels, std::uint16_t{0});
        traced_.ranks = ranksOfPieces(surfaces_.low(), options_.overlap, allocator);
        if (traced_.ranks.size() > 0) {
            traced_.owners = Buffer<std::uint32_t>(allocator, texels, kNoOwner);
            others_ = Buffer<Vec3>(allocator, texels, Vec3{});
        }
        traceInside();
        traceBeside();
    }

  private:
    void traceInside() {
        const SampleBands bands(uvTriangles(surfaces_.low().uvs, options_), options_.width, options_.height, 1, 0);
        const auto texelOf = [&](const BandSample& sample) {
            return std::size_t{sample.row} * options_.width + sample.column;
        };
        const auto traceBand = [&](std::size_t band) {
            // All samples of a texel are in the same band, so no other thread changes its owner.
            if (traced_.ranks.size() > 0) {
                bands.forSamples(band, [&](const BandSample& sample) {
                    std::uint32_t& owner = traced_.owners[texelOf(sample)];
                    owner = std::min(owner, traced_.ranks[sample.triangle]);
                });
            }
            WantedVectors vectors(surfaces_, options_);
            const auto query = [&](std::span<const LowPoint> points, std::span<const std::size_t> texels) {
                vectors.at(points, [&](std::size_t i, bool is_hit, const Vec3& wanted) {
                    if (counts(texels[i], points[i].triangle)) {
                        vote(texels[i], is_hit, wanted);
                    } else if (is_hit) {
                        others_[texels[i]] = others_[texels[i]] + wanted;
                    }
                });
            };
            queryInBatches<std::size_t>(query, [&](auto& together) {
                bands.forSamples(band, [&](const BandSample& sample) {
                    together.add({sample.triangle, sample.weights()}, texelOf(sample));
                });
            });
        };
        forTasksWithProgress(work_, bands.bandCount(), "tracing", traceBand);
        decideVotes();
    }

    /// Returns whether a triangle contributes to a texel. The rank of its UV island decides this.
    [[nodiscard]] bool counts(std::size_t texel, std::uint32_t triangle) const {
        return traced_.ranks.size() == 0 || traced_.owners[texel] == traced_.ranks[triangle];
    }

    void vote(std::size_t texel, bool is_hit, const Vec3& wanted) {
        TexelOrigin& origin = traced_.origins[texel];
        if (origin != TexelOrigin::hit) origin = is_hit ? TexelOrigin::hit : TexelOrigin::missed;
        if (!is_hit || votes_[texel] == 0xffff) return;
        traced_.wanted[texel] = traced_.wanted[texel] + wanted;
        ++votes_[texel];
    }

    void decideVotes() {
        for (std::size_t i = 0; i < votes_.size(); ++i) {
            if (votes_[i] == 0) continue;
            const float size = length(traced_.wanted[i]);
            if (triangles_.overlaps[i] && size < kAgreeing * static_cast<float>(votes_[i]))
                countConflict(anglePairOf(size / static_cast<float>(votes_[i])));
            DVec3 mean = toDouble(traced_.wanted[i]);
            traced_.wanted[i] = normalize(mean) ? toFloat(mean) : Vec3{};
            if (others_.size() == 0 || isZero(others_[i])) continue;
            const double apart = degreesBetween(toDouble(traced_.wanted[i]), toDouble(others_[i]));
            if (apart > kApartDeg) countConflict(apart);
        }
    }

    void countConflict(double degrees) {
        ++traced_.conflict_count;
        traced_.conflict_sum_deg += degrees;
        traced_.conflict_max_deg = std::max(traced_.conflict_max_deg, degrees);
    }

    /// Returns the angle in degrees between two unit vectors, given the length of their mean.
    static double anglePairOf(float mean_length) {
        const double cosine = std::min(1.0, static_cast<double>(mean_length));
        return 2 * polarAngle(cosine, std::sqrt(1 - cosine * cosine)) * (180 / kPi);
    }

    void traceBeside() {
        const TextureShape& shape = triangles_.shape;
        const UvTriangles triangles = uvTriangles(surfaces_.low().uvs, options_);
        constexpr std::size_t kRows = 8;
        const auto trace = [&](std::size_t task) {
            WantedVectors vectors(surfaces_, options_);
            const auto query = [&](std::span<const LowPoint> points, std::span<const std::size_t> texels) {
                vectors.at(points, [&](std::size_t i, bool is_hit, const Vec3& wanted) {
                    if (is_hit) traced_.wanted[texels[i]] = wanted;
                });
            };
            queryInBatches<std::size_t>(query, [&](auto& together) {
                const std::size_t end = std::min<std::size_t>((task + 1) * kRows * shape.width, votes_.size());
                for (std::size_t texel = task * kRows * shape.width; texel < end; ++texel) {
                    if (triangles_.kinds[texel] != TexelCoverage::adjacent ||
                        traced_.origins[texel] != TexelOrigin::background)
                        continue;
                    const TexelPlace& place = triangles_.places[texel];
                    traced_.origins[texel] = TexelOrigin::padding;
                    together.add({place.triangle, weightsAt(triangles, shape, place)}, texel);
                }
            });
        };
        const std::size_t tasks = (shape.height + kRows - 1) / kRows;
        forTasksWithProgress(work_, tasks, "padding", trace);
    }

    const MapSurfaces& surfaces_;
    const TexelTriangles& triangles_;
    const BakeOptions& options_;
    const MapWork& work_;
    TracedTexels& traced_;
    Buffer<std::uint16_t> votes_ = {};
    Buffer<Vec3> others_ = {};  ///< with ranks: sums of the target vectors of UV islands that do not own the texel
};

}  // namespace

void traceTexels(const MapSurfaces& surfaces, const TexelTriangles& triangles, const BakeOptions& options,
                 const MapWork& work, TracedTexels& traced) {
    Tracing(surfaces, triangles, options, work, traced).run();
}

namespace {

/// Weight that each adjacent cell adds to the sample at a texel center, relative to other samples. If the other samples
/// are at 1/4 and 3/4 between centers, the centers are sampled too: with this weight, the integral over a cell of the
/// square of any linear function is exact.
constexpr float kCornerOfCell = 0.125F;

void addCenters(const TracedTexels& traced, const TexelPlan& plan, const TexelWindow& window,
                const BakeOptions& options, Parallel& parallel, TexelSystem& system) {
    const std::size_t width = plan.width;
    parallel.forRanges(window.count, 8, [&](std::size_t begin, std::size_t end) {
        for (auto row = static_cast<std::uint32_t>(begin); row < end; ++row) {
            const std::size_t y = window.inImage(row), here = y * width,
                              above = (y > 0 ? y - 1 : plan.height - 1) * width;
            for (std::uint32_t x = 0; x < plan.width; ++x) {
                if (traced.origins[here + x] != TexelOrigin::hit) continue;
                const std::uint32_t left = system.left(x);
                float weight = 0;
                for (const std::size_t cell : {here + x, here + left, above + x, above + left})
                    weight += isTraced(plan.cells[cell]) ? kCornerOfCell : 0;
                if (weight > 0) system.add(x, row, 0, 0, weighted(weight, sampleOf(options, traced.wanted[here + x])));
            }
        }
    });
}

}  // namespace

std::vector<std::size_t> bandsOf(const TexelWindow& window) {
    constexpr std::uint32_t kRows = SampleBands::kBandTexels;
    std::vector<std::size_t> bands;
    for (std::uint32_t begin = 0; begin < window.height; begin += kRows) {
        bool has = false;
        for (std::uint32_t y = begin; y < std::min(begin + kRows, window.height); ++y) has = has || window.hasCells(y);
        if (has) bands.push_back(begin / kRows);
    }
    return bands;
}

void traceBetween(const MapSurfaces& surfaces, const TracedTexels& traced, const TexelPlan& plan,
                  const TexelWindow& window, const PointsBetween& points, const BakeOptions& options,
                  const MapWork& work, ProgressSteps& steps, TexelSystem& system) {
    // A sample is used only if the UV island of its triangle owns the nearest texel, or if no island owns it.
    const auto counts = [&](std::uint32_t triangle, const BetweenTexels& x, const BetweenTexels& y) {
        if (traced.ranks.size() == 0) return true;
        const std::size_t column = x.part < 0.5F ? x.texel : system.right(x.texel),
                          row = y.part < 0.5F ? y.texel : (y.texel + 1) % plan.height;
        const std::uint32_t owner = traced.owners[row * options.width + column];
        return owner == kNoOwner || owner == traced.ranks[triangle];
    };
    const auto traceBand = [&](std::size_t band) {
        struct Place {
            BetweenTexels x = {}, y = {};
        };
        WantedVectors vectors(surfaces, options);
        const auto query = [&](std::span<const LowPoint> batch, std::span<const Place> places) {
            vectors.at(batch, [&](std::size_t i, bool is_hit, const Vec3& wanted) {
                const auto& [x, y] = places[i];
                if (is_hit) system.add(x.texel, window.local(y.texel), x.part, y.part, sampleOf(options, wanted));
            });
        };
        queryInBatches<Place>(query, [&](auto& together) {
            points.bands.forSamples(band, [&](const BandSample& sample) {
                const BetweenTexels x = betweenTexels(sample.column, points.n, options.width, options.wrap_u),
                                    y = betweenTexels(sample.row, points.n, options.height, options.wrap_v);
                const TexelCell cell = plan.cells[std::size_t{y.texel} * options.width + x.texel];
                if (isTraced(cell) && window.hasCells(y.texel) && counts(sample.triangle, x, y))
                    together.add({sample.triangle, sample.weights()}, {x, y});
            });
        });
    };
    const std::vector<std::size_t> bands = bandsOf(window);
    // Adjacent bands share a row of texels, so they must not be processed at the same time.
    forNonAdjacent(bands.size(), [&](std::size_t begin, std::size_t number) {
        forTasksWithProgress(work, number, "solving", steps, [&](std::size_t i) { traceBand(bands[begin + 2 * i]); });
        steps.before += number;
    });
    if (points.n == 2) addCenters(traced, plan, window, options, work.parallel, system);
}

void addSmoothCells(const TexelPlan& plan, const TexelWindow& window, std::span<const Vec3> texels,
                    std::uint32_t points, const BakeOptions& options, Parallel& parallel, TexelSystem& system) {
    // The total weight equals that of a cell sampled by rays.
    const float weight = points == 2 ? 1 + kCornerOfCell : static_cast<float>(points * points) / 4;
    const auto unitSample = [&](const Vec3& mixed) {
        return weighted(weight, sampleOf(options, (1 / length(mixed)) * mixed));
    };
    forNonAdjacentRows(parallel, window.count, [&](std::uint32_t row) {
        const std::uint32_t y = window.inImage(row);
        if (!window.hasCells(y)) return;
        for (std::uint32_t x = 0; x < plan.width; ++x) {
            if (plan.cells[std::size_t{y} * plan.width + x] == TexelCell::smooth)
                addCell(x, row, texels, unitSample, system);
        }
    });
}

void fillFromNeighbors(TracedTexels& traced, const TextureShape& shape) {
    Buffer<Vec3>& wanted = traced.wanted;
    std::vector<bool> is_missing(wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i)
        is_missing[i] = traced.origins[i] != TexelOrigin::background && isZero(wanted[i]);
    // The first ring is extrapolated from the two nearest texels in each direction, because filtering at the rim of a
    // chart reads it. Farther rings use the mean of their neighbors, which cannot overshoot.
    bool is_first_ring = true;
    const auto meanAround = [&](std::size_t texel) -> std::optional<Vec3> {
        const auto at = [&](int dx, int dy) { return toDouble(wanted[texelBeside(shape, texel, dx, dy)]); };
        DVec3 sum{}, ahead{};
        for (const int dy : {-1, 0, 1}) {
            for (const int dx : {-1, 0, 1}) {
                const DVec3 near = at(dx, dy), far = at(2 * dx, 2 * dy);
                sum = sum + near;
                // Extrapolation across a discontinuity is avoided.
                if (dot(near, far) > 0.9) ahead = ahead + (2.0 * near - far);
            }
        }
        if (is_first_ring && normalize(ahead)) return toFloat(ahead);
        return normalize(sum) ? std::optional(toFloat(sum)) : std::nullopt;
    };
    fillRings(
        is_missing, [&](std::size_t texel, const auto& visit) { forTexelsAround(shape, texel, visit); }, meanAround,
        [&](std::size_t texel, const Vec3& mean) {
            wanted[texel] = mean;
            is_first_ring = false;
        });
    for (Vec3& vector : wanted) {
        if (isZero(vector)) vector = {0, 0, 1};
    }
}

}  // namespace tspace
