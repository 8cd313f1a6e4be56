// SPDX-License-Identifier: MIT
// Calls of meshoptimizer behind checks of everything that it takes for granted.
#include "asset/gltf/codecs/meshopt.h"

#include <algorithm>
#include <cstring>
#include <vector>

#ifdef TSPACE_HAS_MESHOPT
#include <meshoptimizer.h>
#endif

namespace tspace::gltf {

namespace {

/// The first version that decodes what KHR_meshopt_compression adds: vertex codec 1 and the colour filter.
constexpr int kFirstKhrVersion = 1000;
#ifdef TSPACE_HAS_MESHOPT
constexpr int kVersion = MESHOPTIMIZER_VERSION;
#else
constexpr int kVersion = 0;
#endif

std::string attributeFault(const MeshoptCoding& coding) {
    if (coding.stride == 0 || coding.stride > 256 || coding.stride % 4 != 0)
        return "rows of compressed attributes have 4, 8, ... or 256 bytes, not " + std::to_string(coding.stride);
    const bool fits = coding.filter == MeshoptFilter::quaternion    ? coding.stride == 8
                      : coding.filter == MeshoptFilter::none        ? true
                      : coding.filter == MeshoptFilter::exponential ? true
                                                                    : coding.stride == 4 || coding.stride == 8;
    return fits ? "" : "the filter does not work on rows of " + std::to_string(coding.stride) + " bytes";
}

std::string indexFault(const MeshoptCoding& coding) {
    if (coding.stride != 2 && coding.stride != 4)
        return "compressed indices have 2 or 4 bytes, not " + std::to_string(coding.stride);
    if (coding.filter != MeshoptFilter::none) return "indices have no filter";
    if (coding.mode == MeshoptMode::triangles && coding.count % 3 != 0)
        return "the number of triangle indices, " + std::to_string(coding.count) + ", is no multiple of 3";
    return {};
}

}  // namespace

std::string meshoptMissing(bool is_khr) {
    if (kVersion == 0) return "this tspace was built without the library meshoptimizer";
    if (is_khr && kVersion < kFirstKhrVersion) {
        return "this tspace was built with meshoptimizer " + std::to_string(kVersion / 1000) + "." +
               std::to_string(kVersion / 10 % 100) + ", which is too old for it (1.0 is needed)";
    }
    return {};
}

std::size_t meshoptRatio(bool is_khr) {
    // Codec 0 spends 2 bits on 16 equal bytes of a column; codec 1 spends 2 bits on 256 of them.
    return is_khr ? 1024 : 64;
}

std::string meshoptFault(const MeshoptCoding& coding, std::size_t byte_count) {
    const bool is_attributes = coding.mode == MeshoptMode::attributes;
    std::string fault = is_attributes ? attributeFault(coding) : indexFault(coding);
    if (!fault.empty()) return fault;
    // A triangle takes at least one byte, and so does an index of any other row.
    const std::size_t most = coding.mode == MeshoptMode::triangles ? byte_count * 3
                             : is_attributes ? byte_count * meshoptRatio(coding.is_khr) / coding.stride
                                             : byte_count;
    if (coding.count > most) {
        return std::to_string(byte_count) + " compressed bytes cannot hold " + std::to_string(coding.count) +
               " elements of " + std::to_string(coding.stride) + " bytes";
    }
    return {};
}

#ifdef TSPACE_HAS_MESHOPT

namespace {

void applyFilter(const MeshoptCoding& coding, std::uint8_t* rows) {
    switch (coding.filter) {
        case MeshoptFilter::none:
            break;
        case MeshoptFilter::octahedral:
            meshopt_decodeFilterOct(rows, coding.count, coding.stride);
            break;
        case MeshoptFilter::quaternion:
            meshopt_decodeFilterQuat(rows, coding.count, coding.stride);
            break;
        case MeshoptFilter::exponential:
            meshopt_decodeFilterExp(rows, coding.count, coding.stride);
            break;
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

bool comesBack(const MeshoptCoding& coding, std::span<const std::uint8_t> rows, const Bytes& data) {
    Bytes decoded(rows.size());
    return decodeMeshopt(coding, data, decoded) && std::equal(rows.begin(), rows.end(), decoded.begin());
}

Bytes encodeIndices(const MeshoptCoding& coding, const std::vector<unsigned>& indices) {
    const std::size_t vertex_count =
        indices.empty() ? 0 : std::size_t{*std::max_element(indices.begin(), indices.end())} + 1;
    const bool triangles = coding.mode == MeshoptMode::triangles;
    // The extensions ask for version 1, which is not the default everywhere. The library keeps it in a global variable.
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
    // The data itself may be hostile: the library checks every byte that it reads. Its counts are checked by
    // meshoptFault.
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

bool encodeMeshopt(MeshoptCoding& coding, std::span<const std::uint8_t> rows, Bytes& data) {
    if (coding.mode == MeshoptMode::attributes) {
        data.resize(meshopt_encodeVertexBufferBound(coding.count, coding.stride));
#if MESHOPTIMIZER_VERSION >= 1000
        // Newer versions encode what only KHR_meshopt_compression allows, unless told not to.
        data.resize(meshopt_encodeVertexBufferLevel(data.data(), data.size(), rows.data(), coding.count, coding.stride,
                                                    2, coding.is_khr ? 1 : 0));
#else
        data.resize(meshopt_encodeVertexBuffer(data.data(), data.size(), rows.data(), coding.count, coding.stride));
#endif
        return !data.empty();
    }
    const std::vector<unsigned> indices = wideIndices(coding, rows);
    data = encodeIndices(coding, indices);
    if (coding.mode == MeshoptMode::triangles && !comesBack(coding, rows, data)) {
        // The triangle codec may begin a triangle at another of its corners, and sums over corners would change.
        coding.mode = MeshoptMode::indices;
        data = encodeIndices(coding, indices);
    }
    return !data.empty() && (coding.mode == MeshoptMode::triangles || comesBack(coding, rows, data));
}

#else

bool decodeMeshopt(const MeshoptCoding&, std::span<const std::uint8_t>, std::span<std::uint8_t>) { return false; }
bool encodeMeshopt(MeshoptCoding&, std::span<const std::uint8_t>, Bytes&) { return false; }

#endif

}  // namespace tspace::gltf
