// SPDX-License-Identifier: MIT
// Writes the GLB container: JSON and BIN.
#include "glb_builder.h"

#include <stdexcept>
#include <string>

namespace tspace::import {
namespace {

void append32(std::vector<std::uint8_t>& out, std::uint64_t value) {
    for (int i = 0; i < 4; ++i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

}  // namespace

std::vector<std::uint8_t> GlbBuilder::finish() {
    bytes().resize((bytes().size() + 3) / 4 * 4, 0);
    if (!bytes().empty()) json()["buffers"] = Json::array({Json{{"byteLength", bytes().size()}}});
    std::string text = json().dump(-1, ' ', BadUtf8::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t total = 12 + 8 + text.size() + (bytes().empty() ? 0 : 8 + bytes().size());
    if (total > 0xffffffffu) throw std::length_error("the model exceeds the 4 GiB that a GLB can contain");
    std::vector<std::uint8_t> glb;
    glb.reserve(static_cast<std::size_t>(total));
    append32(glb, 0x46546c67);  // "glTF"
    append32(glb, 2);
    append32(glb, total);
    append32(glb, text.size());
    append32(glb, 0x4e4f534a);  // "JSON"
    glb.insert(glb.end(), text.begin(), text.end());
    if (bytes().empty()) return glb;
    append32(glb, bytes().size());
    append32(glb, 0x004e4942);  // "BIN"
    glb.insert(glb.end(), bytes().begin(), bytes().end());
    return glb;
}

}  // namespace tspace::import
