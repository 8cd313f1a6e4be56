// SPDX-License-Identifier: MIT
// heightToNormal: finite differences of heights, converted to slopes of the surface.
#include "tspace/maps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/border.h"
#include "core/base/parallel.h"
#include "maps/convert/convert_texel.h"
#include "maps/layout/texel_triangles.h"
#include "maps/texels/texture_sample.h"

namespace tspace {
namespace {

constexpr std::size_t kRowsOfTask = 16;

/// Height differences over one texel width and one texel height.
struct Slope {
    double along_u = 0, along_v = 0;
};

/// Edges of a texel on the surface.
struct TexelEdges {
    DVec3 u, v;
    [[nodiscard]] double size() const { return std::sqrt(length(cross(u, v))); }
};

/// Computes the two edge vectors of a texel (one texel step along u and along v) on the surface of a triangle. Returns
/// false if the triangle has no UV area.
bool edgesOf(const MapSide& mesh, std::size_t triangle, const HeightMap& map, TexelEdges& edges) {
    const auto at = [&](std::size_t k) { return 3 * triangle + k; };
    const Vec2 first = mesh.uvs[at(0)];
    const auto across = [&](std::size_t k) {
        const Vec2 uv = mesh.uvs[at(k)];
        return std::pair{(static_cast<double>(uv.x) - static_cast<double>(first.x)) * map.width,
                         (static_cast<double>(uv.y) - static_cast<double>(first.y)) * map.height};
    };
    const auto [s1, t1] = across(1);
    const auto [s2, t2] = across(2);
    const DVec3 e1 = toDouble(mesh.positions[at(1)]) - toDouble(mesh.positions[at(0)]);
    const DVec3 e2 = toDouble(mesh.positions[at(2)]) - toDouble(mesh.positions[at(0)]);
    const double area = s1 * t2 - s2 * t1;
    if (area == 0 || !std::isfinite(area)) return false;
    edges.u = (1 / area) * (t2 * e1 - t1 * e2);
    edges.v = (1 / area) * (s1 * e2 - s2 * e1);
    return edges.size() > 0 && std::isfinite(edges.size());
}

class Heights {
  public:
    Heights(const HeightMap& map, const MapSide& mesh, std::span<Vec3> out, const HeightToNormalOptions& options,
            const Allocator* allocator, Parallel& parallel)
        : map_(map), mesh_(mesh), out_(out), options_(options), allocator_(allocator), parallel_(parallel) {}

    Result<HeightToNormalReport> run() {
        const UvTriangles triangles = uvTriangles(mesh_.uvs, map_);
        if (!mesh_.uvs.empty()) {
            // Filtering reads texels that are up to two texels away from a triangle.
            auto places = findTexelTriangles(triangles, map_.width, map_.height, 2, parallel_, allocator_);
            if (!places)
                return makeError(ErrorCode::tooLarge, kNoElement,
                                 "the UVs repeat the image too many times; move or scale them to the 0-1 range");
            places_ = std::move(*places);
            findTexelSize();
        }
        Buffer<Leans> leans(allocator_, map_.height);
        parallel_.forRanges(map_.height, kRowsOfTask, [&](std::size_t begin, std::size_t end) {
            for (std::size_t row = begin; row < end; ++row) {
                leans[row] = {};
                for (std::size_t column = 0; column < map_.width; ++column) write(triangles, column, row, leans[row]);
            }
        });
        for (const Leans& row : leans) {
            report_.mean_lean_deg += row.sum / static_cast<double>(map_.heights.size());
            report_.max_lean_deg = std::max(report_.max_lean_deg, row.most);
        }
        return report_;
    }

  private:
    struct Leans {
        double sum = 0, most = 0;
    };

    /// Computes the mean texel size over the texels that triangles cover.
    void findTexelSize() {
        double sum = 0;
        for (std::size_t i = 0; i < places_.places.size(); ++i) {
            TexelEdges edges;
            if (places_.kinds[i] != TexelCoverage::inside || !edgesOf(mesh_, places_.places[i].triangle, map_, edges))
                continue;
            sum += edges.size();
            ++report_.on_mesh;
        }
        if (report_.on_mesh > 0) report_.texel_size = sum / static_cast<double>(report_.on_mesh);
    }

    [[nodiscard]] double heightAt(std::int64_t column, std::int64_t row) const {
        const std::size_t x = wrappedTexel(column, map_.width, map_.wrap_u);
        const std::size_t y = wrappedTexel(row, map_.height, map_.wrap_v);
        return static_cast<double>(map_.heights[y * map_.width + x]);
    }

    /// Returns whether the image ends at this column (or row). The values that a clamped sampler repeats beyond the end
    /// are not heights of the surface.
    static bool isAtEnd(std::int64_t at, std::uint32_t size, TextureWrap wrap) {
        return wrap == TextureWrap::clamp && (at == 0 || at + 1 == size);
    }

    /// Returns the derivative over one texel along a row (or column). It is the central difference; at an end of the
    /// image it is the one-sided difference of second order, or of first order if there are only two texels. All three
    /// are exact for planes, and the differences of second order also for parabolas.
    [[nodiscard]] double derivativeAt(std::int64_t column, std::int64_t row, bool along_u) const {
        const std::int64_t at = along_u ? column : row;
        const std::uint32_t size = along_u ? map_.width : map_.height;
        const auto height = [&](std::int64_t step) {
            return along_u ? heightAt(column + step, row) : heightAt(column, row + step);
        };
        if (!isAtEnd(at, size, along_u ? map_.wrap_u : map_.wrap_v)) return (height(1) - height(-1)) / 2;
        if (size == 1) return 0;
        const std::int64_t inward = at == 0 ? 1 : -1;
        const double slope =
            size == 2 ? height(inward) - height(0) : (4 * height(inward) - 3 * height(0) - height(2 * inward)) / 2;
        return static_cast<double>(inward) * slope;
    }

    /// Returns the slope at a texel.
    /// Based on: Scharr, "Optimale Operatoren in der Digitalen Bildverarbeitung", 2000: the weights 3, 10, 3 have the
    /// least dependence on the direction of the slope. In the first and last row (for the slope along u) or column
    /// (along v), only the texel's own derivative is used, because the mean with a single neighbor would be the
    /// derivative between the two texels.
    [[nodiscard]] Slope slopeAt(std::int64_t column, std::int64_t row) const {
        const auto mean = [&](bool along_u) {
            const double own = derivativeAt(column, row, along_u);
            const bool is_at_end =
                along_u ? isAtEnd(row, map_.height, map_.wrap_v) : isAtEnd(column, map_.width, map_.wrap_u);
            if (is_at_end) return options_.strength * own;
            const auto beside = [&](std::int64_t step) {
                return along_u ? derivativeAt(column, row + step, true) : derivativeAt(column + step, row, false);
            };
            return options_.strength * (3 * beside(-1) + 10 * own + 3 * beside(1)) / 16;
        };
        return {mean(true), mean(false)};
    }

    /// Computes the normal relative to T, B and N of the mesh. Returns false if no triangle covers the texel.
    [[nodiscard]] bool onMesh(const UvTriangles& triangles, std::size_t texel, const Slope& slope,
                              DVec3& vector) const {
        if (mesh_.uvs.empty() || places_.kinds[texel] == TexelCoverage::none) return false;
        const TexelPlace& place = places_.places[texel];
        TexelEdges edges;
        if (!edgesOf(mesh_, place.triangle, map_, edges)) return false;
        const ShadingFrame frame = sideFrame(mesh_, place.triangle, weightsAt(triangles, places_.shape, place));
        DVec3 n = frame.normal;
        if (!normalize(n)) return false;
        const double volume = dot(n, cross(edges.u, edges.v));
        if (!(std::fabs(volume) > 1e-6 * length(edges.u) * length(edges.v))) return false;
        const DVec3 gradient = (1 / volume) * (slope.along_u * cross(edges.v, n) + slope.along_v * cross(n, edges.u));
        vector = vectorFor(frame, n - gradient);
        return dot(vector, vector) > 0;
    }

    void write(const UvTriangles& triangles, std::size_t column, std::size_t row, Leans& leans) {
        const std::size_t texel = row * map_.width + column;
        const Slope slope = slopeAt(static_cast<std::int64_t>(column), static_cast<std::int64_t>(row));
        DVec3 vector;
        if (!onMesh(triangles, texel, slope, vector)) {
            vector = {-slope.along_u / report_.texel_size, slope.along_v / report_.texel_size, 1};
            normalize(vector);
        }
        const double lean = degreesBetween(vector, {0, 0, 1});
        leans.sum += lean;
        leans.most = std::max(leans.most, lean);
        if (options_.green == Green::down) vector.y = -vector.y;
        out_[texel] = channelsOf(vector, {.bits = options_.bits});
    }

    const HeightMap& map_;
    const MapSide& mesh_;
    std::span<Vec3> out_;
    const HeightToNormalOptions& options_;
    const Allocator* allocator_;
    Parallel& parallel_;
    TexelTriangles places_ = {};
    HeightToNormalReport report_ = {};
};

Error checkCall(const HeightMap& map, const MapSide& mesh, std::span<Vec3> out, const HeightToNormalOptions& options) {
    const std::uint64_t texels = std::uint64_t{map.width} * map.height;
    if (texels == 0 || texels >> 32 != 0)
        return makeError(ErrorCode::tooLarge, kNoElement, "the number of texels of an image must be from 1 to 2^32-1");
    if (map.heights.size() != texels || out.size() != texels)
        return makeError(ErrorCode::countMismatch, kNoElement, "heights must have width * height entries");
    if (options.bits != 8 && options.bits != 16 && options.bits != 32)
        return makeError(ErrorCode::invalidOption, kNoElement, "bits must be 8, 16 or 32");
    if (!std::isfinite(options.strength))
        return makeError(ErrorCode::invalidOption, kNoElement, "the strength must be finite");
    const std::size_t corners = mesh.uvs.count;
    if (corners == 0) return Error{ErrorCode::ok};
    if (corners % 3 != 0 || corners / 3 >= kNoTriangle / 3)
        return makeError(ErrorCode::countMismatch, kNoElement, "uvs must have three entries per triangle");
    if (mesh.positions.empty() || mesh.normals.empty() || mesh.tangents.empty())
        return makeError(ErrorCode::missingAttribute, kNoElement, "the mesh must have positions, normals and tangents");
    for (Error error : {checkSpan(mesh.uvs, kAnyCount, "uvs"), checkSpan(mesh.positions, corners, "positions"),
                        checkSpan(mesh.normals, corners, "normals"), checkSpan(mesh.tangents, corners, "tangents")}) {
        if (error.code != ErrorCode::ok) return error;
    }
    return Error{ErrorCode::ok};
}

}  // namespace

Result<HeightToNormalReport> heightToNormal(const HeightMap& map, const MapSide& mesh,
                                            const HeightToNormalOptions& options, std::span<Vec3> out,
                                            const Execution& execution) {
    return atBorder([&]() -> Result<HeightToNormalReport> {
        if (Error error = checkCall(map, mesh, out, options); error.code != ErrorCode::ok) return error;
        Parallel parallel(execution);
        return Heights(map, mesh, out, options, execution.allocator, parallel).run();
    });
}

}  // namespace tspace
