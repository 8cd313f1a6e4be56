// SPDX-License-Identifier: MIT
// Parses the header of a KTX2 file, according to the Khronos KTX File Format Specification 2.0.
#include <algorithm>
#include <iterator>
#include <string_view>

#include "images/layout_guess.h"
#include "images/textures/texture_file.h"

namespace tspace {
namespace {

/// A texel format with its Vulkan format number, and whether that number is an sRGB format.
struct VulkanFormat {
    std::uint16_t number;
    TexelKind kind;
    bool is_srgb = false;
};
constexpr VulkanFormat kVulkanFormats[] = {
    {9, TexelKind::r8},           {10, TexelKind::r8s},         {15, TexelKind::r8, true},
    {16, TexelKind::rg8},         {17, TexelKind::rg8s},        {22, TexelKind::rg8, true},
    {23, TexelKind::rgb8},        {24, TexelKind::rgb8s},       {29, TexelKind::rgb8, true},
    {30, TexelKind::bgr8},        {36, TexelKind::bgr8, true},  {37, TexelKind::rgba8},
    {38, TexelKind::rgba8s},      {43, TexelKind::rgba8, true}, {44, TexelKind::bgra8},
    {50, TexelKind::bgra8, true}, {64, TexelKind::rgb10a2},     {70, TexelKind::r16},
    {71, TexelKind::r16s},        {76, TexelKind::r16f},        {77, TexelKind::rg16},
    {78, TexelKind::rg16s},       {83, TexelKind::rg16f},       {84, TexelKind::rgb16},
    {85, TexelKind::rgb16s},      {90, TexelKind::rgb16f},      {91, TexelKind::rgba16},
    {92, TexelKind::rgba16s},     {97, TexelKind::rgba16f},     {100, TexelKind::r32f},
    {103, TexelKind::rg32f},      {106, TexelKind::rgb32f},     {109, TexelKind::rgba32f},
    {131, TexelKind::bc1},        {132, TexelKind::bc1, true},  {133, TexelKind::bc1},
    {134, TexelKind::bc1, true},  {135, TexelKind::bc2},        {136, TexelKind::bc2, true},
    {137, TexelKind::bc3},        {138, TexelKind::bc3, true},  {139, TexelKind::bc4},
    {140, TexelKind::bc4s},       {141, TexelKind::bc5},        {142, TexelKind::bc5s},
    {145, TexelKind::bc7},        {146, TexelKind::bc7, true},  {153, TexelKind::eacR},
    {154, TexelKind::eacRs},      {155, TexelKind::eacRg},      {156, TexelKind::eacRgs}};

/// Data format descriptor: describes the texels in addition to Vulkan's format number.
struct Description {
    std::uint32_t model = 0, transfer = 0;
    std::uint32_t samples = 0, channel = 0,
                  second_channel = 0;  ///< number of samples, and the channels of the first two
};

class Ktx2Reader {
  public:
    explicit Ktx2Reader(ByteSpan bytes) : bytes_(bytes) {}

    Result<TextureFile> read() {
        constexpr std::size_t kHeadBytes = 80;
        constexpr std::uint8_t kIdentifier[] = {0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n'};
        if (bytes_.size() < kHeadBytes || !std::equal(std::begin(kIdentifier), std::end(kIdentifier), bytes_.begin()))
            return why_;
        texture_.container = "KTX2";
        texture_.size = {std::min(number(20), kMaxTextureSide), std::min(number(24), kMaxTextureSide)};
        if (texture_.size.pixels() == 0 || !isPicture() || !readDescription() || !findFormat() || !findRepacking() ||
            !findLevel())
            return why_;
        readValues();
        return std::move(texture_);
    }

  private:
    static Error damaged() { return {ErrorCode::invalidFile, "the KTX2 is damaged"}; }
    static Error unsupported(std::string why) { return {ErrorCode::unsupportedFile, std::move(why)}; }

    [[nodiscard]] std::uint32_t number(std::size_t at) const { return little32(bytes_.data() + at); }

    /// Returns `count` bytes from `at` on; nullopt if they exceed the file.
    [[nodiscard]] std::optional<ByteSpan> part(std::uint64_t at, std::uint64_t count) const {
        if (at > bytes_.size() || count > bytes_.size() - at) return {};
        return bytes_.subspan(static_cast<std::size_t>(at), static_cast<std::size_t>(count));
    }

    bool isPicture() {
        const std::uint32_t depth = number(28), layers = number(32), faces = number(36);
        if (depth > 1) why_ = unsupported("the KTX2 is three-dimensional, not a single image");
        if (layers > 1) why_ = unsupported("the KTX2 is an array of several images");
        if (faces == 6) why_ = unsupported("the KTX2 is a cube map, not a single image");
        return depth <= 1 && layers <= 1 && faces == 1;
    }

    /// Reads the first block of the data format descriptor, and the first two of its samples.
    bool readDescription() {
        constexpr std::size_t kHead = 4, kBlock = 24, kSample = 16, kChannelAt = kHead + kBlock + 3;
        const std::optional<ByteSpan> data = part(number(48), number(52));
        if (!data || data->size() < kHead + kBlock) return false;
        description_ = {.model = (*data)[12], .transfer = (*data)[14]};
        description_.samples = static_cast<std::uint32_t>((data->size() - kHead - kBlock) / kSample);
        if (description_.samples > 0) description_.channel = (*data)[kChannelAt] & 15;
        if (description_.samples > 1) description_.second_channel = (*data)[kChannelAt + kSample] & 15;
        return true;
    }

    bool findFormat() {
        constexpr std::uint32_t kEtc1s = 163, kUastc = 166, kUastcHdr = 167, kAstc = 162, kSrgb = 2;
        const std::uint32_t vulkan = number(12);
        texture_.is_srgb = description_.transfer == kSrgb;
        const auto* const found = std::find_if(std::begin(kVulkanFormats), std::end(kVulkanFormats),
                                               [&](const VulkanFormat& format) { return format.number == vulkan; });
        if (found != std::end(kVulkanFormats)) {
            texture_.format = texelFormat(found->kind);
            texture_.is_srgb = texture_.is_srgb || found->is_srgb;
            if (texture_.format.channels == 2) setChannels(0, 1);
            return true;
        }
        if (vulkan == 0 && description_.model == kUastc) {
            constexpr std::uint32_t kRrrg = 5, kRg = 6;
            texture_.format = texelFormat(TexelKind::uastc);
            if (description_.channel == kRrrg) setChannels(0, 3);
            if (description_.channel == kRg) setChannels(0, 1);
            return true;
        }
        if (vulkan == 0 && description_.model == kEtc1s) {
            constexpr std::uint32_t kRed = 3, kGreen = 4;
            texture_.format = texelFormat(description_.samples > 1 ? TexelKind::etc1sAlpha : TexelKind::etc1s);
            if (description_.channel == kRed && description_.second_channel == kGreen) setChannels(0, 3);
            return true;
        }
        if (findAstc(vulkan)) return true;
        why_ = unsupported("the KTX2 has the Vulkan format " + std::to_string(vulkan) + ", which is not supported");
        if (description_.model == kAstc && whyNotAstc() != nullptr) why_ = unsupported(whyNotAstc());
        if (description_.model == kUastcHdr) why_ = unsupported("the KTX2 contains UASTC HDR, which is not supported");
        return false;
    }

    /// Finds an ASTC format. Vulkan has a linear and an sRGB format number for each block size, in this order.
    bool findAstc(std::uint32_t vulkan) {
        constexpr std::uint32_t kFirst = 157;
        constexpr std::uint8_t kSizes[][2] = {{4, 4}, {5, 4},  {5, 5},  {6, 5},  {6, 6},   {8, 5},   {8, 6},
                                              {8, 8}, {10, 5}, {10, 6}, {10, 8}, {10, 10}, {12, 10}, {12, 12}};
        if (vulkan < kFirst || (vulkan - kFirst) / 2 >= std::size(kSizes) || whyNotAstc() != nullptr) return false;
        texture_.format = texelFormat(TexelKind::astc);
        texture_.format.width = kSizes[(vulkan - kFirst) / 2][0];
        texture_.format.height = kSizes[(vulkan - kFirst) / 2][1];
        texture_.is_srgb = texture_.is_srgb || (vulkan - kFirst) % 2 != 0;
        return true;
    }

    bool findRepacking() {
        constexpr std::uint32_t kPlain = 0, kBasisLz = 1, kZstd = 2, kZlib = 3;
        const std::uint32_t scheme = number(44);
        const bool is_etc1s = texture_.format.decode == decodeEtc1s;
        if (is_etc1s != (scheme == kBasisLz)) return false;
        if (is_etc1s) return findGlobalData();
        if (scheme != kPlain && scheme != kZstd && scheme != kZlib) {
            why_ = unsupported("the KTX2 uses the supercompression scheme " + std::to_string(scheme) +
                               ", which is not supported");
            return false;
        }
        if (scheme == kZstd) texture_.repacking = Repacking::zstd;
        if (scheme == kZlib) texture_.repacking = Repacking::zlib;
        if (const char* why_not = whyNotUnpacked(texture_.repacking)) {
            why_ = unsupported(why_not);
            return false;
        }
        return true;
    }

    bool findGlobalData() {
        texture_.repacking = Repacking::basisLz;
        const std::optional<ByteSpan> data = part(little64(bytes_.data() + 64), little64(bytes_.data() + 72));
        if (data) texture_.global = *data;
        return data.has_value();
    }

    /// Lists the levels, and checks that they follow the header and do not overlap.
    bool findLevel() {
        constexpr std::size_t kHeadBytes = 80, kEntry = 24, kMaxLevels = 31;
        const std::size_t count = std::max<std::uint32_t>(number(40), 1);
        if (count > kMaxLevels || !part(kHeadBytes, kEntry * count)) return false;
        struct Range {
            std::uint64_t begin, count;
        };
        std::vector<Range> ranges;
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint8_t* const entry = bytes_.data() + kHeadBytes + kEntry * i;
            const Range range{little64(entry), little64(entry + 8)};
            const std::uint64_t unpacked = little64(entry + 16);
            const auto size = [&](std::uint32_t side) { return std::max<std::uint32_t>(side >> i, 1); };
            const std::uint64_t wanted = texture_.format.bytesOf(size(texture_.size.width), size(texture_.size.height));
            if (range.begin < kHeadBytes + kEntry * count || !part(range.begin, range.count)) return false;
            // BasisLZ does not declare the uncompressed size.
            if (unpacked != wanted && texture_.repacking != Repacking::basisLz) return false;
            if (texture_.repacking == Repacking::none && range.count != wanted) return false;
            ranges.push_back(range);
            texture_.levels.push_back({static_cast<std::size_t>(range.begin), static_cast<std::size_t>(range.count)});
        }
        texture_.level = *part(ranges.front().begin, ranges.front().count);
        std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) { return a.begin < b.begin; });
        for (std::size_t i = 1; i < count; ++i) {
            if (ranges[i].begin - ranges[i - 1].begin < ranges[i - 1].count) return false;
        }
        return true;
    }

    /// Reads the key/value data, of which orientation and swizzle are used. Invalid entries are ignored.
    void readValues() {
        const std::optional<ByteSpan> data = part(number(56), number(60));
        if (!data) return;
        for (std::size_t at = 0; at + 4 <= data->size();) {
            const std::size_t count = little32(data->data() + at);
            at += 4;
            if (count > data->size() - at) return;
            const std::string_view pair(reinterpret_cast<const char*>(data->data()) + at, count);
            const std::size_t end = pair.find('\0');
            if (end != std::string_view::npos) readValue(pair.substr(0, end), pair.substr(end + 1));
            at += (count + 3) / 4 * 4;
        }
    }

    void readValue(std::string_view key, std::string_view value) {
        if (key == "KTXorientation" && value.size() >= 2) {
            texture_.turns_columns = value[0] == 'l';
            texture_.turns_rows = value[1] == 'u';
        }
        constexpr std::string_view kNames = "rgba01";
        if (key != "KTXswizzle" || value.size() < 4) return;
        std::array<std::uint8_t, 4> swizzle{};
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t found = kNames.find(value[i]);
            if (found == std::string_view::npos) return;
            swizzle[i] = static_cast<std::uint8_t>(found);
        }
        texture_.swizzle = swizzle;
        // The swizzle uses only two of the four channels, so these contain x and y.
        if (swizzle[0] < 4 && swizzle[1] < 4 && swizzle[2] == TextureFile::kZero && swizzle[3] == TextureFile::kOne) {
            x_ = swizzle[0];
            y_ = swizzle[1];
        }
        if (x_ != y_) setChannels(x_, y_);
    }

    /// Sets the channels of the format that contain x and y, and finds the output colors that the swizzle maps them to.
    void setChannels(std::uint8_t x, std::uint8_t y) {
        x_ = x;
        y_ = y;
        const auto& shown = texture_.swizzle;
        const auto at_x = std::find(shown.begin(), shown.end(), x), at_y = std::find(shown.begin(), shown.end(), y);
        texture_.layout = {};
        if (at_x == shown.end() || at_y == shown.end()) return;
        texture_.layout = twoChannelLayout(static_cast<MapChannel>(at_x - shown.begin()),
                                           static_cast<MapChannel>(at_y - shown.begin()));
    }

    ByteSpan bytes_;
    Error why_ = damaged();
    TextureFile texture_ = {};
    Description description_ = {};
    std::uint8_t x_ = 0, y_ = 0;
};

}  // namespace

Result<TextureFile> readKtx2Header(ByteSpan bytes) { return Ktx2Reader(bytes).read(); }

}  // namespace tspace
