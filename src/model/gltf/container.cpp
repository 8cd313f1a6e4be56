// SPDX-License-Identifier: MIT
// Files of a glTF model.
#include "model/gltf/container.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "images/image.h"
#include "model/gltf/compression_extensions.h"
#include "model/io/file_error.h"
#include "model/io/folder_rule.h"
#include "model/io/named_files.h"
#include "model/io/output_name.h"
#include "model/io/uri.h"

namespace tspace::gltf {

// Reading and writing the GLB container (glTF 2.0 specification, section 4.4).

namespace {

constexpr std::uint32_t kMagic = 0x46546C67;     // "glTF"
constexpr std::uint32_t kJsonType = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinType = 0x004E4942;   // "BIN"
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeadBytes = 8;

std::uint32_t word(std::span<const std::uint8_t> bytes, std::size_t at) {
    return bytes[at] | std::uint32_t{bytes[at + 1]} << 8 | std::uint32_t{bytes[at + 2]} << 16 |
           std::uint32_t{bytes[at + 3]} << 24;
}

void putWord(Bytes& bytes, std::uint64_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

void putChunkHeader(Bytes& bytes, std::size_t length, std::uint32_t type) {
    putWord(bytes, length);
    putWord(bytes, type);
}

std::size_t paddingOf(std::size_t length) { return (4 - length % 4) % 4; }

[[noreturn]] void failGlb(std::string message, std::size_t at) {
    failFile(ErrorCode::invalidFile, std::move(message), "byte " + std::to_string(at));
}

}  // namespace

bool isGlb(std::span<const std::uint8_t> file) { return file.size() >= 4 && word(file, 0) == kMagic; }

GlbChunks readGlb(std::span<const std::uint8_t> file) {
    if (file.size() < kHeaderBytes) failGlb("the GLB header is truncated", file.size());
    if (word(file, 4) != 2) {
        failFile(ErrorCode::unsupportedFile, "the GLB has version " + std::to_string(word(file, 4)) + ", not 2",
                 "byte 4");
    }
    const std::size_t stated = word(file, 8);
    if (stated > file.size()) {
        failGlb("the GLB header states a length of " + std::to_string(stated) + " bytes, but the file has " +
                    std::to_string(file.size()),
                8);
    }
    if (stated <= kHeaderBytes) {
        failGlb("the GLB header states a length of " + std::to_string(stated) +
                    " bytes, which is too short for a JSON chunk",
                8);
    }
    GlbChunks chunks;
    const std::span<const std::uint8_t> whole = file;
    chunks.ignored_bytes = file.size() - stated;
    file = file.first(stated);
    std::size_t at = kHeaderBytes;
    for (std::size_t number = 0; at < file.size(); ++number) {
        if (whole.size() - at < kChunkHeadBytes) failGlb("the header of a GLB chunk is truncated", at);
        const std::size_t length = word(whole, at);
        const std::uint32_t type = word(whole, at + 4);
        if (file.size() - at < kChunkHeadBytes || length > file.size() - at - kChunkHeadBytes)
            failGlb("a chunk extends beyond the end of the GLB", at);
        const auto bytes = file.subspan(at + kChunkHeadBytes, length);
        if ((number == 0) != (type == kJsonType))
            failGlb(number == 0 ? "the first chunk of the GLB is not JSON" : "the GLB has a second JSON chunk", at);
        if (type == kBinType) {
            if (chunks.bin) failGlb("the GLB has a second BIN chunk", at);
            if (number != 1) failGlb("the BIN chunk of the GLB is not its second chunk", at);
            chunks.bin = bytes;
        } else if (number == 0) {
            chunks.json = bytes;
        } else {
            chunks.extra.push_back({type, Bytes(bytes.begin(), bytes.end())});
        }
        at += kChunkHeadBytes + length;
    }
    if (chunks.json.data() == nullptr) failGlb("the GLB has no JSON chunk", at);
    return chunks;
}

GlbFrame frameGlb(const std::string& json, std::optional<std::size_t> bin_bytes, std::span<const ExtraChunk> extra) {
    const std::size_t json_bytes = json.size() + paddingOf(json.size());
    std::uint64_t total = kHeaderBytes + kChunkHeadBytes + json_bytes;
    if (bin_bytes) total += kChunkHeadBytes + *bin_bytes + paddingOf(*bin_bytes);
    for (const ExtraChunk& chunk : extra) total += kChunkHeadBytes + chunk.bytes.size() + paddingOf(chunk.bytes.size());
    if (total > 0xffffffffu) {
        failFile(
            ErrorCode::cannotWrite,
            "the GLB would exceed the 4 GiB that the format allows; write a .gltf, which stores its data in a .bin");
    }
    GlbFrame frame;
    frame.head.reserve(kHeaderBytes + 2 * kChunkHeadBytes + json_bytes);
    putWord(frame.head, kMagic);
    putWord(frame.head, 2);
    putWord(frame.head, total);
    putChunkHeader(frame.head, json_bytes, kJsonType);
    frame.head.insert(frame.head.end(), json.begin(), json.end());
    frame.head.insert(frame.head.end(), paddingOf(json.size()), ' ');
    if (bin_bytes) {
        putChunkHeader(frame.head, *bin_bytes + paddingOf(*bin_bytes), kBinType);
        frame.tail.insert(frame.tail.end(), paddingOf(*bin_bytes), 0);
    }
    for (const ExtraChunk& chunk : extra) {
        putChunkHeader(frame.tail, chunk.bytes.size() + paddingOf(chunk.bytes.size()), chunk.type);
        frame.tail.insert(frame.tail.end(), chunk.bytes.begin(), chunk.bytes.end());
        frame.tail.insert(frame.tail.end(), paddingOf(chunk.bytes.size()), 0);
    }
    return frame;
}

// Conversion between .glb and .gltf: joins buffers, embeds images, and chooses file names.

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kJoinAlignment = 8;  // more than glTF's 4, because data of extensions may require 8
constexpr const char* kNewBufferEnding = ".tspace.bin";

/// Returns the bytes and media type of an image's URI, or nullopt (with a warning) if it cannot be read.
std::optional<DataUri> loadImage(Document& document, const std::string& uri, const std::string& declared,
                                 std::size_t number, std::vector<std::string>& warnings) {
    const std::string place = join("/images", number);
    DataUri image;
    if (uriKind(uri) == UriKind::data) {
        const auto failure = tryFile([&] { image = decodeDataUri(uri, join(place, "uri")); });
        if (failure && failure->code != ErrorCode::invalidFile) throw FileError{*failure};
        if (failure) {
            warnings.push_back("the image " + std::to_string(number) + " keeps its data URI: " + failure->message);
            return {};
        }
        if (!declared.empty()) image.mime_type = declared;
    } else if (uriKind(uri) == UriKind::otherScheme || document.files.areNone()) {
        warnings.push_back("the image " + inQuotes(uri) + " is not a file and was not embedded in the GLB");
        return {};
    } else {
        // The URI may name a folder: FBX files store one for images without a name.
        if (const std::string why = document.files.whyNotRead(uri, place); !why.empty()) {
            warnings.push_back("the image " + inQuotes(uri) +
                               " was not embedded in the GLB, and its URI was kept: " + why);
            return {};
        }
        const Path path = document.files.resolve(uri, join(place, "uri"));
        image.bytes = document.files.read(path, join(place, "uri"));
        document.input_files.push_back(path.string());
        image.mime_type = declared;
    }
    const std::string found = mimeType(imageFormat(image.bytes));
    if (!found.empty()) image.mime_type = found;
    if (image.bytes.empty() || image.mime_type.empty()) {
        warnings.push_back("the image " + inQuotes(uri, 60) + " has an unknown type and was not embedded in the GLB");
        return {};
    }
    return image;
}

/// Returns buffer 0, which is stored in BIN; creates an empty buffer if the document has none.
Buffer& binBuffer(Document& document) {
    if (document.buffers.empty()) {
        document.json["buffers"] = Json::array({Json{{"byteLength", 0}}});
        document.buffers.emplace_back();
        document.buffers[0].source = BufferSource::bin;
        document.buffers[0].own = true;
    }
    return document.buffers[0];
}

std::size_t appendAligned(Buffer& buffer, Bytes bytes, std::size_t alignment) {
    buffer.edited = true;
    return buffer.bytes.append(std::move(bytes), alignment);
}

struct Moved {
    std::size_t buffer = 0, offset = 0;
};

/// Makes `object` (a view, or the compression extension of one) refer to the joined buffer.
void moveReference(Json& object, const std::vector<Moved>& moved) {
    const Moved& to = moved[readSize(object, "buffer", "")];
    const std::size_t offset = readSize(object, "byteOffset", "", 0);
    object["buffer"] = to.buffer;
    if (to.offset != 0) object["byteOffset"] = offset + to.offset;
}

/// Joins all buffers that have data into the first one; buffers without data follow it.
void joinBuffers(Document& document) {
    if (document.buffers.empty()) return;
    Json old_entries = document.json["buffers"];
    std::vector<Buffer> old = std::move(document.buffers);
    std::vector<Moved> moved(old.size());
    document.buffers.clear();
    document.buffers.emplace_back();
    Buffer& bin = document.buffers[0];
    bin.source = BufferSource::bin;
    bin.own = true;
    Json entries = Json::array();
    for (std::size_t i = 0; i < old.size(); ++i) {
        if (!old[i].hasStoredBytes()) continue;
        if (entries.empty()) entries.push_back(old_entries[i]);
        moved[i] = {0, appendAligned(bin, old[i].bytes.joined(), kJoinAlignment)};
        old[i].bytes = {};
    }
    if (entries.empty()) {
        entries.push_back(Json::object());
        bin.bytes = BufferBytes(Bytes(kJoinAlignment, 0));  // glTF does not allow empty buffers
    }
    entries[0].erase("uri");
    // The mark `fallback` allows readers of the extension to skip a buffer. It would be wrong for the joined buffer.
    if (const char* mark = meshoptExtension(entries[0])) eraseExtension(entries[0], mark);
    entries[0]["byteLength"] = bin.bytes.size();
    for (std::size_t i = 0; i < old.size(); ++i) {
        if (old[i].hasStoredBytes()) continue;
        moved[i] = {entries.size(), 0};
        entries.push_back(old_entries[i]);
        document.buffers.push_back(std::move(old[i]));
    }
    document.json["buffers"] = std::move(entries);
    if (!document.json.contains("bufferViews")) return;
    for (std::size_t i = 0; i < document.json["bufferViews"].size(); ++i) {
        Json& view = document.json["bufferViews"][i];
        moveReference(view, moved);
        if (const char* name = meshoptExtension(view)) moveReference(view["extensions"][name], moved);
    }
}

/// Replaces "uri" by "bufferView" and "mimeType", at the same position in the object.
void embedImages(Document& document, std::vector<std::string>& warnings) {
    for (std::size_t i = 0; i < rootArray(document, "images").size(); ++i) {
        const std::string place = join("/images", i);
        const Json& old = rootArray(document, "images")[i];
        const std::string uri = readString(old, "uri", place);
        if (uri.empty()) continue;
        const auto image = loadImage(document, uri, readString(old, "mimeType", place), i, warnings);
        if (!image) continue;
        // binBuffer() must be called first, because a new root member invalidates references to other members.
        Buffer& bin = binBuffer(document);
        Json& views = editableRootArray(document, "bufferViews");
        const std::size_t begin = appendAligned(bin, image->bytes, 4);
        views.push_back(Json{{"buffer", 0}, {"byteOffset", begin}, {"byteLength", image->bytes.size()}});
        document.json["buffers"][0]["byteLength"] = bin.bytes.size();
        Json entry = Json::object();
        for (const auto& [key, value] : document.json["images"][i].items()) {
            if (key == "uri") {
                entry["bufferView"] = views.size() - 1;
                entry["mimeType"] = image->mime_type;
            } else if (key != "mimeType") {
                entry[key] = value;
            }
        }
        document.json["images"][i] = std::move(entry);
    }
}

/// Returns the path of a file in the output's folder; `name` itself if the output's path has no folder.
Path pathNextToTarget(const OutputTarget& target, const Path& name) {
    return fs::path(target.path).parent_path() / fs::path(name);
}

/// Copies one file that the model references to the same relative path in the output's folder.
void copyNamedFile(const Document& document, const OutputTarget& target, const std::string& uri,
                   const std::string& place, AtomicOutput& output, std::vector<std::string>& warnings) {
    if (uri.empty() || uriKind(uri) != UriKind::path || document.new_files.contains(pathOfUri(uri))) return;
    if (output.isStream() || document.files.areNone()) {
        warnings.push_back("the file " + inQuotes(uri) + " that the model references was not copied to the output");
        return;
    }
    const fs::path relative = Path(pathOfUri(uri));
    std::string why = document.files.whyNotRead(uri, place);
    if (leadsAway(relative) != nullptr) why = "it is outside the folder of the model";
    if (!why.empty()) {
        // A model that embeds its images has already reported missing images.
        if (!target.embeds_images) warnings.push_back("the file " + inQuotes(uri) + " was not copied: " + why);
        return;
    }
    const Path from = document.files.resolve(uri, place);
    output.addSource(from);
    const Path to = pathNextToTarget(target, relative);
    const std::vector<std::string> planned = output.files();
    if (std::find(planned.begin(), planned.end(), to.string()) != planned.end()) return;
    if (isThere(to)) {
        if (!document.files.areInMemory() && isSameFile(from, to)) return;
        if (output.leave(to, document.files.read(from, place))) return;
        failFile(ErrorCode::cannotWrite,
                 "the output would reference the file " + inQuotes(uri) + ", but " + pathInQuotes(to) +
                     " already exists and is a different file; choose another output folder",
                 place);
    }
    output.addShared(to, document.files.read(from, place));
}

/// Warns about missing images if no other step reads images.
void noteMissingImages(const Document& document, const OutputTarget& target, std::vector<std::string>& warnings) {
    if (target.embeds_images || document.files.areNone()) return;
    for (const Json& image : rootArray(document, "images")) {
        const std::string uri = readString(image, "uri", "/images");
        if (uri.empty() || uriKind(uri) != UriKind::path || document.new_files.contains(pathOfUri(uri))) continue;
        tryFile([&] {
            if (document.files.kindOf(document.files.resolve(uri, "/images")) == NamedFiles::Kind::missing)
                warnings.push_back("the image " + inQuotes(uri) + " does not exist");
        });
    }
}

void copyNamedFiles(const Document& document, const OutputTarget& target, AtomicOutput& output,
                    std::vector<std::string>& warnings) {
    for (const auto& [path, bytes] : document.new_files) output.add(pathNextToTarget(target, path), bytes);
    if (target.same_folder) return noteMissingImages(document, target, warnings);
    const Json& buffers = rootArray(document, "buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        if (document.buffers[i].own || document.buffers[i].source != BufferSource::file) continue;
        copyNamedFile(document, target, readString(buffers[i], "uri", ""), join("/buffers", i), output, warnings);
    }
    const Json& images = rootArray(document, "images");
    for (std::size_t i = 0; i < images.size(); ++i)
        copyNamedFile(document, target, readString(images[i], "uri", ""), join("/images", i), output, warnings);
}

std::span<const std::uint8_t> bytesOf(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

OutputTarget outputTarget(const Document& document, const Path& path, bool is_stream) {
    OutputTarget target;
    target.path = path;
    if (!isGltfName(path) && !isGlbOutput(path)) failEnding(path, {".glb", ".vrm", ".gltf"});
    target.container = isGlbOutput(path) ? Container::glb : Container::gltf;
    target.embeds_images =
        target.container == Container::glb && (document.container == Container::gltf || document.imported);
    if (is_stream) {
        if (target.container != Container::glb)
            failFile(ErrorCode::invalidOption,
                     "only a GLB can be written to a stream or to memory; write a GLB, or name an output file");
        return target;
    }
    target.in_place = !document.files.areInMemory() && isSameFile(document.path, path);
    target.same_folder = !document.files.areInMemory() && isSameFile(document.files.folder(), folderOf(path));
    return target;
}

bool referencesFile(const Document& document, const std::string& name) {
    for (const char* list : {"buffers", "images"}) {
        for (const Json& entry : rootArray(document, list)) {
            const Json* uri = findMember(entry, "uri");
            if (uri != nullptr && uri->is_string() && pathOfUri(uri->text()) == name) return true;
        }
    }
    return false;
}

std::string freeFileName(const Document& document, const OutputTarget& target, const std::string& ending) {
    const std::string stem = stemOf(target.path);
    const std::size_t dot = ending.rfind('.');
    std::string name = stem + ending;
    for (int number = 2; referencesFile(document, name); ++number)
        name = stem + ending.substr(0, dot) + "-" + std::to_string(number) + ending.substr(dot);
    return name;
}

std::vector<std::string> bufferFilesOf(const std::string& path) {
    if (!isGltfName(path) || isGlbOutput(path)) return {};
    const std::string stem = path.substr(0, path.rfind('.'));
    return {stem + ".bin", stem + kNewBufferEnding};
}

void convertContainer(Document& document, const OutputTarget& target, bool will_edit,
                      std::vector<std::string>& warnings) {
    if (target.container == Container::glb) {
        const bool has_bin = document.buffers.empty() || document.buffers[0].source == BufferSource::bin;
        if (target.embeds_images || (!has_bin && will_edit)) joinBuffers(document);
        document.container = Container::glb;
        if (!document.buffers.empty() && document.buffers[0].source == BufferSource::bin)
            document.buffers[0].own = true;
        return;
    }
    const bool from_glb = document.container == Container::glb;
    document.container = Container::gltf;
    if (from_glb && !document.extra_chunks.empty()) {
        warnings.push_back("the GLB has chunks that a .gltf cannot store; they were removed");
        document.extra_chunks.clear();
    }
    const std::string own_name = stemOf(target.path) + kNewBufferEnding;
    for (std::size_t i = 0; i < document.buffers.size(); ++i) {
        Buffer& buffer = document.buffers[i];
        Json& entry = document.json["buffers"][i];
        if (buffer.source == BufferSource::bin) {
            buffer.source = BufferSource::file;
            buffer.path = freeFileName(document, target, ".bin");
            buffer.own = buffer.edited = true;
            entry["uri"] = percentEncode(buffer.path.string());
        } else if (buffer.source == BufferSource::dataUri) {
            buffer.own = true;
        } else if (buffer.source == BufferSource::file && (target.in_place || !target.same_folder) &&
                   pathOfUri(entry["uri"].text()) == own_name) {
            // The file was written by an earlier run for a model with this name, so the output owns it.
            buffer.own = true;
            buffer.path = own_name;
        }
    }
}

void embedImagesInGlb(Document& document, const OutputTarget& target, std::vector<std::string>& warnings) {
    if (target.embeds_images) embedImages(document, warnings);
}

void writeDocument(Document& document, const OutputTarget& target, AtomicOutput& output,
                   std::vector<std::string>& warnings, const Execution& execution) {
    if (target.container == Container::glb) {
        const std::string text = writeJson(document.json, document.style);
        const bool has_bin = !document.buffers.empty() && document.buffers[0].source == BufferSource::bin;
        const GlbFrame frame = frameGlb(text, has_bin ? std::optional(document.buffers[0].bytes.size()) : std::nullopt,
                                        document.extra_chunks);
        std::vector<OutputPiece> pieces;
        if (has_bin) pieces = document.buffers[0].bytes.pieces();
        pieces.insert(pieces.begin(), frame.head);
        pieces.push_back(frame.tail);
        output.add(target.path, pieces, execution);
    } else {
        for (std::size_t i = 0; i < document.buffers.size(); ++i) {
            const Buffer& buffer = document.buffers[i];
            if (buffer.source != BufferSource::dataUri || !buffer.edited) continue;
            Json& uri = document.json["buffers"][i]["uri"];
            const auto& old = uri.text();
            const std::string mime = old.substr(5, old.find_first_of(";,") - 5);
            uri = encodeDataUri(mime.empty() ? "application/octet-stream" : mime, buffer.bytes.joined());
        }
        output.add(target.path, bytesOf(writeJson(document.json, document.style)));
        for (const Buffer& buffer : document.buffers) {
            if (buffer.source == BufferSource::file && buffer.own && (buffer.edited || !target.in_place))
                output.add(pathNextToTarget(target, buffer.path), buffer.bytes.pieces(), execution);
        }
    }
    copyNamedFiles(document, target, output, warnings);
}

void writeUnchanged(const Document& document, const OutputTarget& target, AtomicOutput& output,
                    std::vector<std::string>& warnings) {
    if (target.in_place) return noteMissingImages(document, target, warnings);
    output.add(target.path, document.file_bytes);
    for (const Buffer& buffer : document.buffers) {
        if (buffer.source == BufferSource::file && buffer.own && !target.same_folder)
            output.add(pathNextToTarget(target, buffer.path), buffer.bytes.pieces());
    }
    copyNamedFiles(document, target, output, warnings);
}

}  // namespace tspace::gltf
