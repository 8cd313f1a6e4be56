// SPDX-License-Identifier: MIT
// Packed tangent frames as glTF attributes: the words, and the accessors of each format. See the table in
// docs/concepts/pack.md.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "model/gltf/codecs/codecs.h"
#include "model/io/file_io.h"
#include "tspace/execution.h"
#include "tspace/pack.h"

namespace tspace::gltf {

/// Attribute that contains `byte_count` bytes of each word, starting at `begin`.
struct PackedPart {
    const char* attribute;
    ComponentType component;
    const char* type;
    bool normalized;
    std::size_t begin, byte_count;
};

struct PackedLayout {
    FrameFormat format;
    std::span<const PackedPart> parts;  ///< parts that together contain each byte of a word once
};

/// Returns all formats, in the order of FrameFormat.
std::span<const PackedLayout> packedLayouts();
/// Returns the layout of a format; `format` must be one of the enumerators.
const PackedLayout& packedLayout(FrameFormat format);

/// Returns whether the attribute name is one of packed frames.
bool isPackedAttribute(const std::string& name);

/// takePart extracts the bytes of one part from words, tightly packed; putPart writes them back.
Bytes takePart(const Bytes& words, FrameFormat format, const PackedPart& part);
void putPart(const Bytes& elements, FrameFormat format, const PackedPart& part, Bytes& words);

/// Returns one word of `format` per frame, without padding, packed by all threads. Adds repaired frames to `report`.
Bytes packWords(FrameFormat format, std::span<const Vec3> normals, std::span<const Vec4> tangents,
                const Execution& execution, PackReport& report);

}  // namespace tspace::gltf
