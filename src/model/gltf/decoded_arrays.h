// SPDX-License-Identifier: MIT
// Accessors as arrays of numbers, each decoded once for all that look at a document at one time.
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

/// Hands out arrays, and remembers each as long as somebody has it. An array is charged to the document's memory budget
/// once, however many have it, and given back when the last one lets go. Used by several threads at once.
class DecodedArrays {
  public:
    /// The document must outlive this; arrays may outlive both.
    explicit DecodedArrays(const Document& document) : document_(document) {}

    /// An accessor as floats. `place`: of the attribute that names it, for errors.
    SharedArray<Vec2> vec2(std::size_t accessor, const std::string& place);
    SharedArray<Vec3> vec3(std::size_t accessor, const std::string& place);
    SharedArray<Vec4> vec4(std::size_t accessor, const std::string& place);
    /// NORMAL of the primitive, or of one of its morph targets, scaled as it says.
    SharedArray<Vec3> normals(const Primitive& primitive, std::size_t accessor, const std::string& place);
    /// As readTriangleCorners. Fails with tooLarge also where the budget has no room for looking at them.
    SharedArray<std::uint32_t> corners(const Primitive& primitive);
    /// As readPackedWords.
    SharedArray<std::uint8_t> packedWords(const Primitive& primitive, const PackedLayout& layout);

    /// What somebody has, or else an array that is decoded for the caller alone and not charged: for work that asks the
    /// budget for all that it takes. The attribute must be there.
    SharedArray<Vec2> borrowUvs(const Primitive& primitive, std::size_t uv_set);
    SharedArray<Vec3> borrowVec3(const Primitive& primitive, const char* attribute);
    SharedArray<Vec4> borrowTangents(const Primitive& primitive);
    SharedArray<std::uint32_t> borrowCorners(const Primitive& primitive);
    /// The same as a list of the caller's own.
    std::vector<std::uint32_t> copyCorners(const Primitive& primitive);

    /// The document has changed: accessors are decoded anew from now on. Arrays that somebody has stay as they are.
    void forget();

  private:
    template <class T>
    using Known = std::weak_ptr<const std::vector<T>>;
    /// Index list, vertices, mode.
    using CornerKey = std::tuple<std::size_t, std::size_t, Mode>;

    /// Nothing where nobody has it.
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
    std::map<std::size_t, Known<Vec2>> vec2_ = {};  ///< by accessor
    std::map<std::size_t, Known<Vec3>> vec3_ = {};
    std::map<std::size_t, Known<Vec4>> vec4_ = {};
    std::map<std::pair<std::size_t, std::size_t>, Known<Vec3>> scaled_normals_ =
        {};  ///< by that of the base, and its own
    std::map<CornerKey, Known<std::uint32_t>> corners_ = {};
    std::map<std::vector<std::size_t>, Known<std::uint8_t>> words_ = {};  ///< by the accessors that hold them
};

}  // namespace tspace::gltf
