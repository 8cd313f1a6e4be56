// SPDX-License-Identifier: MIT
// Reads packed tangent frames of primitives.
#include "model/gltf/packed_frames.h"

#include <algorithm>
#include <utility>

#include "model/gltf/accessor.h"
#include "model/io/file_error.h"

namespace tspace::gltf {
namespace {

/// Returns the format that the accessor of a part must have, as spelled by formatName.
std::string wantedFormat(const PackedPart& part) {
    Accessor wanted;
    wanted.component = part.component;
    wanted.normalized = part.normalized;
    wanted.component_count = part.byte_count / bytesOf(part.component);
    return formatName(wanted);
}

std::string faultOf(const Document& document, const Accessor& accessor, const PackedPart& part) {
    const bool fits =
        accessor.component == part.component && accessor.type == part.type && accessor.normalized == part.normalized;
    if (!fits) return "is " + formatName(accessor) + ", but must be " + wantedFormat(part);
    return hasData(document, accessor) ? "" : "has no data that this build of tspace can read";
}

std::string countFault(const Accessor& accessor, const Primitive& primitive) {
    return "has " + std::to_string(accessor.count) + " elements, but the primitive has " +
           std::to_string(primitive.vertex_count) + " vertices";
}

}  // namespace

std::vector<StoredPacking> findPacked(const Document& document, const Primitive& primitive) {
    std::vector<StoredPacking> found;
    for (const PackedLayout& layout : packedLayouts()) {
        StoredPacking packing{.layout = &layout};
        std::string missing;
        for (const PackedPart& part : layout.parts) {
            const auto index = primitive.find(part.attribute);
            const auto miscounted = findAttribute(primitive.miscounted, part.attribute);
            if (!index && !miscounted) {
                missing = part.attribute;
                continue;
            }
            const std::string fault = index ? faultOf(document, readAccessor(document, *index), part)
                                            : countFault(readAccessor(document, *miscounted), primitive);
            if (packing.attribute.empty() || (packing.fault.empty() && !fault.empty())) {
                packing.attribute = part.attribute;
                packing.fault = fault;
            }
        }
        if (packing.attribute.empty()) continue;
        if (!missing.empty() && packing.fault.empty())
            packing.fault = "needs the attribute " + missing + ", which is missing";
        found.push_back(std::move(packing));
    }
    return found;
}

std::string packedAlone(const Document& document, const Primitive& primitive) {
    if (primitive.find("NORMAL") && primitive.find("TANGENT")) return {};
    for (const StoredPacking& packing : findPacked(document, primitive)) {
        if (packing.fault.empty()) return packing.attribute;
    }
    return {};
}

Bytes readPackedWords(const Document& document, const Primitive& primitive, const PackedLayout& layout) {
    Bytes words(primitive.vertex_count * frameBytes(layout.format));
    for (const PackedPart& part : layout.parts) {
        const Accessor accessor = readAccessor(document, *primitive.find(part.attribute));
        putPart(copyElements(document, accessor), layout.format, part, words);
    }
    return words;
}

bool removeMiscounted(Document& document, std::span<Primitive> primitives, std::optional<FrameFormat> pack) {
    bool is_changed = false;
    for (Primitive& primitive : primitives) {
        for (const auto& [name, index] : primitive.miscounted) {
            const bool will_be_recomputed =
                pack &&
                std::any_of(packedLayout(*pack).parts.begin(), packedLayout(*pack).parts.end(),
                            [&attribute = name](const PackedPart& part) { return part.attribute == attribute; });
            if (!will_be_recomputed) {
                failFile(ErrorCode::invalidFile,
                         "the attribute " + countFault(readAccessor(document, index), primitive),
                         join(join(primitive.place(), "attributes"), name));
            }
            document.json["meshes"][primitive.mesh]["primitives"][primitive.index]["attributes"].erase(name);
            is_changed = true;
        }
        primitive.miscounted.clear();
    }
    return is_changed;
}

}  // namespace tspace::gltf
