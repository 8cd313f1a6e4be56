// SPDX-License-Identifier: MIT
// Accessors as arrays of numbers, each decoded once for all concurrent users of a document.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "model/gltf/document.h"
#include "model/gltf/packed_layout.h"
#include "model/gltf/primitive_reader.h"
#include "model/scene/scene.h"
#include "tspace/span.h"

namespace tspace::gltf {

/// Cache of decoded arrays; an array is kept while it is in use. It is charged to the document's memory budget once,
/// regardless of the number of users, and released with the last one. Thread-safe.
class DecodedArrays {
  public:
    /// The document must outlive this object; arrays may outlive both.
    explicit DecodedArrays(const Document& document) : document_(document) {}

    /// Returns an accessor as floats. `place`: JSON pointer of the attribute that references it, for errors.
    SharedArray<Vec2> vec2(std::size_t accessor, const std::string& place);
    SharedArray<Vec3> vec3(std::size_t accessor, const std::string& place);
    SharedArray<Vec4> vec4(std::size_t accessor, const std::string& place);
    /// Returns NORMAL of the primitive, or of one of its morph targets, scaled as the primitive specifies.
    SharedArray<Vec3> normals(const Primitive& primitive, std::size_t accessor, const std::string& place);
    /// Returns the triangles like readTriangleCorners. Also fails with tooLarge if the budget does not allow reading
    /// them.
    SharedArray<std::uint32_t> corners(const Primitive& primitive);
    /// Returns packed frames like readPackedWords.
    SharedArray<std::uint8_t> packedWords(const Primitive& primitive, const PackedLayout& layout);

    /// Returns a cached array, or decodes one for the caller without charging the budget. It is meant for callers that
    /// reserve all of their memory in the budget. The attribute must exist.
    SharedArray<Vec2> borrowUvs(const Primitive& primitive, std::size_t uv_set);
    SharedArray<Vec3> borrowVec3(const Primitive& primitive, const char* attribute);
    SharedArray<Vec4> borrowTangents(const Primitive& primitive);
    SharedArray<std::uint32_t> borrowCorners(const Primitive& primitive);
    /// Returns the triangles as a list that the caller owns.
    std::vector<std::uint32_t> copyCorners(const Primitive& primitive);

    /// Must be called after the document has changed: accessors are then decoded again. Arrays in use are not changed.
    void forget();

  private:
    template <class T>
    using Known = std::weak_ptr<const std::vector<T>>;
    /// Index accessor, vertex count, and mode.
    using CornerKey = std::tuple<std::size_t, std::size_t, Mode>;

    /// Returns a cached array, or nullopt.
    template <class T, class Key>
    std::optional<SharedArray<T>> known(const std::map<Key, Known<T>>& table, const Key& key) const;
    template <class T, class Key, class Decode>
    SharedArray<T> make(std::map<Key, Known<T>>& table, const Key& key, std::uint64_t bytes, const std::string& place,
                        const Decode& decode);
    template <class Vec, class Decode>
    SharedArray<Vec> vectors(std::map<std::size_t, Known<Vec>>& table, std::size_t accessor, const std::string& place,
                             const Decode& decode);
    [[nodiscard]] CornerKey keyOf(const Primitive& primitive) const;

    const Document& document_;
    mutable std::mutex mutex_ = {};
    std::map<std::size_t, Known<Vec2>> vec2_ = {};  ///< decoded vectors, keyed by accessor
    std::map<std::size_t, Known<Vec3>> vec3_ = {};
    std::map<std::size_t, Known<Vec4>> vec4_ = {};
    /// scaled normals and normal deltas, keyed by the accessor of NORMAL and their own accessor
    std::map<std::pair<std::size_t, std::size_t>, Known<Vec3>> scaled_normals_ = {};
    std::map<CornerKey, Known<std::uint32_t>> corners_ = {};
    std::map<std::vector<std::size_t>, Known<std::uint8_t>> words_ = {};  ///< keyed by the accessors of the words
};

}  // namespace tspace::gltf
