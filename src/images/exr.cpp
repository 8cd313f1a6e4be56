// SPDX-License-Identifier: MIT
// EXR by OpenEXR's C library, which is loaded when the first such image comes.
#include <openexr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

#include "images/codecs.h"
#include "images/float_image.h"
#include "images/loaded_library.h"

namespace tspace {

namespace {

/// The fields of the header that are needed before the library reads the file.
struct ExrHead {
    ImageSize size = {};
    std::uint64_t channel_count = 0, chunk_pixels = 0;
    bool has_more = false;  ///< several parts, or several values a pixel
    bool is_plain = false;  ///< packed in a way that every reader has long had
};

class ExrHeadReader {
  public:
    explicit ExrHeadReader(ByteSpan bytes) : bytes_(bytes) {}

    /// Nothing for a broken head.
    std::optional<ExrHead> read() {
        at_ = 4;  // behind the magic number
        ExrHead head;
        constexpr std::uint32_t kDeepOrParts = 0x1800;
        head.has_more = (number() & kDeepOrParts) != 0;
        std::uint64_t tile_pixels = 0;
        for (std::string_view name = text(); !name.empty(); name = text()) {
            text();  // its type
            const std::uint64_t size = number(), begin = at_;
            if (failed_ || size > bytes_.size() - at_) return {};
            if (name == "dataWindow" && size == 16) head.size = readWindow();
            if (name == "compression" && size == 1) head.is_plain = bytes_[begin] <= EXR_COMPRESSION_PXR24;
            if (name == "channels") head.channel_count = countChannels(begin + size);
            if (name == "tiles" && size >= 8) tile_pixels = readTile();
            at_ = begin + size;
        }
        if (failed_ || head.size.pixels() == 0) return {};
        constexpr std::uint64_t kMostRows = 256;  // of a chunk, with any compression
        const std::uint64_t rows = head.size.width * std::min<std::uint64_t>(kMostRows, head.size.height);
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
            constexpr std::int64_t kMost = std::int64_t{1} << 30;  // no product overflows
            return static_cast<std::uint32_t>(std::clamp<std::int64_t>(last - first + 1, 0, kMost));
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

/// The functions of the library that is there at run time.
struct OpenExr {
    LoadedLibrary library = LoadedLibrary(TSPACE_OPENEXR_LIBRARY);
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

class ExrReader {
  public:
    ExrReader(ByteSpan bytes, const ExrHead& head, std::string& why) : bytes_(bytes), size_(head.size), why_(why) {}

    std::optional<FloatImage> read() {
        if (!open() || !checkWindows() || !findChannels()) return {};
        image_ = {size_.width, size_.height, bits_, std::vector<Vec3>(size_.pixels()), {}};
        if (has_alpha_) image_.alpha.resize(size_.pixels());
        why_ = "it is a broken EXR";
        exr_storage_t storage = EXR_STORAGE_LAST_TYPE;
        openExr().getStorage(file_.context, kPart, &storage);
        if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED) return {};
        if (!(storage == EXR_STORAGE_TILED ? readTiles() : readRows())) return {};
        replaceNotFinite();
        return std::move(image_);
    }

  private:
    bool open() {
        why_ = "it is a broken EXR";
        exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
        setup.error_handler_fn = ignoreError;
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
        why_ = "its pixels are not those of the whole picture (dataWindow is not displayWindow)";
        return std::memcmp(&window_, &display, sizeof display) == 0;
    }

    /// R, G and B, or X, Y and Z, and perhaps A.
    bool findChannels() {
        const exr_attr_chlist_t* list = nullptr;
        if (openExr().getChannels(file_.context, kPart, &list) != EXR_ERR_SUCCESS || list == nullptr) return false;
        const auto find = [&](std::string_view name) {
            const auto* end = list->entries + list->num_channels;
            const auto* found = std::find_if(list->entries, end, [&](const exr_attr_chlist_entry_t& entry) {
                const auto size = static_cast<std::size_t>(std::max(entry.name.length, 0));
                return std::string_view(entry.name.str, size) == name;
            });
            return found != end ? found : nullptr;
        };
        names_ = find("R") != nullptr ? std::array{"R", "G", "B"} : std::array{"X", "Y", "Z"};
        has_alpha_ = find("A") != nullptr;
        bits_ = 16;
        for (const char* name : {names_[0], names_[1], names_[2], "A"}) {
            const exr_attr_chlist_entry_t* entry = find(name);
            if (entry == nullptr && *name == 'A') continue;
            why_ = "it has no channels R, G and B";
            if (entry == nullptr) return false;
            why_ = "its channels are not floats, one for each pixel";
            if (entry->pixel_type == EXR_PIXEL_UINT || entry->x_sampling != 1 || entry->y_sampling != 1) return false;
            if (entry->pixel_type == EXR_PIXEL_FLOAT) bits_ = 32;
        }
        return true;
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

    /// Puts the chunk's pixels where its corner (x, y) is in the image.
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
        if (name == names_[0]) to = &image_.texels[first].x;
        if (name == names_[1]) to = &image_.texels[first].y;
        if (name == names_[2]) to = &image_.texels[first].z;
        if (name == "A") {
            to = &image_.alpha[first];
            pixel_bytes = sizeof(float);
        }
        channel.decode_to_ptr = reinterpret_cast<std::uint8_t*>(to);
        channel.user_bytes_per_element = sizeof(float);
        channel.user_data_type = EXR_PIXEL_FLOAT;
        channel.user_pixel_stride = static_cast<std::int32_t>(pixel_bytes);
        channel.user_line_stride = static_cast<std::int32_t>(pixel_bytes * size_.width);
    }

    /// Counts texels that are not finite, which have no direction, and makes them grey.
    void replaceNotFinite() {
        for (Vec3& texel : image_.texels) {
            if (std::isfinite(texel.x) && std::isfinite(texel.y) && std::isfinite(texel.z)) continue;
            texel = {0.5F, 0.5F, 0.5F};
            ++image_.not_finite;
        }
        for (float& alpha : image_.alpha) {
            if (!std::isfinite(alpha)) alpha = 1;
        }
    }

    ByteSpan bytes_;
    ImageSize size_;
    std::string& why_;
    ExrContext file_ = {};
    exr_attr_box2i_t window_ = {};
    std::array<const char*, 3> names_ = {};
    bool has_alpha_ = false;
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

/// Rows of the image from `row` on, as channels B, G, R and perhaps A; the rows that there are, where it ends.
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
    const std::optional<ExrHead> head = ExrHeadReader(bytes).read();
    if (!head) return {};
    // The pixels, and of one chunk what is packed, unpacked and between, 4 bytes a channel each.
    constexpr std::uint64_t kMost = std::uint64_t{1} << 60;
    const double work = 16.0 * static_cast<double>(head->size.pixels()) +
                        16.0 * static_cast<double>(head->chunk_pixels) * static_cast<double>(head->channel_count);
    return {head->size, work < static_cast<double>(kMost) ? static_cast<std::uint64_t>(work) : kMost};
}

std::optional<FloatImage> decodeExr(ByteSpan bytes, std::uint64_t most_pixels, std::string& why) {
    constexpr std::uint64_t kMostChannels = 64;
    why = "it is a broken EXR";
    const std::optional<ExrHead> head = ExrHeadReader(bytes).read();
    if (!head || isTooLarge(head->size, bytes.size(), most_pixels, why)) return {};
    if (head->channel_count > kMostChannels) why = "it has more channels than are looked at";
    if (head->has_more) why = "it has several parts, or several values a pixel";
    if (!head->is_plain) why = "it is packed with loss (B44 or DWA), which is not read";
    if (head->channel_count > kMostChannels || head->has_more || !head->is_plain) return {};
    return ExrReader(bytes, *head, why).read();
}

std::optional<std::vector<std::uint8_t>> encodeExr(const FloatImage& image, unsigned bits) {
    constexpr std::uint32_t kRowsOfChunk = 16;  // of EXR_COMPRESSION_ZIP
    std::vector<std::uint8_t> bytes;
    ExrContext file;
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.error_handler_fn = ignoreError;
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
