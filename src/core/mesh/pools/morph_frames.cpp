// SPDX-License-Identifier: MIT
// Computes the frames of morph targets. Each target is evaluated on the plan of the base, repaired like the base, and
// compared with the base corner by corner. If nothing near a corner moves, the evaluation has the bits of the base, so
// the offset is exactly zero. If a target makes faces collapse (an eye that closes), the corner has no tangent of its
// own and keeps the tangent of the base.
//
// A group of the base extends over equal vertices. If a target gives these different normals, as flat shading does when
// a plane bends, a common tangent would point out of every face; the moved shape is then regrouped.
#include "core/mesh/pools/morph_frames.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>
#include <utility>

#include "core/base/unique_index.h"
#include "core/base/vec_math.h"
#include "tspace/frame.h"
#include "tspace/tangents.h"

namespace tspace {
namespace {

constexpr double kCosineOfFiveDegrees = 0.99619469809174555;
constexpr double kTenthOfADegree = 0.0017453283658983088;  // sine of 0.1 degrees

Vec3 sum(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

/// Returns the moved normal as viewers compute it. A sum without direction is returned unchanged, and repaired later.
Vec3 unitSum(const Vec3& normal, const Vec3& offset) {
    const Vec3 moved = sum(normal, offset);
    const DVec3 wide = toDouble(moved);
    const double size = length(wide);
    return size > 0 && std::isfinite(size) ? toFloat((1 / size) * wide) : moved;
}

bool hasDirection(const Vec4& tangent) {
    return isFinite(xyz(tangent)) && length(toDouble(xyz(tangent))) >= double{FLT_MIN};
}

/// Returns whether the tangent has a direction, within a tenth of a degree of the plane perpendicular to N.
bool liesInPlane(const Vec4& tangent, const Vec3& normal) {
    const DVec3 t = toDouble(xyz(tangent)), n = toDouble(normal);
    return hasDirection(tangent) && std::fabs(dot(t, n)) <= kTenthOfADegree * length(t) * length(n);
}

/// Returns whether the tangent points out of the plane of a unit normal. Sums of vectors in the plane do not, unless
/// they cancel out and only rounding errors remain.
bool pointsOutOfPlane(const Vec4& tangent, const Vec3& normal) {
    constexpr double kAboutUnit = 1e-3, kSineOfFiveDegrees = 0.08715574274765817;
    const DVec3 t = toDouble(xyz(tangent)), n = toDouble(normal);
    return std::fabs(dot(n, n) - 1) < kAboutUnit && std::fabs(dot(t, n)) > kSineOfFiveDegrees * length(t);
}

/// Returns a tangent of the base, made orthogonal to another normal if that has a direction.
Vec4 projectedTangent(const Vec4& tangent, const Vec3& from, const Vec3& to) {
    if (from == to || !isFinite(to) || isZero(to)) return tangent;
    const Vec3 t = orthonormalize({.tangent = xyz(tangent), .bitangent = {}, .normal = to}).tangent;
    return {t.x, t.y, t.z, tangent.w};
}

unsigned stepsOf(const TangentOptions& options) { return options.method == Method::best ? options.refine : 0; }

/// Computes values + offsets, per vertex; a vertex with a zero offset keeps its bits. Returns whether any vertex
/// changed.
template <class Add>
bool move(const StridedSpan<const Vec3>& values, const LocalMesh& mesh, const std::vector<Vec3>& offsets, Add&& add,
          std::vector<Vec3>& out) {
    out.resize(values.count);
    for (std::size_t v = 0; v < out.size(); ++v) out[v] = values[v];
    if (offsets.empty() || values.empty()) return false;
    bool moves = false;
    for (std::size_t v = 0; v < out.size(); ++v) {
        const Vec3& offset = offsets[mesh.sources.empty() ? v : mesh.sources[v]];
        if (isZero(offset)) continue;
        out[v] = add(out[v], offset);
        moves = true;
    }
    return moves;
}

/// Returns whether two vectors have equal bits, where both zeros are equal. NaN therefore equals itself.
bool haveEqualBits(const Vec3& a, const Vec3& b) {
    return weldBits(a.x) == weldBits(b.x) && weldBits(a.y) == weldBits(b.y) && weldBits(a.z) == weldBits(b.z);
}

}  // namespace

bool WeldClasses::findApart(std::span<const std::uint32_t> corners, std::span<const Vec3> positions,
                            std::span<const Vec3> normals, std::vector<bool>& apart) const {
    apart.assign(classes_.class_count, false);
    if (classes_.class_count == classes_.class_of.size()) return false;
    constexpr std::uint32_t kNoVertex = 0xffffffffu;
    std::vector<std::uint32_t> first(classes_.class_count, kNoVertex);
    bool any = false;
    for (const std::uint32_t v : corners) {
        std::uint32_t& other = first[of(v)];
        if (other == kNoVertex) other = v;
        if (haveEqualBits(positions[v], positions[other]) && haveEqualBits(normals[v], normals[other])) continue;
        apart[of(v)] = any = true;
    }
    return any;
}

void WeldClasses::spread(const LocalMesh& mesh, unsigned rounds, std::vector<bool>& apart) const {
    const auto classAt = [&](std::size_t c) {
        return of(mesh.indices[mesh.face_corners.empty() ? c : mesh.face_corners[c]]);
    };
    for (; rounds != 0; --rounds) {
        const std::vector<bool> before = apart;
        for (std::size_t c = 0; c < mesh.triangleCornerCount(); c += 3) {
            const std::uint32_t a = classAt(c), b = classAt(c + 1), d = classAt(c + 2);
            if (before[a] || before[b] || before[d]) apart[a] = apart[b] = apart[d] = true;
        }
    }
}

Result<MorphOffsets> readTarget(const PoolView& pool, std::size_t i) {
    Result<MorphOffsets> offsets = pool.targets.read(i);
    if (!offsets) return offsets;
    for (const std::vector<Vec3>* list : {&offsets->positions, &offsets->normals, &offsets->tangents}) {
        if (list->empty() || list->size() == pool.positions.count) continue;
        return Error{ErrorCode::countMismatch, "morph target " + std::to_string(i) + " has " +
                                                   std::to_string(list->size()) + " offsets for " +
                                                   std::to_string(pool.positions.count) + " vertices"};
    }
    return offsets;
}

bool MorphPose::take(const LocalMesh& mesh, const MorphOffsets& offsets) {
    const bool moves_positions = move(mesh.positions, mesh, offsets.positions, sum, positions_);
    const bool moves_normals = move(mesh.normals, mesh, offsets.normals, unitSum, normals_);
    return moves_positions || moves_normals;
}

Vec3 offsetBetween(const Vec3& from, const Vec3& to) {
    // Adding +0 converts -0 to +0.
    const Vec3 offset{to.x - from.x + 0.0f, to.y - from.y + 0.0f, to.z - from.z + 0.0f};
    return isFinite(offset) ? offset : Vec3{};
}

Result<Done> MorphTangents::add(LocalMesh&& mesh, FramesReport& report) {
    Result<TangentPlan> plan = planTangents(mesh.view(), options_.tangents, options_.execution);
    if (!plan) return std::move(plan).error();
    const MeshView view = mesh.view();
    tangents_.resize(mesh.indices.size());
    const Result<TangentReport> made =
        evaluateTangents(*plan, {view.positions, view.normals}, {.tangents = tangents_}, options_.execution);
    if (!made) return made.error();
    WeldClasses classes(mesh);
    pieces_.push_back({std::move(mesh), *std::move(plan), std::move(classes), tangents_, &report});
    return Done{};
}

Result<Done> MorphTangents::compute(std::span<const Vec4> tangents, MorphSplit& split, const KeptOffsets* kept) {
    std::vector<Vec3> offsets(tangents.size());
    for (std::size_t target = 0; target < pool_.targets.count; ++target) {
        const Result<MorphOffsets> moved = readTarget(pool_, target);
        if (!moved) return moved.error();
        std::size_t first = 0;
        for (const Piece& piece : pieces_) {
            const std::size_t count = piece.mesh.triangleCornerCount();
            const std::span<Vec3> own = std::span<Vec3>(offsets).subspan(first, count);
            if (!pose_.take(piece.mesh, *moved)) {
                std::fill(own.begin(), own.end(), Vec3{});
            } else if (Result<Done> done = evaluateFaces(piece, tangents.subspan(first, count), own); !done) {
                return done;
            }
            first += count;
        }
        if (kept != nullptr && !moved->tangents.empty()) {
            for (std::size_t c = 0; c < offsets.size(); ++c) {
                if (!kept->is_new[c]) offsets[c] = moved->tangents[kept->vertices[c]];
            }
        }
        if (Result<Done> done = split.add(offsets, 0, options_.execution); !done) return done;
    }
    return Done{};
}

/// Computes the tangent offsets of a piece on its quads. `base` and `offsets`: one per triangle corner.
Result<Done> MorphTangents::evaluateFaces(const Piece& piece, std::span<const Vec4> base, std::span<Vec3> offsets) {
    const std::vector<std::uint32_t>& face_corners = piece.mesh.face_corners;
    if (face_corners.empty()) return evaluate(piece, base, offsets);
    std::vector<Vec4> base_of_faces(piece.mesh.indices.size());
    for (std::size_t c = 0; c < base.size(); ++c) base_of_faces[face_corners[c]] = base[c];
    std::vector<Vec3> offsets_of_faces(base_of_faces.size());
    if (Result<Done> done = evaluate(piece, base_of_faces, offsets_of_faces); !done) return done;
    toTriangles<Vec3>(piece.mesh, offsets_of_faces, offsets);
    return Done{};
}

Result<Done> MorphTangents::evaluate(const Piece& piece, std::span<const Vec4> base, std::span<Vec3> offsets) {
    tangents_.resize(base.size());
    MeshView posed = piece.mesh.view();
    posed.positions = StridedSpan<const Vec3>(pose_.positions());
    posed.normals = StridedSpan<const Vec3>(pose_.normals());
    const Result<TangentReport> made =
        evaluateTangents(piece.plan, {posed.positions, posed.normals}, {.tangents = tangents_}, options_.execution);
    if (!made) return made.error();
    if (piece.classes.findApart(piece.mesh.indices, pose_.positions(), pose_.normals(), apart_)) {
        // A refinement step reads the results of neighbors, so their classes are regrouped too.
        piece.classes.spread(piece.mesh, stepsOf(options_.tangents), apart_);
        if (Result<Done> done = regroup(piece, posed); !done) return done;
    }
    stays_.assign(base.size(), false);
    if (options_.sanitize) {
        // Sanitizing reads other corners at the same position. Corners that do not move must not change if a corner
        // elsewhere moves.
        for (std::size_t c = 0; c < base.size(); ++c) stays_[c] = isUnchangedAt(piece, c);
        keepLostTangents(piece, base);
        const Result<SanitizeReport> repaired =
            sanitizeTangents(posed, options_.sanitize_options, tangents_, options_.execution);
        if (!repaired) return repaired.error();
    }
    for (std::size_t c = 0; c < base.size(); ++c) {
        offsets[c] = Vec3{};
        if (stays_[c]) continue;
        offsets[c] = offsetBetween(xyz(base[c]), xyz(tangents_[c]));
        if (base[c].w != tangents_[c].w) ++piece.report->morph_sign_flip_count;
    }
    return Done{};
}

/// Regroups the moved shape where equal vertices have moved apart. Corners without a tangent of their own (a default
/// points out of the plane), or whose sign is inverted, which a target cannot represent, keep the tangent of the base's
/// group, projected into the plane.
Result<Done> MorphTangents::regroup(const Piece& piece, const MeshView& posed) {
    regrouped_.resize(tangents_.size());
    const Result<TangentReport> made =
        generateTangents(posed, options_.tangents, {.tangents = regrouped_}, options_.execution);
    if (!made) return made.error();
    for (std::size_t c = 0; c < tangents_.size(); ++c) {
        const std::uint32_t v = piece.mesh.indices[c];
        if (!apart_[piece.classes.of(v)]) continue;
        const Vec3& normal = pose_.normals()[v];
        if (regrouped_[c].w == tangents_[c].w && liesInPlane(regrouped_[c], normal)) {
            tangents_[c] = regrouped_[c];
        } else if (hasDirection(tangents_[c])) {
            tangents_[c] = projectedTangent(tangents_[c], piece.mesh.normals[v], normal);
        }
    }
    return Done{};
}

/// Returns whether the corner's normal, and its tangent before any repair, equal those of the base.
bool MorphTangents::isUnchangedAt(const Piece& piece, std::size_t corner) const {
    const std::uint32_t v = piece.mesh.indices[corner];
    return std::memcmp(&tangents_[corner], &piece.unrepaired[corner], sizeof(Vec4)) == 0 &&
           piece.mesh.normals[v] == pose_.normals()[v];
}

/// Keeps the base's tangents where faces collapsed, or where their tangents cancel out.
void MorphTangents::keepLostTangents(const Piece& piece, std::span<const Vec4> base) {
    for (std::size_t c = 0; c < base.size(); ++c) {
        const std::uint32_t v = piece.mesh.indices[c];
        const Vec3 &from = piece.mesh.normals[v], &to = pose_.normals()[v];
        const bool is_lost =
            !hasDirection(tangents_[c]) || (pointsOutOfPlane(tangents_[c], to) && liesInPlane(base[c], from));
        if (hasDirection(piece.unrepaired[c]) && is_lost) tangents_[c] = projectedTangent(base[c], from, to);
    }
}

std::uint64_t countDiffering(std::span<const Vec4> computed, std::span<const Vec4> of_vertices,
                             std::span<const std::uint32_t> vertices) {
    std::uint64_t count = 0;
    for (std::size_t c = 0; c < computed.size(); ++c) {
        const Vec4& kept = of_vertices[vertices[c]];
        const DVec3 a = toDouble(xyz(computed[c])), b = toDouble(xyz(kept));
        const bool same = computed[c].w == kept.w && dot(a, b) >= kCosineOfFiveDegrees * length(a) * length(b);
        count += same ? 0 : 1;
    }
    return count;
}

std::uint64_t countDiffering(std::span<const Vec4> computed, std::span<const Vec4> written) {
    std::uint64_t count = 0;
    for (std::size_t c = 0; c < computed.size(); ++c) {
        const DVec3 a = toDouble(xyz(computed[c])), b = toDouble(xyz(written[c]));
        count += dot(a, b) >= kCosineOfFiveDegrees * length(a) * length(b) ? 0U : 1U;
    }
    return count;
}

// Targets are processed one after the other. Each may split existing vertices; the new vertices inherit the offsets
// from earlier targets.

namespace {

bool areClose(const Vec3& a, const Vec3& b, float tolerance) {
    return std::fabs(a.x - b.x) <= tolerance && std::fabs(a.y - b.y) <= tolerance && std::fabs(a.z - b.z) <= tolerance;
}

}  // namespace

MorphSplit::MorphSplit(SplitResult&& split, bool may_split)
    : split_(std::move(split)), may_split_(may_split), parents_(split_.vertexCount()) {
    std::iota(parents_.begin(), parents_.end(), 0u);
}

Result<Done> MorphSplit::add(std::span<const Vec3> offsets, float tolerance, const Execution& execution) {
    Target& target = targets_.emplace_back();
    if (std::all_of(offsets.begin(), offsets.end(), isZero)) {
        target.vertex_count = split_.vertexCount();
        return Done{};
    }
    if (may_split_ && !agree(offsets, tolerance)) {
        if (Result<Done> done = refine(offsets, tolerance, execution); !done) return done;
    }
    target.vertex_count = split_.vertexCount();
    for (std::size_t v = 0; v < target.vertex_count; ++v) {
        const std::uint32_t corner = split_.source_corners[v];
        if (corner == kNoCorner || isZero(offsets[corner])) continue;
        target.offsets.vertices.push_back(static_cast<std::uint32_t>(v));
        target.offsets.offsets.push_back(offsets[corner]);
    }
    return Done{};
}

bool MorphSplit::agree(std::span<const Vec3> offsets, float tolerance) const {
    for (std::size_t c = 0; c < offsets.size(); ++c) {
        const Vec3& first = offsets[split_.source_corners[split_.indices[c]]];
        if (!areClose(offsets[c], first, tolerance)) return false;
    }
    return true;
}

Result<Done> MorphSplit::refine(std::span<const Vec3> offsets, float tolerance, const Execution& execution) {
    const std::size_t count = split_.vertexCount();
    const CornerAttribute attribute = cornerAttribute(StridedSpan<const Vec3>(offsets), tolerance);
    Result<SplitResult> refined = splitVertices(IndexView(std::span<const std::uint32_t>(split_.indices)), count,
                                                offsets.size(), {&attribute, 1}, execution);
    if (!refined) return std::move(refined).error();
    for (std::size_t v = count; v < refined->vertexCount(); ++v) {
        const std::uint32_t parent = refined->source_vertices[v];
        parents_.push_back(parent);
        split_.source_vertices.push_back(split_.source_vertices[parent]);
        split_.source_corners.push_back(refined->source_corners[v]);
    }
    split_.indices = std::move(refined->indices);
    return Done{};
}

std::vector<VertexOffsets> MorphSplit::finish() {
    std::vector<VertexOffsets> result;
    for (Target& target : targets_) {
        result.push_back(spread(target.offsets, parents_, target.vertex_count));
        target.offsets = {};
    }
    targets_.clear();
    return result;
}

VertexOffsets spread(const VertexOffsets& offsets, std::span<const std::uint32_t> sources, std::size_t old_count) {
    VertexOffsets result = offsets;
    if (offsets.vertices.empty() || old_count == sources.size()) return result;
    // 1-based position of each vertex in offsets.vertices; 0: none
    std::vector<std::uint32_t> places(sources.size(), 0);
    for (std::size_t i = 0; i < offsets.vertices.size(); ++i)
        places[offsets.vertices[i]] = static_cast<std::uint32_t>(i + 1);
    for (std::size_t v = old_count; v < sources.size(); ++v) {
        places[v] = places[sources[v]];
        if (places[v] == 0) continue;
        result.vertices.push_back(static_cast<std::uint32_t>(v));
        result.offsets.push_back(offsets.offsets[places[v] - 1]);
    }
    return result;
}

}  // namespace tspace
