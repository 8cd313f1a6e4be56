// SPDX-License-Identifier: MIT
// Meshopt extensions of buffer views: JSON, limits, decoding, and encoding.
#include "model/gltf/meshopt_views.h"

#include <array>
#include <cstring>
#include <utility>

#include "model/io/file_error.h"
#include "tspace/mesh.h"

namespace tspace::gltf {
namespace {

/// Number of bytes that a fallback buffer without data may have outside of its compressed views, for files of any size.
/// Gaps between views take memory too.
constexpr std::uint64_t kFreeGap = std::uint64_t{4} << 20;
constexpr std::uint64_t kGapRatio = 16;

constexpr std::array<std::pair<const char*, MeshoptMode>, 3> kModes = {{{"ATTRIBUTES", MeshoptMode::attributes},
                                                                        {"TRIANGLES", MeshoptMode::triangles},
                                                                        {"INDICES", MeshoptMode::indices}}};
constexpr std::array<std::pair<const char*, MeshoptFilter>, 5> kFilters = {{{"NONE", MeshoptFilter::none},
                                                                            {"OCTAHEDRAL", MeshoptFilter::octahedral},
                                                                            {"QUATERNION", MeshoptFilter::quaternion},
                                                                            {"EXPONENTIAL", MeshoptFilter::exponential},
                                                                            {"COLOR", MeshoptFilter::color}}};

template <class Value, std::size_t count>
Value valueOf(const std::array<std::pair<const char*, Value>, count>& table, const std::string& name,
              const std::string& place) {
    for (const auto& [key, value] : table) {
        if (name == key) return value;
    }
    failFile(ErrorCode::invalidFile, "the value " + inQuotes(name) + " is not defined", place);
}

template <class Value, std::size_t count>
const char* nameOf(const std::array<std::pair<const char*, Value>, count>& table, Value value) {
    for (const auto& [key, entry] : table) {
        if (entry == value) return key;
    }
    return "";
}

std::string placeOf(std::size_t view, const char* extension) {
    return join(join("/bufferViews", view) + "/extensions", std::string(extension));
}

/// Reads the range of the compressed bytes, which must be inside a buffer that has data.
void readRange(const Document& document, const Json& object, const std::string& place, MeshoptView& view) {
    view.buffer = requireIndex(object, "buffer", place, document.buffers.size(), "buffer");
    view.begin = readSize(object, "byteOffset", place, 0);
    view.byte_count = readSize(object, "byteLength", place);
    const Buffer& data = document.buffers[view.buffer];
    if (!data.hasStoredBytes())
        failFile(ErrorCode::invalidFile, "the buffer of the compressed data has no data", join(place, "buffer"));
    if (view.begin > data.bytes.size() || view.byte_count > data.bytes.size() - view.begin) {
        failFile(ErrorCode::invalidFile,
                 "the compressed data extends beyond its buffer of " + std::to_string(data.bytes.size()) + " bytes",
                 place);
    }
}

std::span<const std::uint8_t> compressedBytes(const Document& document, const MeshoptView& view) {
    return document.buffers[view.buffer].bytes.range(view.begin, view.byte_count);
}

void decodeInto(const Document& document, std::size_t index, const MeshoptView& view, std::span<std::uint8_t> to) {
    if (!to.empty() && !decodeMeshopt(view.coding, compressedBytes(document, view), to))
        failFile(ErrorCode::invalidFile, "the compressed data is damaged", placeOf(index, view.extension));
}

/// Returns the views to decode, keyed by their fallback buffer.
std::map<std::size_t, std::vector<std::size_t>> viewsToDecode(const Document& document) {
    std::map<std::size_t, std::vector<std::size_t>> views;
    std::uint64_t decoded_bytes = 0, stored_bytes = 0;
    for (const Buffer& buffer : document.buffers) stored_bytes += buffer.bytes.size();
    for (std::size_t i = 0; i < rootArray(document, "bufferViews").size(); ++i) {
        const std::optional<MeshoptView> view = readMeshoptView(document, i);
        if (!view) continue;
        const std::size_t buffer = readBufferView(document, i).buffer;
        if (document.buffers[buffer].source != BufferSource::absent) continue;
        decoded_bytes += view->coding.byteCount();
        // Several views may refer to the same compressed bytes, so their sum needs a limit too.
        if (decoded_bytes > stored_bytes * meshoptRatio(view->coding.is_khr)) {
            failFile(ErrorCode::invalidFile, "the compressed buffer views declare more data than the file can contain",
                     placeOf(i, view->extension));
        }
        if (meshoptMissing(view->coding.is_khr).empty()) views[buffer].push_back(i);
    }
    return views;
}

/// Allocates the fallback buffer that receives the decoded views.
void makeFallback(Document& document, std::size_t index, std::span<const std::size_t> views) {
    const std::string place = join("/buffers", index);
    const std::size_t length = readSize(rootArray(document, "buffers")[index], "byteLength", place);
    std::uint64_t covered = 0;
    for (const std::size_t view : views) covered += readBufferView(document, view).byte_count;
    if (length > covered && length - covered > kFreeGap + kGapRatio * document.input_bytes) {
        failFile(ErrorCode::invalidFile,
                 "the buffer declares " + std::to_string(length) + " bytes, but its compressed buffer views have " +
                     std::to_string(covered),
                 join(place, "byteLength"));
    }
    // Decoded bytes count as bytes of the file, so the budget grows with them; meshoptRatio bounds them.
    document.memory->allow(covered);
    document.memory->take(length, place);
    Buffer& buffer = document.buffers[index];
    buffer.bytes = BufferBytes(Bytes(length, 0));
    buffer.source = BufferSource::decoded;
    for (std::size_t i = 0; i < rootArray(document, "bufferViews").size(); ++i) {
        const Json& view = rootArray(document, "bufferViews")[i];
        if (readBufferView(document, i).buffer == index && meshoptExtension(view) == nullptr)
            document.views_without_data.insert(i);
    }
}

}  // namespace

std::optional<MeshoptView> readMeshoptView(const Document& document, std::size_t index) {
    const Json& object = rootArray(document, "bufferViews")[index];
    const char* extension = meshoptExtension(object);
    if (extension == nullptr) return {};
    const Json& member = *findExtension(object, extension);
    const std::string place = placeOf(index, extension);
    if (!member.is_object()) failFile(ErrorCode::invalidFile, "the extension must be a JSON object", place);
    MeshoptView view;
    view.extension = extension;
    readRange(document, member, place, view);
    view.coding.is_khr = extension == kKhrMeshopt;
    view.coding.mode = valueOf(kModes, readString(member, "mode", place), join(place, "mode"));
    view.coding.filter = valueOf(kFilters, readString(member, "filter", place, "NONE"), join(place, "filter"));
    if (view.coding.filter == MeshoptFilter::color && !view.coding.is_khr)
        failFile(ErrorCode::invalidFile,
                 "the filter 'COLOR' is not defined in EXT_meshopt_compression, only in KHR_meshopt_compression",
                 join(place, "filter"));
    view.coding.count = readSize(member, "count", place);
    view.coding.stride = readSize(member, "byteStride", place);
    if (std::string fault = meshoptFault(view.coding, view.byte_count); !fault.empty())
        failFile(ErrorCode::invalidFile, std::move(fault), place);
    const BufferView range = readBufferView(document, index);
    if (view.coding.byteCount() != range.byte_count || (range.stride != 0 && range.stride != view.coding.stride)) {
        failFile(ErrorCode::invalidFile,
                 std::to_string(view.coding.count) + " elements of " + std::to_string(view.coding.stride) +
                     " bytes do not match the buffer view of " + std::to_string(range.byte_count) + " bytes",
                 place);
    }
    return view;
}

void decodeMeshoptViews(Document& document) {
    for (const auto& [buffer, views] : viewsToDecode(document)) {
        makeFallback(document, buffer, views);
        for (const std::size_t index : views) {
            const MeshoptView view = *readMeshoptView(document, index);
            const BufferView range = readBufferView(document, index);
            decodeInto(document, index, view, document.buffers[buffer].bytes.range(range.begin, range.byte_count));
        }
    }
}

MeshoptFilter filterOf(const Document& document, const Accessor& accessor) {
    if (!accessor.view) return MeshoptFilter::none;
    const std::optional<MeshoptView> view = readMeshoptView(document, *accessor.view);
    return view ? view->coding.filter : MeshoptFilter::none;
}

Bytes gatherUnfiltered(const Document& document, const Accessor& accessor, std::span<const std::uint32_t> sources) {
    if (filterOf(document, accessor) == MeshoptFilter::none || accessor.sparse || accessor.count == 0) return {};
    MeshoptView view = *readMeshoptView(document, *accessor.view);
    if (!meshoptMissing(view.coding.is_khr).empty()) return {};
    const MeshoptFilter filter = std::exchange(view.coding.filter, MeshoptFilter::none);
    const std::size_t row = (accessor.element_bytes + 3) / 4 * 4;
    // The exponential filter encodes each 4-byte component separately; the other filters need complete rows.
    const bool can_cut = filter == MeshoptFilter::exponential
                             ? accessor.component == ComponentType::f32 && accessor.byte_offset % 4 == 0
                             : row == accessor.stride && accessor.byte_offset == 0;
    const std::size_t total =
        readBufferView(document, *accessor.view).byte_count;  // the size that readMeshoptView has checked
    if (!can_cut || accessor.byte_offset + (accessor.count - 1) * accessor.stride + row > total) return {};
    Bytes all(total);
    decodeInto(document, *accessor.view, view, all);
    Bytes rows(sources.size() * row);
    for (std::size_t i = 0; i < sources.size(); ++i)
        std::memcpy(rows.data() + i * row, all.data() + accessor.byte_offset + sources[i] * accessor.stride, row);
    return rows;
}

void encodeMeshoptView(Document& document, std::size_t index, const MeshoptRequest& request, std::size_t data_buffer) {
    const BufferView range = readBufferView(document, index);
    MeshoptCoding coding;
    coding.is_khr = request.extension == kKhrMeshopt;
    coding.stride = request.stride;
    coding.count = range.byte_count / coding.stride;
    if (request.is_indices) coding.mode = coding.count % 3 == 0 ? MeshoptMode::triangles : MeshoptMode::indices;
    std::span<const std::uint8_t> rows = document.buffers[range.buffer].bytes.range(range.begin, range.byte_count);
    if (request.unfiltered.size() == range.byte_count) {
        coding.filter = request.filter;
        rows = request.unfiltered;
    }
    Bytes data;
    if (!encodeMeshopt(coding, rows, data))
        failFile(ErrorCode::internal, "meshoptimizer could not encode the buffer view", join("/bufferViews", index));
    Json extension = Json::object();
    extension["buffer"] = data_buffer;
    extension["byteOffset"] = 0;
    extension["byteLength"] = data.size();
    extension["byteStride"] = coding.stride;
    extension["count"] = coding.count;
    extension["mode"] = nameOf(kModes, coding.mode);
    if (coding.filter != MeshoptFilter::none) extension["filter"] = nameOf(kFilters, coding.filter);
    Buffer& buffer = document.buffers[data_buffer];
    extension["byteOffset"] = buffer.bytes.append(std::move(data), 4);
    buffer.edited = true;
    document.json["bufferViews"][index]["extensions"][request.extension] = std::move(extension);
}

}  // namespace tspace::gltf
