// SPDX-License-Identifier: MIT
// A model file in memory: its glTF document, and beside that what is made of it once, when it is first asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "model/gltf/document.h"
#include "model/gltf/packed.h"
#include "model/gltf/primitive_reader.h"
#include "model/scene/scene.h"
#include "tspace/vec.h"

namespace tspace::gltf {

// Accessors as arrays of numbers, each decoded once for all that look at a document at one time.

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

/// Moving it leaves references to its document and primitives valid.
class Model {
  public:
    explicit Model(Document&& document);

    /// Whoever changes the document calls `wasEdited` before primitives, arrays or scenes are asked for again.
    [[nodiscard]] Document& document() { return *document_; }
    [[nodiscard]] DecodedArrays& arrays() { return *arrays_; }

    /// As readPrimitives.
    [[nodiscard]] std::vector<Primitive>& primitives();

    /// All primitives as a Scene, which stays, and so do its arrays, until dropScene. Copies of it share the arrays.
    [[nodiscard]] const Scene& scene();
    /// The same, or these primitives alone, for the caller to keep.
    [[nodiscard]] Scene sceneOf();
    [[nodiscard]] Scene sceneOf(std::span<const std::size_t> numbers);
    void dropScene() { scene_.reset(); }

    /// The scene with looks and places, and `with_images` the bytes of those images that pictures show. The model does not
    /// keep it.
    [[nodiscard]] DrawnScene drawnScene(bool with_images);
    /// The same with all that materials show: the bytes of the images of colours, metal and emission, and the colours of
    /// vertices.
    [[nodiscard]] DrawnScene materialScene(bool with_normal_maps);
    /// The same as nodes pose it; `with_images`: with the bytes of all images and the colours of vertices.
    [[nodiscard]] PosedScene posedScene(bool with_images);

    /// Primitives and scene are made anew when they are next asked for, and their old memory is free again.
    void wasEdited();

    /// Makes the model what a reader of its file would get: compressed geometry is decoded again, since Draco reorders and
    /// rounds vertices and meshopt turns triangles; the budget is that of a file of this size.
    void readAnew();

  private:
    std::unique_ptr<Document> document_;
    std::unique_ptr<DecodedArrays> arrays_;
    std::optional<std::vector<Primitive>> primitives_ = {};
    std::int64_t primitive_bytes_ = 0;  ///< what the budget was charged for them
    std::optional<Scene> scene_ = {};
};

}  // namespace tspace::gltf
