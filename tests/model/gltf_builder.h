// SPDX-License-Identifier: MIT
// Builds small glTF documents for tests.
#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/numbers.h"
#include "model/gltf/container.h"
#include "model/gltf/document.h"
#include "model/gltf/load_document.h"
#include "model/io/file_error.h"
#include "model/io/uri.h"

namespace tspace {

/// Prints JSON in messages of tests.
inline std::ostream& operator<<(std::ostream& stream, const Json& json) { return stream << json.dump(); }

}  // namespace tspace

namespace tspace::test {

using gltf::Json;

template <class T, class Allocator = std::allocator<T>>
Bytes bytesOfValues(const std::vector<T, Allocator>& values) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(values.data());
    Bytes bytes(first, first + values.size() * sizeof(T));
    // Vectors consist of floats, so floats are converted.
    convertLittleEndian(bytes, std::is_arithmetic_v<T> ? sizeof(T) : sizeof(float));
    return bytes;
}

/// A document with one buffer. Accessors are appended with their bytes.
class GltfBuilder {
  public:
    GltfBuilder() {
        json_ = Json::parse(R"({"asset":{"version":"2.0"},"buffers":[],"bufferViews":[],"accessors":[]})");
    }

    Json& json() { return json_; }
    Bytes& bytes() { return bytes_; }

    std::size_t addView(const Bytes& bytes) {
        while (bytes_.size() % 4 != 0) bytes_.push_back(0);
        json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}});
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        return json_["bufferViews"].size() - 1;
    }
    template <class T, class Allocator = std::allocator<T>>
    std::size_t addAccessor(const std::vector<T, Allocator>& values, int component_type, const std::string& type,
                            std::size_t count) {
        const std::size_t view = addView(bytesOfValues(values));
        json_["accessors"].push_back(
            {{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", type}});
        return json_["accessors"].size() - 1;
    }
    std::size_t addFloats(const std::vector<float>& values, std::size_t components) {
        return addAccessor(values, 5126, "VEC" + std::to_string(components), values.size() / components);
    }
    /// Adds a primitive to mesh 0 and returns its JSON.
    Json& addPrimitive(const Json& attributes) {
        if (!json_.contains("meshes")) json_["meshes"] = Json::array({Json{{"primitives", Json::array()}}});
        json_["meshes"][0]["primitives"].push_back({{"attributes", attributes}});
        return json_["meshes"][0]["primitives"].back();
    }

    [[nodiscard]] std::string gltfText(int indent = -1) const {
        Json json = json_;
        if (!bytes_.empty()) {
            json["buffers"] = Json::array(
                {Json{{"byteLength", bytes_.size()}, {"uri", encodeDataUri("application/octet-stream", bytes_)}}});
        }
        return json.dump(indent);
    }
    [[nodiscard]] Bytes glb(const std::vector<gltf::ExtraChunk>& extra = {}) const {
        Json json = json_;
        if (!bytes_.empty()) json["buffers"] = Json::array({Json{{"byteLength", bytes_.size()}}});
        const auto frame =
            gltf::frameGlb(json.dump(), bytes_.empty() ? std::nullopt : std::optional(bytes_.size()), extra);
        Bytes file = frame.head;
        file.insert(file.end(), bytes_.begin(), bytes_.end());
        file.insert(file.end(), frame.tail.begin(), frame.tail.end());
        return file;
    }

  private:
    Json json_;
    Bytes bytes_;
};

inline Bytes toBytes(const std::string& text) { return Bytes(text.begin(), text.end()); }

inline gltf::Document parse(const GltfBuilder& builder) {
    return gltf::parseDocument(toBytes(builder.gltfText()), "model.gltf", {});
}

/// Returns the error that `body` throws, or the code ErrorCode::ok if it succeeds.
template <class Body>
Error errorOf(Body&& body) {
    const Result<Done> result = atFileBorder([&]() -> Result<Done> {
        body();
        return Done{};
    });
    return result ? Error{ErrorCode::ok, {}, kNoElement, {}} : result.error();
}

}  // namespace tspace::test
