// SPDX-License-Identifier: MIT
// Changes the compression of a file, by way of plain views.
#include "model/gltf/compression/recompress.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "model/gltf/compression/pack_draco.h"
#include "model/gltf/draco_primitives.h"
#include "model/gltf/editor.h"
#include "model/gltf/gather_elements.h"
#include "model/gltf/primitive_reader.h"
#include "model/gltf/references.h"
#include "model/io/file_error.h"

namespace tspace::gltf {

namespace {

void unpackMeshopt(Document& document, Editor& editor) {
    for (std::size_t i = 0; i < rootArray(document, "bufferViews").size(); ++i) {
        const char* name = meshoptExtension(rootArray(document, "bufferViews")[i]);
        if (name == nullptr) continue;
        if (document.buffers[readBufferView(document, i).buffer].source == BufferSource::absent)
            failFile(ErrorCode::unsupportedFile, meshoptMissing(name == kKhrMeshopt), join("/bufferViews", i));
        editor.unpackView(i);
    }
    for (std::size_t i = 0; i < document.buffers.size(); ++i) {
        Json& buffer = document.json["buffers"][i];
        const char* mark = meshoptExtension(buffer);
        if (mark == nullptr) continue;
        buffer["extensions"].erase(mark);
        if (buffer["extensions"].empty()) buffer.erase("extensions");
    }
    for (const char* name : {kExtMeshopt, kKhrMeshopt}) dropExtension(document, name);
}

void unpackDraco(Document& document, Editor& editor) {
    if (!document.hidden_accessors.empty()) failFile(ErrorCode::unsupportedFile, dracoMissing());
    std::set<std::size_t> indices;
    for (Json& mesh : editableRootArray(document, "meshes")) {
        for (Json& primitive : mesh["primitives"]) {
            const Json* extension = findExtension(primitive, kDraco);
            if (extension == nullptr) continue;
            editor.letGoOfView((*extension)["bufferView"].get<std::size_t>());
            primitive["extensions"].erase(kDraco);
            if (primitive["extensions"].empty()) primitive.erase("extensions");
            if (primitive.contains("indices")) indices.insert(primitive["indices"].get<std::size_t>());
        }
    }
    std::vector<std::size_t> accessors;
    for (const auto& [accessor, elements] : document.elements) accessors.push_back(accessor);
    for (const std::size_t index : accessors) {
        const Accessor accessor = readAccessor(document, index);
        std::vector<std::uint32_t> all(accessor.count);
        std::iota(all.begin(), all.end(), 0u);
        ElementData data = gatherElements(document, accessor, all);
        data.like.reset();
        renewBounds(data);  // decoded Draco values rarely have exactly the stated extremes
        if (indices.count(index) != 0) data.target = kIndexTarget;
        document.elements.erase(index);
        editor.store(std::move(data), index);
    }
    document.draco_roundings.clear();
    dropExtension(document, kDraco);
}

/// The geometry that reads a buffer view.
struct ViewUse {
    std::set<std::size_t> accessors = {};
    bool by_indices = false, by_vertices = false;
    std::size_t stride = 0;      ///< of all accessors; 0 where they differ
    std::size_t byte_count = 0;  ///< whole rows that they read
};

class ViewUses {
  public:
    explicit ViewUses(const Document& document)
        : document_(document), uses_(rootArray(document, "bufferViews").size()) {
        for (const Primitive& primitive : readPrimitives(document)) {
            if (primitive.indices) add(*primitive.indices, true);
            for (const auto& [name, accessor] : primitive.attributes) add(accessor, false);
            for (const AttributeList& target : primitive.targets) {
                for (const auto& [name, accessor] : target) add(accessor, false);
            }
        }
        all_ = countViewUses(document);
    }

    [[nodiscard]] const ViewUse& operator[](std::size_t view) const { return uses_[view]; }

    /// Whether the codec can hold the view: rows of one size, read either as vertices or as indices and not otherwise.
    [[nodiscard]] bool canPack(std::size_t view) const {
        const ViewUse& use = uses_[view];
        if (use.accessors.empty() || use.accessors.size() != all_[view] || use.by_indices == use.by_vertices)
            return false;
        if (use.byte_count == 0 || rootArray(document_, "bufferViews")[view].contains("extensions")) return false;
        return use.by_indices ? use.stride == 2 || use.stride == 4
                              : use.stride != 0 && use.stride % 4 == 0 && use.stride <= 256;
    }

  private:
    void add(std::size_t index, bool is_indices) {
        const Accessor accessor = readAccessor(document_, index);
        if (!accessor.view || !hasData(document_, accessor)) return;
        ViewUse& use = uses_[*accessor.view];
        const bool is_first = use.accessors.empty();
        use.accessors.insert(index);
        (is_indices ? use.by_indices : use.by_vertices) = true;
        if (is_first) use.stride = accessor.stride;
        if (use.stride != accessor.stride || accessor.component_count == 0) use.stride = 0;
        if (accessor.count == 0 || use.stride == 0) return;
        const std::size_t end = accessor.byte_offset + (accessor.count - 1) * accessor.stride + accessor.data_bytes;
        use.byte_count = std::max(use.byte_count, (end + use.stride - 1) / use.stride * use.stride);
    }

    const Document& document_;
    std::vector<ViewUse> uses_;
    std::vector<std::size_t> all_;
};

void packMeshopt(Document& document, Editor& editor) {
    const ViewUses uses(document);
    const std::size_t view_count = rootArray(document, "bufferViews").size();
    bool any = false;
    for (std::size_t i = 0; i < view_count; ++i) {
        if (!uses.canPack(i)) continue;
        editor.packView(i, uses[i].byte_count, uses[i].stride, uses[i].by_indices);
        any = true;
    }
    if (any) requireExtension(document, kExtMeshopt);
}

bool usesDraco(const Document& document) {
    for (const Json& mesh : rootArray(document, "meshes")) {
        for (const Json& primitive : readArray(mesh, "primitives", "")) {
            if (findExtension(primitive, kDraco) != nullptr) return true;
        }
    }
    return false;
}

bool usesMeshopt(const Document& document) {
    const Json& views = rootArray(document, "bufferViews");
    return std::any_of(views.begin(), views.end(), [](const Json& view) { return meshoptExtension(view) != nullptr; });
}

/// Whether anything changed.
template <class Body>
bool edit(Document& document, const std::string& new_file_name, Body&& body) {
    Editor editor(document, new_file_name);
    body(editor);
    if (!editor.changed()) return false;
    editor.finish();
    removeUnreferencedBuffers(document);
    return true;
}

void needLibrary(const std::string& missing) {
    if (!missing.empty()) failFile(ErrorCode::unsupportedFile, "the output cannot be compressed so: " + missing);
}

}  // namespace

bool unpackGeometry(Document& document, Compression compression, const std::string& new_file_name,
                    std::vector<std::string>& warnings) {
    if (compression == Compression::keep) return false;
    if (compression == Compression::meshopt) needLibrary(meshoptMissing(false));
    if (compression == Compression::draco) needLibrary(dracoMissing());
    return edit(document, new_file_name, [&](Editor& editor) {
        if (compression != Compression::draco && usesDraco(document)) unpackDraco(document, editor);
        if (compression != Compression::meshopt && usesMeshopt(document)) unpackMeshopt(document, editor);
        if (compression != Compression::draco) return;
        for (std::string& warning : packDraco(document, editor)) warnings.push_back(std::move(warning));
    });
}

bool packGeometry(Document& document, Compression compression, const std::string& new_file_name) {
    if (compression != Compression::meshopt) return false;
    return edit(document, new_file_name, [&](Editor& editor) { packMeshopt(document, editor); });
}

}  // namespace tspace::gltf
