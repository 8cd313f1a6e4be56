// SPDX-License-Identifier: MIT
// Overwriting, storing and reusing of accessors and buffer views.
#include "model/gltf/editor.h"

#include <algorithm>
#include <cstring>

#include "core/base/numbers.h"
#include "model/gltf/draco_primitives.h"
#include "model/gltf/gather_elements.h"
#include "model/gltf/references.h"
#include "model/io/uri.h"

namespace tspace::gltf {
namespace {

/// Sets a member; removes it if the value is null.
void setOrErase(Json& object, const char* key, Json value) {
    if (value.is_null()) return object.erase(key);
    object[key] = std::move(value);
}

}  // namespace

Editor::Editor(Document& document, std::string new_file_name)
    : document_(document), new_file_name_(std::move(new_file_name)), accessor_uses_(countAccessorUses(document)),
      view_uses_(countViewUses(document)), extents_(collectExtents(document)) {}

void Editor::moveUse(std::optional<std::size_t> from, std::size_t to) {
    if (from) --accessor_uses_[*from];
    ++accessor_uses_[to];
}

void Editor::release(std::size_t index) {
    changed_ = true;
    if (--accessor_uses_[index] > 0) return;
    freeAccessorData(readAccessor(document_, index));
    Json& accessor = document_.json["accessors"][index];
    for (const char* member : {"bufferView", "byteOffset", "min", "max", "sparse"}) accessor.erase(member);
    accessor["count"] = 1;
}

/// Frees the bytes of an accessor that will be replaced, and views without other uses.
void Editor::freeAccessorData(const Accessor& old) {
    if (old.view) {
        const std::size_t begin = old.byte_offset;
        releaseRange(*old.view, begin, old.count == 0 ? begin : begin + (old.count - 1) * old.stride + old.data_bytes);
    }
    if (old.sparse) {
        const SparsePart& sparse = *old.sparse;
        releaseRange(sparse.index_view, sparse.index_offset,
                     sparse.index_offset + sparse.count * bytesOf(sparse.index_type));
        releaseRange(sparse.value_view, sparse.value_offset, sparse.value_offset + sparse.count * old.element_bytes);
    }
}

void Editor::releaseRange(std::size_t index, std::size_t begin, std::size_t end) {
    const BufferView range = readBufferView(document_, index);
    if (begin < end) vacated_.push_back({range.buffer, range.begin + begin, range.begin + end});
    const Json& view = rootArray(document_, "bufferViews")[index];
    const Json* extensions = findMember(view, "extensions");
    const bool is_plain = extensions == nullptr || (extensions->size() == 1 && meshoptExtension(view) != nullptr);
    if (--view_uses_[index] > 0 || !is_plain) return;
    if (const auto packed = readMeshoptView(document_, index))
        vacated_.push_back({packed->buffer, packed->begin, packed->begin + packed->byte_count});
    to_encode_.erase(index);
    document_.views_without_data.erase(index);
    document_.json["bufferViews"][index].erase("extensions");
    spare_views_.push_back(index);
}

/// Shrinks an unused view to one byte: entries are never removed, and a view must not be empty.
void Editor::shrinkView(std::size_t index) {
    const BufferView old = readBufferView(document_, index);
    Json& view = document_.json["bufferViews"][index];
    view.erase("byteStride");
    view.erase("target");
    const bool has_own_bytes = target_buffer_ && document_.buffers[*target_buffer_].bytes.size() > 0;
    if (!document_.buffers[old.buffer].own) {
        view["byteLength"] = 1;
        if (!has_own_bytes) return;
        // The view moves to a buffer that the output owns, so that an unused view keeps no reference to the old buffer.
        vacated_.push_back({old.buffer, old.begin, old.begin + old.byte_count});
        view["buffer"] = targetBuffer();
        view["byteOffset"] = 0;
    } else if (old.byte_count > 1) {
        vacated_.push_back({old.buffer, old.begin + 1, old.begin + old.byte_count});
        view["byteLength"] = 1;
    }
}

/// Returns an unused view entry, or a new one, with one reference.
std::size_t Editor::newView() {
    Json& views = editableRootArray(document_, "bufferViews");
    std::size_t index = views.size();
    if (spare_views_.empty()) {
        views.push_back(Json::object());
        view_uses_.push_back(1);
    } else {
        index = spare_views_.front();
        spare_views_.erase(spare_views_.begin());
        view_uses_[index] = 1;
    }
    return index;
}

bool Editor::canOverwrite(const Accessor& accessor) const {
    if (!accessor.view || accessor.sparse || accessor.count == 0) return false;
    if (rootArray(document_, "bufferViews")[*accessor.view].contains("extensions")) return false;
    const Extent own = extentOf(document_, accessor);
    if (!document_.buffers[own.buffer].own) return false;
    return std::none_of(extents_.begin(), extents_.end(),
                        [&](const Extent& other) { return other.accessor != accessor.index && overlaps(own, other); });
}

void Editor::overwrite(const Accessor& accessor, const Bytes& elements) {
    const BufferView view = readBufferView(document_, *accessor.view);
    // Lazy pieces may read the bytes that are overwritten, so all of them are generated first.
    for (Buffer& any : document_.buffers) any.bytes.makeAll();
    Buffer& buffer = document_.buffers[view.buffer];
    std::uint8_t* to =
        buffer.bytes
            .range(view.begin + accessor.byte_offset, (accessor.count - 1) * accessor.stride + accessor.data_bytes)
            .data();
    for (std::size_t i = 0; i < accessor.count; ++i)
        std::memcpy(to + i * accessor.stride, elements.data() + i * accessor.element_bytes, accessor.element_bytes);
    Json& json = document_.json["accessors"][accessor.index];
    ElementData data{.component = accessor.component, .element_bytes = accessor.element_bytes, .bytes = elements};
    for (const auto& [key, bound] : {std::pair{"max", &data.max}, std::pair{"min", &data.min}}) {
        if (accessor.component == ComponentType::f32 && json.contains(key)) *bound = json[key];
    }
    renewBounds(data);
    setOrErase(json, "max", data.max);
    setOrErase(json, "min", data.min);
    buffer.edited = true;
    changed_ = true;
    changed_accessors_.insert(accessor.index);
}

std::size_t Editor::targetBuffer() {
    if (target_buffer_) return *target_buffer_;
    for (std::size_t i = 0; i < document_.buffers.size(); ++i) {
        if (document_.buffers[i].own) target_buffer_ = i;
    }
    // Data may be appended to any buffer that the output owns: existing views keep their ranges, and so does the data
    // of compressed views.
    if (target_buffer_) return *target_buffer_;
    Json& buffers = editableRootArray(document_, "buffers");
    target_buffer_ = buffers.size();
    Json entry = Json::object();
    entry["byteLength"] = 0;
    Buffer buffer;
    buffer.own = true;
    if (document_.container == Container::glb) {
        buffer.source = BufferSource::bin;
    } else {
        buffer.source = BufferSource::file;
        entry["uri"] = percentEncode(new_file_name_);
        buffer.path = new_file_name_;
    }
    buffers.push_back(std::move(entry));
    document_.buffers.push_back(std::move(buffer));
    return *target_buffer_;
}

std::size_t Editor::appendBytes(std::size_t index, Bytes bytes, std::size_t element_bytes, std::size_t stride) {
    Buffer& buffer = document_.buffers[index];
    buffer.edited = true;
    if (stride == element_bytes) return buffer.bytes.append(std::move(bytes), 4);
    const std::size_t count = bytes.size() / element_bytes;
    Bytes spread(count * stride, 0);
    for (std::size_t i = 0; i < count; ++i)
        std::memcpy(spread.data() + i * stride, bytes.data() + i * element_bytes, element_bytes);
    return buffer.bytes.append(std::move(spread), 4);
}

Editor::Form Editor::formLike(std::optional<std::size_t> accessor) const {
    if (!accessor) return {};
    if (document_.elements.count(*accessor) != 0) return {.is_draco = true};
    const Json* number = findMember(rootArray(document_, "accessors")[*accessor], "bufferView");
    if (number == nullptr) return {};
    const auto view = number->get<std::size_t>();
    Form form;
    const auto request = to_encode_.find(view);
    form.meshopt = request != to_encode_.end() ? request->second.extension
                                               : meshoptExtension(rootArray(document_, "bufferViews")[view]);
    // Without the library, only the uncompressed data next to the compressed data can be updated.
    if (form.meshopt != nullptr && !meshoptMissing(form.meshopt == kKhrMeshopt).empty()) form.meshopt = nullptr;
    const std::size_t buffer = readBufferView(document_, view).buffer;
    if (document_.buffers[buffer].source == BufferSource::decoded) form.decoded_buffer = buffer;
    return form;
}

std::size_t Editor::storeView(ElementData& data, const Form& form) {
    // Each element of a vertex attribute is aligned to 4 bytes; indices are tightly packed.
    const std::size_t stride = data.target == kVertexTarget ? (data.element_bytes + 3) / 4 * 4 : data.element_bytes;
    const std::size_t count = data.byteCount() / data.element_bytes;
    // The codec does not support 1-byte indices.
    const bool packs = form.meshopt != nullptr && stride > 1;
    const std::size_t buffer = packs && form.decoded_buffer ? *form.decoded_buffer : targetBuffer();
    if (data.later && (packs || stride != data.element_bytes)) data.makeNow();
    if (data.later) document_.buffers[buffer].edited = true;
    const std::size_t begin = data.later ? document_.buffers[buffer].bytes.append(std::move(data.later), 4)
                                         : appendBytes(buffer, std::move(data.bytes), data.element_bytes, stride);
    const std::size_t index = newView();
    Json& view = document_.json["bufferViews"][index];
    view["buffer"] = buffer;
    view["byteOffset"] = begin;
    view["byteLength"] = count * stride;
    setOrErase(view, "byteStride", stride != data.element_bytes ? Json(stride) : Json());
    setOrErase(view, "target", data.target != kNoTarget ? Json(data.target) : Json());
    if (packs) {
        to_encode_[index] = {form.meshopt, data.filter, std::move(data.unfiltered), data.target == kIndexTarget,
                             stride};
    }
    return index;
}

/// Stores elements and returns the member `sparse` of their accessor.
Json Editor::storeSparse(ElementData& data) {
    const std::vector<std::uint32_t>& places = *data.places;
    ElementData indices = indexElements(std::vector(places), ComponentType::u16, places.back());
    indices.target = data.target = kNoTarget;
    Json sparse = Json::object();
    sparse["count"] = places.size();
    sparse["indices"]["bufferView"] = storeView(indices, {});
    sparse["indices"]["componentType"] = static_cast<std::uint32_t>(indices.component);
    sparse["values"]["bufferView"] = storeView(data, {});
    return sparse;
}

std::size_t Editor::store(ElementData&& data, std::optional<std::size_t> replaces) {
    // The budget is charged for the whole run, because the data stays in memory until the file is written.
    document_.memory->take(data.byteCount() + data.unfiltered.size(), "/accessors");
    changed_ = true;
    const Form form = data.in_draco ? Form{.is_draco = true} : formLike(data.like);
    if (replaces) freeAccessorData(readAccessor(document_, *replaces));
    if (form.is_draco || data.places) data.makeNow();
    std::optional<std::size_t> view;
    Json sparse;
    if (form.is_draco) {
        // The caller moves the bytes into Draco data.
    } else if (!data.places) {
        view = storeView(data, form);
    } else {
        sparse = storeSparse(data);
    }
    Json& accessors = editableRootArray(document_, "accessors");
    const std::size_t index = replaces ? *replaces : accessors.size();
    if (!replaces) {
        accessors.push_back(Json::object());
        accessor_uses_.push_back(0);
    }
    if (!data.in_draco) changed_accessors_.insert(index);
    if (form.is_draco) {
        document_.elements[index] = std::move(data.bytes);
    } else {
        document_.elements.erase(index);
    }
    Json& accessor = accessors[index];
    setOrErase(accessor, "bufferView", view ? Json(*view) : Json());
    accessor.erase("byteOffset");
    accessor["componentType"] = static_cast<std::uint32_t>(data.component);
    setOrErase(accessor, "normalized", data.normalized ? Json(true) : Json());
    accessor["count"] = data.count;
    accessor["type"] = data.type;
    setOrErase(accessor, "max", data.max);
    setOrErase(accessor, "min", data.min);
    setOrErase(accessor, "sparse", std::move(sparse));
    return index;
}

std::size_t Editor::storeBlob(Bytes data, std::optional<std::size_t> replaces) {
    const std::size_t buffer = targetBuffer();
    if (replaces) {
        const BufferView old = readBufferView(document_, *replaces);
        vacated_.push_back({old.buffer, old.begin, old.begin + old.byte_count});
    }
    const std::size_t byte_count = data.size();
    const std::size_t begin = appendBytes(buffer, std::move(data), 1, 1);
    const std::size_t index = replaces ? *replaces : newView();
    Json& view = document_.json["bufferViews"][index];
    view["buffer"] = buffer;
    view["byteOffset"] = begin;
    view["byteLength"] = byte_count;
    for (const char* member : {"byteStride", "target"}) view.erase(member);
    return index;
}

Json& Editor::primitive(std::size_t mesh, std::size_t index) {
    return document_.json["meshes"][mesh]["primitives"][index];
}

Json& Editor::accessor(std::size_t index) { return document_.json["accessors"][index]; }

void Editor::finish() {
    if (!changed_) return;
    for (const auto& [view, request] : to_encode_) encodeMeshoptView(document_, view, request, targetBuffer());
    to_encode_.clear();
    encodeDracoPrimitives(
        document_, changed_accessors_, view_uses_,
        [&](Bytes data, std::optional<std::size_t> replaces) { return storeBlob(std::move(data), replaces); });
    for (const std::size_t view : spare_views_) shrinkView(view);
    spare_views_.clear();
    if (!vacated_.empty()) cutVacated(document_, vacated_);
    // The array is looked up for each buffer, because a document without buffers has none.
    for (std::size_t i = 0; i < document_.buffers.size(); ++i) {
        if (document_.buffers[i].edited) document_.json["buffers"][i]["byteLength"] = document_.buffers[i].bytes.size();
    }
    removeEmptiedBuffers(document_);
}

void Editor::require(const char* extension) { requireExtension(document_, extension); }

void Editor::releaseView(std::size_t view) {
    releaseRange(view, 0, readBufferView(document_, view).byte_count);
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
    eraseExtension(view, packed.extension);
    changed_ = true;
}

/// Returns the fallback buffer: it has no data in the file, and holds the decoded bytes of views that are stored only
/// compressed.
std::size_t Editor::fallbackBuffer() {
    if (fallback_buffer_) return *fallback_buffer_;
    // Must come first: if the document has no buffers, a new BIN must get index 0, before the fallback buffer is added.
    targetBuffer();
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
