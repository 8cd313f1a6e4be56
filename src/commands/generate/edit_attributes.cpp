// SPDX-License-Identifier: MIT
// Edits attributes and index lists.
#include "commands/generate/edit_attributes.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "core/mesh/pools/unit_lattice.h"
#include "model/gltf/component_rules.h"
#include "model/gltf/compression_extensions.h"
#include "model/gltf/gather_elements.h"
#include "model/gltf/packed_layout.h"

namespace tspace::gltf {

// Keeps, overwrites or stores the elements of an attribute.

VectorFormat unitFormatOf(const Accessor& accessor) {
    return accessor.component == ComponentType::i8    ? VectorFormat::snorm8
           : accessor.component == ComponentType::i16 ? VectorFormat::snorm16
                                                      : VectorFormat::float32;
}

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
    if (old && old != attribute.spare && attribute.may_reuse) {
        current = readAccessor(document, *old);
        if (!hasFormatOf(*current, data)) current.reset();
    }
    if (current) data.makeNow();
    if (current && copyElements(document, *current) == data.bytes) return false;
    // KHR_mesh_quantization is required for normalized formats of attributes that glTF specifies. Application-specific
    // attributes may be integers without it.
    if (data.normalized && !isPackedAttribute(attribute.name)) editor.require("KHR_mesh_quantization");
    if (attribute.target != kBase) makeSparseWhereSmaller(data);
    // New attributes of a morph target are compressed like its first attribute, not like the base, because Draco does
    // not compress morph targets.
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

// Removes TANGENT from primitives, morph targets and the Draco extension.

namespace {

bool names(const AttributeList& list, const char* attribute) {
    return std::any_of(list.begin(), list.end(), [&](const auto& entry) { return entry.first == attribute; });
}

bool hasKnownType(const Json& accessor) {
    static constexpr std::array kTypes{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    const std::string type = accessor["type"].get<std::string>();
    return std::any_of(kTypes.begin(), kTypes.end(), [&](const char* known) { return type == known; });
}

}  // namespace

bool canStripTangents(const Primitive& primitive) {
    bool has = names(primitive.attributes, "TANGENT");
    for (const AttributeList& target : primitive.targets) {
        const bool here = names(target, "TANGENT");
        if (here && target.size() == 1) return false;
        has = has || here;
    }
    return has;
}

/// Removes the attribute from the primitive, and from its Draco extension, because decoders must not look for a removed
/// attribute.
void eraseAttribute(Editor& editor, const Primitive& primitive, const char* name) {
    Json& object = editor.primitive(primitive.mesh, primitive.index);
    object["attributes"].erase(name);
    if (findExtension(object, kDraco) == nullptr) return;
    Json& draco = object["extensions"][kDraco];
    if (findMember(draco, "attributes") != nullptr && draco["attributes"].is_object()) draco["attributes"].erase(name);
}

void stripTangents(Editor& editor, std::span<const Primitive> primitives, std::span<const PrimitiveReport> reports) {
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (reports[i].action != PrimitiveAction::removed) continue;
        const Primitive& primitive = primitives[i];
        if (const auto tangents = primitive.find("TANGENT")) {
            eraseAttribute(editor, primitive, "TANGENT");
            editor.release(*tangents);
        }
        for (std::size_t t = 0; t < primitive.targets.size(); ++t) {
            if (const auto deltas = findAttribute(primitive.targets[t], "TANGENT")) {
                editor.primitive(primitive.mesh, primitive.index)["targets"][t].erase("TANGENT");
                editor.release(*deltas);
            }
        }
    }
}

void removeUnreadable(Editor& editor, const Primitive& primitive, std::ptrdiff_t target, const std::string& name,
                      std::size_t accessor) {
    if (target == kBase) {
        eraseAttribute(editor, primitive, name.c_str());
    } else {
        attributesOf(editor, primitive, target).erase(name);
    }
    // Data of an unknown type cannot be freed, because its size is unknown.
    if (hasKnownType(editor.accessor(accessor))) editor.release(accessor);
}

namespace {

/// Returns the elements of an accessor with the required number of components: truncated, or padded with zeros.
ElementData resizedElements(const Document& document, const AttributeFault& fault) {
    const Accessor accessor = readAccessor(document, fault.accessor);
    const Bytes elements = copyElements(document, accessor);
    ElementData data{.component = accessor.component,
                     .type = "VEC" + std::to_string(fault.new_count),
                     .normalized = accessor.normalized,
                     .count = accessor.count,
                     .element_bytes = fault.new_count * bytesOf(accessor.component)};
    data.bytes = Bytes(data.count * data.element_bytes, 0);
    for (std::size_t i = 0; i < data.count; ++i)
        std::copy_n(elements.data() + i * accessor.element_bytes, std::min(data.element_bytes, accessor.element_bytes),
                    data.bytes.data() + i * data.element_bytes);
    const Json& object = rootArray(document, "accessors")[fault.accessor];
    const auto firstOf = [&](const char* name) {
        const Json* bounds = findMember(object, name);
        if (bounds == nullptr || !bounds->is_array() || bounds->size() < fault.new_count) return Json();
        Json first = Json::array();
        for (std::size_t i = 0; i < fault.new_count; ++i) first.push_back((*bounds)[i]);
        return first;
    };
    data.min = firstOf("min");
    data.max = firstOf("max");
    return data;
}

/// Repairs an attribute and returns a warning about it. `stored`: resized elements by accessor and number of
/// components.
std::string repairAttribute(Editor& editor, const Document& document, const Primitive& primitive,
                            const AttributeFault& fault,
                            std::map<std::pair<std::size_t, std::size_t>, std::size_t>& stored) {
    const std::string start = primitive.place() + ": " + attributeText(fault.name, fault.target);
    if (fault.repair == AttributeRepair::remove) {
        removeUnreadable(editor, primitive, fault.target, fault.name, fault.accessor);
        return start + " was removed: " + fault.why;
    }
    const auto [entry, is_new] = stored.try_emplace({fault.accessor, fault.new_count}, 0);
    const std::size_t old_count = readAccessor(document, fault.accessor).component_count;
    if (is_new) entry->second = editor.store(resizedElements(document, fault), {});
    attributesOf(editor, primitive, fault.target)[fault.name] = entry->second;
    editor.moveUse(fault.accessor, entry->second);
    if (old_count < fault.new_count)
        return start + " has only " + std::to_string(old_count) + (old_count == 1 ? " component" : " components") +
               ", fewer than required; zeros were appended";
    return start + " has more components than allowed; only the first " + std::to_string(fault.new_count) + " are kept";
}

}  // namespace

std::vector<bool> repairAttributes(Document& document, const std::string& new_file,
                                   std::span<const Primitive> primitives, const std::vector<bool>& chosen,
                                   std::vector<std::string>& warnings) {
    std::vector<bool> lost_normals(primitives.size(), false);
    Editor editor(document, new_file);
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> stored;  // key: accessor and number of components
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const Primitive& primitive = primitives[i];
        if (!chosen[i]) continue;
        for (const AttributeFault& fault : primitive.attribute_faults) {
            warnings.push_back(repairAttribute(editor, document, primitive, fault, stored));
            const bool is_removed = fault.repair == AttributeRepair::remove;
            if (is_removed && fault.target < 0 && fault.name == "NORMAL") lost_normals[i] = true;
        }
    }
    editor.finish();
    return lost_normals;
}

namespace {

std::vector<std::uint32_t> flippedCorners(const Document& document, const Primitive& primitive,
                                          const std::vector<std::uint8_t>& flipped) {
    std::vector<std::uint32_t> corners = readTriangleCorners(document, primitive);
    for (std::size_t t = 0; t < flipped.size(); ++t) {
        if (flipped[t] != 0) std::swap(corners[3 * t + 1], corners[3 * t + 2]);
    }
    return corners;
}

/// Primitives with equal new lists that replace the same old list.
struct NewList {
    std::vector<std::uint32_t> corners = {};
    std::vector<std::size_t> primitives = {};
};

}  // namespace

void flipTriangles(Document& document, const std::string& new_file, std::span<const Primitive> primitives,
                   std::span<const std::vector<std::uint8_t>> flipped) {
    const std::optional<std::size_t> none;
    // Primitives are grouped by old list and POSITION accessor, which also determine how a list is stored.
    std::map<std::pair<std::optional<std::size_t>, std::optional<std::size_t>>, std::vector<NewList>> lists;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (std::find(flipped[i].begin(), flipped[i].end(), 1) == flipped[i].end()) continue;
        std::vector<NewList>& known = lists[{primitives[i].indices, primitives[i].find("POSITION")}];
        std::vector<std::uint32_t> corners = flippedCorners(document, primitives[i], flipped[i]);
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

namespace {

Bytes floatsOf(const std::vector<Vec3>& vectors) {
    const std::vector<std::uint8_t> bytes = packUnits(std::span<const Vec3>(vectors), VectorFormat::float32);
    return Bytes(bytes.begin(), bytes.end());
}

/// Returns the normals that primitives share, scaled to length 1, or the accordingly scaled offsets of a morph target
/// as floats.
ElementData unitNormals(const Document& document, const Primitive& primitive, std::ptrdiff_t target) {
    if (target != kBase) {
        const std::vector<Vec3> offsets = readOffsets(document, primitive, static_cast<std::size_t>(target), "NORMAL");
        return {.type = "VEC3", .count = offsets.size(), .element_bytes = sizeof(Vec3), .bytes = floatsOf(offsets)};
    }
    const std::vector<Vec3> normals = readVec3(document, primitive, "NORMAL");
    const Accessor accessor = readAccessor(document, *primitive.find("NORMAL"));
    const bool is_kept =
        accessor.component == ComponentType::f32 ||
        (accessor.normalized && (accessor.component == ComponentType::i8 || accessor.component == ComponentType::i16));
    if (!is_kept)
        return {.type = "VEC3", .count = normals.size(), .element_bytes = sizeof(Vec3), .bytes = floatsOf(normals)};
    Bytes elements = copyElements(document, accessor);
    for (std::size_t v = 0; v < normals.size(); ++v) {
        if (primitive.normal_scales->of_vertices[v] == 1) continue;
        const std::vector<std::uint8_t> bytes =
            packUnits(std::span<const Vec3>(&normals[v], 1), unitFormatOf(accessor));
        std::copy(bytes.begin(), bytes.end(), elements.data() + v * accessor.element_bytes);
    }
    return {.component = accessor.component,
            .type = accessor.type,
            .normalized = accessor.normalized,
            .count = accessor.count,
            .element_bytes = accessor.element_bytes,
            .bytes = std::move(elements)};
}

}  // namespace

bool canScaleNormals(const Document& document, const Primitive& primitive) {
    return primitive.normal_scales != nullptr && !areUnsigned(document, primitive.find("NORMAL"));
}

void writeUnitNormals(Document& document, const std::string& new_file, std::span<const Primitive> primitives) {
    // Primitives are grouped by target, by the NORMAL accessor of the target, and by the NORMAL accessor of the base.
    std::map<std::tuple<std::ptrdiff_t, std::size_t, std::size_t>, std::vector<std::size_t>> sharing;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const Primitive& primitive = primitives[i];
        if (!canScaleNormals(document, primitive)) continue;
        const std::size_t base = *primitive.find("NORMAL");
        sharing[{kBase, base, base}].push_back(i);
        for (std::size_t target = 0; target < primitive.targets.size(); ++target) {
            if (const auto offsets = findAttribute(primitive.targets[target], "NORMAL"))
                sharing[{static_cast<std::ptrdiff_t>(target), *offsets, base}].push_back(i);
        }
    }
    // Reads all attributes before writing any: accessors may share bytes.
    std::vector<ElementData> made;
    for (const auto& [key, numbers] : sharing) {
        const Primitive& first = primitives[numbers.front()];
        document.memory->require(std::uint64_t{48} * first.vertex_count, first.place());
        made.push_back(unitNormals(document, first, std::get<0>(key)));
    }
    Editor editor(document, new_file);
    std::size_t next = 0;
    for (const auto& [key, numbers] : sharing) {
        setAttribute(editor, document,
                     {.primitives = primitives, .numbers = numbers, .target = std::get<0>(key), .name = "NORMAL"},
                     std::move(made[next++]));
    }
    editor.finish();
}

}  // namespace tspace::gltf
