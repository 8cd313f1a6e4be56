// SPDX-License-Identifier: MIT
// API boundary of the library: errors and their names, and validation of meshes and spans.
#include "tspace/result.h"

#include <algorithm>
#include <atomic>
#include <cstdarg>
#include <iterator>
#include <limits>
#include <new>
#include <string_view>

#include "core/base/border.h"
#include "core/base/mesh_loops.h"
#include "core/base/parallel.h"
#include "tspace/convention.h"
#include "tspace/mesh.h"

namespace tspace {

const char* errorName(ErrorCode code) {
    static constexpr std::uint32_t kFirstOfFiles = 100;
    static constexpr const char* kNames[] = {
        "ok",           "nullData", "countMismatch",    "indexOutOfRange", "strideTooSmall",
        "misaligned",   "tooLarge", "missingAttribute", "invalidOption",   "outOfMemory",
        "planMismatch", "internal", "cancelled"};
    static constexpr const char* kNamesOfFiles[] = {"invalidFile", "unsupportedFile", "forbiddenPath", "cannotRead",
                                                    "cannotWrite"};
    static_assert(std::size(kNames) == static_cast<std::size_t>(ErrorCode::cancelled) + 1);
    static_assert(std::size(kNamesOfFiles) == static_cast<std::size_t>(ErrorCode::cannotWrite) + 1 - kFirstOfFiles);
    const auto number = static_cast<std::uint32_t>(code);
    if (number < std::size(kNames)) return kNames[number];
    return number - kFirstOfFiles < std::size(kNamesOfFiles) ? kNamesOfFiles[number - kFirstOfFiles] : "unknown";
}

const Convention* findConvention(const char* name) {
    struct Preset {
        std::string_view name;
        Convention convention;
    };
    static constexpr Preset kPresets[] = {
        {"gltf", conventions::gltf},     {"opengl", conventions::opengl}, {"directx", conventions::directx},
        {"unreal", conventions::unreal}, {"unity", conventions::unity},   {"blender", conventions::blender},
        {"godot", conventions::godot},
    };
    if (name == nullptr) return nullptr;
    for (const Preset& preset : kPresets) {
        if (preset.name == name) return &preset.convention;
    }
    return nullptr;
}

namespace {

void append(std::string& text, std::size_t number) {
    char digits[20];
    std::size_t first = sizeof digits;
    do {
        digits[--first] = static_cast<char>('0' + number % 10);
        number /= 10;
    } while (number != 0);
    text.append(digits + first, sizeof digits - first);
}

}  // namespace

// Avoids the C library's printf, which takes 20 KB of a static program, and 4 KB of a compressed WebAssembly module.
Error makeError(ErrorCode code, std::uint64_t element, const char* format, ...) {
    Error error{code, {}, element};
    std::va_list arguments;
    va_start(arguments, format);
    for (; *format != 0; ++format) {
        if (*format != '%') {
            error.message += *format;
        } else if (*++format == 's') {
            error.message += va_arg(arguments, const char*);
        } else if (*format == 'z') {
            ++format;
            append(error.message, va_arg(arguments, std::size_t));
        } else {
            append(error.message, va_arg(arguments, unsigned));
        }
    }
    va_end(arguments);
    return error;
}

#ifdef __cpp_exceptions

void throwOutOfMemory() { throw OutOfMemory{}; }

Error caughtError() {
    // Messages of up to 15 characters need no allocation: std::string stores them inline.
    try {
        throw;
    } catch (const OutOfMemory&) {
        return {ErrorCode::outOfMemory, "out of memory"};
    } catch (const std::bad_alloc&) {
        return {ErrorCode::outOfMemory, "out of memory"};
    } catch (const Cancelled&) {
        return {ErrorCode::cancelled, "the call was canceled before it finished"};
    } catch (...) {
        // The message has more than 15 characters, so std::string allocates memory for it, which may fail.
        try {
            return {ErrorCode::internal, "internal error: an unexpected exception occurred"};
        } catch (...) {
            return {ErrorCode::internal, "internal error"};
        }
    }
}

#else

// The program that links the library defines this function. In bindings without exceptions, it aborts the call.
extern "C" [[noreturn]] void tspace_endCallOutOfMemory(void);
void throwOutOfMemory() { tspace_endCallOutOfMemory(); }

#endif

// Validation of meshes and spans at the API boundary.

namespace {

Error fine() { return {ErrorCode::ok, {}}; }

Error checkFaces(const MeshView& mesh) {
    const std::size_t corners = mesh.cornerCount();
    if (mesh.face_sizes.empty()) {
        if (mesh.face_size == 0) return {ErrorCode::invalidOption, "face_size is 0"};
        if (corners % mesh.face_size != 0) {
            return makeError(ErrorCode::countMismatch, kNoElement,
                             "the %zu corners cannot be divided into faces of %u corners", corners, mesh.face_size);
        }
        return fine();
    }
    if (mesh.face_sizes.data() == nullptr) return {ErrorCode::nullData, "face_sizes is null, but its count is not 0"};
    if (mesh.face_sizes.size() > kMaxCorners) return {ErrorCode::tooLarge, "the mesh has more than 2^31-1 faces"};
    std::uint64_t sum = 0;
    for (std::size_t f = 0; f < mesh.face_sizes.size(); ++f) {
        sum += mesh.face_sizes[f];
        if (sum > corners) {
            return makeError(ErrorCode::countMismatch, f, "face sizes add up to more than the %zu corners of the mesh",
                             corners);
        }
    }
    if (sum != corners) {
        return makeError(ErrorCode::countMismatch, kNoElement, "face sizes add up to %zu corners, but the mesh has %zu",
                         static_cast<std::size_t>(sum), corners);
    }
    return fine();
}

/// Returns whether all indices are below `limit`, without branches, so that compilers vectorize it. For i < 2^31 and
/// limit <= 2^31, i - limit has its highest bit set exactly if i < limit.
bool allBelow(const std::uint32_t* indices, std::size_t count, std::uint32_t limit) {
    std::uint32_t all = ~std::uint32_t{0};
    for (std::size_t c = 0; c < count; ++c) all &= (indices[c] - limit) & ~indices[c];
    return all >> 31 != 0;
}

/// Checks that each index is below `count`.
Error checkBelow(const IndexView& indices, std::size_t count, Parallel* parallel, const char* index_name,
                 const char* name) {
    if (indices.type == IndexType::none) return fine();
    const auto limit = static_cast<std::uint32_t>(std::min(count, kMaxCorners + 1));
    std::atomic<bool> all{true};
    const auto check = [&](std::size_t begin, std::size_t end) {
        constexpr std::size_t kPart = 1024;  // indices widened per step; 32-bit indices are read in place
        std::uint32_t buffer[kPart];
        const std::size_t step = indices.type == IndexType::u32 ? end - begin : kPart;
        for (; begin < end; begin += step) {
            const std::size_t part = std::min(step, end - begin);
            if (!allBelow(readIndices(indices, begin, part, buffer), part, limit))
                all.store(false, std::memory_order_relaxed);
        }
    };
    constexpr std::size_t kGrain = 200'000;  // indices per task: checking them takes longer than starting a thread
    if (parallel == nullptr)
        check(0, indices.count);
    else
        parallel->forRanges(indices.count, kGrain, check);
    std::size_t c = all ? indices.count : 0;
    while (c < indices.count && indices[c] < count) ++c;
    if (c == indices.count) return fine();
    return makeError(ErrorCode::indexOutOfRange, c, "%s %u of corner %zu is out of range: there are %zu %s", index_name,
                     indices[c], c, count, name);
}

Error checkIndexSpan(const IndexView& indices, const char* name) {
    if (indices.type == IndexType::none) {
        if (indices.count != 0) {
            return makeError(ErrorCode::invalidOption, kNoElement, "%s have a count, but their type is IndexType::none",
                             name);
        }
        return fine();
    }
    const auto bytes = static_cast<std::size_t>(indices.type);
    if (bytes != 1 && bytes != 2 && bytes != 4) {  // IndexType::corners is valid for attributes only
        return makeError(ErrorCode::invalidOption, kNoElement, "unknown index type %zu", bytes);
    }
    return checkSpan(indices.data, indices.count, bytes, bytes, kAnyCount, name);
}

/// Checks one attribute, viewed as bytes: one entry per vertex, or any number of entries with an index list of its own.
Error checkAttribute(const StridedSpan<const std::byte>& span, std::size_t element_bytes, const IndexView& indices,
                     const MeshView& mesh, const char* name, const char* indices_name) {
    const std::size_t corner_count = mesh.cornerCount();
    const auto checkCount = [&](std::size_t count) {
        return checkSpan(span.data, span.count, span.stride_bytes, element_bytes, count, name);
    };
    if (indices.type == IndexType::none && indices.count == 0)
        return span.empty() ? fine() : checkCount(mesh.vertexCount());
    if (indices.type == IndexType::corners) return span.empty() ? fine() : checkCount(corner_count);
    if (span.count > kMaxCorners)
        return makeError(ErrorCode::tooLarge, kNoElement, "the mesh has more than 2^31-1 %s", name);
    if (Error e = checkCount(kAnyCount); e.code != ErrorCode::ok) return e;
    if (Error e = checkIndexSpan(indices, indices_name); e.code != ErrorCode::ok) return e;
    if (indices.count != corner_count) {
        return makeError(ErrorCode::countMismatch, kNoElement,
                         "%s has %zu entries, but needs one for each of the %zu corners", indices_name, indices.count,
                         corner_count);
    }
    if (span.empty() && corner_count != 0) return fine();
    return checkBelow(indices, span.count, nullptr, indices_name, name);
}

}  // namespace

Error checkSpan(const void* data, std::size_t count, std::size_t stride_bytes, std::size_t element_bytes,
                std::size_t expected_count, const char* name) {
    if (expected_count != kAnyCount && count != expected_count) {
        return makeError(ErrorCode::countMismatch, kNoElement, "%s has %zu entries, but needs %zu", name, count,
                         expected_count);
    }
    if (count == 0) return fine();
    if (data == nullptr)
        return makeError(ErrorCode::nullData, kNoElement, "%s is null, but its count is %zu", name, count);
    if (count > 1 && stride_bytes < element_bytes) {
        return makeError(ErrorCode::strideTooSmall, kNoElement,
                         "%s has a stride of %zu bytes, which is less than its element size of %zu bytes", name,
                         stride_bytes, element_bytes);
    }
    // alignment: 4 for floats and 32-bit indices; otherwise the size of the index
    const std::size_t alignment = element_bytes % 4 == 0 ? 4 : element_bytes;
    if (reinterpret_cast<std::uintptr_t>(data) % alignment != 0 || (count > 1 && stride_bytes % alignment != 0))
        return makeError(ErrorCode::misaligned, kNoElement, "%s is not aligned to %zu bytes", name, alignment);
    if (count > 1 && (count - 1) > (std::numeric_limits<std::size_t>::max() - element_bytes) / stride_bytes)
        return makeError(ErrorCode::tooLarge, kNoElement, "%s with its stride exceeds the address space", name);
    return fine();
}

Error checkIndices(const IndexView& indices, std::size_t vertex_count, Parallel* parallel) {
    if (Error e = checkIndexSpan(indices, "indices"); e.code != ErrorCode::ok) return e;
    return checkBelow(indices, vertex_count, parallel, "index", "vertices");
}

Error checkMesh(const MeshView& mesh, Parallel* parallel) {
    if (mesh.positions.count > kMaxCorners || mesh.indices.count > kMaxCorners)
        return {ErrorCode::tooLarge, "the mesh has more than 2^31-1 vertices or corners"};
    if (Error e = checkSpan(mesh.positions, kAnyCount, "positions"); e.code != ErrorCode::ok) return e;
    if (Error e = checkIndexSpan(mesh.indices, "indices"); e.code != ErrorCode::ok) return e;
    const auto check = [&](const auto& span, const IndexView& indices, const char* name, const char* indices_name) {
        return checkAttribute({reinterpret_cast<const std::byte*>(span.data), span.count, span.stride_bytes},
                              sizeof *span.data, indices, mesh, name, indices_name);
    };
    Error e = check(mesh.normals, mesh.normal_indices, "normals", "normal_indices");
    if (e.code == ErrorCode::ok) e = check(mesh.uvs, mesh.uv_indices, "uvs", "uv_indices");
    if (e.code == ErrorCode::ok) e = checkFaces(mesh);
    if (e.code != ErrorCode::ok) return e;
    return checkBelow(mesh.indices, mesh.positions.count, parallel, "index", "vertices");
}

const std::uint32_t* widenIndices(const IndexView& view, std::size_t first, std::size_t count, std::uint32_t* buffer) {
    const auto fill = [=](const auto& indexAt) {
        for (std::size_t i = 0; i < count; ++i) buffer[i] = static_cast<std::uint32_t>(indexAt(first + i));
    };
    switch (view.type) {
#ifndef TSPACE_SMALL
        case IndexType::u16:
            fill([from = static_cast<const std::uint16_t*>(view.data)](std::size_t c) { return from[c]; });
            break;
        case IndexType::u8:
            fill([from = static_cast<const std::uint8_t*>(view.data)](std::size_t c) { return from[c]; });
            break;
#endif
        default: fill([](std::size_t c) { return c; }); break;
    }
    return buffer;
}

Result<Done> validate(const MeshView& mesh) {
    return atBorder([&]() -> Result<Done> {
        if (Error e = checkMesh(mesh); e.code != ErrorCode::ok) return e;
        return Done{};
    });
}

}  // namespace tspace
