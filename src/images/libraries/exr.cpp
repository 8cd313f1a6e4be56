// SPDX-License-Identifier: MIT
// Reads and writes EXR with OpenEXR's C library, which is loaded for the first EXR image.
#include <openexr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/ascii.h"
#include "images/codecs.h"
#include "images/float_image.h"
#include "images/layout_guess.h"
#include "images/loaded_library.h"
#include "images/tracked_memory.h"

namespace tspace {
namespace {

/// Header fields that are needed before the library reads the file.
struct ExrHeader {
    ImageSize size = {};
    std::uint64_t channel_count = 0, chunk_pixels = 0;
    bool has_more = false;  ///< multiple parts, or multiple values per pixel
    bool is_plain = false;  ///< uses a compression that all readers have supported for a long time
};

class ExrHeaderReader {
  public:
    explicit ExrHeaderReader(ByteSpan bytes) : bytes_(bytes) {}

    /// Returns nullopt for an invalid header.
    std::optional<ExrHeader> read() {
        at_ = 4;  // after the magic number
        ExrHeader head;
        constexpr std::uint32_t kDeepOrParts = 0x1800;
        head.has_more = (number() & kDeepOrParts) != 0;
        std::uint64_t tile_pixels = 0;
        for (std::string_view name = text(); !name.empty(); name = text()) {
            text();  // the attribute type
            const std::uint64_t size = number(), begin = at_;
            if (failed_ || size > bytes_.size() - at_) return {};
            if (name == "dataWindow" && size == 16) head.size = readWindow();
            if (name == "compression" && size == 1) head.is_plain = bytes_[begin] <= EXR_COMPRESSION_PXR24;
            if (name == "channels") head.channel_count = countChannels(begin + size);
            if (name == "tiles" && size >= 8) tile_pixels = readTile();
            at_ = begin + size;
        }
        if (failed_ || head.size.pixels() == 0) return {};
        constexpr std::uint64_t kMaxRows = 256;  // maximum number of rows of a chunk, with any compression
        const std::uint64_t rows = head.size.width * std::min<std::uint64_t>(kMaxRows, head.size.height);
        head.chunk_pixels = tile_pixels != 0 ? std::min(tile_pixels, head.size.pixels()) : rows;
        return head;
    }

  private:
    std::string_view text() {
        const std::size_t begin = at_;
        while (at_ < bytes_.size() && bytes_[at_] != 0) ++at_;
        if (at_ >= bytes_.size()) {
            failed_ = true;
            return {};
        }
        const std::size_t size = at_++ - begin;
        return {reinterpret_cast<const char*>(bytes_.data()) + begin, size};
    }
    std::uint32_t number() {
        if (bytes_.size() - at_ < 4) {
            failed_ = true;
            return 0;
        }
        std::uint32_t value = 0;
        for (unsigned i = 0; i < 4; ++i) value |= std::uint32_t{bytes_[at_ + i]} << 8 * i;
        at_ += 4;
        return value;
    }
    ImageSize readWindow() {
        std::array<std::int64_t, 4> corner{};
        for (std::int64_t& value : corner) value = static_cast<std::int32_t>(number());
        const auto size = [](std::int64_t first, std::int64_t last) {
            constexpr std::int64_t kMax = std::int64_t{1} << 30;  // prevents overflow of products
            return static_cast<std::uint32_t>(std::clamp<std::int64_t>(last - first + 1, 0, kMax));
        };
        return {size(corner[0], corner[2]), size(corner[1], corner[3])};
    }
    std::uint64_t countChannels(std::uint64_t end) {
        constexpr std::size_t kBytesBehindName = 16;
        std::uint64_t count = 0;
        while (at_ < end && !text().empty() && !failed_) {
            at_ = std::min<std::size_t>(at_ + kBytesBehindName, bytes_.size());
            ++count;
        }
        return count;
    }
    std::uint64_t readTile() {
        const std::uint64_t width = number(), height = number();
        return width * height;
    }

    ByteSpan bytes_;
    std::size_t at_ = 0;
    bool failed_ = false;
};

/// Functions of the library installed at run time.
struct OpenExr {
    LoadedLibrary library = LoadedLibrary(TSPACE_OPENEXR_LIBRARY, std::size_t{8} << 20);
    decltype(&exr_start_read) startRead = library.find("exr_start_read");
    decltype(&exr_start_write) startWrite = library.find("exr_start_write");
    decltype(&exr_finish) finish = library.find("exr_finish");
    decltype(&exr_get_storage) getStorage = library.find("exr_get_storage");
    decltype(&exr_get_channels) getChannels = library.find("exr_get_channels");
    decltype(&exr_get_data_window) getDataWindow = library.find("exr_get_data_window");
    decltype(&exr_get_display_window) getDisplayWindow = library.find("exr_get_display_window");
    decltype(&exr_get_scanlines_per_chunk) getScanlinesPerChunk = library.find("exr_get_scanlines_per_chunk");
    decltype(&exr_get_tile_sizes) getTileSizes = library.find("exr_get_tile_sizes");
    decltype(&exr_read_scanline_chunk_info) readScanlineChunkInfo = library.find("exr_read_scanline_chunk_info");
    decltype(&exr_read_tile_chunk_info) readTileChunkInfo = library.find("exr_read_tile_chunk_info");
    decltype(&exr_decoding_initialize) decodingInitialize = library.find("exr_decoding_initialize");
    decltype(&exr_decoding_choose_default_routines) decodingChooseDefaultRoutines =
        library.find("exr_decoding_choose_default_routines");
    decltype(&exr_decoding_run) decodingRun = library.find("exr_decoding_run");
    decltype(&exr_decoding_destroy) decodingDestroy = library.find("exr_decoding_destroy");
    decltype(&exr_add_part) addPart = library.find("exr_add_part");
    decltype(&exr_initialize_required_attr_simple) initializeRequiredAttrSimple =
        library.find("exr_initialize_required_attr_simple");
    decltype(&exr_add_channel) addChannel = library.find("exr_add_channel");
    decltype(&exr_write_header) writeHeader = library.find("exr_write_header");
    decltype(&exr_write_scanline_chunk_info) writeScanlineChunkInfo = library.find("exr_write_scanline_chunk_info");
    decltype(&exr_encoding_initialize) encodingInitialize = library.find("exr_encoding_initialize");
    decltype(&exr_encoding_choose_default_routines) encodingChooseDefaultRoutines =
        library.find("exr_encoding_choose_default_routines");
    decltype(&exr_encoding_run) encodingRun = library.find("exr_encoding_run");
    decltype(&exr_encoding_destroy) encodingDestroy = library.find("exr_encoding_destroy");
    bool is_loaded = library.hasAll();
};

const OpenExr& openExr() {
    static const OpenExr loaded;
    return loaded;
}

constexpr int kPart = 0;

void ignoreError(exr_const_context_t, exr_result_t, const char*) {}

struct ExrContext {
    exr_context_t context = nullptr;

    ExrContext() = default;
    ExrContext(const ExrContext&) = delete;
    ExrContext& operator=(const ExrContext&) = delete;
    ~ExrContext() { finish(); }
    bool finish() {
        const bool is_fine = context == nullptr || openExr().finish(&context) == EXR_ERR_SUCCESS;
        context = nullptr;
        return is_fine;
    }
};

std::int64_t readExrBytes(exr_const_context_t, void* data, void* buffer, std::uint64_t size, std::uint64_t offset,
                          exr_stream_error_func_ptr_t) {
    const ByteSpan& bytes = *static_cast<const ByteSpan*>(data);
    if (offset >= bytes.size()) return 0;
    const std::size_t count = std::min<std::size_t>(size, bytes.size() - offset);
    std::memcpy(buffer, bytes.data() + offset, count);
    return static_cast<std::int64_t>(count);
}

std::int64_t exrByteCount(exr_const_context_t, void* data) {
    return static_cast<std::int64_t>(static_cast<const ByteSpan*>(data)->size());
}

/// Channels to read from a file.
struct ExrChannels {
    /// Names of the channels that become red, green and blue. The second is empty if there is one channel, the third if
    /// there are only x and y.
    std::array<std::string, 3> colors = {};
    std::string alpha = {};   ///< name of the alpha channel; empty if the image is opaque
    std::string others = {};  ///< channels of other layers that contain vectors, as text; empty if there are none

    [[nodiscard]] bool has(std::string_view name) const {
        return !name.empty() && (name == alpha || std::find(colors.begin(), colors.end(), name) != colors.end());
    }
    /// Returns whether the channels are in a layer, or z is missing.
    [[nodiscard]] bool isUnusual() const { return colors[2].empty() || colors[0].find('.') != std::string::npos; }
    [[nodiscard]] std::string text() const {
        std::string text = colors[0];
        for (std::size_t i = 1; i < 3; ++i) text += colors[i].empty() ? "" : (i == 2 ? " and " : ", ") + colors[i];
        return text;
    }
};

/// Channels of one layer, such as "layer.R", or of no layer (empty prefix).
struct ExrLayer {
    std::string prefix = {};  ///< name of the layer with the dot
    std::vector<std::string_view> names = {};

    /// Returns the full name of the channel whose name without the prefix is `letter`, in upper or lower case; empty if
    /// there is none.
    [[nodiscard]] std::string find(const char* letter) const {
        for (const std::string_view name : names) {
            if (lowerAscii(std::string(name.substr(prefix.size()))) == letter) return std::string(name);
        }
        return {};
    }
    /// Returns the channels R, G, B or X, Y, Z, or the first two of them.
    [[nodiscard]] std::optional<ExrChannels> vectors() const {
        constexpr std::array<std::array<const char*, 3>, 2> kLetters{{{"r", "g", "b"}, {"x", "y", "z"}}};
        for (const std::size_t count : {3U, 2U}) {
            for (const auto& letters : kLetters) {
                ExrChannels channels{.alpha = find("a")};
                for (std::size_t i = 0; i < count; ++i) channels.colors[i] = find(letters[i]);
                if (!channels.colors[0].empty() && !channels.colors[1].empty() &&
                    (count == 2 || !channels.colors[2].empty()))
                    return channels;
            }
        }
        return {};
    }
    /// Returns a single channel of any name, optionally with alpha.
    [[nodiscard]] std::optional<ExrChannels> heights() const {
        const std::string alpha = find("a");
        if (names.size() != (alpha.empty() ? 1U : 2U)) return {};
        for (const std::string_view name : names) {
            if (name != alpha) return ExrChannels{.colors = {std::string(name)}, .alpha = alpha};
        }
        return {};
    }
};

/// Returns whether a part of the name of a layer says that it holds normals: a part that contains "normal", or that is
/// one of the usual abbreviations.
bool isNamedNormal(const std::string& prefix) {
    constexpr std::array<std::string_view, 6> kNames{"n", "nor", "norm", "nrm", "nml", "ddn"};
    const std::string name = lowerAscii(prefix);
    if (name.find("normal") != std::string::npos) return true;
    const auto isLetter = [](char c) { return c >= 'a' && c <= 'z'; };
    for (std::size_t at = 0; at < name.size();) {
        std::size_t end = at;
        while (end < name.size() && isLetter(name[end])) ++end;
        if (std::find(kNames.begin(), kNames.end(), name.substr(at, end - at)) != kNames.end()) return true;
        at = end + 1;
    }
    return false;
}

std::vector<ExrLayer> exrLayers(std::span<const std::string_view> names) {
    std::vector<ExrLayer> layers;
    for (const std::string_view name : names) {
        const std::size_t dot = name.rfind('.');
        const std::string prefix(dot == std::string_view::npos ? "" : name.substr(0, dot + 1));
        auto layer =
            std::find_if(layers.begin(), layers.end(), [&](const auto& known) { return known.prefix == prefix; });
        if (layer == layers.end()) layer = layers.insert(prefix.empty() ? layers.begin() : layers.end(), {prefix});
        layer->names.push_back(name);
    }
    return layers;
}

/// Chooses the channels to read, in this order: for a normal map, vectors of the only layer named like normals; vectors
/// without a layer; vectors of the only layer named like normals, or of the only layer that has any; a single channel.
std::optional<ExrChannels> chooseExrChannels(std::span<const std::string_view> names, ImageUse use, std::string& why) {
    const std::vector<ExrLayer> layers = exrLayers(names);
    std::vector<ExrChannels> found;
    std::vector<std::size_t> of_normals;
    bool has_root = false;
    for (const ExrLayer& layer : layers) {
        const std::optional<ExrChannels> vectors = layer.vectors();
        if (!vectors) continue;
        has_root = has_root || layer.prefix.empty();
        if (isNamedNormal(layer.prefix)) of_normals.push_back(found.size());
        found.push_back(*vectors);
    }
    std::optional<std::size_t> chosen;
    if (has_root || found.size() == 1) chosen = 0;  // channels without a layer are the first
    if (of_normals.size() == 1 && (use == ImageUse::vectors || !has_root)) chosen = of_normals.front();
    if (chosen) {
        ExrChannels channels = found[*chosen];
        for (std::size_t i = 0; i < found.size(); ++i) {
            if (i != *chosen) channels.others.append(channels.others.empty() ? "" : "; ").append(found[i].text());
        }
        return channels;
    }
    if (found.empty() && layers.size() == 1) {
        if (std::optional<ExrChannels> heights = layers.front().heights()) return heights;
    }
    std::string list;
    for (const std::string_view name : names) list.append(list.empty() ? "" : ", ").append(name);
    why = found.empty()
              ? "the EXR must have the channels R, G and B, or X, Y and Z, or a single channel, but it has " + list
              : "several layers of the EXR contain vectors, and not exactly one of them is named normal: " + list;
    return {};
}

class ExrReader {
  public:
    ExrReader(ByteSpan bytes, const ExrHeader& head, ImageUse use, std::string& why)
        : bytes_(bytes), size_(head.size), use_(use), why_(why) {}

    std::optional<FloatImage> read() {
        if (!open() || !checkWindows() || !findChannels()) return {};
        image_ = {size_.width, size_.height, bits_, std::vector<Vec3>(size_.pixels()), {}};
        if (!channels_.alpha.empty()) image_.alpha.resize(size_.pixels());
        why_ = "the EXR is damaged";
        exr_storage_t storage = EXR_STORAGE_LAST_TYPE;
        openExr().getStorage(file_.context, kPart, &storage);
        if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED) return {};
        if (!(storage == EXR_STORAGE_TILED ? readTiles() : readRows())) return {};
        finish();
        return std::move(image_);
    }

  private:
    bool open() {
        why_ = "the EXR is damaged";
        exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
        setup.error_handler_fn = ignoreError;
        setup.alloc_fn = trackedMalloc;
        setup.free_fn = std::free;
        setup.user_data = &bytes_;
        setup.read_fn = readExrBytes;
        setup.size_fn = exrByteCount;
        setup.max_image_width = static_cast<int>(size_.width);
        setup.max_image_height = static_cast<int>(size_.height);
        setup.flags = EXR_CONTEXT_FLAG_SILENT_HEADER_PARSE | EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
        return openExr().startRead(&file_.context, "image.exr", &setup) == EXR_ERR_SUCCESS;
    }

    bool checkWindows() {
        exr_attr_box2i_t display{};
        if (openExr().getDataWindow(file_.context, kPart, &window_) != EXR_ERR_SUCCESS ||
            openExr().getDisplayWindow(file_.context, kPart, &display) != EXR_ERR_SUCCESS ||
            std::int64_t{window_.max.x} - window_.min.x + 1 != size_.width ||
            std::int64_t{window_.max.y} - window_.min.y + 1 != size_.height) {
            return false;
        }
        why_ = "the EXR does not store the whole picture: its dataWindow differs from its displayWindow";
        return std::memcmp(&window_, &display, sizeof display) == 0;
    }

    bool findChannels() {
        const exr_attr_chlist_t* list = nullptr;
        if (openExr().getChannels(file_.context, kPart, &list) != EXR_ERR_SUCCESS || list == nullptr) return false;
        const std::span entries(list->entries, static_cast<std::size_t>(std::max(list->num_channels, 0)));
        std::vector<std::string_view> names;
        for (const exr_attr_chlist_entry_t& entry : entries)
            names.emplace_back(entry.name.str, static_cast<std::size_t>(std::max(entry.name.length, 0)));
        const std::optional<ExrChannels> chosen = chooseExrChannels(names, use_, why_);
        if (!chosen) return false;
        channels_ = *chosen;
        bits_ = 16;
        std::size_t whole = 0, used = 0;
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (!channels_.has(names[i])) continue;
            const exr_attr_chlist_entry_t& entry = entries[i];
            why_ = "the EXR has subsampled channels, which are not supported";
            if (entry.x_sampling != 1 || entry.y_sampling != 1) return false;
            if (entry.pixel_type == EXR_PIXEL_FLOAT) bits_ = 32;
            whole += entry.pixel_type == EXR_PIXEL_UINT ? 1 : 0;
            ++used;
        }
        why_ = "some channels of the EXR contain floats and others integers; write one type for all channels";
        is_whole_ = whole == used;
        return whole == 0 || is_whole_;
    }

    bool readRows() {
        std::int32_t step = 0;
        if (openExr().getScanlinesPerChunk(file_.context, kPart, &step) != EXR_ERR_SUCCESS || step <= 0) return false;
        for (std::uint32_t row = 0; row < size_.height; row += static_cast<std::uint32_t>(step)) {
            exr_chunk_info_t chunk{};
            const auto y = static_cast<int>(window_.min.y + std::int64_t{row});
            if (openExr().readScanlineChunkInfo(file_.context, kPart, y, &chunk) != EXR_ERR_SUCCESS ||
                !readChunk(chunk, 0, row)) {
                return false;
            }
        }
        return true;
    }

    bool readTiles() {
        std::int32_t width = 0, height = 0;
        if (openExr().getTileSizes(file_.context, kPart, 0, 0, &width, &height) != EXR_ERR_SUCCESS || width <= 0 ||
            height <= 0) {
            return false;
        }
        const auto columns = static_cast<std::uint32_t>(width), rows = static_cast<std::uint32_t>(height);
        for (std::uint32_t y = 0; y < size_.height; y += rows) {
            for (std::uint32_t x = 0; x < size_.width; x += columns) {
                exr_chunk_info_t chunk{};
                if (openExr().readTileChunkInfo(file_.context, kPart, static_cast<int>(x / columns),
                                                static_cast<int>(y / rows), 0, 0, &chunk) != EXR_ERR_SUCCESS ||
                    !readChunk(chunk, x, y)) {
                    return false;
                }
            }
        }
        return true;
    }

    /// Decodes a chunk into the image, with the chunk's upper left corner at (x, y).
    bool readChunk(const exr_chunk_info_t& chunk, std::uint32_t x, std::uint32_t y) {
        if (chunk.width <= 0 || chunk.height <= 0 || static_cast<std::uint32_t>(chunk.width) > size_.width - x ||
            static_cast<std::uint32_t>(chunk.height) > size_.height - y) {
            return false;
        }
        exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
        if (openExr().decodingInitialize(file_.context, kPart, &chunk, &pipeline) != EXR_ERR_SUCCESS) return false;
        const std::size_t first = std::size_t{y} * size_.width + x;
        for (int i = 0; i < pipeline.channel_count; ++i) aim(pipeline.channels[i], first);
        const bool is_fine =
            openExr().decodingChooseDefaultRoutines(file_.context, kPart, &pipeline) == EXR_ERR_SUCCESS &&
            openExr().decodingRun(file_.context, kPart, &pipeline) == EXR_ERR_SUCCESS;
        openExr().decodingDestroy(file_.context, &pipeline);
        return is_fine;
    }

    void aim(exr_coding_channel_info_t& channel, std::size_t first) {
        float* to = nullptr;
        std::size_t pixel_bytes = sizeof(Vec3);
        const std::string_view name = channel.channel_name;
        if (name == channels_.colors[0]) to = &image_.texels[first].x;
        if (name == channels_.colors[1]) to = &image_.texels[first].y;
        if (name == channels_.colors[2]) to = &image_.texels[first].z;
        if (name == channels_.alpha) {
            to = &image_.alpha[first];
            pixel_bytes = sizeof(float);
        }
        channel.decode_to_ptr = reinterpret_cast<std::uint8_t*>(to);
        channel.user_bytes_per_element = sizeof(float);
        channel.user_data_type = EXR_PIXEL_FLOAT;
        channel.user_pixel_stride = static_cast<std::int32_t>(pixel_bytes);
        channel.user_line_stride = static_cast<std::int32_t>(pixel_bytes * size_.width);
    }

    void finish() {
        if (is_whole_) scaleWhole();
        if (channels_.colors[1].empty()) {
            for (Vec3& texel : image_.texels) texel = {texel.x, texel.x, texel.x};
        } else if (channels_.colors[2].empty()) {
            image_.texture.layout = twoChannelLayout(MapChannel::red, MapChannel::green);
        }
        if (channels_.isUnusual()) image_.texture.name = "an EXR with the channels " + channels_.text();
        if (!channels_.others.empty())
            image_.layer_text = "the EXR has several layers: the channels " + channels_.text() +
                                " were read, and not those of other layers (" + channels_.others + ")";
        readFloats(is_whole_ ? ImageUse::numbers : use_, image_);
    }

    /// Scales integers n to n / (2^b - 1), with the smallest b of 8, 16 and 32 that fits all of them.
    void scaleWhole() {
        float most = 0;
        for (const Vec3& texel : image_.texels) most = std::max({most, texel.x, texel.y, texel.z});
        image_.bits = most <= 255 ? 8 : most <= 65535 ? 16 : 32;
        const float scale = image_.bits == 8 ? 255.0F : image_.bits == 16 ? 65535.0F : 4294967295.0F;
        for (Vec3& texel : image_.texels) texel = {texel.x / scale, texel.y / scale, texel.z / scale};
        for (float& alpha : image_.alpha) alpha = std::min(alpha / scale, 1.0F);
    }

    ByteSpan bytes_;
    ImageSize size_;
    ImageUse use_;
    std::string& why_;
    ExrContext file_ = {};
    exr_attr_box2i_t window_ = {};
    ExrChannels channels_ = {};
    bool is_whole_ = false;
    unsigned bits_ = 16;
    FloatImage image_ = {};
};

std::int64_t writeExrBytes(exr_const_context_t, void* data, const void* buffer, std::uint64_t size,
                           std::uint64_t offset, exr_stream_error_func_ptr_t) {
    auto& bytes = *static_cast<std::vector<std::uint8_t>*>(data);
    try {
        if (bytes.size() < offset + size) bytes.resize(offset + size);
    } catch (const std::bad_alloc&) {
        return -1;
    }
    if (size > 0) std::memcpy(bytes.data() + offset, buffer, size);
    return static_cast<std::int64_t>(size);
}

bool addExrChannels(exr_context_t file, bool has_alpha, exr_pixel_type_t type) {
    for (const char* name : {"A", "B", "G", "R"}) {
        if (*name == 'A' && !has_alpha) continue;
        if (openExr().addChannel(file, kPart, name, type, EXR_PERCEPTUALLY_LINEAR, 1, 1) != EXR_ERR_SUCCESS)
            return false;
    }
    return true;
}

/// Writes one chunk of rows, starting at `row`, with channels B, G, R and optionally A; fewer rows at the end of the
/// image.
bool writeExrRows(exr_context_t file, const FloatImage& image, std::uint32_t row) {
    exr_chunk_info_t chunk{};
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    if (openExr().writeScanlineChunkInfo(file, kPart, static_cast<int>(row), &chunk) != EXR_ERR_SUCCESS ||
        openExr().encodingInitialize(file, kPart, &chunk, &pipeline) != EXR_ERR_SUCCESS) {
        return false;
    }
    const std::size_t first = std::size_t{row} * image.width;
    for (int i = 0; i < pipeline.channel_count; ++i) {
        exr_coding_channel_info_t& channel = pipeline.channels[i];
        const char name = channel.channel_name[0];
        const float* const from = name == 'A'   ? &image.alpha[first]
                                  : name == 'B' ? &image.texels[first].z
                                  : name == 'G' ? &image.texels[first].y
                                                : &image.texels[first].x;
        const std::size_t pixel_bytes = name == 'A' ? sizeof(float) : sizeof(Vec3);
        channel.encode_from_ptr = reinterpret_cast<const std::uint8_t*>(from);
        channel.user_bytes_per_element = sizeof(float);
        channel.user_data_type = EXR_PIXEL_FLOAT;
        channel.user_pixel_stride = static_cast<std::int32_t>(pixel_bytes);
        channel.user_line_stride = static_cast<std::int32_t>(pixel_bytes * image.width);
    }
    const bool is_fine = openExr().encodingChooseDefaultRoutines(file, kPart, &pipeline) == EXR_ERR_SUCCESS &&
                         openExr().encodingRun(file, kPart, &pipeline) == EXR_ERR_SUCCESS;
    openExr().encodingDestroy(file, &pipeline);
    return is_fine;
}

}  // namespace

bool hasOpenExr() { return openExr().is_loaded; }

ImageClaim claimOfExr(ByteSpan bytes) {
    const std::optional<ExrHeader> head = ExrHeaderReader(bytes).read();
    if (!head) return {};
    // Memory of the pixels, and of the compressed, decompressed and intermediate data of one chunk with 4 bytes per
    // channel.
    constexpr std::uint64_t kMax = std::uint64_t{1} << 60;
    const double work = 16.0 * static_cast<double>(head->size.pixels()) +
                        16.0 * static_cast<double>(head->chunk_pixels) * static_cast<double>(head->channel_count);
    return {head->size, work < static_cast<double>(kMax) ? static_cast<std::uint64_t>(work) : kMax};
}

std::optional<FloatImage> decodeExr(ByteSpan bytes, std::uint64_t most_pixels, std::string& why, ImageUse use) {
    constexpr std::uint64_t kMaxChannels = 64;
    why = "the EXR is damaged";
    const std::optional<ExrHeader> head = ExrHeaderReader(bytes).read();
    if (!head || isTooLarge(head->size, bytes.size(), most_pixels, why)) return {};
    if (head->channel_count > kMaxChannels) why = "the EXR has more channels than tspace supports";
    if (head->has_more) why = "the EXR has several parts or deep pixels, which are not supported";
    if (!head->is_plain) why = "the EXR uses lossy compression (B44 or DWA), which is not supported";
    if (head->channel_count > kMaxChannels || head->has_more || !head->is_plain) return {};
    return orOutOfMemory([&] { return ExrReader(bytes, *head, use, why).read(); });
}

std::optional<std::vector<std::uint8_t>> encodeExr(const FloatImage& image, unsigned bits) {
    constexpr std::uint32_t kRowsOfChunk = 16;  // rows of a chunk of EXR_COMPRESSION_ZIP
    std::vector<std::uint8_t> bytes;
    ExrContext file;
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.error_handler_fn = ignoreError;
    setup.alloc_fn = trackedMalloc;
    setup.free_fn = std::free;
    setup.user_data = &bytes;
    setup.write_fn = writeExrBytes;
    int part = kPart;
    if (openExr().startWrite(&file.context, "image.exr", EXR_WRITE_FILE_DIRECTLY, &setup) != EXR_ERR_SUCCESS ||
        openExr().addPart(file.context, "map", EXR_STORAGE_SCANLINE, &part) != EXR_ERR_SUCCESS ||
        openExr().initializeRequiredAttrSimple(file.context, kPart, static_cast<std::int32_t>(image.width),
                                               static_cast<std::int32_t>(image.height),
                                               EXR_COMPRESSION_ZIP) != EXR_ERR_SUCCESS ||
        !addExrChannels(file.context, !image.alpha.empty(), bits == 32 ? EXR_PIXEL_FLOAT : EXR_PIXEL_HALF) ||
        openExr().writeHeader(file.context) != EXR_ERR_SUCCESS) {
        return {};
    }
    for (std::uint32_t row = 0; row < image.height; row += kRowsOfChunk) {
        if (!writeExrRows(file.context, image, row)) return {};
    }
    if (!file.finish()) return {};
    return bytes;
}

}  // namespace tspace
