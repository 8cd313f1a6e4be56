// SPDX-License-Identifier: MIT
// Finds hard edges of a mesh without normals, in these steps:
//
//   1. makeFaces: normals of faces
//   2. measureAngles: dihedral angles, and their histogram
//   3. filterNormals: face normals without noise, if the angles show that there may be some
//   4. angleInGap: the angle from which edges are hard
//   5. markEdges: the kind of each edge; single gaps and single hard edges are removed
#include "core/estimate/creases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/base/mesh_loops.h"
#include "core/base/vec_math.h"
#include "core/estimate/denoise.h"

namespace tspace {
namespace {

constexpr std::uint32_t kNoPair = ~std::uint32_t{0};
constexpr double kLeastFilteredDeg = 3, kLoudDeg = 12, kLouderDeg = 30;
/// Maximum angle, in degrees, by which noise with a standard deviation of one edge length rotates edges.
constexpr double kMostTurnOfNoise = 183;
constexpr int kBins = 180;

/// For each edge with exactly two faces: maps the corner on one side to the corner on the other side.
class EdgePairs {
  public:
    explicit EdgePairs(const NormalsCall& call)
        : call_(call), others_(call.allocator, call.mesh.cornerCount(), kNoPair) {
        const auto forHalves = [&](const auto& add) {
            forEachFace(call.mesh, [&](std::size_t, std::size_t first, std::uint32_t size) {
                if (size < 3) return;
                const auto begin = static_cast<std::uint32_t>(first), last = begin + size - 1;
                std::uint32_t from = call.items.pointOf(last);
                for (std::uint32_t c = begin, corner = last; c <= last; corner = c++) {
                    const std::uint32_t to = call.items.pointOf(c);
                    if (from != to) add(std::min(from, to), std::max(from, to), corner);
                    from = to;
                }
            });
        };
        forEachEdge(call.mesh.vertexCount(), call.allocator, forHalves,
                    [&](std::uint32_t, std::uint32_t, std::span<const HalfEdge> halves) {
                        has_crowded_ = has_crowded_ || halves.size() > 2;
                        if (halves.size() != 2) return;
                        const std::uint32_t a = cornerOf(halves[0]), b = cornerOf(halves[1]);
                        others_[a] = b;
                        others_[b] = a;
                    });
    }

    [[nodiscard]] std::uint32_t other(std::size_t corner) const { return others_[corner]; }
    [[nodiscard]] bool hasCrowdedEdges() const { return has_crowded_; }

    struct Ends {
        std::uint32_t low, high;  ///< points at the ends of the edge
    };
    [[nodiscard]] Ends endsOf(std::uint32_t corner) const {
        const std::uint32_t a = call_.items.pointOf(corner), b = call_.items.pointOf(call_.faces.next(corner));
        return {std::min(a, b), std::max(a, b)};
    }

  private:
    const NormalsCall& call_;
    Buffer<std::uint32_t> others_;
    bool has_crowded_ = false;
};

Float4 toFloat4(const DVec3& v) {
    return Float4{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0};
}

/// Approximates exp(-x) for x >= 0; 0 from 16 on. Avoids library functions whose last bits differ between C libraries.
Float4 decay(Float4 x) {
    Float4 y = max4(splat(1.0f) - x * splat(1.0f / 16), splat(0.0f));
    for (int i = 0; i < 4; ++i) y *= y;
    return y;
}

/// Columns of four rows that are transposed: three vector components, and the fourth component.
struct Columns {
    Vec3x4 vectors;
    Float4 fourths;

    Columns(Float4 a, Float4 b, Float4 c, Float4 d) : vectors{a, b, c}, fourths(d) {
        transpose4(vectors.x, vectors.y, vectors.z, fourths);
    }
};

/// A face adjacent across an edge.
struct Near {
    std::uint32_t face;
    float weight;  ///< weight of the face in the filter; depends on its area and distance
};

/// Total edge length per degree of the dihedral angle.
struct Histogram {
    std::array<double, kBins> lengths = {};
    double all = 0;
};

/// State that the steps of the search for creases share.
struct CreaseFinder {
    const NormalsCall& call;
    const EdgePairs& pairs;
    double noise_deg = 0;
    Buffer<float> normals = {}, angles = {};
};

/// Returns the number of faces, rounded up to rows of four; entries after the last face are zero.
std::size_t paddedCount(const CreaseFinder& finder) { return (finder.call.mesh.faceCount() + 3) / 4 * 4; }

template <class Body>
void forFaces(CreaseFinder& finder, const Body& body) {
    finder.call.parallel.forRanges(finder.call.mesh.faceCount(), Parallel::kGrain / 4,
                                   [&](std::size_t begin, std::size_t end) {
                                       for (std::size_t f = begin; f < end; ++f) body(static_cast<std::uint32_t>(f));
                                   });
}

void makeFaces(CreaseFinder& finder) {
    finder.normals = Buffer<float>(finder.call.allocator, 4 * paddedCount(finder), 0.0f);
    forFaces(finder, [&](std::uint32_t f) {
        const bool is_used = finder.call.faces.isUsed(f);
        const FaceRow row = is_used ? faceRow(finder.call.mesh, finder.call.faces.first(f), finder.call.faces.past(f),
                                              finder.call.factor, true)
                                    : FaceRow{};
        Float4 normal = splat(0.0f);
        if (!row.isDegenerate()) {
            normal = toFloat4(row.unit());
            normal[3] = static_cast<float>(row.size);
        }
        storeFloat4(finder.normals.data() + 4 * std::size_t{f}, normal);
    });
}

template <class Body>
void forCorners(CreaseFinder& finder, const Body& body) {
    finder.call.parallel.forRanges(finder.call.mesh.cornerCount(), Parallel::kGrain,
                                   [&](std::size_t begin, std::size_t end) {
                                       for (std::size_t c = begin; c < end; ++c) body(static_cast<std::uint32_t>(c));
                                   });
}

/// Returns the face normal, with twice the area as fourth component.
Float4 filteredNormal(const CreaseFinder& finder, std::size_t face) {
    return loadFloat4(finder.normals.data() + 4 * face);
}

/// Stores the angle between the two faces of each edge, in degrees, at both corners of the edge; -1 without a pair.
void measureAngles(CreaseFinder& finder) {
    finder.angles = Buffer<float>(finder.call.allocator, finder.call.mesh.cornerCount(), -1.0f);
    forCorners(finder, [&](std::uint32_t c) {
        const std::uint32_t other = finder.pairs.other(c);
        if (other == kNoPair || other < c) return;
        const Float4 m = filteredNormal(finder, finder.call.faces.of(c)),
                     n = filteredNormal(finder, finder.call.faces.of(other));
        if (!(m[3] > 0) || !(n[3] > 0)) return;
        const DVec3 a{m[0], m[1], m[2]}, b{n[0], n[1], n[2]};
        finder.angles[c] = finder.angles[other] = static_cast<float>(angleBetween(a, b) * (180 / kPi));
    });
}

double edgeLength(const CreaseFinder& finder, std::uint32_t corner) {
    const MeshView& mesh = finder.call.mesh;
    return length(toDouble(mesh.positions[mesh.indices[finder.call.faces.next(corner)]]) -
                  toDouble(mesh.positions[mesh.indices[corner]]));
}

Histogram histogram(const CreaseFinder& finder) {
    Histogram of;
    for (std::uint32_t c = 0; c < finder.call.mesh.cornerCount(); ++c) {
        if (finder.angles[c] < 0 || finder.pairs.other(c) < c) continue;
        const double size = edgeLength(finder, c);
        if (!std::isfinite(size)) continue;
        of.lengths[static_cast<std::size_t>(std::min(kBins - 1, static_cast<int>(finder.angles[c])))] += size;
        of.all += size;
    }
    return of;
}

/// Returns whether noise must be measured. Noise of standard deviation s, relative to the edge length, gives half of
/// the edges a dihedral angle of at least 126 s degrees: if half of them have angles below 2 degrees, no filtering is
/// needed.
bool mayBeNoisy(const Histogram& angles) { return angles.lengths[0] + angles.lengths[1] < angles.all / 2; }

/// Filters four faces at a time, one per lane: 62 instructions per triangle and pass, and 149 with one face at a time
/// (callgrind, a torus of 32,000 triangles). Faces of one group are padded to the largest: up to 32 bytes per corner.
template <class NearOf>
void filterFaces(CreaseFinder& finder, const NearOf& nearOf, float per_turn, int passes) {
    struct Around {
        std::uint32_t faces[4];
        float weights[4];
    };
    const std::size_t count = finder.call.mesh.faceCount(), fours = paddedCount(finder) / 4;
    const auto forFours = [&](const auto& body) {
        finder.call.parallel.forRanges(fours, Parallel::kGrain / 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t four = begin; four < end; ++four) body(four);
        });
    };
    // As many entries as the largest of the four faces has corners; the weights of its neighbors remain 0.
    Buffer<std::size_t> ends(finder.call.allocator, fours + 1, std::size_t{0});
    forEachFace(finder.call.mesh, [&](std::size_t face, std::size_t, std::size_t size) {
        ends[face / 4 + 1] = std::max(ends[face / 4 + 1], size);
    });
    for (std::size_t four = 0; four < fours; ++four) ends[four + 1] += ends[four];
    Buffer<Around> around(finder.call.allocator, ends[fours], Around{});
    forFours([&](std::size_t four) {
        for (std::size_t lane = 0; lane < std::min<std::size_t>(4, count - 4 * four); ++lane) {
            const auto face = static_cast<std::uint32_t>(4 * four + lane);
            const std::uint32_t first = finder.call.faces.first(face), past = finder.call.faces.past(face);
            for (std::uint32_t c = first; c < past; ++c) {
                const Near near = nearOf(c);
                Around& to = around[ends[four] + c - first];
                to.faces[lane] = near.face;
                to.weights[lane] = near.weight;
            }
        }
    });
    Buffer<float> before(finder.call.allocator, finder.normals.size());
    for (int pass = 0; pass < passes; ++pass) {
        std::swap(finder.normals, before);
        const float* const from = before.data();
        const auto row = [from](std::size_t face) { return loadFloat4(from + 4 * face); };
        forFours([&](std::size_t four) {
            const Columns own(row(4 * four), row(4 * four + 1), row(4 * four + 2), row(4 * four + 3));
            Vec3x4 sum = own.fourths * own.vectors;
            for (std::size_t i = ends[four]; i < ends[four + 1]; ++i) {
                const std::uint32_t* const faces = around[i].faces;
                const Columns other(row(faces[0]), row(faces[1]), row(faces[2]), row(faces[3]));
                const Vec3x4 turn = other.vectors - own.vectors;
                const Float4 alike = decay(splat(per_turn) * dot(turn, turn));
                sum = sum + (loadFloat4(around[i].weights) * alike) * other.vectors;
            }
            const Float4 square = dot(sum, sum);
            const Vec3x4 unit = (splat(1.0f) / sqrt4(square)) * sum;
            const Mask4 has_mean = (square > splat(0.0f)) & (square <= splat(std::numeric_limits<float>::max()));
            Float4 rows[4] = {select4(has_mean, unit.x, own.vectors.x), select4(has_mean, unit.y, own.vectors.y),
                              select4(has_mean, unit.z, own.vectors.z), own.fourths};
            transpose4(rows[0], rows[1], rows[2], rows[3]);
            for (std::size_t lane = 0; lane < 4; ++lane)
                storeFloat4(finder.normals.data() + 4 * (4 * four + lane), rows[lane]);
        });
    }
}

/// Replaces each face normal by the weighted mean of itself and the normals of neighboring faces: close and similar
/// normals have larger weights.
void filterNormals(CreaseFinder& finder) {
    const std::size_t count = finder.call.mesh.faceCount();
    Buffer<float> centers(finder.call.allocator, 4 * count);
    forFaces(finder, [&](std::uint32_t f) {
        DVec3 sum;
        const std::uint32_t first = finder.call.faces.first(f), past = finder.call.faces.past(f);
        for (std::uint32_t c = first; c < past; ++c)
            sum = sum + toDouble(finder.call.mesh.positions[finder.call.mesh.indices[c]]);
        storeFloat4(centers.data() + 4 * std::size_t{f}, toFloat4((1.0 / std::max(1u, past - first)) * sum));
    });
    const auto center = [&](std::size_t face) { return loadFloat4(centers.data() + 4 * face); };
    double distances = 0;
    std::size_t edges = 0;
    for (std::uint32_t c = 0; c < finder.call.mesh.cornerCount(); ++c) {
        if (finder.pairs.other(c) == kNoPair || finder.pairs.other(c) < c) continue;
        const Float4 apart = center(finder.call.faces.of(c)) - center(finder.call.faces.of(finder.pairs.other(c)));
        const double square = dotted(apart, apart);
        if (!std::isfinite(square)) continue;
        distances += std::sqrt(square);
        ++edges;
    }
    const double mean = distances / static_cast<double>(std::max<std::size_t>(edges, 1));
    if (!(mean > 0)) return;
    const double alike = finder.noise_deg < kLoudDeg ? 0.25 : finder.noise_deg < kLouderDeg ? 0.35 : 0.5;
    const auto per_place = static_cast<float>(0.5 / (mean * mean)),
               per_turn = static_cast<float>(0.5 / (alike * alike));
    const auto nearOf = [&](std::uint32_t c) {
        const std::uint32_t f = finder.call.faces.of(c),
                            g = finder.pairs.other(c) == kNoPair ? f : finder.call.faces.of(finder.pairs.other(c));
        const Float4 apart = center(g) - center(f);
        return Near{g, g == f ? 0 : filteredNormal(finder, g)[3] * decay(splat(per_place * dotted(apart, apart)))[0]};
    };
    const int passes = finder.noise_deg < kLoudDeg / 2 ? 8 : finder.noise_deg < kLoudDeg ? 16 : 32;
    filterFaces(finder, nearOf, per_turn, passes);
}

/// Returns whether edges with angles of up to 8 degrees have less than a quarter of the total edge length. In shapes
/// with sharp edges, decimated to 1 % or less, the flattest quarter reaches 4 degrees. In smooth shapes with so few
/// triangles that the histogram has no gap, it reaches 12 (scripts/accuracy --kinds); their edges of 40 degrees and
/// more are soft.
bool isBentEverywhere(const Histogram& angles) {
    double flat = 0;
    for (std::size_t bin = 0; bin < 8; ++bin) flat += angles.lengths[bin];
    return flat < angles.all / 4;
}

/// Returns the center of the widest gap of the angle histogram: the angle range in which the blurred edge length per
/// degree is within 5e-5 (of the total edge length) of the minimum. If the mesh has little noise and its histogram has
/// no gap, returns a fixed angle.
double angleInGap(const CreaseFinder& finder, const Histogram& angles) {
    constexpr int kBlur = 6;
    constexpr double kMost = 70;
    const double all = angles.all;
    std::array<double, kBins> density{};
    // Normal distribution with a standard deviation of 2 degrees.
    constexpr double kWeights[kBlur + 1] = {0.199676, 0.176213, 0.121109, 0.064826, 0.027023, 0.008773, 0.002218};
    for (int bin = 0; bin < kBins; ++bin) {
        for (int d = -kBlur; d <= kBlur; ++d) {
            const int from = std::clamp(bin + d, 0, kBins - 1);
            density[static_cast<std::size_t>(bin)] +=
                kWeights[d < 0 ? -d : d] * angles.lengths[static_cast<std::size_t>(from)];
        }
    }
    const int first = static_cast<int>(std::max(15.0, std::min(25.0, 12 + finder.noise_deg)));
    const auto end = static_cast<int>(kMost);
    double least = density[static_cast<std::size_t>(first)];
    for (int bin = first; bin < end; ++bin) least = std::min(least, density[static_cast<std::size_t>(bin)]);
    // Grid meshes cut the edges of shapes at all angles, so their histogram has no gap. This angle was correct for all
    // grid meshes that were tried.
    constexpr double kAngleOfGrids = 30;
    if (finder.noise_deg <= kLeastFilteredDeg && least > 3e-4 * all)
        return isBentEverywhere(angles) ? kMost : kAngleOfGrids;
    const double limit = least + 5e-5 * all;
    int best_begin = first, best_end = first;
    for (int begin = first; begin < end; ++begin) {
        int past = begin;
        while (past < end && density[static_cast<std::size_t>(past)] <= limit) ++past;
        if (past - begin > best_end - best_begin) best_begin = begin, best_end = past;
        if (past > begin) begin = past;
    }
    return 0.5 * (best_begin + best_end);
}

void markEdges(const CreaseFinder& finder, Creases& creases) {
    const std::size_t corners = finder.call.mesh.cornerCount();
    creases.edges = Buffer<EdgeKind>(finder.call.allocator, corners, EdgeKind::byAngle);
    Buffer<std::uint8_t> counts(finder.call.allocator, finder.call.mesh.vertexCount(),
                                std::uint8_t{0});  // number of hard edges at each point; 2 means two or more
    const auto forPairs = [&](const auto& body) {
        for (std::uint32_t c = 0; c < corners; ++c) {
            if (finder.angles[c] >= 0 && finder.pairs.other(c) > c) body(c);
        }
    };
    const auto areBothEnds = [&](std::uint32_t c) {
        const EdgePairs::Ends ends = finder.pairs.endsOf(c);
        return counts[ends.low] == 1 && counts[ends.high] == 1;
    };
    const auto set = [&](std::uint32_t corner, EdgeKind kind) {
        creases.edges[corner] = creases.edges[finder.pairs.other(corner)] = kind;
    };
    const auto countHard = [&] {
        std::fill(counts.begin(), counts.end(), std::uint8_t{0});
        forPairs([&](std::uint32_t c) {
            if (creases.edges[c] != EdgeKind::hard) return;
            const EdgePairs::Ends ends = finder.pairs.endsOf(c);
            for (const std::uint32_t point : {ends.low, ends.high}) counts[point] = counts[point] == 0 ? 1 : 2;
        });
    };
    forPairs([&](std::uint32_t c) { set(c, finder.angles[c] > creases.angle_deg ? EdgeKind::hard : EdgeKind::soft); });
    countHard();
    forPairs([&](std::uint32_t c) {
        if (creases.edges[c] == EdgeKind::hard && areBothEnds(c)) set(c, EdgeKind::soft);
    });
    countHard();
    forPairs([&](std::uint32_t c) {
        const bool may_be_gap = creases.edges[c] == EdgeKind::soft && finder.angles[c] > creases.angle_deg / 2;
        if (may_be_gap && areBothEnds(c)) set(c, EdgeKind::hard);
    });
    creases.are_all_soft = !finder.pairs.hasCrowdedEdges() &&
                           std::find(creases.edges.begin(), creases.edges.end(), EdgeKind::hard) == creases.edges.end();
}

Creases creasesOf(CreaseFinder& finder) {
    makeFaces(finder);
    measureAngles(finder);
    Histogram angles = histogram(finder);
    if (mayBeNoisy(angles)) finder.noise_deg = kMostTurnOfNoise * roughnessOf(finder.call);
    if (finder.noise_deg > kLeastFilteredDeg) {
        filterNormals(finder);
        measureAngles(finder);
        angles = histogram(finder);
    }
    Creases creases;
    creases.angle_deg = static_cast<float>(angleInGap(finder, angles));
    markEdges(finder, creases);
    return creases;
}

}  // namespace

Creases findCreases(const MeshView& mesh, const NormalOptions& options, const Execution& execution,
                    Parallel& parallel) {
    Call<NormalOptions> plain{{}, execution};
    plain.convention = options.convention;
    plain.weld_positions = options.weld_positions;
    const NormalsCall call(mesh, mesh, plain, {}, parallel);
    const EdgePairs pairs(call);
    CreaseFinder finder{.call = call, .pairs = pairs};
    return creasesOf(finder);
}

}  // namespace tspace
