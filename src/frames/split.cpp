// SPDX-License-Identifier: MIT
// Duplicates vertices whose corners disagree: the first corner of each vertex, then all corners that equal it, then
// the few others one by one.
#include "tspace/split.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

#include "core/border.h"
#include "core/memory.h"
#include "core/mesh_loops.h"
#include "core/parallel.h"
#include "frames/variants.h"

namespace tspace {

namespace {

constexpr std::size_t kCornersPerTask = 1 << 13;
/// Fewer tasks are done sooner than threads are started.
constexpr std::size_t kTasksForThreads = 16;
/// Corners that are compared before those that differ are put behind each other.
constexpr std::size_t kCompared = 64;

using AttributeSpan = std::span<const CornerAttribute>;

/// Corners one behind the other, and what is known of their vertices.
struct CornerBlock {
    std::uint32_t corner;  ///< the first one
    std::size_t count;
    const std::uint32_t* vertices;  ///< one per corner
    std::uint32_t* firsts;          ///< of all vertices: the first corner
};

/// Writes those corners that do not equal the first one of their vertex to `different`. Returns how many they are.
using ListDifferent = std::size_t (*)(AttributeSpan attributes, const CornerBlock& block, std::uint32_t* different);

/// Exact attributes with these numbers of components, in this order; any where there are none. Unless it is known, the
/// first corner of a vertex is found on the way.
template <bool kFirstsAreKnown, std::uint32_t... Counts>
std::size_t listDifferent(AttributeSpan attributes, const CornerBlock& block, std::uint32_t* different) {
    std::array<CornerAttribute, sizeof...(Counts)> exact;  // copies, which no store can change
    std::copy_n(attributes.begin(), exact.size(), exact.begin());
    const auto at = [&](std::size_t i, std::uint32_t corner) {
        return reinterpret_cast<const std::byte*>(exact[i].data) + corner * exact[i].stride_bytes;
    };
    const auto [corner, count, vertices, firsts] = block;
    std::size_t different_count = 0;
    for (std::size_t k = 0; k < count; ++k) {
        static_assert(kNoCorner == 0xffffffffu);  // above all corners
        const std::uint32_t here = corner + static_cast<std::uint32_t>(k);
        std::uint32_t first = firsts[vertices[k]], differs = 0;
        if (!kFirstsAreKnown) firsts[vertices[k]] = first = std::min(first, here);
        different[different_count] = here;
        if constexpr (sizeof...(Counts) == 0) {
            differs = equalCorners(attributes, here, first) ? 0u : 1u;
        } else {
            std::size_t i = 0;
            ((differs |= std::memcmp(at(i, here), at(i, first), 4 * Counts) == 0 ? 0u : 1u, ++i), ...);
        }
        different_count += differs;
    }
    return different_count;
}

template <std::uint32_t... Counts>
bool areExact(AttributeSpan attributes) {
    constexpr std::array<std::uint32_t, sizeof...(Counts)> counts{Counts...};
    return std::equal(attributes.begin(), attributes.end(), counts.begin(), counts.end(),
                      [](const CornerAttribute& attribute, std::uint32_t count) {
                          return attribute.component_count == count && attribute.tolerance == 0.0f;
                      });
}

template <bool kFirstsAreKnown>
ListDifferent listerFor([[maybe_unused]] AttributeSpan attributes) {
#ifndef TSPACE_SMALL
    if (areExact<4>(attributes)) return listDifferent<kFirstsAreKnown, 4>;
    if (areExact<3>(attributes)) return listDifferent<kFirstsAreKnown, 3>;
    if (areExact<3, 4>(attributes)) return listDifferent<kFirstsAreKnown, 3, 4>;
#endif
    return listDifferent<kFirstsAreKnown>;
}

class Splitter {
  public:
    Splitter(AttributeSpan attributes, std::size_t vertex_count, std::size_t corner_count, const Execution& execution)
        : attributes_(attributes),
          vertex_count_(vertex_count),
          parallel_(execution, corner_count),
          pending_(execution.allocator, (corner_count + kCornersPerTask - 1) / kCornersPerTask),
          variants_(attributes, result_) {
        resizeAtOnce(result_.indices, corner_count, corner_count);
        // Room for some copies costs nothing until it is used.
        resizeAtOnce(result_.source_corners, vertex_count, vertex_count + vertex_count / 8, kNoCorner);
    }

    SplitResult split(const IndexView& indices) {
        if (parallel_.width() == 1 || pending_.size() < kTasksForThreads) {
            // One after the other, while corners are in the cache.
            const ListDifferent list = listerFor<false>(attributes_);
            for (std::size_t task = 0; task < pending_.size(); ++task) {
                compare(task, indices, list);
                resolve(task, indices);
            }
        } else {
            splitByAll(indices);
        }
        writeSources(indices);
        return std::move(result_);
    }

  private:
    [[gnu::noinline]] static void resizeAtOnce(std::vector<std::uint32_t>& values, std::size_t count,
                                               std::size_t capacity, std::uint32_t value = 0) {
        values.reserve(capacity);
        askForPages(values.data(), count * sizeof(std::uint32_t));
        values.resize(count, value);
    }

    /// By all threads.
    void splitByAll(const IndexView& indices) {
        // Backwards, so that the first corner of a vertex is the one that stays.
        for (std::size_t c = result_.indices.size(); c-- > 0;)
            result_.source_corners[indices[c]] = static_cast<std::uint32_t>(c);
        const ListDifferent list = listerFor<true>(attributes_);
        parallel_.forTasks(pending_.size(), [&](std::size_t task) { compare(task, indices, list); });
        for (std::size_t task = 0; task < pending_.size(); ++task) {
            for (std::uint32_t corner = pending_[task]; corner != kNoCorner; corner = result_.indices[corner]) {
                for (const CornerAttribute& attribute : attributes_)
                    __builtin_prefetch(cornerValues(attribute, corner));
            }
            resolve(task, indices);
        }
    }

    /// Gives corners that equal the first one of their vertex this vertex, and lists the others.
    void compare(std::size_t task, const IndexView& view, ListDifferent list) {
        // A copy: numbers that are written might be those of the vector itself.
        std::uint32_t* const indices = result_.indices.data();
        const std::size_t end = std::min((task + 1) * kCornersPerTask, result_.indices.size());
        std::uint32_t first = kNoCorner, last = kNoCorner;
        for (std::size_t begin = task * kCornersPerTask; begin < end; begin += kCompared) {
            const std::size_t count = std::min(kCompared, end - begin);
            std::array<std::uint32_t, kCompared> different, buffer;
            const std::uint32_t* const vertices = readIndices(view, begin, count, buffer.data());
            std::copy_n(vertices, count, indices + begin);
            const std::size_t different_count =
                list(attributes_, {static_cast<std::uint32_t>(begin), count, vertices, result_.source_corners.data()},
                     different.data());
            for (std::size_t i = 0; i < different_count; ++i) {
                (last == kNoCorner ? first : indices[last]) = different[i];
                last = different[i];
            }
        }
        if (last != kNoCorner) indices[last] = kNoCorner;
        pending_[task] = first;
    }

    /// Task after task, because copies are numbered in corner order.
    void resolve(std::size_t task, const IndexView& indices) {
        if (pending_[task] == kNoCorner) return;
        if (result_.source_vertices.empty()) variants_.prepare();
        for (std::uint32_t corner = pending_[task]; corner != kNoCorner;) {
            const std::uint32_t next = result_.indices[corner];
            result_.indices[corner] = variants_.variantOf(corner, indices[corner]);
            corner = next;
        }
    }

    void writeSources(const IndexView& indices) {
        std::vector<std::uint32_t>& sources = result_.source_vertices;
        if (sources.empty()) resizeAtOnce(sources, vertex_count_, vertex_count_);
        std::iota(sources.begin(), sources.begin() + static_cast<std::ptrdiff_t>(vertex_count_), 0u);
        for (std::size_t v = vertex_count_; v < sources.size(); ++v) sources[v] = indices[result_.source_corners[v]];
    }

    AttributeSpan attributes_;
    std::size_t vertex_count_;
    Parallel parallel_;
    /// For each task the first corner that differs from the first one of its vertex; the rest of them is a list
    /// through result_.indices.
    Buffer<std::uint32_t> pending_;
    SplitResult result_;
    Variants variants_;
};

Error checkAttributes(std::span<const CornerAttribute> attributes, std::size_t corner_count) {
    for (std::size_t i = 0; i < attributes.size(); ++i) {
        const CornerAttribute& attribute = attributes[i];
        if (attribute.component_count < 1 || attribute.component_count > 16) {
            return makeError(ErrorCode::invalidOption, i, "attribute %zu has %u components, not 1 to 16", i,
                             attribute.component_count);
        }
        if (!(attribute.tolerance >= 0.0f) || !std::isfinite(attribute.tolerance)) {
            return makeError(ErrorCode::invalidOption, i,
                             "attribute %zu has a tolerance that is negative or not finite", i);
        }
        const Error name = makeError(ErrorCode::ok, i, "attribute %zu", i);
        Error e = checkSpan(attribute.data, corner_count, attribute.stride_bytes,
                            attribute.component_count * sizeof(float), kAnyCount, name.message.c_str());
        if (e.code != ErrorCode::ok) return e;
    }
    return {ErrorCode::ok, {}};
}

Error check(const IndexView& indices, std::size_t vertex_count, std::size_t corner_count,
            std::span<const CornerAttribute> attributes) {
    if (vertex_count > kMaxCorners || corner_count > kMaxCorners) {
        return {ErrorCode::tooLarge, "more than 2^31-1 vertices or corners"};
    }
    if (Error e = checkIndices(indices, vertex_count); e.code != ErrorCode::ok) return e;
    if (indices.type == IndexType::none && corner_count > vertex_count) {
        return makeError(ErrorCode::indexOutOfRange, vertex_count,
                         "corner %zu has no vertex: there are %zu vertices and no indices", vertex_count, vertex_count);
    }
    if (indices.type != IndexType::none && corner_count != indices.count) {
        return makeError(ErrorCode::countMismatch, kNoElement, "%zu corners but %zu indices", corner_count,
                         indices.count);
    }
    return checkAttributes(attributes, corner_count);
}

}  // namespace

Result<SplitResult> splitVertices(const IndexView& indices, std::size_t vertex_count, std::size_t corner_count,
                                  std::span<const CornerAttribute> attributes, const Execution& execution) {
    return atBorder([&]() -> Result<SplitResult> {
        if (Error e = check(indices, vertex_count, corner_count, attributes); e.code != ErrorCode::ok) return e;
        return Splitter(attributes, vertex_count, corner_count, execution).split(indices);
    });
}

}  // namespace tspace
