// SPDX-License-Identifier: MIT
// Loads a glTF file and the bytes that it needs.
#include "model/gltf/load_document.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "model/gltf/accessor.h"
#include "model/gltf/container.h"
#include "model/gltf/draco_primitives.h"
#include "model/gltf/member_types.h"
#include "model/gltf/meshopt_views.h"
#include "model/gltf/nodes.h"
#include "model/io/file_error.h"
#include "model/io/named_files.h"
#include "model/io/text_encoding.h"
#include "model/io/uri.h"

namespace tspace::gltf {
namespace {

/// Required extensions that do not affect how geometry is read.
constexpr std::array<const char*, 28> kHarmless = {"KHR_mesh_quantization",
                                                   "KHR_texture_transform",
                                                   "KHR_texture_basisu",
                                                   "EXT_texture_webp",
                                                   "EXT_texture_avif",
                                                   "MSFT_texture_dds",
                                                   "KHR_materials_variants",
                                                   "KHR_materials_unlit",
                                                   "KHR_materials_clearcoat",
                                                   "KHR_materials_anisotropy",
                                                   "KHR_materials_pbrSpecularGlossiness",
                                                   "KHR_materials_sheen",
                                                   "KHR_materials_transmission",
                                                   "KHR_materials_volume",
                                                   "KHR_materials_ior",
                                                   "KHR_materials_specular",
                                                   "KHR_materials_iridescence",
                                                   "KHR_materials_emissive_strength",
                                                   "KHR_materials_dispersion",
                                                   "KHR_materials_diffuse_transmission",
                                                   "KHR_lights_punctual",
                                                   "KHR_animation_pointer",
                                                   "KHR_node_visibility",
                                                   "KHR_xmp_json_ld",
                                                   "EXT_mesh_gpu_instancing",
                                                   "EXT_lights_image_based",
                                                   "KHR_node_hoverability",
                                                   "KHR_interactivity"};

bool isCompression(const std::string& name) { return name == kExtMeshopt || name == kKhrMeshopt || name == kDraco; }

/// Returns why this build cannot read a compression extension, or an empty string if it can.
std::string compressionMissing(const std::string& name) {
    return name == kDraco ? dracoMissing() : meshoptMissing(name == kKhrMeshopt);
}

/// Checks the root object once, so that later code finds its arrays in constant time, and may assume types of members.
void checkRoot(const Json& root) {
    // The number of members is limited, because member lookup is a linear search and is done for every accessor.
    constexpr std::size_t kMaxRootMembers = 1000;
    if (root.size() > kMaxRootMembers)
        failFile(ErrorCode::invalidFile, "the root object has more than 1000 members, which is not supported", "");
    checkMemberTypes(root);
}

/// Fails with the name of the file type for known types that are not glTF, instead of with a syntax error.
void checkLooksLikeJson(std::span<const std::uint8_t> text) {
    const std::string_view view = narrowText({reinterpret_cast<const char*>(text.data()), text.size()});
    const std::size_t first = view.find_first_not_of(" \t\r\n");
    if (text.empty()) failFile(ErrorCode::invalidFile, "the file is empty", "byte 0");
    if (first != std::string_view::npos && view[first] == '[')
        failFile(ErrorCode::invalidFile, "the top level of the JSON is not an object", "byte 0");
    if (first == std::string_view::npos || view[first] != '{')
        failFile(ErrorCode::invalidFile, "the file is neither a GLB nor a glTF JSON file", "byte 0");
}

void checkVersion(const Json& root) {
    const Json* asset = readObject(root, "asset", "");
    if (asset == nullptr)
        failFile(ErrorCode::invalidFile, "the member 'asset' is missing: this is not a glTF 2.0 file", "");
    for (const char* key : {"version", "minVersion"}) {
        const std::string version = readString(*asset, key, "/asset", std::string(key) == "version" ? "" : "2.0");
        if (version.empty()) failFile(ErrorCode::invalidFile, "the glTF version is missing", "/asset/version");
        const bool readable = std::string(key) == "version" ? version.substr(0, 2) == "2." : version == "2.0";
        if (!readable) {
            failFile(ErrorCode::unsupportedFile, "the file requires glTF version " + inQuotes(version) + ", not 2.0",
                     join("/asset", key));
        }
    }
}

Buffer loadBuffer(Document& document, const Json& entry, std::size_t index, const GlbChunks* glb) {
    const std::string place = join("/buffers", index);
    const std::size_t length = readSize(entry, "byteLength", place);
    Buffer buffer;
    const Json* uri = findMember(entry, "uri");
    if (uri == nullptr) {
        if (index != 0 || glb == nullptr || !glb->bin) {
            if (document.container == Container::glb && index == 0 && meshoptExtension(entry) == nullptr &&
                length > 0) {
                failFile(ErrorCode::invalidFile, "the buffer refers to the BIN chunk, but the file has none", place);
            }
            return buffer;
        }
        if (length > glb->bin->size()) {
            failFile(ErrorCode::invalidFile,
                     "the buffer declares " + std::to_string(length) + " bytes, but the BIN chunk has only " +
                         std::to_string(glb->bin->size()),
                     join(place, "byteLength"));
        }
        buffer.source = BufferSource::bin;
        const auto begin = static_cast<std::size_t>(glb->bin->data() - document.file_bytes.data());
        buffer.bytes = BufferBytes(std::span(document.file_bytes).subspan(begin, length));
        return buffer;
    }
    const auto& text = uri->text();
    Bytes bytes;
    if (uriKind(text) == UriKind::data) {
        buffer.source = BufferSource::dataUri;
        bytes = decodeDataUri(text, join(place, "uri")).bytes;
        document.memory->take(bytes.size(), place);
    } else {
        buffer.source = BufferSource::file;
        buffer.path = document.files.resolve(text, join(place, "uri"));
        bytes = document.files.read(buffer.path, join(place, "uri"));
        const std::string name = buffer.path.string();
        // A file that is referenced twice is read twice, but its bytes count once.
        if (std::find(document.input_files.begin(), document.input_files.end(), name) == document.input_files.end()) {
            document.input_bytes += bytes.size();
            document.memory->allow(bytes.size());
            document.input_files.push_back(name);
        }
        document.memory->take(bytes.size(), place);
    }
    if (length > bytes.size()) {
        failFile(ErrorCode::invalidFile,
                 "the buffer declares " + std::to_string(length) + " bytes, but its data has only " +
                     std::to_string(bytes.size()),
                 join(place, "byteLength"));
    }
    bytes.resize(length);
    buffer.bytes = BufferBytes(std::move(bytes));
    return buffer;
}

/// Warns of nodes whose instancing attributes have different numbers of elements. References to accessors that do not
/// exist are errors only of commands that use them.
void checkInstances(Document& document) {
    constexpr std::size_t kMaxWarnings = 8;
    const Json& nodes = rootArray(document, "nodes");
    std::size_t count = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        InstanceCounts instances;
        tryFile([&] { instances = countInstances(document, nodes[i], join("/nodes", i)); });
        if (instances.complete == instances.largest || ++count > kMaxWarnings) continue;
        document.warnings.push_back("node " + std::to_string(i) +
                                    " has instancing attributes (EXT_mesh_gpu_instancing) of different lengths, " +
                                    std::to_string(instances.complete) + " to " + std::to_string(instances.largest) +
                                    " elements; only the first " + std::to_string(instances.complete) +
                                    " instances are complete and are used");
    }
    if (count > kMaxWarnings)
        document.warnings.push_back(std::to_string(count - kMaxWarnings) +
                                    " more nodes have instancing attributes of different lengths");
}

/// Records the files of images as inputs; they are not read here. A rejected URI causes a warning only, because
/// geometry does not depend on images.
void checkImageUris(Document& document) {
    constexpr std::size_t kMaxWarnings = 8;
    const Json& images = rootArray(document, "images");
    std::size_t refused_count = 0;
    for (std::size_t i = 0; i < images.size(); ++i) {
        const std::string place = join("/images", i);
        const std::string uri = readString(images[i], "uri", place);
        if (uri.empty() || uriKind(uri) == UriKind::data) continue;
        // With allow_external a web address is not an error: it names no local file.
        if (uriKind(uri) == UriKind::otherScheme && document.options.allow_external) continue;
        const std::optional<Error> failure = tryFile([&] {
            if (!document.files.areNone()) {
                document.files.note(document.files.resolve(uri, join(place, "uri")));
            } else if (uriKind(uri) == UriKind::path) {
                // The URI is not followed, but it must be well-formed.
                static_cast<void>(checkedPathOfUri(uri, true, join(place, "uri")));
            }
        });
        if (failure && ++refused_count <= kMaxWarnings)
            document.warnings.push_back("image " + std::to_string(i) + " is not read: " + failure->message);
    }
    if (refused_count > kMaxWarnings)
        document.warnings.push_back(std::to_string(refused_count - kMaxWarnings) + " more images could not be read");
}

/// Charges the budget for tables of uses and reports: a fixed cost per entry, because an entry takes only a few bytes
/// of JSON.
void takeEntries(const Document& document) {
    struct List {
        const char* name;
        std::size_t entry_bytes;
    };
    for (const List& list :
         {List{"buffers", 1500}, List{"images", 500}, List{"accessors", 200}, List{"bufferViews", 200},
          List{"materials", 100}, List{"meshes", 100}, List{"nodes", 100}}) {
        document.memory->take(rootArray(document, list.name).size() * list.entry_bytes, std::string("/") + list.name);
    }
}

void checkViewsAndAccessors(const Document& document) {
    const std::size_t view_count = rootArray(document, "bufferViews").size();
    for (std::size_t i = 0; i < view_count; ++i) readBufferView(document, i);
    const std::size_t accessor_count = rootArray(document, "accessors").size();
    for (std::size_t i = 0; i < accessor_count; ++i) readAccessor(document, i);
}

}  // namespace

Document parseDocument(Bytes file_bytes, const Path& path, const FileOptions& options) {
    Document document;
    document.path = path;
    document.files = NamedFiles(path, options);
    document.options = options;
    document.memory = std::make_shared<MemoryBudget>(options.memory_limit_bytes);
    document.file_bytes = std::move(file_bytes);
    document.input_bytes = document.file_bytes.size();
    document.container = isGlb(document.file_bytes) ? Container::glb : Container::gltf;
    GlbChunks glb;
    std::span<const std::uint8_t> text = document.file_bytes;
    if (document.container == Container::glb) {
        glb = readGlb(document.file_bytes);
        text = glb.json;
        if (text.empty()) failFile(ErrorCode::invalidFile, "the JSON chunk of the GLB is empty", "byte 12");
        document.extra_chunks = std::move(glb.extra);
        if (glb.ignored_bytes > 0) {
            document.warnings.push_back("the file has " + std::to_string(glb.ignored_bytes) +
                                        " bytes after the length that its GLB header states; they are ignored, and "
                                        "removed when the file is rewritten");
        }
    } else {
        constexpr std::size_t kGlbHeaderBytes = 12;
        if (isGlbName(path) && !text.empty() && text.size() < kGlbHeaderBytes)
            failFile(ErrorCode::invalidFile, "the GLB header is truncated", "byte " + std::to_string(text.size()));
        checkLooksLikeJson(text);
    }
    document.memory->allow(document.file_bytes.size());
    document.memory->take(document.file_bytes.size(), {});
    ParsedJson parsed = parseJson(text, document.memory.get());
    document.json = std::move(parsed.root);
    document.style = parsed.style;
    checkVersion(document.json);  // must come first: the arrays of glTF 2.0 are objects in 1.0
    checkRoot(document.json);
    takeEntries(document);
    const Json& buffers = rootArray(document, "buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        document.buffers.push_back(
            loadBuffer(document, buffers[i], i, document.container == Container::glb ? &glb : nullptr));
    }
    checkImageUris(document);
    checkViewsAndAccessors(document);
    checkInstances(document);
    decodeMeshoptViews(document);
    decodeDracoPrimitives(document);
    return document;
}

void checkRequiredExtensions(Document& document) {
    const Json& required = readArray(document.json, "extensionsRequired", "", false);
    for (std::size_t i = 0; i < required.size(); ++i) {
        const std::string place = join("/extensionsRequired", i);
        const auto& name = required[i].text();
        if (isCompression(name)) {
            const std::string missing = compressionMissing(name);
            if (!missing.empty())
                failFile(ErrorCode::unsupportedFile, "the file requires " + name + ": " + missing, place);
            continue;
        }
        if (std::find(kHarmless.begin(), kHarmless.end(), name) == kHarmless.end()) {
            document.warnings.push_back("the file requires the extension " + inQuotes(name) +
                                        ", which tspace does not support; its data is preserved");
        }
    }
}

}  // namespace tspace::gltf
