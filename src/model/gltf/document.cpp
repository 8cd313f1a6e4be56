// SPDX-License-Identifier: MIT
// Loading a glTF file and the bytes that it needs.
#include "model/gltf/document.h"
#include "model/gltf/container.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "model/gltf/accessor.h"
#include "model/gltf/draco_primitives.h"
#include "model/gltf/meshopt_views.h"
#include "model/io/file_error.h"
#include "model/io/memory_budget.h"
#include "model/io/uri.h"

namespace tspace::gltf {

// Errors of JSON with their places, and checked access.

namespace {

[[noreturn]] void failJson(std::string message, std::string place) {
    failFile(ErrorCode::invalidFile, std::move(message), std::move(place));
}

/// Charges the memory of values to the budget of the file.
class BudgetMemory final : public JsonMemory {
  public:
    explicit BudgetMemory(MemoryBudget& budget) : budget_(budget) {}
    void take(std::size_t bytes) override { budget_.take(bytes, {}); }

  private:
    MemoryBudget& budget_;
};

Json parseText(std::string_view text, MemoryBudget* budget) {
    std::optional<BudgetMemory> memory;
    if (budget != nullptr) memory.emplace(*budget);
    JsonError error;
    std::optional<Json> root = Json::read(text, error, memory ? &*memory : nullptr);
    if (root) return std::move(*root);
    if (error.repeated) failJson("the JSON has the member " + inQuotes(*error.repeated) + " twice in one object", {});
    failJson(error.message, error.byte ? "JSON byte " + std::to_string(*error.byte) : std::string());
}

JsonStyle styleOf(std::string_view text) {
    JsonStyle style;
    style.final_newline = !text.empty() && text.back() == '\n';
    const std::size_t open = text.find('{');
    const std::size_t line = open == std::string_view::npos ? open : text.find_first_not_of(" \r", open + 1);
    if (line == std::string_view::npos || text[line] != '\n') return style;
    const std::size_t first = text.find_first_not_of(" \t", line + 1);
    const std::size_t width = first == std::string_view::npos ? 0 : first - line - 1;
    style.indent_char = width > 0 && text[line + 1] == '\t' ? '\t' : ' ';
    style.indent = static_cast<int>(std::min<std::size_t>(width, 16));
    return style;
}

/// Reads 64 bits also where size_t has 32, so that large numbers are compared and not truncated.
std::optional<std::uint64_t> wholeNumber(const Json& value) {
    if (value.is_number_integer()) {
        // Parsed numbers are unsigned; those that this program wrote may be signed.
        if (!value.is_number_unsigned() && value.get<std::int64_t>() < 0) return {};
        return value.get<std::uint64_t>();
    }
    if (!value.is_number_float()) return {};
    // 5.0 is a whole number too; beyond 2^53 a double cannot say which one.
    const double number = value.get<double>();
    if (!(number >= 0 && number <= 9007199254740992.0) || number != std::floor(number)) return {};
    return static_cast<std::uint64_t>(number);
}

}  // namespace

ParsedJson parseJson(std::span<const std::uint8_t> bytes, MemoryBudget* budget) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    ParsedJson result{parseText(text, budget), styleOf(text)};
    if (!result.root.is_object()) failJson("the JSON is not an object", {});
    return result;
}

std::string writeJson(const Json& root, const JsonStyle& style) {
    std::string text = root.dump(style.indent, style.indent_char, BadUtf8::replace);
    if (style.final_newline) text += '\n';
    return text;
}

const Json* findMember(const Json& object, const char* key) { return object.find(key); }

std::uint64_t readWhole(const Json& object, const char* key, const std::string& place,
                        std::optional<std::uint64_t> fallback) {
    const Json* value = findMember(object, key);
    if (value == nullptr) {
        if (fallback) return *fallback;
        failJson(std::string("the member '") + key + "' is missing", place);
    }
    const auto number = wholeNumber(*value);
    if (!number) failJson(std::string("'") + key + "' is not a whole number of 0 or more", join(place, key));
    return *number;
}

std::size_t readSize(const Json& object, const char* key, const std::string& place,
                     std::optional<std::size_t> fallback) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::size_t>::max();
    const std::uint64_t number = readWhole(object, key, place, fallback);
    if (number > kMost) {
        failJson(std::string("'") + key + "' is " + std::to_string(number) + "; this build counts to " +
                     std::to_string(kMost),
                 join(place, key));
    }
    return static_cast<std::size_t>(number);
}

std::size_t toIndex(const Json& value, const std::string& place, std::size_t limit, const char* what) {
    const auto number = wholeNumber(value);
    if (!number) failJson(std::string("the index of the ") + what + " is not a whole number of 0 or more", place);
    if (*number >= limit) {
        failJson(std::string("there is no ") + what + " " + std::to_string(*number) + "; the file has " +
                     std::to_string(limit),
                 place);
    }
    return static_cast<std::size_t>(*number);
}

std::optional<std::size_t> readIndex(const Json& object, const char* key, const std::string& place, std::size_t limit,
                                     const char* what) {
    const Json* value = findMember(object, key);
    if (value == nullptr) return {};
    return toIndex(*value, join(place, key), limit, what);
}

double readNumber(const Json& object, const char* key, const std::string& place, double fallback) {
    const Json* value = findMember(object, key);
    if (value == nullptr) return fallback;
    if (!value->is_number()) failJson(std::string("'") + key + "' is not a number", join(place, key));
    return value->get<double>();
}

void readNumbers(const Json& object, const char* key, const std::string& place, std::span<double> numbers) {
    const Json* value = findMember(object, key);
    if (value == nullptr) return;
    bool are_numbers = value->is_array() && value->size() == numbers.size();
    for (std::size_t i = 0; are_numbers && i < numbers.size(); ++i) are_numbers = (*value)[i].is_number();
    if (!are_numbers) {
        failJson(std::string("'") + key + "' is not an array of " + std::to_string(numbers.size()) + " numbers",
                 join(place, key));
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = (*value)[i].get<double>();
}

std::string readString(const Json& object, const char* key, const std::string& place, const std::string& fallback) {
    const Json* value = findMember(object, key);
    if (value == nullptr) return fallback;
    if (!value->is_string()) failJson(std::string("'") + key + "' is not a string", join(place, key));
    return value->get<std::string>();
}

bool readBool(const Json& object, const char* key, const std::string& place, bool fallback) {
    const Json* value = findMember(object, key);
    if (value == nullptr) return fallback;
    if (!value->is_boolean()) failJson(std::string("'") + key + "' is not true or false", join(place, key));
    return value->get<bool>();
}

const Json& readArray(const Json& object, const char* key, const std::string& place, bool of_objects) {
    static const Json empty = Json::array();
    const Json* value = findMember(object, key);
    if (value == nullptr) return empty;
    if (!value->is_array()) failJson(std::string("'") + key + "' is not an array", join(place, key));
    for (std::size_t i = 0; of_objects && i < value->size(); ++i) {
        if (!(*value)[i].is_object()) {
            failJson(std::string("an entry of '") + key + "' is not an object", join(join(place, key), i));
        }
    }
    return *value;
}

const Json* readObject(const Json& object, const char* key, const std::string& place) {
    const Json* value = findMember(object, key);
    if (value != nullptr && !value->is_object())
        failJson(std::string("'") + key + "' is not an object", join(place, key));
    return value;
}

const Json* findExtension(const Json& object, const char* name) {
    const Json* extensions = findMember(object, "extensions");
    return extensions == nullptr ? nullptr : findMember(*extensions, name);
}

std::string join(const std::string& place, const std::string& key) {
    std::string result = place + '/';
    for (const char c : key) {
        if (c == '~') {
            result += "~0";
        } else if (c == '/') {
            result += "~1";
        } else {
            result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
        }
    }
    return result;
}

std::string join(const std::string& place, std::size_t index) { return place + '/' + std::to_string(index); }

namespace {

/// Required extensions that do not change how geometry is read.
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

/// Why this build cannot read an extension; empty when it can.
std::string compressionMissing(const std::string& name) {
    return name == kDraco ? dracoMissing() : meshoptMissing(name == kKhrMeshopt);
}

/// Checked once, so that later code may assume that every entry of these arrays is an object, and finds arrays in
/// constant time.
void checkRoot(const Json& root) {
    // Looking up a member is a linear search, done for every accessor.
    constexpr std::size_t kMaxRootMembers = 1000;
    if (root.size() > kMaxRootMembers) failFile(ErrorCode::invalidFile, "the root has more than 1000 members", "");
    for (const char* name :
         {"accessors", "bufferViews", "buffers", "images", "materials", "meshes", "nodes", "skins", "animations"}) {
        readArray(root, name, "", true);
    }
}

/// Names other kinds of files in place of a "syntax error".
void checkLooksLikeJson(std::span<const std::uint8_t> text) {
    std::string_view view(reinterpret_cast<const char*>(text.data()), text.size());
    if (view.substr(0, 3) == "\xef\xbb\xbf") view.remove_prefix(3);  // byte order mark
    const std::size_t first = view.find_first_not_of(" \t\r\n");
    if (text.empty()) failFile(ErrorCode::invalidFile, "the file is empty", "byte 0");
    if (first != std::string_view::npos && view[first] == '[')
        failFile(ErrorCode::invalidFile, "the JSON is not an object", "byte 0");
    if (first == std::string_view::npos || view[first] != '{') {
        failFile(ErrorCode::invalidFile, "the file is neither GLB nor the JSON of glTF", "byte 0");
    }
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
            failFile(ErrorCode::unsupportedFile, "the file needs glTF version " + inQuotes(version) + ", not 2.0",
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
                failFile(ErrorCode::invalidFile, "the buffer is in the BIN chunk, but the file has none", place);
            }
            return buffer;
        }
        if (length > glb->bin->size()) {
            failFile(ErrorCode::invalidFile,
                     "the buffer says " + std::to_string(length) + " bytes, but the BIN chunk has " +
                         std::to_string(glb->bin->size()),
                     join(place, "byteLength"));
        }
        buffer.source = BufferSource::bin;
        const auto begin = static_cast<std::size_t>(glb->bin->data() - document.file_bytes.data());
        buffer.bytes = BufferBytes(std::span(document.file_bytes).subspan(begin, length));
        return buffer;
    }
    if (!uri->is_string()) failFile(ErrorCode::invalidFile, "'uri' is not a string", join(place, "uri"));
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
        // A file that is named twice is read twice, but its bytes count once.
        if (std::find(document.input_files.begin(), document.input_files.end(), name) == document.input_files.end()) {
            document.input_bytes += bytes.size();
            document.memory->allow(bytes.size());
            document.input_files.push_back(name);
        }
        document.memory->take(bytes.size(), place);
    }
    if (length > bytes.size()) {
        failFile(
            ErrorCode::invalidFile,
            "the buffer says " + std::to_string(length) + " bytes, but its data has " + std::to_string(bytes.size()),
            join(place, "byteLength"));
    }
    bytes.resize(length);
    buffer.bytes = BufferBytes(std::move(bytes));
    return buffer;
}

/// Images are not read here, but each of their files is part of the input. A URI that is refused gets a warning: geometry
/// does not depend on it.
void checkImageUris(Document& document) {
    constexpr std::size_t kMostWarnings = 8;
    const Json& images = rootArray(document, "images");
    std::size_t refused_count = 0;
    for (std::size_t i = 0; i < images.size(); ++i) {
        const std::string place = join("/images", i);
        const std::string uri = readString(images[i], "uri", place);
        if (uri.empty() || uriKind(uri) == UriKind::data) continue;
        // With allow_external a web address is left as it is: it names no local file.
        if (uriKind(uri) == UriKind::otherScheme && document.options.allow_external) continue;
        const std::optional<Error> failure = tryFile([&] {
            if (!document.files.areNone()) {
                document.files.note(document.files.resolve(uri, join(place, "uri")));
            } else if (uriKind(uri) == UriKind::path) {
                // No URI is followed, wherever it leads; but it is one.
                static_cast<void>(checkedPathOfUri(uri, true, join(place, "uri")));
            }
        });
        if (failure && ++refused_count <= kMostWarnings)
            document.warnings.push_back("image " + std::to_string(i) + " is not read: " + failure->message);
    }
    if (refused_count > kMostWarnings)
        document.warnings.push_back(std::to_string(refused_count - kMostWarnings) + " more images are not read either");
}

/// Charges each entry a fixed cost for tables of uses, places and reports: an entry takes only a few bytes of JSON.
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

const Json& rootArray(const Document& document, const char* name) { return readArray(document.json, name, "", false); }

Json& editableRootArray(Document& document, const char* name) {
    Json& array = document.json[name];
    if (array.is_null()) array = Json::array();
    return array;
}

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
                                        " bytes behind the length that its GLB header states; they mean "
                                        "nothing, and are left out when the file is written anew");
        }
    } else {
        constexpr std::size_t kGlbHeaderBytes = 12;
        if (isGlbName(path) && !text.empty() && text.size() < kGlbHeaderBytes)
            failFile(ErrorCode::invalidFile, "the GLB header is cut short", "byte " + std::to_string(text.size()));
        checkLooksLikeJson(text);
    }
    document.memory->allow(document.file_bytes.size());
    document.memory->take(document.file_bytes.size(), {});
    ParsedJson parsed = parseJson(text, document.memory.get());
    document.json = std::move(parsed.root);
    document.style = parsed.style;
    checkVersion(document.json);  // first: glTF 1.0 has objects where 2.0 has arrays
    checkRoot(document.json);
    takeEntries(document);
    const Json& buffers = rootArray(document, "buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        document.buffers.push_back(
            loadBuffer(document, buffers[i], i, document.container == Container::glb ? &glb : nullptr));
    }
    checkImageUris(document);
    checkViewsAndAccessors(document);
    decodeMeshoptViews(document);
    decodeDracoPrimitives(document);
    return document;
}

std::string formatOf(const Document& document) {
    if (document.imported) return lowerExtension(document.path).substr(1);
    return document.container == Container::glb ? "glb" : "gltf";
}

std::string generatorOf(const Document& document) {
    if (document.imported) return document.source_generator;
    const Json* asset = readObject(document.json, "asset", "");
    return asset != nullptr ? readString(*asset, "generator", "/asset") : std::string();
}

void checkRequiredExtensions(Document& document) {
    const Json& required = readArray(document.json, "extensionsRequired", "", false);
    for (std::size_t i = 0; i < required.size(); ++i) {
        const std::string place = join("/extensionsRequired", i);
        if (!required[i].is_string())
            failFile(ErrorCode::invalidFile, "the name of an extension is not a string", place);
        const auto& name = required[i].text();
        if (isCompression(name)) {
            const std::string missing = compressionMissing(name);
            if (!missing.empty())
                failFile(ErrorCode::unsupportedFile, "the file requires " + name + ": " + missing, place);
            continue;
        }
        if (std::find(kHarmless.begin(), kHarmless.end(), name) == kHarmless.end()) {
            document.warnings.push_back("the file requires the extension " + inQuotes(name) +
                                        ", which tspace does not know; its data is kept as it is");
        }
    }
}

namespace {

constexpr const char* kLists[] = {"extensionsUsed", "extensionsRequired"};

}  // namespace

void requireExtension(Document& document, const char* name) {
    for (const char* key : kLists) {
        const Json& list = readArray(document.json, key, "", false);
        if (std::find(list.begin(), list.end(), name) == list.end()) document.json[key].push_back(name);
    }
}

void dropExtension(Document& document, const char* name) {
    for (const char* key : kLists) {
        const Json& list = readArray(document.json, key, "", false);
        const auto found = std::find(list.begin(), list.end(), name);
        if (found == list.end()) continue;
        Json& edited = document.json[key];
        edited.erase(static_cast<std::size_t>(found - list.begin()));
        if (edited.empty()) document.json.erase(key);
    }
}

}  // namespace tspace::gltf
