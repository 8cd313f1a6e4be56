// SPDX-License-Identifier: MIT
// Converts a plan to words. Corners take their tangents from sources (groups, members of groups that split, conflicts,
// vertices of lengyel), each a list of half-edges, and their normals from components. The entries of a result list the
// corners of its source and of its component.
#include "tspace/plan_buffers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>

#include "core/base/border.h"
#include "core/estimate/pose_normals.h"
#include "core/tangents/derivative_terms.h"
#include "core/tangents/plan_parts.h"
#include "tspace/indexed_frames.h"

namespace tspace {
namespace {

using WordList = std::vector<std::uint32_t>;
using mikk::kNone, mikk::kTopBit, mikk::kValue;

constexpr std::uint64_t kMostTriangles = (1u << 28) - 1;

/// Concatenated lists of numbers.
struct Lists {
    WordList begins{0}, items;

    [[nodiscard]] std::size_t count() const { return begins.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> at(std::size_t list) const {
        return {items.data() + begins[list], items.data() + begins[list + 1]};
    }
    void end() { begins.push_back(static_cast<std::uint32_t>(items.size())); }

    /// Returns the numbers below `count` grouped by key, ascending; keys of `key_count` and above belong to no list.
    template <class KeyOf>
    static Lists sorted(std::size_t count, std::size_t key_count, const KeyOf& keyOf) {
        Lists lists;
        lists.begins.assign(key_count + 2, 0);
        for (std::uint32_t i = 0; i < count; ++i) {
            if (keyOf(i) < key_count) ++lists.begins[keyOf(i) + 2];
        }
        std::partial_sum(lists.begins.begin(), lists.begins.end(), lists.begins.begin());
        lists.items.resize(lists.begins.back());
        for (std::uint32_t i = 0; i < count; ++i) {
            if (keyOf(i) < key_count) lists.items[lists.begins[keyOf(i) + 1]++] = i;
        }
        lists.begins.pop_back();
        return lists;
    }
};

/// Sources of tangents. A source is the tangent of one or more corners; `sources` lists the parts of each source, and
/// `parts` the half-edges of each part.
struct TangentSources {
    Lists parts, sources;
    WordList of_corner;                                 ///< source of each corner, or kNone
    std::vector<std::uint8_t> is_positive, is_cleared;  ///< flags per source, and per corner
    WordList vertices;                                  ///< vertex of each half-edge
    WordList corners;                                   ///< corner of each half-edge
    std::vector<float> uvs;                             ///< UV coefficients of each triangle (PlanBuffers)
    /// UVs of triangles that need doubles (PlanBuffers), in ascending order of triangles.
    struct DoubleUvs {
        std::size_t triangle;
        double values[5];
    };
    std::vector<DoubleUvs> double_uvs;

    [[nodiscard]] std::size_t triangleCount() const { return vertices.size() / 3; }
};

class GroupedSources {
  public:
    explicit GroupedSources(const mikk::EvaluationPlan& plan) : plan_(plan) {}

    TangentSources read() {
        to_.is_cleared.assign(plan_.corner_count, 0);
        to_.of_corner.assign(plan_.corner_count, kNone);
        const std::size_t half_edges = 3 * plan_.triangle_count;
        to_.parts = Lists::sorted(half_edges, plan_.group_count, [&](std::uint32_t h) { return plan_.groups[h]; });
        for (std::uint32_t g = 0; g < plan_.group_count; ++g) addSource({&g, 1}, plan_.group_positive[g] != 0);
        for (std::uint32_t h = 0; h < half_edges; ++h) {
            const std::uint32_t group = plan_.groups[h] & kValue, slot = plan_.slotOf(h);
            to_.vertices.push_back(plan_.vertices[h]);
            to_.corners.push_back(slot & kValue);
            if (group < plan_.group_count && (slot & kTopBit) == 0) to_.of_corner[slot] = group;
        }
        addSplits();
        addConflicts();
        for (const mikk::Copy& copy : plan_.copies) to_.of_corner[copy.to] = to_.of_corner[copy.from];
        for (const std::uint32_t corner : plan_.skipped_corners) to_.is_cleared[corner] = 1;
        for (std::size_t t = 0; t < plan_.triangle_count; ++t) addUvs(to_.vertices.data() + 3 * t);
        return std::move(to_);
    }

  private:
    std::uint32_t addSource(std::span<const std::uint32_t> parts, bool is_positive) {
        to_.sources.items.insert(to_.sources.items.end(), parts.begin(), parts.end());
        to_.sources.end();
        to_.is_positive.push_back(is_positive ? 1 : 0);
        return static_cast<std::uint32_t>(to_.sources.count() - 1);
    }

    void addSplits() {
        members_.resize(plan_.members.size());
        for (const mikk::EvaluatedSplit& split : plan_.splits) {
            const std::size_t words = (std::size_t{split.count} + 63) / 64;
            const std::uint64_t* row = plan_.split_rows.data() + split.rows;
            for (std::uint32_t a = 0; a < split.count; ++a, row += words) {
                std::uint32_t& source = members_[split.begin + a];
                if (a != 0 && std::equal(row, row + words, row - words)) {
                    source = members_[split.begin + a - 1];
                } else {
                    for (std::uint32_t b = 0; b < split.count; ++b) {
                        if ((row[b / 64] >> b % 64 & 1) != 0) to_.parts.items.push_back(plan_.members[split.begin + b]);
                    }
                    to_.parts.end();
                    const auto part = static_cast<std::uint32_t>(to_.parts.count() - 1);
                    source = addSource({&part, 1}, split.positive);
                }
                const std::uint32_t slot = plan_.slotOf(plan_.members[split.begin + a]);
                if ((slot & kTopBit) == 0) to_.of_corner[slot] = source;
            }
        }
    }

    void addConflicts() {
        WordList parts;
        for (std::size_t i = 0; i < plan_.conflicts.size();) {
            const std::uint32_t corner = plan_.conflicts[i].corner;
            std::uint32_t source = 0;
            parts.clear();
            for (; i < plan_.conflicts.size() && plan_.conflicts[i].corner == corner; ++i) {
                source = plan_.conflicts[i].source;
                if ((source & kTopBit) != 0) source = members_[source & kValue];
                const std::uint32_t part = to_.sources.at(source)[0];
                if (parts.size() != 1 || parts[0] != part)
                    // the mean of equal results equals the first of them, so other parts are omitted
                    parts.push_back(part);
            }
            to_.of_corner[corner] = parts.size() == 1 ? source : addSource(parts, to_.is_positive[source] != 0);
        }
    }

    void addUvs(const std::uint32_t* v) {
        const Vec2 d1 = plan_.uvs[v[1]] - plan_.uvs[v[0]], d2 = plan_.uvs[v[2]] - plan_.uvs[v[0]];
        const float area = d1.x * d2.y - d1.y * d2.x;
        const float facing = isMikktspace(plan_.method) || !isEstimated(plan_.method) ? (area > 0 ? 1.0f : -1.0f)
                                                                                      : (area < 0 ? -1.0f : 1.0f);
        to_.uvs.insert(to_.uvs.end(), {facing * d2.y, facing * d1.y});
    }

    const mikk::EvaluationPlan& plan_;
    TangentSources to_;
    WordList members_;  // source of each member of a group that splits
};

/// Computes the UV coefficients of triangles for lengyel by its own kernel: dP/du and dP/dv of the triangle (0, 0, 0),
/// (1, 0, 0), (0, 1, 0) are (a, -b, 0) and (-d, c, 0).
class UvCoefficients {
  public:
    UvCoefficients(const IndexedPlan& plan, SimdTarget simd, TangentSources& to)
        : plan_(plan), kernel_(derivatives::derivativeKernelFor(simd)), to_(to) {
        for (std::uint32_t i = 0; i < kCorners; ++i) {
            corners_[i] = i;
            positions_[i] = {i % 3 == 1 ? 1.0f : 0.0f, i % 3 == 2 ? 1.0f : 0.0f, 0};
        }
    }

    void write() {
        for (std::size_t first = 0; first < plan_.triangleCount(); first += derivatives::kTermTriangles)
            writeBlock(first, std::min(plan_.triangleCount() - first, derivatives::kTermTriangles));
    }

  private:
    static constexpr std::uint32_t kCorners = 3 * derivatives::kTermTriangles;

    void writeBlock(std::size_t first, std::size_t count) {
        for (std::size_t i = 0; i < 3 * count; ++i) uvs_[i] = plan_.uvs[plan_.triangle_vertices[3 * first + i]];
        kernel_.compute({reinterpret_cast<const std::byte*>(positions_), reinterpret_cast<const std::byte*>(uvs_),
                         sizeof(Vec3), sizeof(Vec2), kCorners},
                        corners_, count, terms_);
        for (std::size_t t = 0; t < count; ++t) {
            const float* const row = terms_.rows[t];
            if ((terms_.safe >> t & 1) != 0)
                to_.uvs.insert(to_.uvs.end(), {row[0], 0 - row[1], row[4], 0 - row[3]});
            else
                writeDoubles(first + t, uvs_ + 3 * t);
        }
    }

    void writeDoubles(std::size_t triangle, const Vec2* uvs) {
        const auto difference = [&](std::size_t k, float Vec2::*axis) {
            return double{uvs[k].*axis} - double{uvs[0].*axis};
        };
        to_.uvs.insert(to_.uvs.end(), 4, 0.0f);
        const double determinant = uvFrame({}, {}, {}, uvs[0], uvs[1], uvs[2]).determinant;
        if (!hasUvArea(determinant)) return;
        to_.double_uvs.push_back({triangle,
                                  {1 / determinant, difference(2, &Vec2::y), difference(1, &Vec2::y),
                                   difference(1, &Vec2::x), difference(2, &Vec2::x)}});
    }

    const IndexedPlan& plan_;
    derivatives::DerivativeKernel kernel_;
    TangentSources& to_;
    std::uint32_t corners_[kCorners];
    Vec3 positions_[kCorners + 1] = {};  // the kernel reads 4 bytes after a vector
    Vec2 uvs_[kCorners] = {};
    derivatives::DerivativeTerms terms_;
};

/// Returns the sources of lengyel, where each vertex is a source.
TangentSources indexedSources(const IndexedPlan& plan, SimdTarget simd) {
    TangentSources to;
    const std::size_t half_edges = 3 * plan.triangleCount();
    const bool per_vertex = plan.domain == OutputDomain::vertex;
    for (std::size_t h = 0; h < half_edges; ++h) to.vertices.push_back(plan.triangle_vertices[h]);
    UvCoefficients(plan, simd, to).write();
    to.parts = Lists::sorted(half_edges, plan.vertex_count, [&](std::uint32_t h) { return to.vertices[h]; });
    to.sources.items.resize(plan.vertex_count);
    std::iota(to.sources.items.begin(), to.sources.items.end(), 0u);
    for (std::size_t v = 0; v < plan.vertex_count; ++v) to.sources.begins.push_back(static_cast<std::uint32_t>(v + 1));
    to.is_positive.assign(plan.vertex_count, plan.sign_factor > 0 ? 1 : 0);
    for (std::size_t i = 0; i < plan.outputCount(); ++i) {
        const std::size_t vertex = per_vertex ? i : plan.corner_vertices[i];
        to.of_corner.push_back(static_cast<std::uint32_t>(vertex));
        to.is_cleared.push_back((per_vertex ? to.parts.at(vertex).empty() : !plan.isUsed(i)) ? 1 : 0);
    }
    return to;
}

class BufferWriter {
  public:
    BufferWriter(const TangentPlan& plan, const PlanParts& parts, const PlanBufferOptions& options, SimdTarget simd)
        : plan_(plan), options_(options), is_lengyel_(parts.indexed != nullptr), normalizes_(parts.normalizes_normals),
          convention_(parts.grouped != nullptr ? parts.grouped->convention : options.normals.convention),
          in_(is_lengyel_ ? indexedSources(*parts.indexed, simd) : GroupedSources(*parts.grouped).read()),
          fold_(is_lengyel_ ? 1.0f : signFactor(convention_) * normalFactor(convention_)) {}

    Result<PlanBuffers> write(const Execution& execution) {
        if (in_.triangleCount() > kMostTriangles)
            return Error{ErrorCode::tooLarge, "the plan has more than 268435455 triangles"};
        if (options_.mesh.vertexCount() != 0) {
            Result<WordList> shared = findSharedNormals(options_.mesh, options_.normals, execution);
            if (!shared) return std::move(shared).error();
            shared_ = std::move(*shared);
            components_ = Lists::sorted(shared_.size(), shared_.size(), [&](std::uint32_t c) { return shared_[c]; });
        }
        if (method() == Method::fast) scaleUvs();
        writeResults();
        writeAll();
        return std::move(to_);
    }

  private:
    [[nodiscard]] Method method() const { return plan_.method(); }

    /// Scales UVs so that typical values are about 1, which keeps products with edges in range; only the ratios of UVs
    /// matter.
    void scaleUvs() {
        std::vector<float> sizes;
        for (float& value : in_.uvs) {
            if (!std::isfinite(value)) value = 0;
            if (value != 0) sizes.push_back(std::fabs(value));
        }
        if (sizes.empty()) return;
        const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
        std::nth_element(sizes.begin(), middle, sizes.end());
        const int exponent = -std::ilogb(*middle);
        for (float& value : in_.uvs) {
            value = std::ldexp(value, exponent);
            if (!std::isfinite(value)) value = 0;
        }
    }

    /// Tangent source and normal component of a result.
    struct Key {
        std::uint32_t source, component, result;
        [[nodiscard]] bool isLike(const Key& other) const {
            return source == other.source && component == other.component;
        }
    };

    [[nodiscard]] std::size_t resultCount() const {
        return options_.source_corners.empty() ? in_.of_corner.size() : options_.source_corners.size();
    }
    [[nodiscard]] bool resultsAreCorners() const {
        return options_.source_corners.empty() && plan_.outputCount() == plan_.cornerCount();
    }
    [[nodiscard]] std::uint32_t cornerOf(std::size_t result) const {
        return options_.source_corners.empty() ? static_cast<std::uint32_t>(result) : options_.source_corners[result];
    }

    void writeResults() {
        const std::size_t count = resultCount();
        WordList half_edges(plan_.cornerCount(),
                            kNone);  // first half-edge of each corner; without polygons, the corner itself
        for (std::uint32_t h = 0; h < in_.vertices.size(); ++h) {
            std::uint32_t& first = half_edges[in_.corners.empty() ? h : in_.corners[h]];
            first = std::min(first, h);
        }
        const bool per_vertex = plan_.outputCount() != plan_.cornerCount() && options_.source_corners.empty();
        std::vector<Key> keys(count);
        results_.resize(3 * count);
        for (std::uint32_t r = 0; r < count; ++r) {
            const std::uint32_t corner = cornerOf(r);
            const bool has_corner = corner != kNoCorner;
            const bool is_cleared = has_corner && in_.is_cleared[corner] != 0;
            const std::uint32_t source = has_corner && !is_cleared ? in_.of_corner[corner] : kNone;
            std::uint32_t own = kNone;
            if (per_vertex)
                own = in_.parts.at(r).empty() ? kNone : in_.parts.at(r)[0];
            else if (has_corner)
                own = half_edges[corner];
            const bool has_normal = !shared_.empty() && own != kNone;
            keys[r] = {source, has_normal ? shared_[own] & ~kNoSharedNormal : kNone, r};
            results_[3 * r + 1] = flagsOf(source, is_cleared);
            results_[3 * r + 2] = own == kNone ? std::uint32_t{PlanBuffers::kNoEntry} : own / 3 * 4 + own % 3;
        }
        std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
            return std::tie(a.source, a.component, a.result) < std::tie(b.source, b.component, b.result);
        });
        WordList first_like(count);  // for each result: the first result with the same entries
        for (std::size_t i = 0, first = 0; i < count; ++i) {
            if (!keys[i].isLike(keys[first])) first = i;
            first_like[keys[i].result] = keys[first].result;
        }
        std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) { return a.result < b.result; });
        for (std::uint32_t r = 0; r < count; ++r) {
            const std::uint32_t like = first_like[r];
            const auto begin =
                static_cast<std::uint32_t>(like == r ? entries_.size() : results_[3 * std::size_t{like}]);
            if (like == r) writeEntries(keys[r]);
            if (mixesNormals(keys[r])) results_[3 * r + 1] |= PlanBuffers::mixes_normals;
            results_[3 * r] = begin;
            results_[3 * r + 1] |= like == r ? static_cast<std::uint32_t>(entries_.size()) - begin
                                             : results_[3 * std::size_t{like} + 1] & PlanBuffers::count_mask;
        }
    }

    [[nodiscard]] std::uint32_t flagsOf(std::uint32_t source, bool is_cleared) const {
        if (is_cleared) return PlanBuffers::is_cleared;
        const bool is_positive = source != kNone ? in_.is_positive[source] != 0 : is_lengyel_;
        std::uint32_t flags = (is_positive ? fold_ : -fold_) < 0 ? std::uint32_t{PlanBuffers::negative} : 0u;
        if (source == kNone || !isMikktspace(method())) flags |= PlanBuffers::has_default;
        return flags;
    }

    [[nodiscard]] bool mixesNormals(const Key& key) const {
        if (key.source == kNone || key.component == kNone || is_lengyel_) return false;
        for (const std::uint32_t part : in_.sources.at(key.source)) {
            for (const std::uint32_t h : in_.parts.at(part)) {
                if ((shared_[h] & ~kNoSharedNormal) != key.component) return true;
            }
        }
        return false;
    }

    /// Writes the corners whose normals are summed (the component) and those of the first part of the tangent source,
    /// merged in ascending order; then each other part after a kNextPart.
    void writeEntries(const Key& key) {
        std::span<const std::uint32_t> normal, parts;
        if (key.component != kNone) normal = components_.at(key.component);
        if (key.source != kNone) parts = in_.sources.at(key.source);
        const std::span<const std::uint32_t> first =
            parts.empty() ? std::span<const std::uint32_t>() : in_.parts.at(parts[0]);
        const auto push = [&](std::uint32_t h, std::uint32_t flags) {
            entries_.push_back((h / 3 * 4 + h % 3) | flags);
        };
        auto t = first.begin();
        for (auto n = normal.begin(); n != normal.end() || t != first.end();) {
            const bool takes_n = n != normal.end() && (t == first.end() || *n <= *t);
            const bool takes_t = t != first.end() && (n == normal.end() || *t <= *n);
            push(takes_n ? *n : *t, (takes_t ? 0u : std::uint32_t{PlanBuffers::no_tangent}) |
                                        (takes_n ? 0u : std::uint32_t{PlanBuffers::no_normal}));
            n += takes_n ? 1 : 0;
            t += takes_t ? 1 : 0;
        }
        for (std::size_t i = 1; i < parts.size(); ++i) {
            entries_.push_back(PlanBuffers::kNextPart);
            for (const std::uint32_t h : in_.parts.at(parts[i])) push(h, PlanBuffers::no_normal);
        }
    }

    void writeAll() {
        const auto size = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
        const std::uint32_t uv_words = is_lengyel_ ? 4 : 2, triangles = size(in_.vertices) / 3;
        WordList& words = to_.words;
        words.resize(PlanBuffers::header_words);
        words[PlanBuffers::version] = PlanBuffers::kVersion;
        words[PlanBuffers::method] = static_cast<std::uint32_t>(method());
        words[PlanBuffers::flags] = (shared_.empty() ? 0u : std::uint32_t{PlanBuffers::makes_normals}) |
                                    (normalFactor(convention_) < 0 ? std::uint32_t{PlanBuffers::inward_normals} : 0u) |
                                    (normalizes_ ? std::uint32_t{PlanBuffers::normalizes_normals} : 0u) |
                                    (resultsAreCorners() ? std::uint32_t{PlanBuffers::results_are_corners} : 0u);
        words[PlanBuffers::weighting] = static_cast<std::uint32_t>(options_.normals.weighting);
        words[PlanBuffers::result_count] = size(results_) / 3;
        words[PlanBuffers::entry_count] = size(entries_);
        words[PlanBuffers::triangle_count] = triangles;
        words[PlanBuffers::triangle_words] = 3 + uv_words;
        words[PlanBuffers::results] = size(words);
        words.reserve(words.size() + results_.size() + entries_.size() + (3 + uv_words) * std::size_t{triangles});
        words.insert(words.end(), results_.begin(), results_.end());
        words[PlanBuffers::entries] = size(words);
        words.insert(words.end(), entries_.begin(), entries_.end());
        words[PlanBuffers::triangles] = size(words);
        for (std::size_t t = 0; t < triangles; ++t) {
            for (std::size_t h = 3 * t; h < 3 * t + 3; ++h)
                words.push_back(options_.indices.empty() ? in_.vertices[h]
                                                         : options_.indices[in_.corners.empty() ? h : in_.corners[h]]);
            for (std::size_t i = uv_words * t; i < uv_words * (t + 1); ++i)
                words.push_back(std::bit_cast<std::uint32_t>(in_.uvs[i]));
        }
        for (const TangentSources::DoubleUvs& uvs : in_.double_uvs) {
            std::uint32_t* const to = words.data() + words[PlanBuffers::triangles] + (3 + uv_words) * uvs.triangle + 3;
            to[0] = PlanBuffers::kDoubles;
            to[1] = size(words);
            for (const double value : uvs.values) {
                const auto bits = std::bit_cast<std::uint64_t>(value);
                words.push_back(static_cast<std::uint32_t>(bits >> 32));
                words.push_back(static_cast<std::uint32_t>(bits));
            }
        }
    }

    const TangentPlan& plan_;
    const PlanBufferOptions& options_;
    bool is_lengyel_, normalizes_;
    Convention convention_;
    TangentSources in_;
    float fold_;  ///< sign of the tangent for a positive orientation
    WordList shared_;
    Lists components_;
    WordList results_, entries_;
    PlanBuffers to_;
};

Error checkBuffers(const TangentPlan& plan, const PlanParts& parts, const PlanBufferOptions& options) {
    const auto refuse = [](const char* why) { return Error{ErrorCode::invalidOption, why}; };
    const Method method = plan.method();
    if (method == Method::flat || method == Method::basis || method == Method::best)
        return refuse(
            "the shaders do not implement the methods flat, basis and best; use mikktspace, uniform, angle, area, "
            "lengyel or fast");
    if (parts.is_symmetric) return refuse("the shaders do not implement symmetric frames");
    if (parts.indexed != nullptr && !parts.indexed->cut_triangles.empty())
        return refuse("lengyel on a GPU needs a triangle mesh; triangulate the mesh first");
    if (parts.has_own_lists && options.indices.empty())
        return refuse(
            "the plan was created for a mesh with several index lists, so options.indices must contain the vertex of "
            "each corner in a pose");
    if (!options.indices.empty() && options.indices.size() != plan.cornerCount())
        return {ErrorCode::countMismatch, "indices must have one entry per corner of the plan"};
    for (const std::uint32_t corner : options.source_corners) {
        if (corner != kNoCorner && corner >= plan.cornerCount())
            return {ErrorCode::indexOutOfRange, "the source corners contain a corner that the plan does not have"};
    }
    if (!options.source_corners.empty() && plan.outputCount() != plan.cornerCount())
        return refuse("source_corners needs a plan with one result per corner, but this plan has one per vertex");
    if (options.mesh.vertexCount() == 0) return {ErrorCode::ok, {}};
    if (options.normals.weighting == NormalWeighting::best || options.normals.denoise != 0)
        return refuse("the shaders cannot compute normals with the weighting best or with denoise");
    if (options.mesh.vertexCount() != plan.vertexCount() || options.mesh.cornerCount() != plan.cornerCount())
        return {ErrorCode::planMismatch, "the mesh is not the mesh that the plan was created for"};
    return {ErrorCode::ok, {}};
}

}  // namespace

Result<PlanBuffers> planBuffers(const TangentPlan& plan, const PlanBufferOptions& options, const Execution& execution) {
    return atBorder([&]() -> Result<PlanBuffers> {
        const PlanParts parts = partsOf(plan);
        if (Error e = checkBuffers(plan, parts, options); e.code != ErrorCode::ok) return e;
        return BufferWriter(plan, parts, options, execution.simd).write(execution);
    });
}

}  // namespace tspace
