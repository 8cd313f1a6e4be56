// SPDX-License-Identifier: MIT
// Shared by the modules: the mesh of a call, and the return of results.
#pragma once

#include <cstring>
#include <span>
#include <vector>

#include "reports.h"
#include "tspace/indexed_frames.h"
#include "tspace/tangents.h"

namespace tspace::js {

/// Returns the mesh that setMesh() received.
const MeshView& mesh();

/// Returns the options that setNormalOptions() received.
const NormalOptions& normalOptions();

/// Decodes a convention: v axis in the lowest two bits, then one bit each for green, stored sign, handedness and
/// winding.
Convention conventionOf(std::uint32_t bits);

/// Returns the outputs of a call: four floats per entry for `count` entries, and a byte per entry unless `has_tangent`
/// is null.
inline TangentOutput outputOf(float* tangents, std::uint8_t* has_tangent, std::size_t count) {
    return {.tangents = vec4Span(tangents, count), .has_tangent = {has_tangent, has_tangent == nullptr ? 0 : count}};
}

/// Layout shared with JavaScript.
struct AttributeWords {
    const float* data;
    std::uint32_t component_count;
    float tolerance;
};

/// Returns a copy that JavaScript frees: its address and the number of its elements.
template <class T>
void giveArray(const std::vector<T>& from, std::uint32_t* to) {
    void* memory = ::operator new(from.size() * sizeof(T));
    std::memcpy(memory, from.data(), from.size() * sizeof(T));
    to[0] = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(memory));
    to[1] = static_cast<std::uint32_t>(from.size());
}

}  // namespace tspace::js
