// SPDX-License-Identifier: MIT
// BasisLZ supercompression of ETC1S: two codebooks shared by all levels, and codebook indices per block. See Khronos
// KTX File Format Specification 2.0, appendix BasisLZ/ETC1S.
#include <algorithm>
#include <array>

#include "images/textures/texture_file.h"

namespace tspace {
namespace {

/// Reads bits, starting with the lowest bit of each byte. After the end of the data it returns zeros and sets a flag.
class BasisBits {
  public:
    explicit BasisBits(ByteSpan bytes) : bytes_(bytes) {}

    std::uint32_t take(unsigned count) {
        std::uint32_t value = 0;
        for (unsigned i = 0; i < count; ++i) value |= bit() << i;
        return value;
    }
    std::uint32_t bit() {
        const std::size_t byte = at_ >> 3;
        if (byte >= bytes_.size()) {
            has_failed_ = true;
            return 0;
        }
        const std::uint32_t value = bytes_[byte] >> (at_ & 7) & 1U;
        ++at_;
        return value;
    }
    /// Reads a number in groups of `count` bits, each followed by a bit that tells whether another group follows.
    std::uint32_t takeParts(unsigned count) {
        std::uint32_t value = 0;
        for (unsigned at = 0; at < 32; at += count) {
            const std::uint32_t part = take(count + 1);
            value |= (part & ((1U << count) - 1)) << at;
            if (part >> count == 0) break;
        }
        return value;
    }
    void fail() { has_failed_ = true; }
    [[nodiscard]] bool hasFailed() const { return has_failed_; }

  private:
    ByteSpan bytes_;
    std::size_t at_ = 0;
    bool has_failed_ = false;
};

/// Canonical Huffman code as in Deflate (RFC 1951, 3.2.2), with up to 16 bits.
class HuffmanCode {
  public:
    HuffmanCode() = default;
    /// `lengths`: code length of each symbol; 0: unused.
    HuffmanCode(std::span<const std::uint8_t> lengths, BasisBits& bits) {
        for (const std::uint8_t length : lengths) ++counts_[length];
        counts_[0] = 0;
        std::uint32_t left = 1;
        std::array<std::uint32_t, kMax + 2> begins{};
        for (std::size_t length = 1; length <= kMax; ++length) {
            left <<= 1;
            if (counts_[length] > left) {  // more codes than possible
                bits.fail();
                return;
            }
            left -= counts_[length];
            begins[length + 1] = begins[length] + counts_[length];
        }
        symbols_.resize(begins[kMax + 1]);
        for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol) {
            if (lengths[symbol] != 0) symbols_[begins[lengths[symbol]]++] = static_cast<std::uint16_t>(symbol);
        }
    }

    std::uint32_t read(BasisBits& bits) const {
        std::uint32_t code = 0, first = 0, index = 0;
        for (std::size_t length = 1; length <= kMax; ++length) {
            code |= bits.bit();
            if (code - first < counts_[length]) return symbols_[index + code - first];
            index += counts_[length];
            first = (first + counts_[length]) << 1;
            code <<= 1;
        }
        bits.fail();
        return 0;
    }

  private:
    static constexpr std::size_t kMax = 16;
    std::array<std::uint32_t, kMax + 1> counts_ = {};
    std::vector<std::uint16_t> symbols_ = {};  ///< symbols in code order
};

/// Reads a Huffman code whose code lengths are themselves Huffman-coded.
HuffmanCode readCode(BasisBits& bits) {
    constexpr std::uint8_t kOrder[] = {17, 18, 19, 20, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15, 16};
    const std::uint32_t symbols = bits.take(14), used = bits.take(5);
    if (symbols == 0) return {};
    if (used == 0 || used > std::size(kOrder)) {
        bits.fail();
        return {};
    }
    std::array<std::uint8_t, std::size(kOrder)> lengths_of_lengths{};
    for (std::uint32_t i = 0; i < used; ++i) lengths_of_lengths[kOrder[i]] = static_cast<std::uint8_t>(bits.take(3));
    const HuffmanCode code(lengths_of_lengths, bits);
    std::vector<std::uint8_t> lengths;
    while (lengths.size() < symbols && !bits.hasFailed()) {
        const std::uint32_t symbol = code.read(bits);
        if (symbol <= 16) {
            lengths.push_back(static_cast<std::uint8_t>(symbol));
            continue;
        }
        constexpr unsigned kBits[] = {3, 7, 2, 7}, kMin[] = {3, 11, 3, 7};
        const std::uint32_t count = kMin[symbol - 17] + bits.take(kBits[symbol - 17]);
        const bool repeats = symbol >= 19;
        if ((repeats && (lengths.empty() || lengths.back() == 0)) || count > symbols - lengths.size()) {
            bits.fail();
            break;
        }
        lengths.insert(lengths.end(), count, repeats ? lengths.back() : std::uint8_t{0});
    }
    return bits.hasFailed() ? HuffmanCode{} : HuffmanCode(lengths, bits);
}

/// Endpoint color: red, green, blue, and the index of a modifier table.
using Etc1sEnd = std::array<std::uint8_t, 4>;
/// Selectors of a block: four rows of four 2-bit values.
using Etc1sCodes = std::array<std::uint8_t, 4>;

std::vector<Etc1sEnd> readEnds(ByteSpan data, std::size_t count) {
    BasisBits bits(data);
    std::array<HuffmanCode, 3> of_colors;
    for (HuffmanCode& code : of_colors) code = readCode(bits);
    const HuffmanCode of_tables = readCode(bits);
    const bool is_gray = bits.bit() != 0;
    std::vector<Etc1sEnd> ends;
    Etc1sEnd last{16, 16, 16, 0};
    while (ends.size() < count && !bits.hasFailed()) {
        last[3] = static_cast<std::uint8_t>((last[3] + of_tables.read(bits)) & 7);
        for (std::size_t i = 0; i < (is_gray ? 1U : 3U); ++i) {
            const std::size_t range = last[i] < 10 ? 0 : last[i] < 22 ? 1 : 2;
            last[i] = static_cast<std::uint8_t>((last[i] + of_colors[range].read(bits)) & 31);
        }
        if (is_gray) last[1] = last[2] = last[0];
        ends.push_back(last);
    }
    if (bits.hasFailed()) ends.clear();
    return ends;
}

std::vector<Etc1sCodes> readSelectors(ByteSpan data, std::size_t count) {
    BasisBits bits(data);
    if (bits.take(2) != 0) return {};
    const bool is_plain = bits.bit() != 0;
    const HuffmanCode code = is_plain ? HuffmanCode{} : readCode(bits);
    std::vector<Etc1sCodes> selectors;
    Etc1sCodes last{};
    while (selectors.size() < count && !bits.hasFailed()) {
        for (std::uint8_t& row : last) {
            const bool is_whole = is_plain || selectors.empty();
            row = static_cast<std::uint8_t>(is_whole ? bits.take(8) : row ^ code.read(bits));
        }
        selectors.push_back(last);
    }
    if (bits.hasFailed()) selectors.clear();
    return selectors;
}

/// Recently used selectors, approximately in order of use.
class SelectorHistory {
  public:
    explicit SelectorHistory(std::size_t count) : values_(count), next_(count / 2) {}

    void add(std::uint32_t value) {
        if (values_.empty()) return;
        values_[next_++] = value;
        if (next_ == values_.size()) next_ = values_.size() / 2;
    }
    std::uint32_t use(std::size_t index) {
        const std::uint32_t value = values_[index];
        std::swap(values_[index / 2], values_[index]);
        return value;
    }
    [[nodiscard]] std::size_t size() const { return values_.size(); }

  private:
    std::vector<std::uint32_t> values_;
    std::size_t next_;
};

struct BasisTables {
    std::vector<Etc1sEnd> ends = {};
    std::vector<Etc1sCodes> selectors = {};
    HuffmanCode of_predictions = {}, of_ends = {}, of_selectors = {}, of_runs = {};
    std::size_t history = 0;
};

/// Decodes the blocks of one slice in order.
class BasisSlice {
  public:
    BasisSlice(const BasisTables& tables, ByteSpan data, std::size_t across, std::size_t down)
        : tables_(tables), bits_(data), history_(tables.history), across_(across), down_(down), above_(across),
          predictions_((across + 1) / 2) {}

    /// Writes eight bytes per block: endpoint and selectors. `stride`: distance between blocks. Returns false for
    /// corrupt data.
    bool read(std::uint8_t* to, std::size_t stride) {
        for (std::size_t y = 0; y < down_; ++y) {
            for (std::size_t x = 0; x < across_; ++x, to += stride) {
                const std::optional<std::uint32_t> end = readEnd(x, y), selector = readSelector();
                if (!end || !selector || *end >= tables_.ends.size() || *selector >= tables_.selectors.size() ||
                    bits_.hasFailed())
                    return false;
                std::copy_n(tables_.ends[*end].begin(), 4, to);
                std::copy_n(tables_.selectors[*selector].begin(), 4, to + 4);
            }
        }
        return true;
    }

  private:
    /// Reads how the endpoints of four blocks are predicted, two bits each.
    std::uint32_t readPredictions() {
        constexpr std::uint32_t kRepeats = 256, kMinRepeats = 3;
        if (repeats_ > 0) {
            --repeats_;
            return last_predictions_;
        }
        const std::uint32_t read = tables_.of_predictions.read(bits_);
        if (read == kRepeats) {
            repeats_ = std::uint64_t{bits_.takeParts(4)} + kMinRepeats - 1;
        } else {
            last_predictions_ = read;
        }
        return last_predictions_;
    }

    std::optional<std::uint32_t> readEnd(std::size_t x, std::size_t y) {
        if (x % 2 == 0) {
            if (y % 2 == 0) {
                current_ = readPredictions();
                predictions_[x / 2] = current_ >> 4;
            } else {
                current_ = predictions_[x / 2];
            }
        }
        const std::uint32_t way = current_ & 3;
        current_ >>= 2;
        std::uint32_t end = left_;
        const std::uint32_t above_left = above_left_;
        above_left_ = above_[x];
        if ((way == 0 || way == 2) && x == 0) return {};
        if ((way == 1 || way == 2) && y == 0) return {};
        if (way == 1) end = above_[x];
        if (way == 2) end = above_left;
        if (way == 3) {
            end += tables_.of_ends.read(bits_);
            if (end >= tables_.ends.size()) end -= static_cast<std::uint32_t>(tables_.ends.size());
        }
        above_[x] = left_ = end;
        return end;
    }

    std::optional<std::uint32_t> readSelector() {
        constexpr std::uint32_t kLongRun = 63, kMinRun = 3;
        const auto count = static_cast<std::uint32_t>(tables_.selectors.size());
        std::uint32_t symbol = count;
        if (run_ > 0) {
            --run_;
        } else {
            symbol = tables_.of_selectors.read(bits_);
            if (symbol == count + history_.size()) {
                const std::uint32_t length = tables_.of_runs.read(bits_);
                run_ = std::uint64_t{length == kLongRun ? bits_.takeParts(7) : length} + kMinRun - 1;
                symbol = count;
            }
        }
        if (symbol < count) {
            history_.add(symbol);
            return symbol;
        }
        if (symbol - count >= history_.size()) return {};
        return history_.use(symbol - count);
    }

    const BasisTables& tables_;
    BasisBits bits_;
    SelectorHistory history_;
    std::size_t across_, down_;
    std::vector<std::uint32_t> above_, predictions_;
    std::uint32_t left_ = 0, above_left_ = 0, current_ = 0, last_predictions_ = 0;
    std::uint64_t repeats_ = 0, run_ = 0;
};

/// Sections of the global data, which must cover it completely.
struct BasisParts {
    std::size_t end_count = 0, selector_count = 0;
    ByteSpan image = {}, ends = {}, selectors = {}, tables = {};
};

/// Finds the sections. `image`: index of the requested image, less than `images`.
std::optional<BasisParts> findParts(ByteSpan data, std::size_t images, std::size_t image) {
    constexpr std::size_t kHead = 20, kImage = 20;
    if (data.size() < kHead || images > (data.size() - kHead) / kImage) return {};
    BasisParts parts{.end_count = little16(data.data()), .selector_count = little16(data.data() + 2)};
    parts.image = data.subspan(kHead + kImage * image, kImage);
    std::size_t at = kHead + kImage * images;
    std::size_t place = 4;
    for (ByteSpan* part : {&parts.ends, &parts.selectors, &parts.tables}) {
        const std::size_t count = little32(data.data() + place);
        place += 4;
        if (count > data.size() - at) return {};
        *part = data.subspan(at, count);
        at += count;
    }
    return parts;
}

}  // namespace

bool unpackBasisLz(const TextureFile& texture, std::span<std::uint8_t> blocks) {
    constexpr std::size_t kSlice = 8;
    const std::optional<BasisParts> parts = findParts(texture.global, texture.levels.size(), texture.level_number);
    if (!parts) return false;
    BasisTables tables;
    tables.ends = readEnds(parts->ends, parts->end_count);
    tables.selectors = readSelectors(parts->selectors, parts->selector_count);
    BasisBits bits(parts->tables);
    for (HuffmanCode* code : {&tables.of_predictions, &tables.of_ends, &tables.of_selectors, &tables.of_runs})
        *code = readCode(bits);
    tables.history = bits.take(13);
    if (bits.hasFailed() || tables.ends.empty() || tables.selectors.empty()) return false;
    const auto across = static_cast<std::size_t>(texture.format.blocksAcross(texture.size.width));
    const auto down = static_cast<std::size_t>(texture.format.blocksDown(texture.size.height));
    for (std::size_t i = 0; i * kSlice < texture.format.block_bytes; ++i) {
        const std::size_t at = little32(parts->image.data() + 4 + 8 * i),
                          count = little32(parts->image.data() + 8 + 8 * i);
        if (at > texture.level.size() || count > texture.level.size() - at || count == 0) return false;
        BasisSlice slice(tables, texture.level.subspan(at, count), across, down);
        if (!slice.read(blocks.data() + kSlice * i, texture.format.block_bytes)) return false;
    }
    return true;
}

}  // namespace tspace
