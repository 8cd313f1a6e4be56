// SPDX-License-Identifier: MIT
// Repair of invalid tangents: a fast scan finds blocks of faces that may contain invalid tangents; in these blocks,
// invalid corners are detected, valid ones at their positions are searched, and the repairs are written face by face.
// Based on: Gram-Schmidt; Duff et al. 2017 if only the normal is usable.
#include "tspace/tangents.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cfloat>
#include <cmath>
#include <utility>

#include "core/base/border.h"
#include "core/base/memory.h"
#include "core/base/mesh_loops.h"
#include "core/base/parallel.h"
#include "core/base/vec_math.h"
#include "core/base/weld.h"
#include "core/frames/one_list.h"

namespace tspace {
namespace {

/// Tolerance of the glTF validator for the length of a tangent.
constexpr double kUnitTolerance = 5e-4;
/// Sine of one degree.
constexpr double kOneDegree = 0.017452406437283512;
/// Tolerance of orthogonalize_all: valid tangents this close to unit and orthogonal are unchanged. Rounding to float
/// leaves an error of less than 1.5e-7, so repaired tangents are not changed again.
constexpr double kOrthogonalTolerance = 5e-7;

/// Triangles per block of the scan. With larger blocks, more valid faces would take the slow path.
constexpr std::size_t kFacesPerBlock = 4;
constexpr std::size_t kScanGrain = 1024;

/// Counters of the report: causes of invalid tangents, sources of their repair, and others.
enum class Counted : std::uint8_t {
    notFinite,
    zero,
    notUnit,
    parallel,
    placeholder,
    badSign,
    mixedSign,
    notOrthogonal,
    fromOwn,
    fromNeighbor,
    fromBasis,
    badNormal,
    needsNeighbor,
    valid
};
using Cause = Counted;
using Repair = Counted;
constexpr auto kCounted = static_cast<std::size_t>(Counted::valid);

struct Counts {
    std::array<std::uint64_t, kCounted> of{};
    void count(Counted what) { ++of[static_cast<std::size_t>(what)]; }
};

bool isSign(float w) { return w == 1.0f || w == -1.0f; }

/// Returns the normalized N; zero if it has no direction.
DVec3 unitNormal(const Vec3& normal) {
    if (!isFinite(normal)) return {};
    const DVec3 n = toDouble(normal);
    const double size = length(n);
    return size > 0 ? (1 / size) * n : DVec3{};
}

bool isZero(const DVec3& v) { return v.x == 0 && v.y == 0 && v.z == 0; }

/// Returns whether a tangent can be derived from a direction at a corner with this unit normal (zero: no normal).
bool isUsable(const Vec3& direction, const DVec3& n) {
    if (!isFinite(direction)) return false;
    const DVec3 t = toDouble(direction);
    const double size = length(t);
    return size >= double{FLT_MIN} && length(cross(n, t)) >= (isZero(n) ? 0.0 : kOneDegree * size);
}

/// Returns whether the direction is a placeholder that an exporter wrote: see tangents.h.
bool isPlaceholder(const Vec4& tangent, const DVec3& n) {
    return xyz(tangent) == Vec3{1, 0, 0} && std::abs(n.x) > kOrthogonalTolerance;
}

Cause causeOf(const Vec4& tangent, const DVec3& n) {
    if (!isFinite(xyz(tangent))) return Cause::notFinite;
    const double size = length(toDouble(xyz(tangent)));
    if (size < double{FLT_MIN}) return Cause::zero;
    if (std::abs(size - 1) > kUnitTolerance) return Cause::notUnit;
    if (!isUsable(xyz(tangent), n)) return Cause::parallel;
    if (isPlaceholder(tangent, n)) return Cause::placeholder;
    return isSign(tangent.w) ? Cause::valid : Cause::badSign;
}

/// Returns a usable direction made unit and orthogonal to n. Orthogonalizes twice, because close to n the first pass
/// loses digits by cancellation.
Vec3 orthonormal(const Vec3& direction, const DVec3& n) {
    DVec3 t = toDouble(direction);
    for (int pass = 0; pass < 2; ++pass) {
        t = (1 / length(t)) * t;
        t = t - dot(n, t) * n;
    }
    return toFloat((1 / length(t)) * t);
}

bool isOrthonormal(const Vec3& tangent, const DVec3& n) {
    const DVec3 t = toDouble(tangent);
    return std::abs(length(t) - 1) <= kOrthogonalTolerance && std::abs(dot(n, t)) <= kOrthogonalTolerance;
}

/// Conservative fast test: true only for tangents that causeOf considers valid, with a normal that has a direction. All
/// limits are stricter than the exact ones by far more than float rounding.
struct FastValidityTest {
    static constexpr float kSquareTolerance = 9.9e-4f;  // below 2 * kUnitTolerance
    static constexpr float kSquareCosine = 0.99f;       // squared cosine of 5.7 degrees
    static constexpr float kSquareLean = 1e-13f;        // below kOrthogonalTolerance^2
    // Limits of the squared length of N within which the products below neither underflow nor overflow.
    static constexpr float kLeast = 1e-20f, kMost = 1e20f;

    /// Tests four tangents at once; `w` contains their signs.
    static Mask4 of(const Vec3x4& t, Float4 w, const Vec3x4& n) {
        const Float4 nn = dot(n, n), nt = dot(n, t);
        const Float4 most = select4(or4(t.y, t.z) == splat(0), splat(kSquareLean), splat(kSquareCosine));
        return (abs4(dot(t, t) - splat(1)) <= splat(kSquareTolerance)) & (nn >= splat(kLeast)) & (nn <= splat(kMost)) &
               (nt * nt <= most * nn) & (abs4(w) == splat(1));
    }
    static bool of(const Vec4& t, const Vec3& n) {
        return laneBits(of({splat(t.x), splat(t.y), splat(t.z)}, splat(t.w), {splat(n.x), splat(n.y), splat(n.z)})) !=
               0;
    }
};

class Sanitizer {
  public:
    Sanitizer(const MeshView& mesh, const SanitizeOptions& options, StridedSpan<Vec4> tangents,
              const Execution& execution)
        : mesh_(mesh), tangents_(tangents), options_(options), allocator_(execution.allocator),
          parallel_(execution, mesh.cornerCount()) {
        cutIntoBlocks();
    }

    SanitizeReport run() {
        if (!scan()) return {};
        causes_ = Buffer<Cause>(allocator_, mesh_.cornerCount(), Cause::valid);
        forEachCandidate(
            [this](std::size_t first, std::uint32_t size, Counts& counts) { detect(first, size, counts); });
        if (countOf(Counted::needsNeighbor) != 0) findTangentsByPosition();
        forEachCandidate(
            [this](std::size_t first, std::uint32_t size, Counts& counts) { repair(first, size, counts); });
        if (countOf(Counted::badNormal) != 0) alignWithoutNormals();
        return report();
    }

  private:
    [[nodiscard]] std::uint64_t countOf(Counted what) const { return counts_[static_cast<std::size_t>(what)]; }

    [[nodiscard]] SanitizeReport report() const {
        return {.not_finite_count = countOf(Counted::notFinite),
                .zero_count = countOf(Counted::zero),
                .not_unit_count = countOf(Counted::notUnit),
                .parallel_count = countOf(Counted::parallel),
                .placeholder_count = countOf(Counted::placeholder),
                .bad_sign_count = countOf(Counted::badSign),
                .mixed_sign_count = countOf(Counted::mixedSign),
                .orthogonalized_count = countOf(Counted::notOrthogonal),
                .normalized_count = countOf(Counted::fromOwn),
                .from_neighbor_count = countOf(Counted::fromNeighbor),
                .from_basis_count = countOf(Counted::fromBasis),
                .bad_normal_count = countOf(Counted::badNormal)};
    }

    void cutIntoBlocks() {
        const std::size_t faces = mesh_.faceCount();
        candidates_ = Buffer<std::uint8_t>(allocator_, (faces + kFacesPerBlock - 1) / kFacesPerBlock);
        if (mesh_.face_sizes.empty()) return;
        block_corners_ = Buffer<std::uint32_t>(allocator_, candidates_.size());
        forEachFace(mesh_, [&](std::size_t face, std::size_t first, std::uint32_t) {
            if (face % kFacesPerBlock == 0) block_corners_[face / kFacesPerBlock] = static_cast<std::uint32_t>(first);
        });
    }

    /// Calls body(first_corner, corner_count) for each face of the block with at least 3 corners.
    template <class Body>
    void forEachFaceOf(std::size_t block, Body&& body) const {
        const std::size_t begin = block * kFacesPerBlock;
        const std::size_t end = std::min(begin + kFacesPerBlock, mesh_.faceCount());
        std::size_t first = block_corners_.empty() ? begin * mesh_.face_size : block_corners_[block];
        for (std::size_t face = begin; face < end; ++face) {
            const std::uint32_t size = faceSize(mesh_, face);
            if (size >= 3) body(first, size);
            first += size;
        }
    }

    /// Marks blocks in which something may have to be counted or changed; returns false if there are none.
    bool scan() {
        return sumRanges(parallel_, candidates_.size(), kScanGrain, [this](std::size_t begin, std::size_t end) {
                   std::uint64_t count = 0;
                   for (std::size_t block = begin; block < end; ++block)
                       count += candidates_[block] = options_.orthogonalize_all || !isValidBlock(block) ? 1 : 0;
                   return count;
               }) != 0;
    }

    [[nodiscard]] bool isValidBlock(std::size_t block) const {
        return withIndices(mesh_.indices, [&](auto vertexOf) {
            const bool has_triangles = mesh_.face_sizes.empty() && mesh_.face_size == 3;
            const std::size_t begin = block * kFacesPerBlock;
            if (has_triangles && begin + kFacesPerBlock <= mesh_.faceCount()) return areValid(3 * begin, vertexOf);
            bool fine = true;
            forEachFaceOf(block, [&](std::size_t first, std::uint32_t size) {
                const float sign = tangents_[first].w;
                for (std::size_t c = first; c < first + size; ++c) {
                    const Vec4& tangent = tangents_[c];
                    fine &= FastValidityTest::of(tangent, mesh_.normals[vertexOf(c)]) & (tangent.w == sign);
                }
            });
            return fine;
        });
    }

    /// Tests the four triangles of a full block.
    template <class VertexOf>
    [[nodiscard]] bool areValid(std::size_t first, VertexOf vertexOf) const {
        static_assert(kFacesPerBlock == 4);
        constexpr unsigned kFirstTwoOfThree = 0b011'011'011'011;
        unsigned signs = 0;
        Mask4 valid = Mask4{} - 1;
        for (unsigned i = 0; i < 12; i += 4) {
            const std::size_t c = first + i;
            Float4 x = loadFloat4(&tangents_[c].x), y = loadFloat4(&tangents_[c + 1].x),
                   z = loadFloat4(&tangents_[c + 2].x), w = loadFloat4(&tangents_[c + 3].x);
            transpose4(x, y, z, w);
            const auto normal = [&](unsigned k) -> const Vec3& { return mesh_.normals[vertexOf(c + k)]; };
            valid &= FastValidityTest::of({x, y, z}, w, gatherVec3(normal(0), normal(1), normal(2), normal(3)));
            signs |= laneBits(std::bit_cast<Mask4>(w)) << i;
        }
        // Bit i of `signs` equals bit i + 1, except at the end of a triangle.
        return laneBits(valid) == 0b1111 && ((signs ^ signs >> 1) & kFirstTwoOfThree) == 0;
    }

    /// Calls body(first_corner, corner_count, counts) for each face that scan() did not exclude; faces are independent.
    template <class Body>
    void forEachCandidate(Body&& body) {
        parallel_.forRanges(candidates_.size(), kScanGrain, [&](std::size_t begin, std::size_t end) {
            Counts counts;
            for (std::size_t block = begin; block < end; ++block) {
                if (candidates_[block] == 0) continue;
                forEachFaceOf(block, [&](std::size_t first, std::uint32_t size) { body(first, size, counts); });
            }
            for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += counts.of[i];
        });
    }

    [[nodiscard]] DVec3 normalAt(std::size_t corner) const { return unitNormal(mesh_.normals[mesh_.indices[corner]]); }

    /// Returns the first valid corner of the face, or `first + size`.
    [[nodiscard]] std::size_t firstValid(std::size_t first, std::uint32_t size) const {
        std::size_t c = first;
        while (c < first + size && causes_[c] != Cause::valid) ++c;
        return c;
    }

    /// Detects the defects of a face's corners, and counts corners that need the valid tangent of another corner at
    /// their position.
    void detect(std::size_t first, std::uint32_t size, Counts& counts) {
        bool all_valid = true;
        for (std::size_t c = first; c < first + size; ++c) {
            if (FastValidityTest::of(tangents_[c], mesh_.normals[mesh_.indices[c]]))
                continue;  // causes_ is initialized to Cause::valid
            const DVec3 n = normalAt(c);
            if (isZero(n)) counts.count(Counted::badNormal);
            causes_[c] = causeOf(tangents_[c], n);
            all_valid = all_valid && causes_[c] == Cause::valid;
        }
        if (all_valid) return;
        const std::size_t valid = firstValid(first, size);
        const bool has_valid = valid < first + size;
        for (std::size_t c = first; c < first + size; ++c) {
            if (causes_[c] == Cause::valid) continue;
            const DVec3 n = normalAt(c);
            const bool has_sign = has_valid || isSign(tangents_[c].w);
            if (!has_sign || !(isUsable(xyz(tangents_[c]), n) || (has_valid && isUsable(xyz(tangents_[valid]), n))))
                counts.count(Counted::needsNeighbor);
        }
    }

    /// Finds the first valid tangent at each position.
    void findTangentsByPosition() {
        points_ = weldPositions(mesh_, allocator_, parallel_);
        found_ = Buffer<Vec4>(allocator_, mesh_.vertexCount(), Vec4{});
        withIndices(mesh_.indices, [&](auto vertexOf) {
            forEachFace(mesh_, [&](std::size_t, std::size_t first, std::uint32_t size) {
                for (std::size_t c = first; size >= 3 && c < first + size; ++c) {
                    if (causes_[c] != Cause::valid) continue;
                    Vec4& found = found_[pointOf(vertexOf(c))];
                    if (found.w == 0) found = tangents_[c];
                }
            });
        });
    }

    [[nodiscard]] std::uint32_t pointOf(std::uint32_t vertex) const {
        return points_.empty() ? vertex : points_[vertex];
    }
    /// Returns the first valid tangent at a corner's position; null if there is none, or if no such corner needs one.
    [[nodiscard]] const Vec4* validTangentAt(std::size_t corner) const {
        const std::uint32_t vertex = mesh_.indices[corner];
        const Vec3& p = mesh_.positions[vertex];
        if (found_.empty() || !(p == p)) return nullptr;
        const Vec4& found = found_[pointOf(vertex)];
        return found.w != 0 ? &found : nullptr;
    }

    /// Returns the common sign of a face's corners, from the first of these sources that exists: valid corners whose N
    /// has a direction (without one, a sign is meaningless); other valid corners; invalid corners that have a sign; the
    /// first valid corner at one of the face's positions; +1.
    [[nodiscard]] float signOf(std::size_t first, std::uint32_t size) const {
        const auto votes = [this](std::size_t c, int round) {
            if (round == 2) return isSign(tangents_[c].w);
            return causes_[c] == Cause::valid && (round == 1 || !isZero(normalAt(c)));
        };
        for (int round = 0; round < 3; ++round) {
            std::int64_t sum = 0;
            float first_sign = 0;
            for (std::size_t c = first; c < first + size; ++c) {
                if (!votes(c, round)) continue;
                const float w = tangents_[c].w;
                sum += w > 0 ? 1 : -1;
                if (first_sign == 0) first_sign = w;
            }
            if (first_sign != 0) return sum == 0 ? first_sign : (sum > 0 ? 1.0f : -1.0f);
        }
        for (std::size_t c = first; c < first + size; ++c) {
            if (const Vec4* valid = validTangentAt(c)) return valid->w;
        }
        return 1.0f;
    }

    void repair(std::size_t first, std::uint32_t size, Counts& counts) {
        const float sign = signOf(first, size);
        const std::size_t valid = firstValid(first, size);
        const Vec4 neighbor = valid < first + size ? tangents_[valid] : Vec4{};
        for (std::size_t c = first; c < first + size; ++c) {
            Cause cause = causes_[c];
            if (cause == Cause::valid && tangents_[c].w != sign) cause = Cause::mixedSign;
            if (cause == Cause::valid && !options_.orthogonalize_all) continue;
            const DVec3 n = normalAt(c);
            if (cause == Cause::valid && isOrthonormal(xyz(tangents_[c]), n)) continue;
            if (cause == Cause::valid) cause = Cause::notOrthogonal;
            const auto [tangent, cure] = repaired(c, n, neighbor);
            tangents_[c] = {tangent.x, tangent.y, tangent.z, sign};
            causes_[c] = cure;
            counts.count(cause);
            counts.count(cure);
        }
    }

    /// Where N has no direction, lets corners at one position with substituted tangents and equal signs share the first
    /// of these tangents, so that no vertex has to be split.
    void alignWithoutNormals() {
        if (points_.empty()) points_ = weldPositions(mesh_, allocator_, parallel_);
        Buffer<Vec4> made(allocator_, 2 * mesh_.vertexCount(), Vec4{});
        for (std::size_t c = 0; c < mesh_.cornerCount(); ++c) {
            const bool is_substituted = causes_[c] == Repair::fromNeighbor || causes_[c] == Repair::fromBasis;
            const Vec3& p = mesh_.positions[mesh_.indices[c]];
            if (!is_substituted || !(p == p) || !isZero(normalAt(c))) continue;
            Vec4& first = made[2 * std::size_t{pointOf(mesh_.indices[c])} + (tangents_[c].w < 0 ? 1 : 0)];
            if (first.w == 0) first = tangents_[c];
            tangents_[c] = first;
        }
    }

    [[nodiscard]] std::pair<Vec3, Repair> repaired(std::size_t corner, const DVec3& n, const Vec4& neighbor) const {
        if (isUsable(xyz(tangents_[corner]), n)) return {orthonormal(xyz(tangents_[corner]), n), Repair::fromOwn};
        if (isUsable(xyz(neighbor), n)) return {orthonormal(xyz(neighbor), n), Repair::fromNeighbor};
        const Vec4* valid = validTangentAt(corner);
        if (valid != nullptr && isUsable(xyz(*valid), n)) return {orthonormal(xyz(*valid), n), Repair::fromNeighbor};
        return {toFloat(planeAxes(isZero(n) ? DVec3{0, 0, 1} : n).x), Repair::fromBasis};
    }

    const MeshView& mesh_;
    StridedSpan<Vec4> tangents_;
    const SanitizeOptions& options_;
    const Allocator* allocator_;
    Parallel parallel_;
    Buffer<std::uint8_t> candidates_;      ///< one flag per block: it may contain corners to count or repair
    Buffer<std::uint32_t> block_corners_;  ///< first corner of each block; empty if all faces have the same size
    Buffer<Cause> causes_;
    // Tangents for corners without a valid one: the point of each vertex (empty: the vertex itself), and the first
    // valid tangent at each point; a sign of 0 means that there is none.
    Buffer<std::uint32_t> points_;
    Buffer<Vec4> found_;
    /// Sums of the counters over all tasks; sums of integers do not depend on the order.
    std::array<std::atomic<std::uint64_t>, kCounted> counts_{};
};

Error check(const MeshView& mesh, const StridedSpan<Vec4>& tangents) {
    if (Result<Done> valid = validate(mesh); !valid) return std::move(valid).error();
    if (mesh.normals.empty() && mesh.vertexCount() != 0)
        return {ErrorCode::missingAttribute, "sanitize needs normals, but the mesh has none"};
    return checkSpan(tangents, mesh.cornerCount(), "tangents");
}

}  // namespace

Result<SanitizeReport> sanitizeTangents(const MeshView& mesh, const SanitizeOptions& options,
                                        StridedSpan<Vec4> tangents, const Execution& execution) {
    return atBorder([&]() -> Result<SanitizeReport> {
        if (hasOwnLists(mesh)) {
            return withOneList(mesh, execution, [&](const MeshView& with_one_list) {
                return sanitizeTangents(with_one_list, options, tangents, execution);
            });
        }
        if (Error e = check(mesh, tangents); e.code != ErrorCode::ok) return e;
        return Sanitizer(mesh, options, tangents, execution).run();
    });
}

}  // namespace tspace
