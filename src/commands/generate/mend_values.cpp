// SPDX-License-Identifier: MIT
#include "commands/generate/mend_values.h"

#include <algorithm>
#include <cstring>
#include <map>

#include "core/mesh/pools/primitive.h"
#include "core/mesh/pools/unit_lattice.h"
#include "core/mesh/surface/surface.h"
#include "model/gltf/apply_frames.h"
#include "model/gltf/material_needs.h"
#include "model/io/file_error.h"

namespace tspace::gltf {

namespace {

/// The arrays of one primitive that mending looks at.
struct Stored {
    std::vector<Vec3> positions = {}, normals = {};
    std::vector<std::uint32_t> corners = {};
    std::vector<Vec4> tangents = {};

    [[nodiscard]] TangentView view() const {
        return {.positions = positions, .normals = normals, .tangents = tangents, .corners = corners};
    }
};

bool isRead(const Document& document, const Primitive& primitive) {
    return hasTriangles(primitive.mode) && primitive.find("NORMAL") && !tangentUses(document, primitive).empty();
}

/// The first whose tangents a material reads; without one the first.
std::size_t judgeOf(const Document& document, std::span<const Primitive> primitives,
                    const std::vector<std::size_t>& numbers) {
    const auto read = std::find_if(numbers.begin(), numbers.end(),
                                   [&](std::size_t number) { return isRead(document, primitives[number]); });
    return read == numbers.end() ? numbers.front() : *read;
}

Stored readStored(const Document& document, const Primitive& primitive) {
    Stored stored{.tangents = readTangents(document, primitive)};
    if (primitive.find("NORMAL")) stored.normals = readVec3(document, primitive, "NORMAL");
    if (!hasTriangles(primitive.mode) || !primitive.find("POSITION")) return stored;
    stored.positions = readVec3(document, primitive, "POSITION");
    stored.corners = readTriangleCorners(document, primitive);
    return stored;
}

bool areBroken(Model& model, const Primitive& primitive) {
    const SharedArray<Vec4> tangents = model.arrays().borrowTangents(primitive);
    SharedArray<Vec3> normals;
    if (isRead(model.document(), primitive)) normals = model.arrays().borrowVec3(primitive, "NORMAL");
    for (std::size_t v = 0; v < tangents.size(); ++v) {
        if (!hasSoundValues(tangents[v]) || (!normals.empty() && !hasDirection(tangents[v], normals[v]))) return true;
    }
    return false;
}

VectorFormat formatOf(const Accessor& accessor) {
    return accessor.component == ComponentType::i8    ? VectorFormat::snorm8
           : accessor.component == ComponentType::i16 ? VectorFormat::snorm16
                                                      : VectorFormat::float32;
}

}  // namespace

std::vector<std::vector<std::size_t>> findBrokenValues(Model& model, const GeneratePlan& plan) {
    const Document& document = model.document();
    const std::span<const Primitive> primitives = model.primitives();
    std::vector<bool> is_computed(primitives.size(), false);
    for (const Pool& pool : plan.pools) {
        for (const std::size_t number : pool.primitives) is_computed[number] = !pool.keeps_tangents;
    }
    std::map<std::size_t, std::vector<std::size_t>> sharing;  // accessor -> primitives
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const auto accessor = primitives[i].find("TANGENT");
        // Without positions there is nothing to draw, and no element to store new ones like.
        if (!accessor || !primitives[i].find("POSITION") || is_computed[i]) continue;
        if (plan.reports[i].action == PrimitiveAction::removed) continue;
        if (hasData(document, readAccessor(document, *accessor))) sharing[*accessor].push_back(i);
    }
    std::vector<std::vector<std::size_t>> groups;
    for (const auto& [accessor, numbers] : sharing) {
        const Primitive& judge = primitives[judgeOf(document, primitives, numbers)];
        document.memory->require((sizeof(Vec4) + sizeof(Vec3)) * judge.vertex_count, judge.place());
        if (areBroken(model, judge)) groups.push_back(numbers);
    }
    return groups;
}

void mendBrokenValues(Editor& editor, const Document& document, std::span<const Primitive> primitives,
                      std::span<const std::vector<std::size_t>> groups, std::span<PrimitiveReport> reports) {
    for (const std::vector<std::size_t>& numbers : groups) {
        const Primitive& judge = primitives[judgeOf(document, primitives, numbers)];
        constexpr std::uint64_t kOfCorner = 48, kOfVertex = 128;
        document.memory->require(kOfCorner * 3 * judge.triangleCount() + kOfVertex * judge.vertex_count, judge.place());
        const Stored stored = readStored(document, judge);
        std::vector<Vec4> mended = stored.tangents;
        valueOrThrow(mendValues(stored.view(), !isRead(document, judge), mended));
        const Accessor accessor = readAccessor(document, *judge.find("TANGENT"));
        Bytes elements = copyElements(document, accessor);
        std::size_t count = 0;
        for (std::size_t v = 0; v < mended.size(); ++v) {
            if (std::memcmp(&mended[v], &stored.tangents[v], sizeof(Vec4)) == 0) continue;
            ++count;
            const std::vector<std::uint8_t> bytes = packUnits(std::span<const Vec4>(&mended[v], 1), formatOf(accessor));
            std::copy(bytes.begin(), bytes.end(), elements.data() + v * accessor.element_bytes);
        }
        setAttribute(editor, document, {.primitives = primitives, .numbers = numbers, .name = "TANGENT"},
                     {.component = accessor.component,
                      .type = accessor.type,
                      .normalized = accessor.normalized,
                      .count = accessor.count,
                      .element_bytes = accessor.element_bytes,
                      .bytes = std::move(elements)});
        for (const std::size_t number : numbers) {
            PrimitiveReport& report = reports[number];
            report.mended_vertex_count = count;
            if (report.action == PrimitiveAction::kept) report.action = PrimitiveAction::replaced;
            report.notes.push_back(
                "its tangents stay, but at " + std::to_string(count) + " of " + std::to_string(mended.size()) +
                " vertices they were not finite, not unit, along the normal, or had a sign other than "
                "+1 and -1: mended there");
        }
    }
}

}  // namespace tspace::gltf
