// SPDX-License-Identifier: MIT
// Packed tangent frames as attributes of glTF: the words, and which accessors hold those of each format. docs/concepts/pack.md has
// the table.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "model/gltf/codecs/codecs.h"
#include "model/io/file_io.h"
#include "tspace/execution.h"
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

/// Whether an attribute of this name holds packed frames.
bool isPackedAttribute(const std::string& name);

/// Copies the bytes of one part out of whole words, tightly packed; putPart copies them back.
Bytes takePart(const Bytes& words, FrameFormat format, const PackedPart& part);
void putPart(const Bytes& elements, FrameFormat format, const PackedPart& part, Bytes& words);

/// One word of `format` for each frame, without padding, by all threads. Adds repaired frames to `report`.
Bytes packWords(FrameFormat format, std::span<const Vec3> normals, std::span<const Vec4> tangents,
                const Execution& execution, PackReport& report);

}  // namespace tspace::gltf
