// SPDX-License-Identifier: MIT
// Packed tangent frames in glTF (an attribute and a note in extras): how they lie, reading, writing.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/gltf/codecs/codecs.h"
#include "model/gltf/editor.h"
#include "model/gltf/primitive_reader.h"
#include "model/io/file_io.h"
#include "tspace/asset.h"
#include "tspace/execution.h"
#include "tspace/pack.h"

namespace tspace::gltf {

// Packed frames as attributes: the words, and which accessors hold those of each format. docs/pack.md has the table.

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

// Reads the packed frames of a primitive.

/// Attributes of one format.
struct StoredPacking {
    const PackedLayout* layout = nullptr;
    std::string attribute = {};  ///< the first of them, or the one that `fault` is about
    /// Why they are not valid packed frames, half a sentence about `attribute`; empty when they are.
    std::string fault = {};
};

/// The formats of which the primitive has an attribute, in the order of FrameFormat.
std::vector<StoredPacking> findPacked(const Document& document, const Primitive& primitive);

/// The attribute with the primitive's only frames: packed ones without valid NORMAL and TANGENT beside them. Empty when
/// the primitive has others, or none.
std::string packedAlone(const Document& document, const Primitive& primitive);

/// The words, without padding, of a format without fault. Fails as copyElements.
Bytes readPackedWords(const Document& document, const Primitive& primitive, const PackedLayout& layout);

/// Removes the attributes in Primitive::miscounted that packing as `pack` makes anew; fails with invalidFile where there
/// are others. Returns whether the document changed.
bool removeMiscounted(Document& document, std::span<Primitive> primitives, std::optional<FrameFormat> pack);

// Writes packed frames for all primitives that have frames; the last edit of a run.

/// Writes the attributes of `options.pack` from NORMAL and TANGENT as they are in the document now, and removes those
/// that `options.pack_drop` names. Primitives that share both share the packed attributes. Fills frames_packed, packing,
/// normals_dropped and tangents_dropped of the reports; a note says why where nothing is written, or where an attribute
/// stays although it was to be removed. Attributes that have these bits already stay as they are.
void writePackedFrames(Editor& editor, const Document& document, const GenerateOptions& options,
                       std::span<PrimitiveReport> reports);

/// Notes packed frames that stay although the tangents beside them were computed anew.
void noteStalePackedFrames(const Document& document, std::span<const Primitive> primitives,
                           const GenerateOptions& options, std::span<PrimitiveReport> reports);

}  // namespace tspace::gltf
