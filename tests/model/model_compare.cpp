// SPDX-License-Identifier: MIT
// Structural comparison of two glTF documents.
#include "model_compare.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <set>

#include "model/gltf/accessor.h"
#include "model/gltf/primitive_reader.h"
#include "model/io/named_files.h"
#include "model/io/uri.h"

namespace tspace::test {

namespace {

using gltf::Accessor;
using gltf::AttributeList;
using gltf::Document;
using gltf::Json;
using gltf::Primitive;

class Comparison {
  public:
    Comparison(const Document& before, const Document& after, const GenerateReport& report, bool is_repacked)
        : before_(before), after_(after), report_(report), is_repacked_(is_repacked) {}

    std::vector<std::string> run() {
        compareRoot();
        comparePrimitives();
        compareUntouchedAccessors();
        compareImages();
        return std::move(found_);
    }

  private:
    void expect(bool same, const std::string& what) {
        if (!same && found_.size() < 20) found_.push_back(what);
    }

    /// Returns the object without the members that an edit may change. The order of the others is kept.
    static Json without(Json object, const std::vector<std::string>& members) {
        for (const std::string& name : members) object.erase(name);
        return withoutCompression(std::move(object));
    }

    /// Returns the object without its compression, which may change. Decompressed data is compared elsewhere.
    static Json withoutCompression(Json object) {
        if (!object.is_object() || !object.contains("extensions")) return object;
        for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression", "KHR_draco_mesh_compression"})
            object["extensions"].erase(name);
        if (object["extensions"].empty()) object.erase("extensions");
        return object;
    }

    static Json withoutTangents(Json primitive) {
        primitive["attributes"].erase("TANGENT");
        if (primitive.contains("targets")) {
            for (Json& target : primitive["targets"]) target.erase("TANGENT");
        }
        return primitive;
    }

    /// Returns the primitive without new tangent deltas: tangents that are kept may get deltas in morph targets that
    /// had none.
    static Json withoutNewDeltas(Json primitive, const Json& old) {
        if (!old.contains("targets")) return primitive;
        for (std::size_t t = 0; t < std::min(old["targets"].size(), primitive["targets"].size()); ++t) {
            if (!old["targets"][t].contains("TANGENT")) primitive["targets"][t].erase("TANGENT");
        }
        return primitive;
    }

    void compareArray(const char* name, const std::vector<std::string>& may_change) {
        const Json& old_list = rootArray(before_, name);
        const Json& new_list = rootArray(after_, name);
        expect(new_list.size() >= old_list.size(), std::string("entries were removed from ") + name);
        for (std::size_t i = 0; i < std::min(old_list.size(), new_list.size()); ++i) {
            expect(without(old_list[i], may_change) == without(new_list[i], may_change),
                   gltf::join(std::string("/") + name, i) + " changed");
        }
    }

    void compareRoot() {
        std::vector<std::string> edited = {"accessors", "bufferViews", "buffers", "meshes", "images"};
        if (is_repacked_) edited.insert(edited.end(), {"extensionsUsed", "extensionsRequired"});
        expect(without(before_.json, edited) == without(after_.json, edited), "members of the root changed");
        compareArray("accessors", {"bufferView", "byteOffset", "componentType", "count", "type", "min", "max",
                                   "normalized", "sparse"});
        compareArray("bufferViews", {"buffer", "byteOffset", "byteLength", "byteStride", "target"});
        compareArray("meshes", {"primitives"});
        for (std::size_t i = 0; i < before_.extra_chunks.size() && before_.container == after_.container; ++i) {
            expect(i < after_.extra_chunks.size() && before_.extra_chunks[i].bytes == after_.extra_chunks[i].bytes,
                   "a GLB chunk changed");
        }
    }

    [[nodiscard]] const Json& primitiveJson(const Document& document, const Primitive& primitive) const {
        return document.json["meshes"][primitive.mesh]["primitives"][primitive.index];
    }

    static bool isComputed(PrimitiveAction action) {
        return action == PrimitiveAction::generated || action == PrimitiveAction::replaced;
    }

    void comparePrimitives() {
        const std::vector<Primitive> old_list = readPrimitives(before_), new_list = readPrimitives(after_);
        expect(old_list.size() == new_list.size() && old_list.size() == report_.primitives.size(),
               "the number of primitives changed");
        if (!found_.empty()) return;
        for (std::size_t i = 0; i < old_list.size(); ++i) {
            const Primitive &a = old_list[i], &b = new_list[i];
            const Json &old_json = primitiveJson(before_, a), &new_json = primitiveJson(after_, b);
            if (!isComputed(report_.primitives[i].action)) {
                const bool removed = report_.primitives[i].action == PrimitiveAction::removed;
                expect(withoutCompression(removed ? withoutTangents(old_json) : old_json) ==
                           withoutCompression(withoutNewDeltas(new_json, old_json)),
                       a.place() + " changed");
                // Accessors that are still used must be unchanged.
                const Primitive& kept = removed ? b : a;
                for (const auto& [name, accessor] : kept.attributes) untouched_.insert(accessor);
                for (const AttributeList& target : kept.targets) {
                    for (const auto& [name, accessor] : target) untouched_.insert(accessor);
                }
                if (a.indices) untouched_.insert(*a.indices);
                continue;
            }
            const std::vector<std::string> edited = {"attributes", "targets", "indices", "mode"};
            expect(without(old_json, edited) == without(new_json, edited), a.place() + " lost or changed a member");
            compareComputed(a, b, report_.primitives[i]);
        }
    }

    void compareComputed(const Primitive& a, const Primitive& b, const PrimitiveReport& report) {
        expect(b.find("TANGENT").has_value() && b.find("NORMAL").has_value(), a.place() + " has no frame");
        expect(a.triangleCount() == b.triangleCount(), a.place() + " has another number of triangles");
        expect(b.vertex_count == report.vertices_after, a.place() + " has another number of vertices than reported");
        const auto old_corners = readTriangleCorners(before_, a), new_corners = readTriangleCorners(after_, b);
        if (old_corners.size() != new_corners.size()) return;
        if (a.vertex_count == b.vertex_count)
            expect(a.mode == b.mode && a.indices == b.indices, a.place() + " was cut without need");
        for (std::size_t i = 0; i < a.attributes.size(); ++i) {
            const auto& [name, accessor] = a.attributes[i];
            expect(i < b.attributes.size() && b.attributes[i].first == name,
                   a.place() + " has attributes in another order");
            if (name == "_BITANGENT" && report.bitangents_generated) continue;
            if (name == "TANGENT" || (name == "NORMAL" && report.normals_generated) || !b.find(name)) continue;
            compareCorners(accessor, old_corners, *b.find(name), new_corners, a.place() + "/attributes/" + name);
        }
        expect(a.targets.size() == b.targets.size(), a.place() + " lost a morph target");
        for (std::size_t t = 0; t < std::min(a.targets.size(), b.targets.size()); ++t) {
            const std::string place = a.place() + "/targets/" + std::to_string(t);
            compareTarget(a.targets[t], old_corners, b.targets[t], new_corners, report.normals_generated, place);
        }
    }

    /// Compares the attributes of a morph target. Deltas of computed attributes are new; all others must match at their
    /// corners.
    void compareTarget(const AttributeList& a, const std::vector<std::uint32_t>& old_corners, const AttributeList& b,
                       const std::vector<std::uint32_t>& new_corners, bool normals_generated,
                       const std::string& place) {
        const auto isNew = [&](const std::string& name) {
            return gltf::movesFrames(a) && (name == "TANGENT" || (name == "NORMAL" && normals_generated));
        };
        for (std::size_t k = 0; k < a.size(); ++k) {
            expect(k < b.size() && a[k].first == b[k].first, place + " has other morph attributes");
            if (k < b.size() && !isNew(a[k].first))
                compareCorners(a[k].second, old_corners, b[k].second, new_corners, place);
        }
        for (std::size_t k = a.size(); k < b.size(); ++k) expect(isNew(b[k].first), place + " got another attribute");
        expect(!gltf::movesFrames(a) || gltf::findAttribute(b, "TANGENT").has_value(),
               place + " has no tangent deltas");
    }

    void compareCorners(std::size_t old_accessor, const std::vector<std::uint32_t>& old_corners,
                        std::size_t new_accessor, const std::vector<std::uint32_t>& new_corners,
                        const std::string& place) {
        const Accessor a = readAccessor(before_, old_accessor), b = readAccessor(after_, new_accessor);
        compareFormat(a, b, place);
        if (a.element_bytes != b.element_bytes) return;
        const Bytes old_bytes = copyElements(before_, a), new_bytes = copyElements(after_, b);
        bool same = true;
        for (std::size_t c = 0; c < old_corners.size() && same; ++c) {
            same = std::memcmp(old_bytes.data() + old_corners[c] * a.element_bytes,
                               new_bytes.data() + new_corners[c] * b.element_bytes, a.element_bytes) == 0;
        }
        expect(same, place + " has other values at some corner");
    }

    void compareFormat(const Accessor& a, const Accessor& b, const std::string& place) {
        expect(a.component == b.component && a.type == b.type && a.normalized == b.normalized,
               place + " has another format");
        const Json &old_json = rootArray(before_, "accessors")[a.index],
                   &new_json = rootArray(after_, "accessors")[b.index];
        for (const char* bound : {"min", "max"}) {
            expect(old_json.contains(bound) == new_json.contains(bound) &&
                       (!old_json.contains(bound) || old_json[bound] == new_json[bound]),
                   place + " has other bounds");
        }
    }

    /// Compares the accessors that no primitive uses, and those of primitives that must not change.
    void compareUntouchedAccessors() {
        std::set<std::size_t> by_primitives;
        for (const Primitive& primitive : readPrimitives(before_)) {
            for (const auto& [name, accessor] : primitive.attributes) by_primitives.insert(accessor);
            for (const AttributeList& target : primitive.targets) {
                for (const auto& [name, accessor] : target) by_primitives.insert(accessor);
            }
            if (primitive.indices) by_primitives.insert(*primitive.indices);
        }
        for (std::size_t i = 0; i < rootArray(before_, "accessors").size(); ++i) {
            if (by_primitives.count(i) != 0 && untouched_.count(i) == 0) continue;
            const Accessor a = readAccessor(before_, i), b = readAccessor(after_, i);
            compareFormat(a, b, a.place());
            expect(a.count == b.count && copyElements(before_, a) == copyElements(after_, b),
                   a.place() + " has other bytes");
        }
    }

    static Bytes imageBytes(const Document& document, const Json& image) {
        if (image.contains("bufferView")) {
            const auto view = readBufferView(document, image["bufferView"].get<std::size_t>());
            const auto bytes = document.buffers[view.buffer].bytes.range(view.begin, view.byte_count);
            return Bytes(bytes.begin(), bytes.end());
        }
        const auto& uri = image.at("uri").text();
        if (uriKind(uri) == UriKind::data) return decodeDataUri(uri, "").bytes;
        const auto path = resolveUri(document.files.folder(), uri, false, "");
        return std::filesystem::exists(path) ? readFile(path) : Bytes{};
    }

    void compareImages() {
        const Json &old_list = rootArray(before_, "images"), &new_list = rootArray(after_, "images");
        expect(old_list.size() == new_list.size(), "the number of images changed");
        for (std::size_t i = 0; i < std::min(old_list.size(), new_list.size()); ++i) {
            const std::vector<std::string> stored = {"uri", "bufferView", "mimeType"};
            const bool converted = before_.container != after_.container;
            expect(
                converted ? without(old_list[i], stored) == without(new_list[i], stored) : old_list[i] == new_list[i],
                gltf::join("/images", i) + " changed");
            expect(imageBytes(before_, old_list[i]) == imageBytes(after_, new_list[i]),
                   gltf::join("/images", i) + " has other bytes");
        }
    }

    const Document& before_;
    const Document& after_;
    const GenerateReport& report_;
    bool is_repacked_;
    std::set<std::size_t> untouched_;
    std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> differences(const Document& before, const Document& after, const GenerateReport& report,
                                     bool is_repacked) {
    return Comparison(before, after, report, is_repacked).run();
}

}  // namespace tspace::test
