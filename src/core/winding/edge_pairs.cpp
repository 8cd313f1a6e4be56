// SPDX-License-Identifier: MIT
#include "core/winding/edge_pairs.h"

#include <algorithm>
#include <span>

#include "core/base/angle.h"
#include "core/base/edge_runs.h"
#include "core/base/mesh_loops.h"
#include "core/base/sort.h"

namespace tspace::winding {

namespace {

/// One face at an edge where more than two meet.
struct FaceAtEdge {
    std::uint32_t corner;
    std::uint32_t low, high;  ///< vertices, not points
    std::uint32_t apex;       ///< the point across, of a triangle; of others a number that no other has
    double turn = 0;          ///< about the edge
};

class Pairing {
  public:
    Pairing(const Surface& surface, const Allocator* allocator)
        : surface_(surface), allocator_(allocator), partners_(allocator, surface.mesh.cornerCount(), kNoPartner) {}

    Buffer<std::uint32_t> run() {
        forEachEdge(
            surface_.mesh.vertexCount(), allocator_, [&](const auto& add) { forHalves(add); },
            [&](std::uint32_t, std::uint32_t, std::span<const HalfEdge> halves) {
                if (halves.size() == 2) {
                    pair(cornerOf(halves[0]), cornerOf(halves[1]));
                } else if (halves.size() > 2) {
                    pairMany(halves);
                }
            });
        return std::move(partners_);
    }

  private:
    /// body(low, high, corner) for the edges of all faces that count.
    template <class Body>
    void forHalves(const Body& body) const {
        forEachFace(surface_.mesh, [&](std::size_t, std::size_t first, std::uint32_t size) {
            if (size < 3 || touchesTwice(first, size)) return;
            const auto begin = static_cast<std::uint32_t>(first), last = begin + size - 1;
            std::uint32_t from = surface_.pointOf(last);
            for (std::uint32_t c = begin, corner = last; c <= last; corner = c++) {
                const std::uint32_t to = surface_.pointOf(c);
                body(std::min(from, to), std::max(from, to), corner);
                from = to;
            }
        });
    }
    /// Neighbouring corners at one point: the face has no area there, and its edges would pair with one another.
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
        if (surface_.faces.past(face) - surface_.faces.first(face) != 3) return kFixed | corner;
        return surface_.pointOf(surface_.faces.previous(corner));
    }
    void pair(std::uint32_t a, std::uint32_t b) {
        const std::uint32_t mark = apexOf(a) == apexOf(b) ? kFixed : 0;
        partners_[a] = b | mark;
        partners_[b] = a | mark;
    }

    void pairMany(std::span<const HalfEdge> halves) {
        Buffer<FaceAtEdge> faces(allocator_, halves.size());
        for (std::size_t i = 0; i < halves.size(); ++i) {
            const std::uint32_t corner = cornerOf(halves[i]);
            const std::uint32_t a = surface_.mesh.indices[corner],
                                b = surface_.mesh.indices[surface_.faces.next(corner)];
            const bool is_forward = runsForward(corner);
            faces[i] = {corner, is_forward ? a : b, is_forward ? b : a, apexOf(corner)};
        }
        std::span<FaceAtEdge> rest{faces.data(), faces.size()};
        rest = pairTwos(rest, [](const FaceAtEdge& f) { return std::pair(f.low, f.high); });
        rest = pairTwos(rest, [](const FaceAtEdge& f) { return std::pair(f.apex, 0u); });
        // More than two that lie on one another, and faces without area, are nobody's neighbours.
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

    /// Pairs those that are two of a kind, and returns the others, sorted.
    template <class KindOf>
    std::span<FaceAtEdge> pairTwos(std::span<FaceAtEdge> faces, KindOf kindOf) {
        sortList(faces.begin(), faces.end(), [&](const FaceAtEdge& a, const FaceAtEdge& b) {
            return std::pair(kindOf(a), a.corner) < std::pair(kindOf(b), b.corner);
        });
        std::size_t kept = 0;
        for (std::size_t i = 0, past = 0; i < faces.size(); i = past) {
            while (past < faces.size() && kindOf(faces[past]) == kindOf(faces[i])) ++past;
            if (past - i == 2) {
                pair(faces[i].corner, faces[i + 1].corner);
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
        double inner = 0;  // of the gaps between faces 0 and 1, 2 and 3, ...
        for (std::size_t i = 0; i < count; i += 2) inner += faces[i + 1].turn - faces[i].turn;
        const std::size_t start = inner <= kPi ? 0 : 1;
        for (std::size_t i = start; i < count + start; i += 2)
            pair(faces[i % count].corner, faces[(i + 1) % count].corner);
    }

    /// The interior of a face lies at cross(normal, edge) of its edge, whichever way it is wound.
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

    /// Of those that are sorted by their turn.
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
        pair(faces[a].corner, faces[b].corner);
    }

    const Surface& surface_;
    const Allocator* allocator_;
    Buffer<std::uint32_t> partners_;
};

}  // namespace

Buffer<std::uint32_t> pairEdges(const Surface& surface, const Allocator* allocator) {
    return Pairing(surface, allocator).run();
}

}  // namespace tspace::winding
