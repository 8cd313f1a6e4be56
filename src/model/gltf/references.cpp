// SPDX-License-Identifier: MIT
// Counts references, closes gaps in buffers, and removes unused buffers.
#include "model/gltf/references.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/base/sort.h"
#include "model/gltf/meshopt_views.h"
#include "model/io/file_error.h"

namespace tspace::gltf {
namespace {

/// Cuts are multiples of this size, so that all data after them keeps its alignment (glTF requires 4; data of
/// extensions may need 8).
constexpr std::size_t kCutAlignment = 8;

/// Counts a reference. Skips values of wrong types: members that tspace interprets were checked while loading, and
/// others are irrelevant.
void count(std::vector<std::size_t>& uses, const Json* value) {
    if (value == nullptr || !value->is_number() || !(value->get<double>() >= 0)) return;
    const double index = value->get<double>();
    if (index < static_cast<double>(uses.size())) ++uses[static_cast<std::size_t>(index)];
}

void countMembers(std::vector<std::size_t>& uses, const Json* object) {
    if (object == nullptr || !object->is_object()) return;
    for (const auto& [name, value] : object->items()) count(uses, &value);
}

void countPrimitive(std::vector<std::size_t>& uses, const Json& primitive) {
    countMembers(uses, findMember(primitive, "attributes"));
    count(uses, findMember(primitive, "indices"));
    const Json* targets = findMember(primitive, "targets");
    if (targets == nullptr) return;
    for (const Json& target : *targets) countMembers(uses, &target);
}

/// Counts the members named "bufferView" in a value and everything below it. The recursion depth is bounded by
/// kMaxJsonDepth.
void countViewMembers(std::vector<std::size_t>& uses, const Json& value) {
    if (value.is_object()) count(uses, findMember(value, "bufferView"));
    if (!value.is_structured()) return;
    for (const Json& child : value) countViewMembers(uses, child);
}

/// Returns how often accessors (and their sparse parts) use each view.
std::vector<std::size_t> accessorViewUses(const Document& document) {
    std::vector<std::size_t> uses(rootArray(document, "bufferViews").size(), 0);
    for (const Json& accessor : rootArray(document, "accessors")) {
        count(uses, findMember(accessor, "bufferView"));
        const Json* sparse = findMember(accessor, "sparse");
        if (sparse == nullptr) continue;
        for (const char* part : {"indices", "values"}) {
            if (const Json* object = findMember(*sparse, part)) count(uses, findMember(*object, "bufferView"));
        }
    }
    return uses;
}

Extent solidExtent(const Document& document, std::size_t accessor, std::size_t view_index, std::size_t offset,
                   std::size_t byte_count) {
    const BufferView view = readBufferView(document, view_index);
    return {accessor, view.buffer, view.begin + offset, view.begin + offset + byte_count, 0, 0};
}

/// Returns the ranges to remove from one buffer: parts of `vacated` that no extent in `live` uses, shrunk to aligned
/// bounds. They are sorted and disjoint.
std::vector<ByteRange> cutsOf(std::size_t buffer, std::span<const ByteRange> vacated, std::span<const Extent> live) {
    std::vector<ByteRange> holes, cuts;
    for (const ByteRange& range : vacated) {
        if (range.buffer == buffer) holes.push_back(range);
    }
    sortList(holes.begin(), holes.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
    std::vector<ByteRange> blocks;
    for (const Extent& extent : live) {
        if (extent.buffer == buffer && extent.begin < extent.end) blocks.push_back({buffer, extent.begin, extent.end});
    }
    sortList(blocks.begin(), blocks.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
    std::size_t done = 0, block = 0, reach = 0;
    const auto addCut = [&](std::size_t begin, std::size_t end) {
        begin = (begin + kCutAlignment - 1) / kCutAlignment * kCutAlignment;
        end = end / kCutAlignment * kCutAlignment;
        if (begin < end) cuts.push_back({buffer, begin, end});
    };
    for (const ByteRange& hole : holes) {
        std::size_t at = std::max(hole.begin, done);
        // `reach` is the largest end of the live ranges that start at or before `at`.
        while (at < hole.end) {
            while (block < blocks.size() && blocks[block].begin <= at) reach = std::max(reach, blocks[block++].end);
            if (reach > at) {
                at = std::min(reach, hole.end);
                continue;
            }
            const std::size_t stop = block < blocks.size() ? std::min(blocks[block].begin, hole.end) : hole.end;
            addCut(at, stop);
            at = stop;
        }
        done = std::max(done, hole.end);
    }
    return cuts;
}

/// Maps byte offsets before the cuts to offsets after them. A byte inside a cut maps to the position of the cut.
class Mover {
  public:
    explicit Mover(std::span<const ByteRange> cuts) : cuts_(cuts) {
        std::size_t sum = 0;
        for (const ByteRange& cut : cuts) {
            removed_before_.push_back(sum);
            sum += cut.end - cut.begin;
        }
    }
    [[nodiscard]] std::size_t operator()(std::size_t offset) const {
        const auto after = std::upper_bound(cuts_.begin(), cuts_.end(), offset,
                                            [](std::size_t value, const ByteRange& cut) { return value < cut.begin; });
        const auto number = static_cast<std::size_t>(after - cuts_.begin());
        if (number == 0) return offset;
        const ByteRange& cut = cuts_[number - 1];
        return offset - removed_before_[number - 1] - (std::min(offset, cut.end) - cut.begin);
    }

  private:
    std::span<const ByteRange> cuts_;
    std::vector<std::size_t> removed_before_;  ///< number of bytes removed before each cut
};

void setOffset(Json& object, std::size_t offset, const char* key) {
    if (offset != 0 || object.contains(key)) object[key] = offset;
}

/// Updates the byteOffset of `object`, which is inside a view that starts at `view_begin`.
void moveOffset(Json& object, const Mover& moved, std::size_t view_begin) {
    const std::size_t offset = readSize(object, "byteOffset", "", 0);
    setOffset(object, moved(view_begin + offset) - moved(view_begin), "byteOffset");
}

void cutBuffer(Document& document, std::size_t buffer, std::span<const ByteRange> cuts) {
    const Mover moved(cuts);
    std::vector<std::size_t> old_begin;
    for (std::size_t i = 0; i < rootArray(document, "bufferViews").size(); ++i) {
        const BufferView view = readBufferView(document, i);
        if (const auto packed = readMeshoptView(document, i); packed && packed->buffer == buffer) {
            setOffset(document.json["bufferViews"][i]["extensions"][packed->extension], moved(packed->begin),
                      "byteOffset");
        }
        old_begin.push_back(view.buffer == buffer ? view.begin : Extent::kNoAccessor);
        if (view.buffer != buffer) continue;
        Json& object = document.json["bufferViews"][i];
        setOffset(object, moved(view.begin), "byteOffset");
        object["byteLength"] = moved(view.begin + view.byte_count) - moved(view.begin);
    }
    const auto moveIn = [&](Json& object) {
        const Json* view = findMember(object, "bufferView");
        if (view == nullptr) return;
        const std::size_t begin = old_begin[view->get<std::size_t>()];
        if (begin != Extent::kNoAccessor) moveOffset(object, moved, begin);
    };
    if (document.json.contains("accessors")) {
        for (Json& accessor : document.json["accessors"]) {
            moveIn(accessor);
            if (!accessor.contains("sparse")) continue;
            moveIn(accessor["sparse"]["indices"]);
            moveIn(accessor["sparse"]["values"]);
        }
    }
    Buffer& data = document.buffers[buffer];
    std::vector<ByteCut> byte_cuts;
    for (const ByteRange& cut : cuts) byte_cuts.push_back({cut.begin, cut.end});
    data.bytes.cut(byte_cuts);
    data.edited = true;
}

}  // namespace

std::vector<std::size_t> countAccessorUses(const Document& document) {
    std::vector<std::size_t> uses(rootArray(document, "accessors").size(), 0);
    for (const Json& mesh : rootArray(document, "meshes")) {
        if (const Json* primitives = findMember(mesh, "primitives")) {
            for (const Json& primitive : *primitives) countPrimitive(uses, primitive);
        }
    }
    for (const Json& skin : rootArray(document, "skins")) count(uses, findMember(skin, "inverseBindMatrices"));
    for (const Json& animation : rootArray(document, "animations")) {
        const Json* samplers = findMember(animation, "samplers");
        if (samplers == nullptr) continue;
        for (const Json& sampler : *samplers) {
            count(uses, findMember(sampler, "input"));
            count(uses, findMember(sampler, "output"));
        }
    }
    for (const Json& node : rootArray(document, "nodes")) {
        if (const Json* instancing = findExtension(node, "EXT_mesh_gpu_instancing"))
            countMembers(uses, findMember(*instancing, "attributes"));
    }
    return uses;
}

std::vector<std::size_t> countViewUses(const Document& document) {
    std::vector<std::size_t> uses(rootArray(document, "bufferViews").size(), 0);
    countViewMembers(uses, document.json);
    return uses;
}

Extent extentOf(const Document& document, const Accessor& accessor) {
    const BufferView view = readBufferView(document, *accessor.view);
    if (accessor.component_count == 0)
        return {accessor.index, view.buffer, view.begin, view.begin + view.byte_count, 0, 0};
    const std::size_t begin = view.begin + accessor.byte_offset;
    const std::size_t span = accessor.count == 0 ? 0 : (accessor.count - 1) * accessor.stride + accessor.data_bytes;
    return {accessor.index, view.buffer, begin, begin + span, accessor.stride, accessor.element_bytes};
}

std::vector<Extent> collectExtents(const Document& document) {
    std::vector<Extent> extents;
    for (std::size_t i = 0; i < rootArray(document, "accessors").size(); ++i) {
        const Accessor accessor = readAccessor(document, i);
        if (accessor.view) extents.push_back(extentOf(document, accessor));
        if (!accessor.sparse) continue;
        const SparsePart& sparse = *accessor.sparse;
        extents.push_back(solidExtent(document, Extent::kNoAccessor, sparse.index_view, sparse.index_offset,
                                      sparse.count * bytesOf(sparse.index_type)));
        const bool known = accessor.component_count > 0;
        extents.push_back(solidExtent(
            document, Extent::kNoAccessor, sparse.value_view, known ? sparse.value_offset : 0,
            known ? sparse.count * accessor.element_bytes : readBufferView(document, sparse.value_view).byte_count));
    }
    for (std::size_t i = 0; i < rootArray(document, "bufferViews").size(); ++i) {
        if (const auto packed = readMeshoptView(document, i)) {
            extents.push_back(
                {Extent::kNoAccessor, packed->buffer, packed->begin, packed->begin + packed->byte_count, 0, 0});
        }
    }
    // Views that images, extensions or unknown readers use are counted as a whole.
    const std::vector<std::size_t> all = countViewUses(document), known = accessorViewUses(document);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (known[i] > 0 && known[i] == all[i] && !rootArray(document, "bufferViews")[i].contains("extensions"))
            continue;
        extents.push_back(solidExtent(document, Extent::kNoAccessor, i, 0, readBufferView(document, i).byte_count));
    }
    return extents;
}

bool overlaps(const Extent& a, const Extent& b) {
    if (a.buffer != b.buffer || a.begin >= b.end || b.begin >= a.end) return false;
    if (a.stride == 0 || a.stride != b.stride) return true;
    // Extents with equal strides overlap only if their positions within one stride do.
    const std::size_t distance =
        a.begin >= b.begin ? (a.begin - b.begin) % a.stride : (a.stride - (b.begin - a.begin) % a.stride) % a.stride;
    return distance < b.element_bytes || a.stride - distance < a.element_bytes;
}

void cutVacated(Document& document, std::span<const ByteRange> vacated) {
    const std::vector<Extent> live = collectExtents(document);
    for (std::size_t i = 0; i < document.buffers.size(); ++i) {
        if (!document.buffers[i].own && document.buffers[i].source != BufferSource::decoded) continue;
        const std::vector<ByteRange> cuts = cutsOf(i, vacated, live);
        if (!cuts.empty()) cutBuffer(document, i, cuts);
    }
}

namespace {

/// Returns, for each buffer, whether a view refers to it.
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
    // Empty buffers are rare, so the function looks for them before it finds used buffers, which reads every view.
    if (std::none_of(document.buffers.begin(), document.buffers.end(), is_emptied)) return;
    std::vector<bool> is_kept = usedBuffers(document);
    for (std::size_t i = 0; i < is_kept.size(); ++i) is_kept[i] = is_kept[i] || !is_emptied(document.buffers[i]);
    keepOnly(document, is_kept);
}

}  // namespace tspace::gltf
