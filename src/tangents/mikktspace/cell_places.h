// SPDX-License-Identifier: MIT
// Where the corners in some cells of the reference's grid are put, cell by cell and in order, by all threads.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/memory.h"
#include "core/parallel.h"
#include "tangents/mikktspace/collect.h"
#include "tangents/mikktspace/growing.h"

namespace tspace::mikk {

/// Marks of vertices in wanted cells: the cell's number, from 1, and whether their nodes are wanted. All
/// cells that get none of their own share the last number.
inline constexpr std::uint8_t kCellNumber = 0x7f, kAtNode = 0x80;

/// Chunks of triangles are worked on at the same time: the corners of each are put behind those of the chunks
/// before it.
template <class VertexOf>
class CellPlaces {
  public:
    /// `found`: triangles with a corner in a wanted cell, ascending; all arguments must outlive this object.
    /// `shared`, if not null, gets those that have two corners or more at wanted nodes. `used`: a byte per vertex,
    /// which becomes 1 for those of the triangles, or empty.
    CellPlaces(const Buffer<std::uint32_t>& found, const VertexOf& vertexOf, const Marks& marks,
               Growing<std::uint32_t>* shared, Marks& used, const Allocator* allocator, Parallel& parallel)
        : found_(found),
          vertexOf_(vertexOf),
          marks_(marks),
          chunks_((found.size() + kChunk - 1) / kChunk),
          places_(allocator, chunks_ + 1, Numbers{}),
          parallel_(parallel) {
        Buffer<std::uint32_t> listed(allocator, shared != nullptr ? found.size() : 0);
        parallel_.forTasks(chunks_, [&](std::size_t chunk) {
            count(chunk, listed.empty() ? nullptr : listed.data(), used.empty() ? nullptr : used.data());
        });
        for (std::size_t chunk = 0; chunk < chunks_ && shared != nullptr; ++chunk) {
            const std::size_t count = places_[chunk][kShared];
            std::copy_n(listed.data() + chunk * kChunk, count, shared->extend(count));
        }
        Numbers total = {};
        for (Numbers& here : places_) {
            for (std::size_t cell = 0; cell < total.size(); ++cell) {
                const std::uint32_t before = total[cell];
                total[cell] += here[cell];
                here[cell] = before;
            }
        }
    }

    /// How many corners a cell has.
    [[nodiscard]] std::uint32_t count(std::size_t cell) const { return places_[chunks_][cell]; }

    /// put(cell, place, entry, vertex): called for the corners in wanted cells; `place` is counted in the cell.
    template <class Put>
    void forAll(const Put& put) const {
        forChunks([&](Numbers next, std::size_t first, std::size_t end) {
            forCorners(first, end, [&](std::uint32_t entry, std::uint32_t vertex) {
                const std::uint8_t cell = marks_[vertex] & kCellNumber;
                if (cell != 0) put(cell, next[cell]++, entry, vertex);
            });
        });
    }

    /// put(place, entry, vertex): called for the corners of one cell, and for those of others before and between
    /// them with the next one's place. Returns whether the corner is in the cell.
    template <class Put>
    void forCell(std::uint8_t cell, const Put& put) const {
        forChunks([&](const Numbers& places, std::size_t first, std::size_t end) {
            std::uint32_t next = places[cell];
            forCorners(first, end, [&](std::uint32_t entry, std::uint32_t vertex) {
                if (put(next, entry, vertex)) ++next;
            });
        });
    }

  private:
    static constexpr std::size_t kChunk = 4096;  // triangles
    /// One per cell; the place of vertices in no wanted cell is for shared triangles.
    using Numbers = std::array<std::uint32_t, kCellNumber + 1>;
    static constexpr std::size_t kShared = 0;

    void count(std::size_t chunk, std::uint32_t* listed, std::uint8_t* used) {
        Numbers& numbers = places_[chunk];
        const std::size_t first = chunk * kChunk, end = std::min(first + kChunk, found_.size());
        std::uint32_t shared_count = 0;
        for (std::size_t n = first; n < end; ++n) {
            const std::uint32_t i = 3 * found_[n];
            const std::uint32_t vertices[] = {vertexOf_(i), vertexOf_(i + 1), vertexOf_(i + 2)};
            const std::uint8_t a = marks_[vertices[0]], b = marks_[vertices[1]], c = marks_[vertices[2]];
            if (a == b && b == c) {
                numbers[a & kCellNumber] += 3;  // the next one waits for this
            } else {
                for (const std::uint8_t mark : {a, b, c}) ++numbers[mark & kCellNumber];
            }
            if (a / kAtNode + b / kAtNode + c / kAtNode > 1 && listed != nullptr)
                listed[first + shared_count++] = found_[n];
            if (used == nullptr) continue;
            for (const std::uint32_t vertex : vertices) {  // several threads may do so at once
                __atomic_store_n(&used[vertex], std::uint8_t{1}, __ATOMIC_RELAXED);
            }
        }
        numbers[kShared] = shared_count;
    }

    /// body(places, first, end): called for the triangles [first, end) of each chunk.
    template <class Body>
    void forChunks(const Body& body) const {
        parallel_.forTasks(chunks_, [&](std::size_t chunk) {
            body(places_[chunk], chunk * kChunk, std::min((chunk + 1) * kChunk, found_.size()));
        });
    }

    template <class Body>
    void forCorners(std::size_t first, std::size_t end, const Body& body) const {
        for (std::size_t n = first; n < end; ++n) {
            const std::uint32_t i = 3 * found_[n];
            for (std::uint32_t k = 0; k < 3; ++k) body(i + k, vertexOf_(i + k));
        }
    }

    const Buffer<std::uint32_t>& found_;
    const VertexOf& vertexOf_;
    const Marks& marks_;
    std::size_t chunks_;
    Buffer<Numbers> places_;  // per chunk: where the first corner of a cell is put; the last ones: how many there are
    Parallel& parallel_;
};

}  // namespace tspace::mikk
