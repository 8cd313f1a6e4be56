// SPDX-License-Identifier: MIT
// JSON of a new glTF document, and the bytes of its only buffer, which grow with each accessor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/gltf/codecs/codecs.h"
#include "model/json/json.h"

namespace tspace::gltf {

inline constexpr unsigned kVertexTarget = 34962;  // ARRAY_BUFFER
inline constexpr unsigned kIndexTarget = 34963;   // ELEMENT_ARRAY_BUFFER
inline constexpr unsigned kNoTarget = 0;          // images, matrices, parts of a sparse accessor

class DocumentBuilder {
  public:
    explicit DocumentBuilder(Json asset) { json_["asset"] = std::move(asset); }

    Json& json() { return json_; }
    Bytes& bytes() { return bytes_; }

    /// Appends an entry to an array of the root, which is created if absent, and returns its index.
    std::size_t append(const char* array, Json entry);

    /// Adds numbers of `number_bytes` each, converted to little-endian. All views start at multiples of 4 bytes.
    std::size_t addView(std::span<const std::byte> numbers, std::size_t number_bytes, unsigned target);
    /// Adds an accessor of a view. `type`: "VEC3" etc.
    std::size_t addAccessor(std::size_t view, ComponentType component, std::size_t count, const std::string& type);
    /// Adds `count` elements of floats or float vectors. `bounds`: writes min and max.
    template <class T>
    std::size_t addFloats(const std::vector<T>& values, std::size_t count, const std::string& type, unsigned target,
                          bool bounds = false) {
        return addFloatBytes(std::as_bytes(std::span(values)), count, type, target, bounds);
    }
    /// Adds 16-bit indices if they suffice, otherwise 32-bit ones. The index 65535 is not used with 16 bits, because
    /// some APIs interpret it as primitive restart.
    std::size_t addIndices(std::span<const std::uint32_t> indices, std::size_t vertex_count);

  private:
    std::size_t addFloatBytes(std::span<const std::byte> floats, std::size_t count, const std::string& type,
                              unsigned target, bool bounds);

    Json json_ = {};
    Bytes bytes_ = {};
};

}  // namespace tspace::gltf
