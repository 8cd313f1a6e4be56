// SPDX-License-Identifier: MIT
// Keeps, overwrites or stores elements.
#include "model/gltf/set_attribute.h"

#include <utility>

#include "model/gltf/gather_elements.h"
#include "model/gltf/packed_layout.h"

namespace tspace::gltf {

namespace {

bool hasFormatOf(const Accessor& accessor, const ElementData& data) {
    return accessor.component == data.component && accessor.type == data.type &&
           accessor.normalized == data.normalized && accessor.count == data.count;
}

Json& attributesOf(Editor& editor, const Primitive& primitive, std::ptrdiff_t target) {
    Json& object = editor.primitive(primitive.mesh, primitive.index);
    return target < 0 ? object["attributes"] : object["targets"][static_cast<std::size_t>(target)];
}

}  // namespace

bool setAttribute(Editor& editor, const Document& document, const SharedAttribute& attribute, ElementData&& data) {
    const auto accessorOf = [&](const Primitive& primitive) {
        const bool is_base = attribute.target == kBase;
        const auto old = findAttribute(
            is_base ? primitive.attributes : primitive.targets[static_cast<std::size_t>(attribute.target)],
            attribute.name);
        return old ? old : attribute.spare;
    };
    const Primitive& first = attribute.primitives[attribute.numbers[0]];
    const std::optional<std::size_t> old = accessorOf(first);
    const bool alone = old && editor.accessorUses(*old) == attribute.numbers.size();
    std::optional<Accessor> current;
    if (old && old != attribute.spare && attribute.may_stay) {
        current = readAccessor(document, *old);
        if (!hasFormatOf(*current, data)) current.reset();
    }
    if (current) data.makeNow();
    if (current && copyElements(document, *current) == data.bytes) return false;
    // KHR_mesh_quantization widens the formats of the specification's attributes; application-specific ones may always
    // be integers.
    if (data.normalized && !isPackedAttribute(attribute.name)) editor.require("KHR_mesh_quantization");
    if (attribute.target != kBase) makeSparseWhereSmaller(data);
    // Of a target, as what moves its vertices: Draco holds no targets.
    const Json& attributes = attributesOf(editor, first, attribute.target);
    data.like = (attribute.target == kBase ? attributes["POSITION"] : attributes.front()).get<std::size_t>();
    if (current && alone && !data.places && editor.canOverwrite(*current)) {
        editor.overwrite(*current, data.bytes);
        return true;
    }
    const std::size_t stored = editor.store(std::move(data), alone ? old : std::nullopt);
    for (const std::size_t number : attribute.numbers) {
        const Primitive& primitive = attribute.primitives[number];
        attributesOf(editor, primitive, attribute.target)[attribute.name] = stored;
        editor.moveUse(accessorOf(primitive), stored);
    }
    return true;
}

}  // namespace tspace::gltf
