// SPDX-License-Identifier: MIT
#include "model/gltf/turn_triangles.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "model/gltf/editor.h"
#include "model/gltf/pool_elements.h"

namespace tspace::gltf {

namespace {

std::vector<std::uint32_t> turnedCorners(const Document& document, const Primitive& primitive,
                                         const std::vector<std::uint8_t>& turned) {
    std::vector<std::uint32_t> corners = readTriangleCorners(document, primitive);
    for (std::size_t t = 0; t < turned.size(); ++t) {
        if (turned[t] != 0) std::swap(corners[3 * t + 1], corners[3 * t + 2]);
    }
    return corners;
}

/// Primitives whose new lists are the same, and replace the same.
struct NewList {
    std::vector<std::uint32_t> corners = {};
    std::vector<std::size_t> primitives = {};
};

}  // namespace

void turnTriangles(Document& document, const std::string& new_file, std::span<const Primitive> primitives,
                   std::span<const std::vector<std::uint8_t>> turned) {
    const std::optional<std::size_t> none;
    // By old list and vertices, which also decide how a list is stored.
    std::map<std::pair<std::optional<std::size_t>, std::optional<std::size_t>>, std::vector<NewList>> lists;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (std::find(turned[i].begin(), turned[i].end(), 1) == turned[i].end()) continue;
        std::vector<NewList>& known = lists[{primitives[i].indices, primitives[i].find("POSITION")}];
        std::vector<std::uint32_t> corners = turnedCorners(document, primitives[i], turned[i]);
        auto list = std::find_if(known.begin(), known.end(), [&](const NewList& l) { return l.corners == corners; });
        if (list == known.end()) list = known.insert(known.end(), {std::move(corners), {}});
        list->primitives.push_back(i);
    }
    Editor editor(document, new_file);
    for (auto& [key, known] : lists) {
        const std::optional<std::size_t> old = key.first;
        for (NewList& list : known) {
            const Primitive& first = primitives[list.primitives.front()];
            ElementData data = newIndices(document, first, std::move(list.corners), first.vertex_count);
            data.like = old ? old : key.second;
            const bool alone = old && editor.accessorUses(*old) == list.primitives.size();
            const std::size_t stored = editor.store(std::move(data), alone ? old : none);
            for (const std::size_t number : list.primitives) {
                Json& object = editor.primitive(primitives[number].mesh, primitives[number].index);
                object["indices"] = stored;
                if (primitives[number].mode != Mode::triangles) object["mode"] = static_cast<unsigned>(Mode::triangles);
                editor.moveUse(old, stored);
            }
        }
    }
    editor.finish();
}

}  // namespace tspace::gltf
