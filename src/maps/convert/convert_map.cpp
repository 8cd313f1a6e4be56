// SPDX-License-Identifier: MIT
// convertMap: computes the frames of both sides at each texel, and the sums of the report.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/border.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/sort.h"
#include "core/base/unique_index.h"
#include "core/base/vec_math.h"
#include "maps/convert/convert_texel.h"
#include "maps/layout/low_points.h"
#include "maps/layout/texel_triangles.h"
#include "maps/rays/map_surfaces.h"
#include "maps/solve/choose_lengths.h"
#include "maps/solve/solve_texels.h"
#include "tspace/maps.h"

namespace tspace {
namespace {

constexpr std::size_t kTexelsOfTask = 4096, kTasksOfStep = 64;

/// Returns the relevant part of an interpretation: in object space only the green channel.
MapReading readingOf(const MapSide& side) {
    return side.space == MapSpace::tangent ? side.reading : MapReading{.green = side.reading.green};
}

bool hasFrames(const MapSide& side) { return side.space == MapSpace::tangent && !side.uvs.empty(); }

/// Counts of the texels of a range, in which mean_change_deg is a sum. Those of all ranges are added in order.
using Counts = ConvertMapReport;

void addCounts(Counts& to, const Counts& part) {
    to.converted += part.converted;
    to.changed += part.changed;
    to.background += part.background;
    to.without_frame += part.without_frame;
    to.below_horizon += part.below_horizon;
    to.unmatched += part.unmatched;
    to.apart += part.apart;
    to.mean_change_deg += part.mean_change_deg;
    to.max_change_deg = std::max(to.max_change_deg, part.max_change_deg);
}

// -- matching of the triangles of both sides --

struct HashedTriangle {
    std::uint64_t hash = 0;
    std::uint32_t triangle = 0;
};

std::uint64_t hashOf(const MapSide& side, std::size_t triangle, bool with_positions) {
    std::array<std::uint64_t, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = foldHash(uvBits(side.uvs[3 * triangle + i]),
                              with_positions ? hashPosition(side.positions[3 * triangle + i]) : 0);
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return foldHash(foldHash(foldHash(0, corners[0]), corners[1]), corners[2]);
}

Buffer<HashedTriangle> sorted(const MapSide& side, bool with_positions, const Allocator* allocator) {
    Buffer<HashedTriangle> list(allocator, side.uvs.count / 3);
    for (std::size_t i = 0; i < list.size(); ++i)
        list[i] = {hashOf(side, i, with_positions), static_cast<std::uint32_t>(i)};
    sortList(list.begin(), list.end(), [](const HashedTriangle& a, const HashedTriangle& b) {
        return a.hash != b.hash ? a.hash < b.hash : a.triangle < b.triangle;
    });
    return list;
}

DVec3 positionAt(const MapSide& side, const UvTriangles& triangles, const TextureShape& shape,
                 const TexelPlace& place) {
    return mixedAt(side.positions, place.triangle, weightsAt(triangles, shape, place));
}

/// Returns, for each triangle of `side`, the triangle of `other` with the same UVs and (if both sides have them) the
/// same positions, or kNoTriangle. Corners may start at a different vertex but must have the same order around the
/// triangle. If several triangles have equal corners, each is matched once, in order. O(n log n).
Buffer<std::uint32_t> matchTriangles(const MapSide& side, const MapSide& other, const Allocator* allocator) {
    const bool with_positions = !side.positions.empty() && !other.positions.empty();
    const Buffer<HashedTriangle> mine = sorted(side, with_positions, allocator);
    const Buffer<HashedTriangle> theirs = sorted(other, with_positions, allocator);
    Buffer<std::uint32_t> match(allocator, mine.size(), kNoTriangle);
    for (std::size_t a = 0, b = 0; a < mine.size() && b < theirs.size();) {
        if (mine[a].hash == theirs[b].hash) {
            match[mine[a++].triangle] = theirs[b++].triangle;
        } else if (mine[a].hash < theirs[b].hash) {
            ++a;
        } else {
            ++b;
        }
    }
    return match;
}

/// Calls visit(texel, place) for each texel whose center is inside a triangle.
template <class Visit>
void forEachTexel(const UvTriangles& triangles, std::size_t triangle, const TextureShape& shape, const Visit& visit) {
    forEachSample(triangles[triangle], shape, 1, [&](const UvSample& sample) {
        const auto x = static_cast<std::int64_t>(std::floor(sample.x));
        const auto y = static_cast<std::int64_t>(std::floor(sample.y));
        const std::uint32_t column = texelInImage(x, shape.width, shape.wrap_u);
        const std::uint32_t row = texelInImage(y, shape.height, shape.wrap_v);
        if (column >= shape.width || row >= shape.height) return;
        visit(std::size_t{row} * shape.width + column,
              TexelPlace{static_cast<std::uint32_t>(triangle), static_cast<std::int32_t>(x),
                         static_cast<std::int32_t>(y)});
    });
}

/// Chooses among overlapping triangles of `other`: each texel inside triangles of both sides gets the triangle that is
/// closest in space to the texel's point on `side`. `places`: triangle of each texel on `side`. Both sides must have
/// positions.
void chooseByPosition(const MapSide& side, const UvTriangles& triangles, const TexelTriangles& places,
                      const MapSide& other, const UvTriangles& other_triangles, TexelTriangles& other_places,
                      const Allocator* allocator) {
    const TextureShape& shape = other_places.shape;
    Buffer<double> distances(allocator, places.kinds.size(), static_cast<double>(INFINITY));
    for (std::size_t triangle = 0; triangle < other.uvs.count / 3; ++triangle) {
        forEachTexel(other_triangles, triangle, shape, [&](std::size_t texel, const TexelPlace& place) {
            if (places.kinds[texel] != TexelCoverage::inside) return;
            const DVec3 apart = positionAt(other, other_triangles, shape, place) -
                                positionAt(side, triangles, shape, places.places[texel]);
            const double distance = dot(apart, apart);
            if (!(distance < distances[texel])) return;
            distances[texel] = distance;
            other_places.places[texel] = place;
        });
    }
}

// -- conversion of texels --

class Conversion {
  public:
    Conversion(const MapImage& map, const MapSide& from, const MapSide& to, std::span<Vec3> out,
               const ConvertMapOptions& options, const Allocator* allocator, Parallel& parallel)
        : map_(map), from_(from), to_(to), out_(out), options_(options), allocator_(allocator), parallel_(parallel),
          // If only one side has frames, they are used for both sides.
          one_mesh_(!(hasFrames(from) && hasFrames(to))),
          main_(from.uvs.empty() || (to.space == MapSpace::tangent && from.space == MapSpace::object) ? to : from),
          other_(&main_ == &from ? to : from), triangles_(uvTriangles(main_.uvs, map)),
          other_triangles_(uvTriangles(other_.uvs, map)) {}

    Result<ConvertMapReport> run(const Progress& progress) {
        if (!main_.uvs.empty()) {
            if (!findPlaces()) {
                return makeError(ErrorCode::tooLarge, kNoElement,
                                 "the UVs repeat the image too many times; move or scale them to the 0-1 range");
            }
        }
        const std::size_t texels = map_.texels.size(), tasks = (texels + kTexelsOfTask - 1) / kTexelsOfTask;
        if (from_.space == MapSpace::tangent && to_.space == MapSpace::object && places_.counts.overlapping > 0)
            countConflicts();
        if (choosesJointly()) {
            vectors_ = Buffer<Vec3>(allocator_, texels, Vec3{});
            keeps_ = Buffer<bool>(allocator_, texels, true);
        }
        Buffer<Counts> counts(allocator_, tasks, Counts{});
        for (std::size_t first = 0; first < tasks; first += kTasksOfStep) {
            if (progress) progress("converting texels", first, tasks);
            parallel_.forTasks(std::min(kTasksOfStep, tasks - first), [&](std::size_t task) {
                const std::size_t begin = (first + task) * kTexelsOfTask;
                for (std::size_t i = begin; i < std::min(begin + kTexelsOfTask, texels); ++i)
                    convert(i, counts[first + task]);
            });
        }
        Counts all;
        for (const Counts& part : counts) addCounts(all, part);
        if (vectors_.size() > 0) all.changed = chooseJointly(all.changed);
        return reportOf(all);
    }

  private:
    /// Finds the triangle of each texel. Returns false if that takes too much work.
    bool findPlaces() {
        // Filters read texels that are at most two texels away from a triangle.
        const std::uint32_t padding = std::max<std::uint32_t>(options_.padding, 2);
        auto places = findTexelTriangles(triangles_, map_.width, map_.height, padding, parallel_, allocator_);
        if (!places) return false;
        places_ = std::move(*places);
        if (one_mesh_) return true;
        matches_ = matchTriangles(main_, other_, allocator_);
        if (!main_.positions.empty() && !other_.positions.empty()) size_ = PositionBox(main_.positions).diagonal();
        if (std::find(matches_.begin(), matches_.end(), kNoTriangle) == matches_.end()) return true;
        auto other_places =
            findTexelTriangles(other_triangles_, map_.width, map_.height, padding, parallel_, allocator_);
        if (!other_places) return false;
        other_places_ = std::move(*other_places);
        if (other_places_.counts.overlapping > 0 && !main_.positions.empty() && !other_.positions.empty())
            chooseByPosition(main_, triangles_, places_, other_, other_triangles_, other_places_, allocator_);
        return true;
    }

    /// Returns whether integers are chosen jointly, so that neighboring texels compensate for rounding errors. This is
    /// useful if vectors lie anywhere between integers (as after a change of space), and if there are few integers. It
    /// is not done for 8-bit two-channel maps, whose z follows from x and y.
    [[nodiscard]] bool choosesJointly() const {
        return options_.bits == 16 ? from_.space != to_.space : options_.bits == 8 && !to_.reading.two_channels;
    }

    /// Chooses integers jointly. `changed`: number of texels changed so far; returns the number after the call.
    std::uint64_t chooseJointly(std::uint64_t changed) {
        const std::span<Vec3> vectors(vectors_.data(), vectors_.size());
        const std::span<const bool> keeps(keeps_.data(), keeps_.size());
        if (options_.bits == 16) {
            roundTexels(vectors, map_.width, {.keeps_lengths = to_.reading.two_channels, .keeps = keeps}, parallel_,
                        allocator_);
        } else {
            chooseLengths({.vectors = vectors,
                           .keeps = keeps,
                           .width = map_.width,
                           .wrap_u = map_.wrap_u,
                           .wrap_v = map_.wrap_v,
                           .scale = to_.reading.scale},
                          options_.lengths, parallel_, allocator_);
        }
        for (std::size_t i = 0; i < vectors.size(); ++i) {
            if (keeps_[i]) continue;
            const Vec3 texel = channelsOf(toDouble(vectors[i]), {.bits = options_.bits});
            changed += texel == out_[i] ? 0 : 1;
            out_[i] = texel;
        }
        return changed;
    }

    void convert(std::size_t texel, Counts& counts) {
        const Vec3 before = map_.texels[texel];
        out_[texel] = before;
        ShadingFrame from{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, to = from;
        if (!main_.uvs.empty()) {
            const TexelCoverage kind = places_.kinds[texel];
            const bool is_shown = kind == TexelCoverage::inside || places_.is_read[texel] ||
                                  (kind == TexelCoverage::adjacent && options_.padding > 0);
            if (!is_shown) {
                ++counts.background;
                return;
            }
            if (!findFrames(texel, from, to, counts)) {
                ++counts.unmatched;
                return;
            }
        }
        const bool is_chosen_later = vectors_.size() > 0;
        const auto converted = convertTexel(before, from, readingOf(from_), to, readingOf(to_),
                                            {.bits = options_.bits, .are_chosen = is_chosen_later});
        if (!converted) {
            ++counts.without_frame;
            return;
        }
        if (is_chosen_later) {
            const Vec3& channels = converted->texel;
            vectors_[texel] = {2 * channels.x - 1, 2 * channels.y - 1, 2 * channels.z - 1};
            keeps_[texel] = converted->stays;
        }
        if (!is_chosen_later || converted->stays) {
            out_[texel] = converted->texel;
            counts.changed += converted->texel == before ? 0 : 1;
        }
        ++counts.converted;
        counts.below_horizon += converted->is_below_horizon ? 1 : 0;
        counts.mean_change_deg += converted->change_deg;
        counts.max_change_deg = std::max(counts.max_change_deg, converted->change_deg);
    }

    /// Counts conflicts. Must be called before any texel is written, because `out_` may be the input.
    void countConflicts() {
        constexpr double kApartDeg = 2;
        const TextureShape& shape = places_.shape;
        Buffer<bool> counted(allocator_, places_.kinds.size(), false);
        const auto directionAt = [&](std::size_t texel, const TexelPlace& place) {
            const ShadingFrame frame = oneMeshFrame(from_, place.triangle, weightsAt(triangles_, shape, place));
            return shadedNormal(frame, decodeTexel(map_.texels[texel], readingOf(from_)));
        };
        for (std::size_t triangle = 0; triangle < main_.uvs.count / 3; ++triangle) {
            forEachTexel(triangles_, triangle, shape, [&](std::size_t texel, const TexelPlace& place) {
                if (places_.kinds[texel] != TexelCoverage::inside || !places_.overlaps[texel] || counted[texel]) return;
                const TexelPlace& first = places_.places[texel];
                if (first.triangle == triangle) return;
                counted[texel] = degreesBetween(directionAt(texel, first), directionAt(texel, place)) > kApartDeg;
                conflict_count_ += counted[texel] ? 1 : 0;
            });
        }
    }

    /// Returns whether the positions of the texel on the two meshes are far apart.
    [[nodiscard]] bool isApart(const TexelPlace& place, const TexelPlace& other) const {
        if (!(size_ > 0)) return false;
        constexpr double kFar = 0.02;
        const DVec3 apart = positionAt(main_, triangles_, places_.shape, place) -
                            positionAt(other_, other_triangles_, places_.shape, other);
        return dot(apart, apart) > kFar * kFar * size_ * size_;
    }

    /// Computes the source and target frame of a texel. Returns false if the other mesh has no triangle at the texel.
    [[nodiscard]] bool findFrames(std::size_t texel, ShadingFrame& from, ShadingFrame& to, Counts& counts) const {
        const TexelPlace& place = places_.places[texel];
        const std::array<double, 3> weights = weightsAt(triangles_, places_.shape, place);
        if (one_mesh_) {
            from = oneMeshFrame(from_, place.triangle, weights);
            to = oneMeshFrame(to_, place.triangle, weights);
            return true;
        }
        TexelPlace other_place = place;
        other_place.triangle = matches_[place.triangle];
        if (other_place.triangle == kNoTriangle) other_place = other_places_.places[texel];
        if (other_place.triangle == kNoTriangle) return false;
        if (matches_[place.triangle] == kNoTriangle && isApart(place, other_place)) ++counts.apart;
        const ShadingFrame main_frame = sideFrame(main_, place.triangle, weights);
        const ShadingFrame other_frame =
            sideFrame(other_, other_place.triangle, weightsAt(other_triangles_, places_.shape, other_place));
        from = &main_ == &from_ ? main_frame : other_frame;
        to = &main_ == &from_ ? other_frame : main_frame;
        return true;
    }

    [[nodiscard]] ShadingFrame oneMeshFrame(const MapSide& side, std::size_t triangle,
                                            const std::array<double, 3>& weights) const {
        if (side.space == MapSpace::object || hasFrames(side)) return sideFrame(side, triangle, weights);
        MapSide with_mesh = main_;
        with_mesh.reading = side.reading;
        return sideFrame(with_mesh, triangle, weights);
    }

    [[nodiscard]] ConvertMapReport reportOf(ConvertMapReport report) const {
        report.overlapping = places_.counts.overlapping;
        report.conflicting = conflict_count_;
        report.degenerate_uv_count = places_.counts.without_area;
        report.bad_uv_count = places_.counts.not_finite + places_.counts.too_far;
        if (report.converted > 0) report.mean_change_deg /= static_cast<double>(report.converted);
        if (options_.bits != 32) {
            report.half_step_deg = 180 / std::numbers::pi / (TexelNumbers{options_.bits}.most());
            report.is_below_half_step = report.changed > 0 && report.mean_change_deg < report.half_step_deg;
        }
        return report;
    }

    const MapImage& map_;
    const MapSide &from_, &to_;
    std::span<Vec3> out_;
    const ConvertMapOptions& options_;
    const Allocator* allocator_;
    Parallel& parallel_;
    bool one_mesh_;
    const MapSide &main_, &other_;  ///< texel positions refer to the triangles of main_
    UvTriangles triangles_, other_triangles_;
    TexelTriangles places_ = {}, other_places_ = {};
    /// Converted vectors, and flags of the texels that are unchanged so far; used if integers are chosen jointly.
    Buffer<Vec3> vectors_ = {};
    Buffer<bool> keeps_ = {};
    std::uint64_t conflict_count_ = 0;
    double size_ = 0;  ///< diagonal of the main mesh's bounding box; 0 unless both sides have positions
    Buffer<std::uint32_t> matches_ = {};  ///< matching triangle of the other side for each triangle of the main side
};

const Error kFine{ErrorCode::ok};

Error checkSide(const MapSide& side, const MapSide& other, const char* missing) {
    const std::size_t corners = side.uvs.count;
    if (Error error = checkSpan(side.uvs, kAnyCount, "uvs"); error.code != ErrorCode::ok) return error;
    if (corners % 3 != 0 || corners / 3 >= kNoTriangle / 3)
        return makeError(ErrorCode::countMismatch, kNoElement, "uvs must have three entries per triangle");
    if (!side.positions.empty()) {
        if (Error error = checkSpan(side.positions, corners, "positions"); error.code != ErrorCode::ok) return error;
    }
    const MapReading& reading = side.reading;
    if (!std::isfinite(reading.scale) || reading.scale == 0)
        return makeError(ErrorCode::invalidOption, kNoElement, "the scale of a map must be finite and not 0");
    if (side.space == MapSpace::object) {
        const std::size_t triangles = (corners != 0 && other.space == MapSpace::object ? corners : other.uvs.count) / 3;
        if (!side.axes.empty() && side.axes.size() != triangles)
            return makeError(ErrorCode::countMismatch, kNoElement, "axes must have one entry per triangle");
        return kFine;
    }
    if (corners == 0) {
        const bool same_frames =
            reading.bitangent == other.reading.bitangent && reading.unit_vectors == other.reading.unit_vectors;
        const bool needs_mesh = other.space == MapSpace::object || (other.uvs.empty() && !same_frames);
        return needs_mesh ? makeError(ErrorCode::missingAttribute, kNoElement, "%s", missing) : kFine;
    }
    if (side.normals.empty() || side.tangents.empty()) {
        return makeError(ErrorCode::missingAttribute, kNoElement,
                         "converting from or to tangent space needs the normals and tangents of the mesh");
    }
    if (Error error = checkSpan(side.normals, corners, "normals"); error.code != ErrorCode::ok) return error;
    return checkSpan(side.tangents, corners, "tangents");
}

Error checkCall(const MapImage& map, const MapSide& from, const MapSide& to, std::span<Vec3> out,
                const ConvertMapOptions& options) {
    const std::uint64_t texels = std::uint64_t{map.width} * map.height;
    if (texels == 0 || texels >> 32 != 0)
        return makeError(ErrorCode::tooLarge, kNoElement, "the number of texels of an image must be from 1 to 2^32-1");
    if (map.texels.size() != texels || out.size() != texels)
        return makeError(ErrorCode::countMismatch, kNoElement, "texels must have width * height entries");
    if (options.bits != 8 && options.bits != 16 && options.bits != 32)
        return makeError(ErrorCode::invalidOption, kNoElement, "bits must be 8, 16 or 32");
    if (Error error =
            checkSide(from, to, "`from` has no mesh; set the UVs, normals and tangents for which the map was made");
        error.code != ErrorCode::ok) {
        return error;
    }
    return checkSide(to, from,
                     "`to` has no mesh; set the UVs, normals and tangents with which the output will be read");
}

}  // namespace

Result<ConvertMapReport> convertMap(const MapImage& map, const MapSide& from, const MapSide& to,
                                    const ConvertMapOptions& options, std::span<Vec3> out, const Execution& execution,
                                    const Progress& progress) {
    return atBorder([&]() -> Result<ConvertMapReport> {
        if (Error error = checkCall(map, from, to, out, options); error.code != ErrorCode::ok) return error;
        Parallel parallel(execution);
        return Conversion(map, from, to, out, options, execution.allocator, parallel).run(progress);
    });
}

}  // namespace tspace
