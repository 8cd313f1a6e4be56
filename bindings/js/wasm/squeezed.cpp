// SPDX-License-Identifier: MIT
// A module that has another one in it, squeezed, which takes a sixth less than gzip leaves of it. What is squeezed is a stream
// of LZMA without a head, as xz writes it with lc=3, lp=0, pb=0; build.mjs gives it as kSqueezed, and its size as kBytes.
#include <cstddef>
#include <cstdint>

namespace {

/// How likely a bit is 0, of 2048.
using Chance = std::uint16_t;

/// Numbers of so many bits, the highest first. [0] is not used.
template <unsigned kBits>
struct Tree {
    Chance chances[1 << kBits];
};

struct Lengths {
    Chance is_middle, is_high;
    Tree<3> low, middle;
    Tree<8> high;
};

/// What was read last says what is likely next: 0 to 6 after a byte, 7 to 11 after a copy.
constexpr unsigned kStates = 12, kAfterCopy = 7;

struct Chances {
    Chance is_copy[kStates], is_known[kStates], is_older[kStates], is_third[kStates], is_fourth[kStates], is_long[kStates];
    Lengths new_lengths, known_lengths;
    Tree<6> distances[4];
    Chance middle_bits[128];
    Tree<4> low_bits;
    Chance bytes[8][3][256];  // by the byte before, and by the bit that a copy would have had
};

struct {
    std::uint32_t size;
    std::uint8_t bytes[kBytes];
} opened;
union {
    Chances chances;
    Chance all_chances[sizeof(Chances) / sizeof(Chance)];
};
const std::uint8_t* next = kSqueezed + 1;
std::uint32_t range = 0xffffffff, code = 0;

/// So that `range` has more than 24 bits.
void fill() {
    if (range >= 1 << 24) return;
    range <<= 8;
    code = code << 8 | *next++;
}

unsigned bit(Chance& chance) {
    fill();
    const std::uint32_t zero = (range >> 11) * chance;
    if (code < zero) {
        range = zero;
        chance = static_cast<std::uint16_t>(chance + ((2048 - chance) >> 5));
        return 0;
    }
    range -= zero;
    code -= zero;
    chance = static_cast<std::uint16_t>(chance - (chance >> 5));
    return 1;
}

/// On from the bits that are known; with a 1 before them all.
unsigned bits(Chance* tree, unsigned known, unsigned end) {
    while (known < end) known = known << 1 | bit(tree[known]);
    return known;
}

template <unsigned kBits>
unsigned number(Tree<kBits>& tree) {
    return bits(tree.chances, 1, 1 << kBits) - (1 << kBits);
}

/// The lowest bit first.
unsigned lowestFirst(Chance* tree, unsigned count) {
    unsigned found = 0, place = 1;
    for (unsigned i = 0; i < count; ++i) {
        const unsigned b = bit(tree[place]);
        place = place << 1 | b;
        found |= b << i;
    }
    return found;
}

unsigned length(Lengths& lengths) {
    if (bit(lengths.is_middle) == 0) return 2 + number(lengths.low);
    if (bit(lengths.is_high) == 0) return 10 + number(lengths.middle);
    return 18 + number(lengths.high);
}

std::uint32_t distance(unsigned copied) {
    const unsigned slot = number(chances.distances[copied < 5 ? copied - 2 : 3]);
    if (slot < 4) return slot;
    const unsigned more = (slot >> 1) - 1;
    const std::uint32_t first = (2 | (slot & 1)) << more;
    if (slot < 14) return first + lowestFirst(chances.middle_bits + first - slot, more);
    std::uint32_t high = 0;
    for (unsigned i = 4; i < more; ++i) {
        fill();
        range >>= 1;
        high <<= 1;
        if (code >= range) {
            code -= range;
            ++high;
        }
    }
    return first + (high << 4) + lowestFirst(chances.low_bits.chances, 4);
}

}  // namespace

/// The size of the module, and behind it its bytes.
extern "C" __attribute__((export_name("unsqueeze"))) const void* unsqueeze() {
    opened.size = kBytes;
    for (Chance& chance : all_chances) chance = 1024;
    for (int i = 0; i < 4; ++i) code = code << 8 | *next++;
    std::uint32_t distances[4] = {};
    unsigned state = 0;
    for (std::uint8_t* to = opened.bytes; to < opened.bytes + kBytes;) {
        const bool after_copy = state >= kAfterCopy;
        const std::uint8_t before = to == opened.bytes ? 0 : to[-1];
        if (bit(chances.is_copy[state]) == 0) {
            Chance(&trees)[3][256] = chances.bytes[before >> 5];
            unsigned known = 1;
            // Where a copy ended, this byte is not what it would have gone on with; the bits up to there are likely the same.
            for (unsigned other = after_copy ? to[-1 - static_cast<std::ptrdiff_t>(distances[0])] : 0; after_copy && known < 256; other <<= 1) {
                const unsigned likely = other >> 7 & 1;
                known = known << 1 | bit(trees[1 + likely][known]);
                if ((known & 1) != likely) break;
            }
            *to++ = static_cast<std::uint8_t>(bits(trees[0], known, 256));
            state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
            continue;
        }
        unsigned count = 1;
        if (bit(chances.is_known[state]) == 0) {
            count = length(chances.new_lengths);
            for (int i = 3; i > 0; --i) distances[i] = distances[i - 1];
            distances[0] = distance(count);
            state = after_copy ? 10 : 7;
        } else {
            unsigned which = bit(chances.is_older[state]);
            if (which != 0) which += bit(chances.is_third[state]);
            if (which == 2) which += bit(chances.is_fourth[state]);
            if (which != 0 || bit(chances.is_long[state]) != 0) {
                const std::uint32_t known = distances[which];
                for (; which > 0; --which) distances[which] = distances[which - 1];
                distances[0] = known;
                count = length(chances.known_lengths);
                state = after_copy ? 11 : 8;
            } else {
                state = after_copy ? 11 : 9;
            }
        }
        for (; count > 0; --count, ++to) *to = to[-1 - static_cast<std::ptrdiff_t>(distances[0])];
    }
    return &opened;
}
