// SPDX-License-Identifier: MIT
// Typical orders in which tools write the triangles of a mesh.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "mesh.h"

namespace tspace::bench {

namespace {

using Numbers = std::vector<std::uint32_t>;

Numbers twoSweep(std::size_t triangles) {
    Numbers order;
    for (const std::uint32_t first : {0u, 1u}) {
        for (std::uint32_t t = first; t < triangles; t += 2) order.push_back(t);
    }
    return order;
}

/// Orders triangles by the Morton codes of their centers, with 10 bits per axis.
Numbers spatial(const Mesh& mesh) {
    const auto middleOf = [&](std::size_t t) {
        Vec3 middle;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = mesh.positions[mesh.indices[3 * t + k]];
            middle = {middle.x + p.x / 3, middle.y + p.y / 3, middle.z + p.z / 3};
        }
        return middle;
    };
    const std::size_t count = mesh.triangleCount();
    Vec3 low = middleOf(0), high = low;
    for (std::size_t t = 0; t < count; ++t) {
        const Vec3 m = middleOf(t);
        low = {std::min(low.x, m.x), std::min(low.y, m.y), std::min(low.z, m.z)};
        high = {std::max(high.x, m.x), std::max(high.y, m.y), std::max(high.z, m.z)};
    }
    const float extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    const auto cellOf = [=](float x, float from) { return static_cast<std::uint32_t>(1023 * (x - from) / extent); };
    Numbers codes(count);
    for (std::size_t t = 0; t < count; ++t) {
        const Vec3 m = middleOf(t);
        const std::uint32_t x = cellOf(m.x, low.x), y = cellOf(m.y, low.y), z = cellOf(m.z, low.z);
        for (std::uint32_t bit = 0; bit < 10; ++bit)
            codes[t] |= (x >> bit & 1) << (3 * bit) | (y >> bit & 1) << (3 * bit + 1) | (z >> bit & 1) << (3 * bit + 2);
    }
    Numbers order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t t) { return codes[t]; });
    return order;
}

/// Orders triangles as fans around one vertex after the other. The next vertex is taken from those in the vertex cache.
/// Based on: Sander, Nehab, Barczak, "Fast Triangle Reordering for Vertex Locality and Reduced Overdraw", 2007.
Numbers vertexCache(const Mesh& mesh) {
    constexpr std::uint32_t kCache = 16;
    const std::size_t vertices = mesh.positions.size();
    Numbers begin(vertices + 1), around(mesh.indices.size()), left(vertices), used(vertices), recent, order;
    for (const std::uint32_t v : mesh.indices) ++begin[v + 1], ++left[v];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    Numbers ends(begin.begin(), begin.end() - 1);
    for (std::uint32_t i = 0; i < mesh.indices.size(); ++i) around[ends[mesh.indices[i]]++] = i / 3;
    std::vector<bool> taken(mesh.triangleCount());
    std::uint32_t time = kCache + 1, cursor = 0;
    bool found = true;
    for (std::uint32_t fan = 0; found;) {
        Numbers candidates;
        for (std::uint32_t i = begin[fan]; i < begin[fan + 1]; ++i) {
            const std::uint32_t t = around[i];
            if (taken[t]) continue;
            taken[t] = true;
            order.push_back(t);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t v = mesh.indices[3 * t + k];
                recent.push_back(v);
                candidates.push_back(v);
                --left[v];
                if (time - used[v] > kCache) used[v] = time++;
            }
        }
        // Choose the oldest vertex that will still be in the cache when its fan is finished.
        std::uint32_t best = 0;
        found = false;
        for (const std::uint32_t v : candidates) {
            if (left[v] == 0) continue;
            const std::uint32_t age = time - used[v], priority = age + 2 * left[v] <= kCache ? age : 0;
            if (!found || priority > best) fan = v, best = priority;
            found = true;
        }
        for (; !found && !recent.empty(); recent.pop_back()) {
            fan = recent.back();
            found = left[fan] != 0;
        }
        for (; !found && cursor < vertices; ++cursor) {
            fan = cursor;
            found = left[fan] != 0;
        }
    }
    return order;
}

}  // namespace

const std::vector<std::string>& triangleOrders() {
    static const std::vector<std::string> names = {"reversed", "two_sweep", "vertex_cache", "spatial", "shuffled"};
    return names;
}

Mesh inOrder(Mesh mesh, const std::string& name) {
    if (name == "shuffled") return shuffled(std::move(mesh));
    Numbers order;
    if (name == "two_sweep") order = twoSweep(mesh.triangleCount());
    if (name == "vertex_cache") order = vertexCache(mesh);
    if (name == "spatial") order = spatial(mesh);
    for (std::size_t t = mesh.triangleCount(); name == "reversed" && t-- > 0;)
        order.push_back(static_cast<std::uint32_t>(t));
    if (order.size() != mesh.triangleCount()) {
        std::fprintf(stderr, "bench: there is no order %s\n", name.c_str());
        std::exit(1);
    }
    Numbers indices;
    indices.reserve(mesh.indices.size());
    for (const std::uint32_t t : order)
        indices.insert(indices.end(), mesh.indices.begin() + 3 * t, mesh.indices.begin() + 3 * t + 3);
    mesh.indices = std::move(indices);
    return mesh;
}

}  // namespace tspace::bench
