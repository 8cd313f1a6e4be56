// SPDX-License-Identifier: MIT
// Pairs faces at edges, and finds components: makes their winding consistent by traversing the pairs, and computes the
// sums that decide the outside of a component.
#include "core/winding/components.h"

#include <algorithm>
#include <span>

#include "core/base/mesh_loops.h"
#include "core/base/sort.h"
#include "core/base/vec_math.h"

namespace tspace::winding {
namespace {

/// Face at an edge where more than two faces meet.
struct FaceAtEdge {
    std::uint32_t corner;
    std::uint32_t low, high;  ///< vertices of the edge, not points
    std::uint32_t apex;       ///< the opposite point of a triangle; for other faces a unique number
    double turn = 0;          ///< angle about the edge
};

class Pairing {
  public:
    Pairing(const Surface& surface, const Allocator* allocator)
        : surface_(surface),
          allocator_(allocator), pairs_{Buffer<std::uint32_t>(allocator, surface.mesh.cornerCount(), kNoPartner), {}} {}

    EdgePairs run() {
        forEachEdge(
            surface_.mesh.vertexCount(), allocator_, [&](const auto& add) { forHalves(add); },
            [&](std::uint32_t, std::uint32_t, std::span<const HalfEdge> halves) {
                if (halves.size() == 2) {
                    const std::uint32_t a = cornerOf(halves[0]), b = cornerOf(halves[1]);
                    pair(a & ~kForward, b & ~kForward, (a & kForward) == (b & kForward));
                } else if (halves.size() > 2) {
                    pairMany(halves);
                }
            });
        return std::move(pairs_);
    }

  private:
    static constexpr std::uint32_t kForward =
        0x80000000u;  // flag of a half-edge that runs from its point with the lower index to the other

    /// Calls body(low, high, corner) for the edges of all used faces; the corner is combined with kForward.
    template <class Body>
    void forHalves(const Body& body) const {
        forEachFace(surface_.mesh, [&](std::size_t, std::size_t first, std::uint32_t size) {
            if (size < 3 || touchesTwice(first, size)) return;
            const auto begin = static_cast<std::uint32_t>(first), last = begin + size - 1;
            std::uint32_t from = surface_.pointOf(last);
            for (std::uint32_t c = begin, corner = last; c <= last; corner = c++) {
                const std::uint32_t to = surface_.pointOf(c);
                body(std::min(from, to), std::max(from, to), corner | (from < to ? kForward : 0));
                from = to;
            }
        });
    }
    /// Returns whether consecutive corners of a face share a point. The face has no area there, and its edges would be
    /// paired with each other.
    [[nodiscard]] bool touchesTwice(std::size_t first, std::uint32_t size) const {
        std::uint32_t before = surface_.pointOf(static_cast<std::uint32_t>(first) + size - 1);
        std::uint32_t next = 0;
        for (std::uint32_t k = 0; k < size; ++k, before = next) {
            next = surface_.pointOf(static_cast<std::uint32_t>(first) + k);
            if (next == before) return true;
        }
        return false;
    }

    [[nodiscard]] std::uint32_t apexOf(std::uint32_t corner) const {
        const std::uint32_t face = surface_.faces.of(corner);
        if (surface_.faces.past(face) - surface_.faces.first(face) != 3) return 0x80000000u | corner;
        return surface_.pointOf(surface_.faces.previous(corner));
    }
    void pair(std::uint32_t a, std::uint32_t b, bool are_alike) {
        const std::uint32_t mark = are_alike && apexOf(a) != apexOf(b) ? kConflict : 0;
        pairs_.sure[a] = b | mark;
        pairs_.sure[b] = a | mark;
    }
    /// Pairs two faces that do not coincide. Such pairs are doubtful.
    void pairDoubtfully(std::uint32_t a, std::uint32_t b, std::uint32_t mark) {
        if (pairs_.doubtful.empty())
            pairs_.doubtful = Buffer<std::uint32_t>(allocator_, pairs_.sure.size(), kNoPartner);
        pairs_.sure[a] = a;
        pairs_.sure[b] = b;
        pairs_.doubtful[a] = b | mark;
        pairs_.doubtful[b] = a | mark;
    }

    void pairMany(std::span<const HalfEdge> halves) {
        Buffer<FaceAtEdge> faces(allocator_, halves.size());
        for (std::size_t i = 0; i < halves.size(); ++i) {
            const std::uint32_t corner = cornerOf(halves[i]) & ~kForward;
            const std::uint32_t a = surface_.mesh.indices[corner],
                                b = surface_.mesh.indices[surface_.faces.next(corner)];
            const bool is_forward = runsForward(corner);
            faces[i] = {corner, is_forward ? a : b, is_forward ? b : a, apexOf(corner)};
        }
        std::span<FaceAtEdge> rest{faces.data(), faces.size()};
        rest = pairUnique(rest, [](const FaceAtEdge& f) { return std::pair(f.low, f.high); });
        rest = pairUnique(rest, [](const FaceAtEdge& f) { return std::pair(f.apex, 0u); });
        // Faces without area, and three or more coincident faces, get no neighbor.
        std::size_t kept = 0;
        for (std::size_t i = 0, past = 0; i < rest.size(); i = past) {
            while (past < rest.size() && rest[past].apex == rest[i].apex) ++past;
            const DVec3 area = surface_.areaVector(surface_.faces.of(rest[i].corner));
            const double size = dot(area, area);
            if (past - i == 1 && size > 0 && size < 1e300) rest[kept++] = rest[i];
        }
        pairByTurn(rest.first(kept));
    }
    [[nodiscard]] bool runsForward(std::uint32_t corner) const {
        return surface_.pointOf(corner) < surface_.pointOf(surface_.faces.next(corner));
    }

    /// Pairs the faces whose kind occurs exactly twice, and returns the other faces, sorted.
    template <class KindOf>
    std::span<FaceAtEdge> pairUnique(std::span<FaceAtEdge> faces, KindOf kindOf) {
        sortList(faces.begin(), faces.end(), [&](const FaceAtEdge& a, const FaceAtEdge& b) {
            return std::pair(kindOf(a), a.corner) < std::pair(kindOf(b), b.corner);
        });
        std::size_t kept = 0;
        for (std::size_t i = 0, past = 0; i < faces.size(); i = past) {
            while (past < faces.size() && kindOf(faces[past]) == kindOf(faces[i])) ++past;
            if (past - i == 2) {
                const std::uint32_t a = faces[i].corner, b = faces[i + 1].corner;
                pair(a, b, runsForward(a) == runsForward(b));
            } else {
                for (std::size_t k = i; k < past; ++k) faces[kept++] = faces[k];
            }
        }
        return faces.first(kept);
    }

    void pairByTurn(std::span<FaceAtEdge> faces) {
        const std::size_t count = faces.size();
        if (count < 2) return;
        setTurns(faces);
        sortList(faces.begin(), faces.end(), [](const FaceAtEdge& a, const FaceAtEdge& b) {
            return a.turn != b.turn ? a.turn < b.turn : a.corner < b.corner;
        });
        if (count % 2 != 0) return pairStraightest(faces);
        double inner = 0;  // sum of the gaps between faces 0 and 1, 2 and 3, ...
        for (std::size_t i = 0; i < count; i += 2) inner += faces[i + 1].turn - faces[i].turn;
        const std::size_t start = inner <= kPi ? 0 : 1;
        for (std::size_t i = start; i < count + start; i += 2)
            pairDoubtfully(faces[i % count].corner, faces[(i + 1) % count].corner, 0);
    }

    /// Computes the angles of faces about their common edge. The interior of a face is in the direction cross(normal,
    /// edge) of its edge, for either winding.
    void setTurns(std::span<FaceAtEdge> faces) const {
        const std::uint32_t any = faces[0].corner, other = surface_.faces.next(any);
        const bool is_forward = runsForward(any);
        const DVec3 edge = surface_.position(is_forward ? other : any) - surface_.position(is_forward ? any : other);
        DVec3 x, y;
        for (FaceAtEdge& face : faces) {
            const DVec3 area = surface_.areaVector(surface_.faces.of(face.corner));
            const DVec3 in = cross((1 / length(area)) * area, runsForward(face.corner) ? edge : -1.0 * edge);
            if (&face == &faces[0]) {
                x = in;
                y = cross(edge, in);
                y = (length(x) / length(y)) * y;
            }
            const double along = dot(in, x), across = dot(in, y);
            if (!(std::fabs(along) < 1e300 && std::fabs(across) < 1e300)) continue;
            face.turn = across < 0 ? 2 * kPi - polarAngle(along, -across) : polarAngle(along, across);
        }
    }

    /// Pairs the two faces whose angle about the edge is closest to 180 degrees. `faces` must be sorted by angle.
    void pairStraightest(std::span<const FaceAtEdge> faces) {
        std::size_t a = 0, b = 1;
        double least = 4 * kPi;
        for (std::size_t i = 0, k = 0; i < faces.size() && faces[i].turn < kPi; ++i) {
            while (k + 1 < faces.size() && faces[k].turn < faces[i].turn + kPi) ++k;
            for (const std::size_t j : {k, k - (k > 0 ? 1 : 0)}) {
                const double bend = std::fabs(faces[j].turn - faces[i].turn - kPi);
                if (j == i || bend >= least) continue;
                least = bend;
                a = i;
                b = j;
            }
        }
        pairDoubtfully(faces[a].corner, faces[b].corner, kOdd);
    }

    const Surface& surface_;
    const Allocator* allocator_;
    EdgePairs pairs_;
};

}  // namespace

EdgePairs pairEdges(const Surface& surface, const Allocator* allocator) { return Pairing(surface, allocator).run(); }

// Winding numbers of open surfaces.
// Based on: Jacobson, Kavan & Sorkine-Hornung, "Robust Inside-Outside Segmentation using Generalized Winding Numbers",
// 2013 (the winding number of an open surface); van Oosterom & Strackee, "The Solid Angle of a Plane Triangle", 1983;
// Barill et al., "Fast Winding Numbers for Soups and Clouds", 2018 (far faces as dipoles).

namespace {

DVec3 center(const Surface& surface, std::uint32_t face) {
    const std::uint32_t first = surface.faces.first(face), past = surface.faces.past(face);
    DVec3 sum;
    for (std::uint32_t c = first; c < past; ++c) sum = sum + surface.position(c);
    return (1.0 / (past - first)) * sum;
}

/// Returns the sum of the normals of a face's corners.
DVec3 normalSum(const Surface& surface, std::uint32_t face) {
    const MeshView& mesh = surface.mesh;
    DVec3 sum;
    for (std::uint32_t c = surface.faces.first(face); c < surface.faces.past(face); ++c) {
        const bool is_own = mesh.normal_indices.type != IndexType::none;
        sum = sum + toDouble(mesh.normals[is_own ? mesh.normal_indices[c] : mesh.indices[c]]);
    }
    return sum;
}

/// Returns the solid angle of a triangle as seen from the origin.
double solidAngle(const DVec3& a, const DVec3& b, const DVec3& c) {
    const double volume = dot(a, cross(b, c)), la = length(a), lb = length(b), lc = length(c);
    const double along = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    if (!(std::fabs(along) < 1e300 && std::fabs(volume) < 1e300)) return 0;
    const double half = polarAngle(along, std::fabs(volume));
    return volume < 0 ? -2 * half : 2 * half;
}

/// Number of faces per block. Blocks are fixed, so that sums do not depend on the number of threads.
constexpr std::size_t kBlock = 2048;
constexpr std::uint32_t kPoints = 12;

/// Sums of the solid angles of a block's faces, as seen from each of the points.
struct OwnAngles {
    const WindingCall& call;
    double x[kPoints], y[kPoints], z[kPoints];
    std::uint32_t own[kPoints];  ///< for each point, the face that contains it, which is excluded from its sum

    void add(std::uint32_t face, double (&sums)[kPoints]) const {
        // Distance, in squared edge lengths, beyond which a face is approximated by a dipole, with an error of some
        // percent.
        constexpr double kFar = 25;
        const Surface& surface = call.surface;
        const DVec3 middle = center(surface, face), vector = call.areaVector(face);
        const double reach = kFar * longestEdge(face);
        double angles[kPoints];
        bool is_far = reach < 1e300;
        for (std::uint32_t p = 0; p < kPoints; ++p) {
            const double a = middle.x - x[p], b = middle.y - y[p], c = middle.z - z[p], square = a * a + b * b + c * c;
            angles[p] = 0.5 * (vector.x * a + vector.y * b + vector.z * c) / (square * std::sqrt(square));
            is_far &= square > reach;
        }
        if (!is_far) addFaceExactly(face, reach, middle, angles);
        for (std::uint32_t p = 0; p < kPoints; ++p) sums[p] += angles[p];
    }

  private:
    /// Returns the largest squared distance of a corner of the face from its first corner.
    [[nodiscard]] double longestEdge(std::uint32_t face) const {
        const MeshFaces& faces = call.surface.faces;
        const DVec3 origin = call.surface.position(faces.first(face));
        double longest = 0;
        for (std::uint32_t c = faces.first(face) + 1; c < faces.past(face); ++c) {
            const DVec3 edge = call.surface.position(c) - origin;
            longest = std::max(longest, dot(edge, edge));
        }
        return longest;
    }
    void addFaceExactly(std::uint32_t face, double reach, const DVec3& middle, double (&angles)[kPoints]) const {
        const Surface& surface = call.surface;
        for (std::uint32_t p = 0; p < kPoints; ++p) {
            const DVec3 from{x[p], y[p], z[p]}, to = middle - from;
            if (dot(to, to) > reach && std::fabs(angles[p]) < 1e300) continue;
            const std::uint32_t first = surface.faces.first(face), past = surface.faces.past(face);
            double sum = 0;
            for (std::uint32_t c = first + 1; c + 1 < past && face != own[p]; ++c)
                sum += solidAngle(surface.position(first) - from, surface.position(c) - from,
                                  surface.position(c + 1) - from);
            const double sign = call.turned[face] != 0 ? -call.outward : call.outward;
            angles[p] = std::fabs(sum) < 1e300 ? sign * sum : 0;
        }
    }
};

class Flood {
  public:
    /// `at_border`: one flag per point, or empty. If it is not empty, pairs whose edge has both ends at a border are
    /// followed last.
    Flood(const WindingCall& call, std::uint32_t begin, Buffer<std::uint32_t>& order, Buffer<std::uint8_t>& reached,
          const Buffer<std::uint8_t>& at_border)
        : call_(call), faces_(call.surface.faces), order_(order), reached_(reached), at_border_(at_border), end_(begin),
          late_(begin), even_(begin), odd_(begin) {}

    Component run(std::uint32_t first) {
        Component component{.begin = end_};
        reach(first, false);
        // conflicts before and after flipping; each pair is visited from both sides
        std::uint64_t before = 0, after = 0;
        std::uint32_t at = component.begin;
        do {
            for (; at < end_; ++at) {
                const std::uint32_t face = order_[at];
                for (std::uint32_t c = faces_.first(face); c < faces_.past(face); ++c) {
                    const std::uint32_t partner = call_.pairs.sure[c];
                    if (partner == kNoPartner) {
                        component.is_closed = false;
                        continue;
                    }
                    if (partner == c) continue;
                    const std::uint32_t other = faces_.of(partner & ~kConflict);
                    const bool differs = (partner & kConflict) != 0;
                    before += differs ? 1U : 0U;
                    if (reached_[other] == 0) {
                        if (isLate(c)) continue;
                        reach(other, isTurned(face) != differs);
                    }
                    after += ((isTurned(face) != isTurned(other)) != differs) ? 1U : 0U;
                }
            }
        } while (followDeferred() || followDoubtful(even_, 0) || followDoubtful(odd_, kOdd));
        component.end = end_;
        component.conflicts_before = (before + doubtfulConflicts(component)) / 2;
        if (!at_border_.empty()) after = sureConflicts(component);
        component.conflicts_after = after / 2;
        return component;
    }

  private:
    static constexpr std::uint8_t kReached = 1, kTurned = 2;

    [[nodiscard]] bool isTurned(std::uint32_t face) const { return reached_[face] == kTurned; }
    [[nodiscard]] bool runsForward(std::uint32_t corner) const {
        return call_.surface.pointOf(corner) < call_.surface.pointOf(faces_.next(corner));
    }
    /// Returns, for a doubtful pair, whether both faces traverse their edge in the same direction.
    [[nodiscard]] bool areInConflict(std::uint32_t corner, std::uint32_t partner) const {
        return runsForward(corner) == runsForward(partner);
    }
    void reach(std::uint32_t face, bool is_turned) {
        reached_[face] = is_turned ? kTurned : kReached;
        call_.turned[face] = is_turned ? 1 : 0;
        order_[end_++] = face;
    }

    [[nodiscard]] bool isLate(std::uint32_t corner) const {
        return !at_border_.empty() && at_border_[call_.surface.pointOf(corner)] != 0 &&
               at_border_[call_.surface.pointOf(faces_.next(corner))] != 0;
    }
    /// Reaches one more face over a deferred pair; returns false if there is none. Faces before late_, and the first
    /// late_corners_ corners of the face at late_, have been examined: a face may have very many corners.
    bool followDeferred() {
        for (; !at_border_.empty() && late_ < end_; ++late_, late_corners_ = 0) {
            const std::uint32_t face = order_[late_];
            for (std::uint32_t c = faces_.first(face) + late_corners_; c < faces_.past(face); ++c) {
                const std::uint32_t partner = call_.pairs.sure[c];
                if (partner == kNoPartner || partner == c) continue;
                const std::uint32_t other = faces_.of(partner & ~kConflict);
                if (reached_[other] != 0) continue;
                reach(other, isTurned(face) != ((partner & kConflict) != 0));
                late_corners_ = c + 1 - faces_.first(face);
                return true;
            }
        }
        return false;
    }
    /// Returns twice the number of sure pairs that are in conflict.
    [[nodiscard]] std::uint64_t sureConflicts(const Component& component) const {
        std::uint64_t count = 0;
        for (std::uint32_t at = component.begin; at < end_; ++at) {
            const std::uint32_t face = order_[at];
            for (std::uint32_t c = faces_.first(face); c < faces_.past(face); ++c) {
                const std::uint32_t partner = call_.pairs.sure[c];
                if (partner == kNoPartner || partner == c) continue;
                const bool is_apart = isTurned(face) != isTurned(faces_.of(partner & ~kConflict));
                count += is_apart != ((partner & kConflict) != 0) ? 1U : 0U;
            }
        }
        return count;
    }

    /// Calls body(face, corner, partner) for the doubtful pairs of a face, as long as it returns true.
    template <class Body>
    bool forDoubtful(std::uint32_t face, const Body& body) const {
        for (std::uint32_t c = faces_.first(face); c < faces_.past(face); ++c) {
            if (call_.pairs.sure[c] == c && !body(c, call_.pairs.doubtful[c])) return false;
        }
        return true;
    }
    /// Reaches one more face over a doubtful pair with this mark; returns false if there is none. Faces before `at`
    /// have been examined.
    bool followDoubtful(std::uint32_t& at, std::uint32_t mark) {
        for (; !call_.pairs.doubtful.empty() && at < end_; ++at) {
            const std::uint32_t face = order_[at];
            const bool is_done = forDoubtful(face, [&](std::uint32_t corner, std::uint32_t partner) {
                const std::uint32_t other = faces_.of(partner & ~kOdd);
                if ((partner & kOdd) != mark || reached_[other] != 0) return true;
                reach(other, isTurned(face) != areInConflict(corner, partner & ~kOdd));
                return false;
            });
            if (!is_done) return true;
        }
        return false;
    }
    /// Returns twice the number of doubtful pairs whose conflict was resolved.
    [[nodiscard]] std::uint64_t doubtfulConflicts(const Component& component) const {
        std::uint64_t count = 0;
        for (std::uint32_t at = component.begin; !call_.pairs.doubtful.empty() && at < end_; ++at) {
            const std::uint32_t face = order_[at];
            forDoubtful(face, [&](std::uint32_t corner, std::uint32_t partner) {
                const bool is_apart = isTurned(face) != isTurned(faces_.of(partner & ~kOdd));
                count += is_apart && areInConflict(corner, partner & ~kOdd) ? 1U : 0U;
                return true;
            });
        }
        return count;
    }

    const WindingCall& call_;
    const MeshFaces& faces_;
    Buffer<std::uint32_t>& order_;
    Buffer<std::uint8_t>& reached_;
    const Buffer<std::uint8_t>& at_border_;
    std::uint32_t end_;                ///< end of the faces in the order that have been reached
    std::uint32_t late_, even_, odd_;  ///< positions up to which deferred, even and odd pairs were examined
    std::uint32_t late_corners_ = 0;
};

Buffer<std::uint8_t> pointsAtBorders(const WindingCall& call) {
    const Surface& surface = call.surface;
    Buffer<std::uint8_t> at_border(call.allocator(), surface.mesh.vertexCount(), 0);
    forEachFace(surface.mesh, [&](std::size_t, std::size_t first, std::uint32_t size) {
        for (std::size_t c = first; c < first + size; ++c) {
            if (call.pairs.sure[c] != kNoPartner) continue;
            const std::size_t next = c + 1 < first + size ? c + 1 : first;
            at_border[surface.points[c]] = at_border[surface.points[next]] = 1;
        }
    });
    return at_border;
}

}  // namespace

Component flood(const WindingCall& call, std::uint32_t first, std::uint32_t begin, FloodMemory& memory) {
    const Buffer<std::uint8_t> anywhere;
    const auto run = [&](const Buffer<std::uint8_t>& at_border) {
        return Flood(call, begin, memory.order, memory.reached, at_border).run(first);
    };
    const Component component = run(anywhere);
    if (component.is_closed || component.conflicts_after == 0) return component;
    const auto again = [&](const Buffer<std::uint8_t>& at_border) {
        for (std::uint32_t i = begin; i < component.end; ++i) memory.reached[memory.order[i]] = 0;
        return run(at_border);
    };
    if (memory.at_border.empty()) memory.at_border = pointsAtBorders(call);
    const Component border_last = again(memory.at_border);
    return border_last.conflicts_after < component.conflicts_after ? border_last : again(anywhere);
}

void measure(const WindingCall& call, const Buffer<std::uint32_t>& order, Component& component) {
    const Surface& surface = call.surface;
    const bool has_normals = call.options.use_normals && !surface.mesh.normals.empty();
    const DVec3 origin = surface.position(surface.faces.first(order[component.begin]));
    Box box;
    for (std::uint32_t i = component.begin; i < component.end; ++i) {
        const std::uint32_t face = order[i];
        const bool is_turned = call.turned[face] != 0;
        const DVec3 counter_clockwise = surface.areaVector(face, [&](const Vec3& p) { box.add(p); });
        const DVec3 vector = (is_turned ? -call.outward : call.outward) * counter_clockwise;
        const double area = length(vector);
        component.turned_count += is_turned ? 1U : 0U;
        if (!(area < 1e300)) continue;
        component.area += area;
        component.kept += is_turned ? -area : area;
        // Adds Newell's vector times any corner, which for a flat face equals the sum over its triangles.
        component.volume += dot(vector, surface.position(surface.faces.first(face)) - origin);
        if (!has_normals) continue;
        const double side = dot(vector, normalSum(surface, face));
        if (!(std::fabs(side) > 0)) continue;
        component.facing += side > 0 ? area : -area;
        component.faced += area;
    }
    component.box = box;
}

double ownWindingNumber(const WindingCall& call, const Buffer<std::uint32_t>& order, const Component& component) {
    OwnAngles angles{call, {}, {}, {}, {}};
    for (std::uint32_t p = 0; p < kPoints; ++p) {
        const std::uint64_t place = (2 * std::uint64_t{p} + 1) * component.size() / (2 * kPoints);
        angles.own[p] = order[component.begin + static_cast<std::uint32_t>(place)];
        const DVec3 from = center(call.surface, angles.own[p]);
        angles.x[p] = from.x;
        angles.y[p] = from.y;
        angles.z[p] = from.z;
    }
    const std::size_t blocks = (component.size() + kBlock - 1) / kBlock;
    Buffer<double> block_sums(call.allocator(), blocks * kPoints);
    call.parallel.forTasks(blocks, [&](std::size_t block) {
        double sums[kPoints] = {};
        const std::size_t begin = component.begin + block * kBlock,
                          end = std::min<std::size_t>(component.end, begin + kBlock);
        for (std::size_t i = begin; i < end; ++i) angles.add(order[i], sums);
        for (std::uint32_t p = 0; p < kPoints; ++p) block_sums[block * kPoints + p] = sums[p];
    });
    double sum = 0;
    for (std::size_t i = 0; i < block_sums.size(); ++i) sum += block_sums[i];
    return sum / (4 * kPi * kPoints);
}

}  // namespace tspace::winding
