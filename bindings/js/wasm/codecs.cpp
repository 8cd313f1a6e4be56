// SPDX-License-Identifier: MIT
// Codecs for compressed geometry, implemented by JavaScript packages that the caller passes in.
#include "codecs.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "model/gltf/codecs/codecs.h"
#include "model/io/file_error.h"

namespace tspace::js {
namespace {

/// Layout shared with JavaScript. The caller frees arrays that JavaScript returns.
struct DracoAttributeWords {
    std::uint32_t id, kind, component, component_count, is_normalized;
    std::uint8_t* values;
    std::size_t value_bytes;
    std::uint32_t rounding_bits, is_octahedral;
    std::uint32_t origin_count;
    float origin[4];
    float range;
};
struct DracoMeshWords {
    std::uint32_t* corners;
    std::size_t corner_count, point_count, attribute_count;
    DracoAttributeWords* attributes;
};

}  // namespace
}  // namespace tspace::js

using namespace tspace::js;

extern "C" {

/// Returns 0 if the data is corrupt.
TSPACE_JS_IMPORT(decodeMeshopt)
int tspace_js_decodeMeshopt(const std::uint8_t* data, std::size_t bytes, std::uint8_t* to, std::size_t count,
                            std::size_t stride, std::uint32_t mode, std::uint32_t filter);
/// Returns the encoded rows, which the caller frees; sets their size.
TSPACE_JS_IMPORT(encodeMeshopt)
std::uint8_t* tspace_js_encodeMeshopt(const std::uint8_t* rows, std::size_t count, std::size_t stride,
                                      std::uint32_t mode, int is_khr, std::size_t* bytes);
/// Returns null, or a text that describes the fault of the data, which the caller frees.
TSPACE_JS_IMPORT(decodeDraco)
char* tspace_js_decodeDraco(const std::uint8_t* data, std::size_t bytes, int is_edgebreaker, std::size_t most_corners,
                            std::size_t most_points, DracoMeshWords* mesh);
/// Returns the encoded mesh like encodeMeshopt, or null if the library cannot encode it. Sets the attribute IDs.
TSPACE_JS_IMPORT(encodeDraco) std::uint8_t* tspace_js_encodeDraco(const DracoMeshWords* mesh, std::size_t* bytes);

}  // extern "C"

namespace tspace::gltf {

namespace {

template <class T>
using Released = std::unique_ptr<T, decltype(&std::free)>;

Bytes takeBytes(std::uint8_t* from, std::size_t count) {
    const Released<std::uint8_t> owner(from, &std::free);
    return Bytes(from, from + count);
}

std::size_t atMostAll(std::uint64_t count) {
    return static_cast<std::size_t>(std::min<std::uint64_t>(count, SIZE_MAX));
}

void needEncoder(Codec encoder, const char* what) {
    if (tspace_js_hasCodec(encoder) == 0) failFile(ErrorCode::unsupportedFile, what);
}

DracoAttributeWords wordsOf(DracoAttribute& attribute) {
    DracoAttributeWords words{.id = attribute.id,
                              .kind = static_cast<std::uint32_t>(attribute.kind),
                              .component = static_cast<std::uint32_t>(attribute.component),
                              .component_count = static_cast<std::uint32_t>(attribute.component_count),
                              .is_normalized = attribute.normalized,
                              .values = attribute.values.data(),
                              .value_bytes = attribute.values.size(),
                              .rounding_bits = static_cast<std::uint32_t>(attribute.rounding.bits),
                              .is_octahedral = attribute.rounding.is_octahedral,
                              .origin_count = static_cast<std::uint32_t>(attribute.rounding.origin.size()),
                              .origin = {},
                              .range = attribute.rounding.range};
    for (std::size_t i = 0; i < attribute.rounding.origin.size() && i < 4; ++i)
        words.origin[i] = attribute.rounding.origin[i];
    return words;
}

DracoMeshWords wordsOf(DracoMesh& mesh, std::vector<DracoAttributeWords>& attributes) {
    for (DracoAttribute& attribute : mesh.attributes) attributes.push_back(wordsOf(attribute));
    return {mesh.corners.data(), mesh.corners.size(), mesh.point_count, attributes.size(), attributes.data()};
}

void take(const DracoAttributeWords& words, DracoAttribute& to) {
    to.values = takeBytes(words.values, words.value_bytes);
    to.rounding.bits = static_cast<int>(words.rounding_bits);
    to.rounding.is_octahedral = words.is_octahedral != 0;
    to.rounding.origin.assign(words.origin, words.origin + words.origin_count);
    to.rounding.range = words.range;
}

}  // namespace

std::string meshoptMissing(bool) {
    if (tspace_js_hasCodec(Codec::meshoptDecoder) != 0) return {};
    return "the option meshopt is missing; it must be { decoder, encoder } of the npm package meshoptimizer";
}

bool decodeMeshopt(const MeshoptCoding& coding, std::span<const std::uint8_t> data, std::span<std::uint8_t> to) {
    return tspace_js_decodeMeshopt(data.data(), data.size(), to.data(), coding.count, coding.stride,
                                   static_cast<std::uint32_t>(coding.mode),
                                   static_cast<std::uint32_t>(coding.filter)) != 0;
}

Bytes encodeUnchecked(const MeshoptCoding& coding, std::span<const std::uint8_t> rows) {
    needEncoder(
        Codec::meshoptEncoder,
        "the output is compressed with meshopt, but the option meshopt has no encoder; use MeshoptEncoder of the npm "
        "package meshoptimizer, or compress: \"none\"");
    std::size_t count = 0;
    std::uint8_t* encoded =
        tspace_js_encodeMeshopt(rows.data(), coding.count, coding.stride, static_cast<std::uint32_t>(coding.mode),
                                coding.is_khr ? 1 : 0, &count);
    return takeBytes(encoded, count);
}

std::string dracoMissing() {
    if (tspace_js_hasCodec(Codec::dracoDecoder) != 0) return {};
    return "the option draco is missing; it must be { decoder, encoder }, the modules of the npm package draco3d";
}

std::string decodeDraco(std::span<const std::uint8_t> data, const DracoLimits& limits, DracoMesh& mesh) {
    if (std::string fault = dracoHeaderFault(data); !fault.empty()) return fault;
    std::vector<DracoAttributeWords> attributes;
    DracoMeshWords words = wordsOf(mesh, attributes);
    const Released<char> fault(
        tspace_js_decodeDraco(data.data(), data.size(), isEdgebreaker(data) ? 1 : 0, atMostAll(limits.corner_count),
                              atMostAll(limits.point_count), &words),
        &std::free);
    if (fault) return fault.get();
    const Released<std::uint32_t> corners(words.corners, &std::free);
    mesh.corners.assign(words.corners, words.corners + words.corner_count);
    mesh.point_count = words.point_count;
    for (std::size_t i = 0; i < attributes.size(); ++i) take(attributes[i], mesh.attributes[i]);
    return {};
}

bool encodeDracoUnchecked(DracoMesh& mesh, Bytes& data) {
    needEncoder(
        Codec::dracoEncoder,
        "the output is compressed with Draco, but the option draco has no encoder; use the encoder module of the npm "
        "package draco3d, or compress: \"none\"");
    std::vector<DracoAttributeWords> attributes;
    const DracoMeshWords words = wordsOf(mesh, attributes);
    std::size_t count = 0;
    std::uint8_t* encoded = tspace_js_encodeDraco(&words, &count);
    if (encoded == nullptr) return false;
    data = takeBytes(encoded, count);
    for (std::size_t i = 0; i < attributes.size(); ++i) mesh.attributes[i].id = attributes[i].id;
    return true;
}

}  // namespace tspace::gltf
