// SPDX-License-Identifier: MIT
// Packed frames as attributes: which accessors hold the words of each format. docs/pack.md has the table.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "model/gltf/codecs/component_type.h"
#include "model/io/file_io.h"
#include "tspace/pack.h"

namespace tspace::gltf {

/// An attribute that holds `byte_count` bytes of each word, from `begin` on.
struct PackedPart {
    const char* attribute;
    ComponentType component;
    const char* type;
    bool normalized;
    std::size_t begin, byte_count;
};

struct PackedLayout {
    FrameFormat format;
    std::span<const PackedPart> parts;  ///< together all bytes of a word, each once
};

/// All formats, in the order of FrameFormat.
std::span<const PackedLayout> packedLayouts();
/// `format` must be one of the enumerators.
const PackedLayout& packedLayout(FrameFormat format);

/// Whether the attribute is one of those that hold packed frames.
bool isPackedAttribute(const std::string& name);

/// The bytes of one part out of whole words, tightly packed; and the way back.
Bytes takePart(const Bytes& words, FrameFormat format, const PackedPart& part);
void putPart(const Bytes& elements, FrameFormat format, const PackedPart& part, Bytes& words);

}  // namespace tspace::gltf
