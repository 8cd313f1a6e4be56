// SPDX-License-Identifier: MIT
// Reads STL files that are text. Binary STL contains floats, which have no additional precision: differences of
// neighboring floats are exact, so normals computed near the origin have the same bits
// (tests/model/imported/near_origin_test.cpp).
#include <cstring>

#include "near_origin/coordinates.h"

namespace tspace::import {
namespace {

/// Returns whether the file is binary STL, by Assimp's rule: the file size matches the declared number of triangles.
bool isBinaryStl(const std::vector<char>& bytes) {
    constexpr std::size_t kHeader = 84, kPerTriangle = 50;
    if (bytes.size() < kHeader) return false;
    std::uint64_t count = 0;
    for (std::size_t i = 4; i-- > 0;) count = count << 8 | static_cast<unsigned char>(bytes[kHeader - 4 + i]);
    return bytes.size() == kHeader + kPerTriangle * count;
}

}  // namespace

Coordinates readStl(std::vector<char> bytes) {
    if (isBinaryStl(bytes)) return {};
    auto file = std::make_unique<TextCoordinates>(std::move(bytes));
    const std::string_view text = file->text();
    file->addList();
    for (std::size_t at = 0; at < text.size();) {
        const std::string_view word = nextWord(text, at);
        if (word == "solid" || word == "endsolid") {
            // The name of the solid may consist of any words.
            while (at < text.size() && text[at] != '\n' && text[at] != '\r') ++at;
            if (word == "solid") {
                file->endList();
                file->addList();
            }
        } else if (word == "vertex") {
            for (int axis = 0; axis < 3; ++axis) {
                const std::string_view number = nextWord(text, at);
                if (number.empty()) return {};
                file->add(number);
            }
        }
    }
    file->endList();
    return file;
}

}  // namespace tspace::import
