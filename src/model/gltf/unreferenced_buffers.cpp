// SPDX-License-Identifier: MIT
// Finding and removing unreferenced buffers.
#include "model/gltf/unreferenced_buffers.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "model/gltf/meshopt_views.h"

namespace tspace::gltf {

namespace {

/// Whether a view lies in each buffer.
std::vector<bool> usedBuffers(const Document& document) {
    std::vector<bool> is_used(document.buffers.size(), false);
    for (std::size_t i = 0; i < rootArray(document, "bufferViews").size(); ++i) {
        is_used[readBufferView(document, i).buffer] = true;
        if (const auto packed = readMeshoptView(document, i)) is_used[packed->buffer] = true;
    }
    return is_used;
}

void keepOnly(Document& document, const std::vector<bool>& is_kept) {
    std::vector<std::size_t> moved(document.buffers.size(), 0);
    std::vector<Buffer> buffers;
    Json entries = Json::array();
    for (std::size_t i = 0; i < document.buffers.size(); ++i) {
        moved[i] = buffers.size();
        if (!is_kept[i]) continue;
        buffers.push_back(std::move(document.buffers[i]));
        entries.push_back(document.json["buffers"][i]);
    }
    const bool is_idle_found = buffers.size() < document.buffers.size();
    document.buffers = std::move(buffers);
    if (!is_idle_found) return;
    document.json["buffers"] = std::move(entries);
    for (std::size_t i = 0; i < rootArray(document, "bufferViews").size(); ++i) {
        Json& view = document.json["bufferViews"][i];
        view["buffer"] = moved[view["buffer"].get<std::size_t>()];
        if (const char* name = meshoptExtension(view)) {
            Json& extension = view["extensions"][name];
            extension["buffer"] = moved[extension["buffer"].get<std::size_t>()];
        }
    }
}

}  // namespace

void removeUnreferencedBuffers(Document& document) {
    std::vector<bool> is_kept = usedBuffers(document);
    for (std::size_t i = 0; i < is_kept.size(); ++i) is_kept[i] = is_kept[i] || document.buffers[i].own;
    keepOnly(document, is_kept);
}

void removeEmptiedBuffers(Document& document) {
    const auto is_emptied = [](const Buffer& buffer) {
        return buffer.own && buffer.edited && buffer.source != BufferSource::bin && buffer.bytes.size() == 0;
    };
    // Nearly never: only then are the views looked at.
    if (std::none_of(document.buffers.begin(), document.buffers.end(), is_emptied)) return;
    std::vector<bool> is_kept = usedBuffers(document);
    for (std::size_t i = 0; i < is_kept.size(); ++i) is_kept[i] = is_kept[i] || !is_emptied(document.buffers[i]);
    keepOnly(document, is_kept);
}

}  // namespace tspace::gltf
