// SPDX-License-Identifier: MIT
// Calls of the library meshoptimizer.
#include "model/gltf/codecs/codecs.h"

#include <algorithm>
#include <cstring>
#include <vector>

#ifdef TSPACE_HAS_MESHOPT
#include <meshoptimizer.h>
#endif

namespace tspace::gltf {
namespace {

/// First version that decodes the additions of KHR_meshopt_compression: vertex codec 1 and the color filter.
constexpr int kFirstKhrVersion = 1000;
#ifdef TSPACE_HAS_MESHOPT
constexpr int kVersion = MESHOPTIMIZER_VERSION;
#else
constexpr int kVersion = 0;
#endif

}  // namespace

std::string meshoptMissing(bool is_khr) {
    if (kVersion == 0) return "this build of tspace does not include the library meshoptimizer";
    if (is_khr && kVersion < kFirstKhrVersion) {
        return "this build of tspace includes meshoptimizer " + std::to_string(kVersion / 1000) + "." +
               std::to_string(kVersion / 10 % 100) + ", but KHR_meshopt_compression needs version 1.0 or later";
    }
    return {};
}

#ifdef TSPACE_HAS_MESHOPT

namespace {

void applyFilter(const MeshoptCoding& coding, std::uint8_t* rows) {
    switch (coding.filter) {
        case MeshoptFilter::none: break;
        case MeshoptFilter::octahedral: meshopt_decodeFilterOct(rows, coding.count, coding.stride); break;
        case MeshoptFilter::quaternion: meshopt_decodeFilterQuat(rows, coding.count, coding.stride); break;
        case MeshoptFilter::exponential: meshopt_decodeFilterExp(rows, coding.count, coding.stride); break;
        case MeshoptFilter::color:
#if MESHOPTIMIZER_VERSION >= 1000
            meshopt_decodeFilterColor(rows, coding.count, coding.stride);
#endif
            break;
    }
}

std::vector<unsigned> wideIndices(const MeshoptCoding& coding, std::span<const std::uint8_t> rows) {
    std::vector<unsigned> indices(coding.count);
    for (std::size_t i = 0; i < coding.count; ++i) {
        std::uint16_t narrow = 0;
        if (coding.stride == 4) {
            std::memcpy(&indices[i], rows.data() + i * 4, 4);
        } else {
            std::memcpy(&narrow, rows.data() + i * 2, 2);
            indices[i] = narrow;
        }
    }
    return indices;
}

Bytes encodeIndices(const MeshoptCoding& coding, const std::vector<unsigned>& indices) {
    const std::size_t vertex_count =
        indices.empty() ? 0 : std::size_t{*std::max_element(indices.begin(), indices.end())} + 1;
    const bool triangles = coding.mode == MeshoptMode::triangles;
    // The extensions require index version 1, which is not the default in all versions. The library keeps the version
    // in a global variable.
    static const bool version_is_set = (meshopt_encodeIndexVersion(1), true);
    static_cast<void>(version_is_set);
    Bytes data(triangles ? meshopt_encodeIndexBufferBound(indices.size(), vertex_count)
                         : meshopt_encodeIndexSequenceBound(indices.size(), vertex_count));
    data.resize(triangles ? meshopt_encodeIndexBuffer(data.data(), data.size(), indices.data(), indices.size())
                          : meshopt_encodeIndexSequence(data.data(), data.size(), indices.data(), indices.size()));
    return data;
}

}  // namespace

bool decodeMeshopt(const MeshoptCoding& coding, std::span<const std::uint8_t> data, std::span<std::uint8_t> to) {
    // Malicious data is safe here: the library checks every read, and meshoptFault has checked the counts.
    int failure = 0;
    switch (coding.mode) {
        case MeshoptMode::attributes:
            failure = meshopt_decodeVertexBuffer(to.data(), coding.count, coding.stride, data.data(), data.size());
            if (failure == 0) applyFilter(coding, to.data());
            break;
        case MeshoptMode::triangles:
            failure = meshopt_decodeIndexBuffer(to.data(), coding.count, coding.stride, data.data(), data.size());
            break;
        case MeshoptMode::indices:
            failure = meshopt_decodeIndexSequence(to.data(), coding.count, coding.stride, data.data(), data.size());
            break;
    }
    return failure == 0;
}

Bytes encodeUnchecked(const MeshoptCoding& coding, std::span<const std::uint8_t> rows) {
    if (coding.mode != MeshoptMode::attributes) return encodeIndices(coding, wideIndices(coding, rows));
    Bytes data;
    data.resize(meshopt_encodeVertexBufferBound(coding.count, coding.stride));
#if MESHOPTIMIZER_VERSION >= 1000
    // By default newer versions use features that only KHR_meshopt_compression allows.
    data.resize(meshopt_encodeVertexBufferLevel(data.data(), data.size(), rows.data(), coding.count, coding.stride, 2,
                                                coding.is_khr ? 1 : 0));
#else
    data.resize(meshopt_encodeVertexBuffer(data.data(), data.size(), rows.data(), coding.count, coding.stride));
#endif
    return data;
}

#else

bool decodeMeshopt(const MeshoptCoding&, std::span<const std::uint8_t>, std::span<std::uint8_t>) { return false; }
Bytes encodeUnchecked(const MeshoptCoding&, std::span<const std::uint8_t>) { return {}; }

#endif

}  // namespace tspace::gltf
