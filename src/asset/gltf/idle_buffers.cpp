// SPDX-License-Identifier: MIT
// Finding and removing idle buffers.
#include "asset/gltf/idle_buffers.h"

#include <utility>
#include <vector>

#include "asset/gltf/compression/meshopt_views.h"

namespace tspace::gltf {

void removeIdleBuffers(Document& document) {
    std::vector<bool> is_used;
    for (const Buffer& buffer : document.buffers) is_used.push_back(buffer.own);
    const std::size_t view_count = rootArray(document, "bufferViews").size();
    for (std::size_t i = 0; i < view_count; ++i) {
        is_used[readBufferView(document, i).buffer] = true;
        if (const auto packed = readMeshoptView(document, i)) is_used[packed->buffer] = true;
    }
    std::vector<std::size_t> moved(document.buffers.size(), 0);
    std::vector<Buffer> buffers;
    Json entries = Json::array();
    for (std::size_t i = 0; i < document.buffers.size(); ++i) {
        moved[i] = buffers.size();
        if (!is_used[i]) continue;
        buffers.push_back(std::move(document.buffers[i]));
        entries.push_back(document.json["buffers"][i]);
    }
    const bool is_idle_found = buffers.size() < document.buffers.size();
    document.buffers = std::move(buffers);
    if (!is_idle_found) return;
    document.json["buffers"] = std::move(entries);
    for (std::size_t i = 0; i < view_count; ++i) {
        Json& view = document.json["bufferViews"][i];
        view["buffer"] = moved[view["buffer"].get<std::size_t>()];
        if (const char* name = meshoptExtension(view)) {
            Json& extension = view["extensions"][name];
            extension["buffer"] = moved[extension["buffer"].get<std::size_t>()];
        }
    }
}

}  // namespace tspace::gltf
