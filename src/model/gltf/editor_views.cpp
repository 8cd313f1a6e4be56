// SPDX-License-Identifier: MIT
// Packing and unpacking of whole buffer views.
#include "model/gltf/editor.h"
#include "model/gltf/extension_lists.h"

namespace tspace::gltf {

void Editor::require(const char* extension) { requireExtension(document_, extension); }

void Editor::letGoOfView(std::size_t view) {
    letGo(view, 0, readBufferView(document_, view).byte_count);
    changed_ = true;
}

void Editor::unpackView(std::size_t index) {
    const MeshoptView packed = *readMeshoptView(document_, index);
    const BufferView range = readBufferView(document_, index);
    vacated_.push_back({packed.buffer, packed.begin, packed.begin + packed.byte_count});
    if (document_.buffers[range.buffer].source == BufferSource::decoded) {
        Bytes plain = document_.buffers[range.buffer].bytes.copy(range.begin, range.byte_count);
        const std::size_t target = targetBuffer();
        const std::size_t begin = appendBytes(target, std::move(plain), 1, 1);
        document_.json["bufferViews"][index]["buffer"] = target;
        document_.json["bufferViews"][index]["byteOffset"] = begin;
    }
    Json& view = document_.json["bufferViews"][index];
    view["extensions"].erase(packed.extension);
    if (view["extensions"].empty()) view.erase("extensions");
    changed_ = true;
}

/// A buffer for the plain form of views that only have a compressed one in the file.
std::size_t Editor::fallbackBuffer() {
    if (fallback_buffer_) return *fallback_buffer_;
    targetBuffer();  // first, because BIN is buffer 0
    for (std::size_t i = 0; i < document_.buffers.size(); ++i) {
        if (document_.buffers[i].source == BufferSource::decoded) fallback_buffer_ = i;
    }
    if (fallback_buffer_) return *fallback_buffer_;
    Json& buffers = document_.json["buffers"];
    fallback_buffer_ = buffers.size();
    Json entry = Json::object();
    entry["byteLength"] = 0;
    entry["extensions"][kExtMeshopt]["fallback"] = true;
    buffers.push_back(std::move(entry));
    document_.buffers.emplace_back().source = BufferSource::decoded;
    return *fallback_buffer_;
}

void Editor::packView(std::size_t index, std::size_t byte_count, std::size_t stride, bool is_indices) {
    const BufferView range = readBufferView(document_, index);
    Bytes plain = document_.buffers[range.buffer].bytes.copy(range.begin, range.byte_count);
    plain.resize(byte_count, 0);
    vacated_.push_back({range.buffer, range.begin, range.begin + range.byte_count});
    const std::size_t fallback = fallbackBuffer();
    const std::size_t begin = appendBytes(fallback, std::move(plain), 1, 1);
    Json& view = document_.json["bufferViews"][index];
    view["buffer"] = fallback;
    view["byteOffset"] = begin;
    view["byteLength"] = byte_count;
    to_encode_[index] = {kExtMeshopt, MeshoptFilter::none, {}, is_indices, stride};
    changed_ = true;
}

}  // namespace tspace::gltf
