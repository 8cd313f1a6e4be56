// SPDX-License-Identifier: MIT
// Shared code of the C API: conversion of C structs to C++ ones, and of Results to codes.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/border.h"
#include "tspace/convention.h"
#include "tspace/execution.h"
#include "tspace/indexed_frames.h"
#include "tspace/mesh.h"
#include "tspace/normals.h"
#include "tspace/result.h"
#include "tspace/tangents.h"
#include "tspace/tspace.h"

namespace tspace::c_api {

/// Writes `error` to the caller's struct, which may be null, and returns its code. Allocates nothing, as memory may
/// have run out.
tspace_ErrorCode finish(const Error& error, tspace_Error* out) noexcept;

/// Appends to the message as much as fits, without splitting a UTF-8 character.
void appendMessage(std::string_view text, tspace_Error& to) noexcept;

/// Writes the error of `result`, or code ok, and returns its code.
template <class Value>
tspace_ErrorCode finishResult(const Result<Value>& result, tspace_Error* out) noexcept {
    return result ? finish(Error{ErrorCode::ok}, out) : finish(result.error(), out);
}

/// Calls `body`, which returns a Result<Done>, at the C API boundary.
template <class Body>
tspace_ErrorCode atCBorder(tspace_Error* out, Body&& body) noexcept {
    return finishResult<Done>(atBorder(body), out);
}

/// All sizes that `Struct` has had in a header, the current one last; a program may have been compiled with any of
/// them. When a field is appended, keep the list and append the new size: an older size tells which fields exist. A
/// field that would use former padding must follow a `reserved` field, since the size of the struct would not change
/// otherwise.
template <class Struct>
inline constexpr std::size_t kSizes[] = {sizeof(Struct)};
template <>
inline constexpr std::size_t kSizes<tspace_Mesh>[] = {offsetof(tspace_Mesh, normal_indices), sizeof(tspace_Mesh)};
template <>
inline constexpr std::size_t kSizes<tspace_NormalOptions>[] = {offsetof(tspace_NormalOptions, denoise),
                                                               sizeof(tspace_NormalOptions)};
template <>
inline constexpr std::size_t kSizes<tspace_TangentOptions>[] = {offsetof(tspace_TangentOptions, normalize_normals),
                                                                sizeof(tspace_TangentOptions)};
template <>
inline constexpr std::size_t kSizes<tspace_WindingOptions>[] = {offsetof(tspace_WindingOptions, weld_distance),
                                                                sizeof(tspace_WindingOptions)};
template <>
inline constexpr std::size_t kSizes<tspace_NormalReport>[] = {offsetof(tspace_NormalReport, noise),
                                                              sizeof(tspace_NormalReport)};
template <>
inline constexpr std::size_t kSizes<tspace_SanitizeReport>[] = {offsetof(tspace_SanitizeReport, placeholder_count),
                                                                sizeof(tspace_SanitizeReport)};
template <>
inline constexpr std::size_t kSizes<tspace_TangentOutput>[] = {offsetof(tspace_TangentOutput, has_tangent),
                                                               sizeof(tspace_TangentOutput)};

/// Returns an Error with code ok if `size` is a current or former size of the struct. A null struct is valid.
Error checkStructSize(std::uint32_t size, std::span<const std::size_t> known, const char* name);

template <class Struct>
Error checkSized(const Struct* sized, const char* name) {
    if (sized == nullptr) return {ErrorCode::ok};
    return checkStructSize(sized->struct_size, kSizes<Struct>, name);
}

/// Checks the size of a struct, like checkSized, and that the struct is not null.
template <class Struct>
Error checkRequired(const Struct* sized, const char* name) {
    if (sized == nullptr) return makeError(ErrorCode::nullData, kNoElement, "%s is null", name);
    return checkSized(sized, name);
}

/// Returns the fields that the caller has given, with defaults for the others.
template <class Struct>
Struct givenOrDefault(const Struct* given) {
    Struct whole;
    TSPACE_INIT(whole);
    if (given != nullptr) std::memcpy(&whole, given, std::min<std::size_t>(given->struct_size, sizeof(Struct)));
    return whole;
}

/// Initializes a struct for languages without macros: writes the defaults of the fields that the caller's version of it
/// has.
template <class Struct>
tspace_ErrorCode init(Struct* options, std::uint32_t struct_size, const char* name, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (options == nullptr) return makeError(ErrorCode::nullData, kNoElement, "%s is null", name);
        if (Error e = checkStructSize(struct_size, kSizes<Struct>, name); e.code != ErrorCode::ok) return e;
        Struct whole;
        TSPACE_INIT(whole);
        whole.struct_size = struct_size;
        std::memcpy(options, &whole, struct_size);
        return Done{};
    });
}

/// Copies a report to the caller's struct: only the fields that the caller's version of the struct has.
template <class Struct>
void writeReport(Struct report, Struct* to) {
    if (to == nullptr) return;
    report.struct_size = to->struct_size;
    std::memcpy(to, &report, to->struct_size);
}

/// Checks that options were initialized. `has_defaults` is false if every field with a nonzero default is 0, as in a
/// zero-filled struct from a language without TSPACE_INIT: such options would silently change the results. `name` is
/// the one in tspace_init<name>, `fields` lists these fields.
Error checkInitialized(bool has_defaults, const char* name, const char* fields);

/// Checks that an enumerator or flag does not exceed its largest value.
Error checkChoice(std::uint32_t value, std::uint32_t largest, const char* name);

/// Returns the first error among several checks, or ok. Later checks are skipped.
template <class... Checks>
Error firstError(Checks&&... checks) {
    Error error{ErrorCode::ok};
    static_cast<void>((((error = checks()).code == ErrorCode::ok) && ...));
    return error;
}

/// Converts a C span of floats to a span of T (float, Vec2, Vec3, Vec4); stride 0 means tightly packed.
template <class T>
StridedSpan<const T> toSpan(const tspace_ConstSpan& span) {
    return {reinterpret_cast<const T*>(span.data), span.count, span.stride_bytes == 0 ? sizeof(T) : span.stride_bytes};
}
template <class T>
StridedSpan<T> toSpan(const tspace_Span& span) {
    return {reinterpret_cast<T*>(span.data), span.count, span.stride_bytes == 0 ? sizeof(T) : span.stride_bytes};
}

IndexView toIndices(const tspace_Indices& indices);

/// Converts a mesh without checks; only its struct size must be valid.
MeshView toMesh(const tspace_Mesh& mesh);

/// Checks what the conversion requires: a pointer that is not null, a known struct size, and no null array with a
/// count, which C++ types cannot represent. validate() checks the rest.
Error checkMesh(const tspace_Mesh* mesh);

Error checkConvention(const tspace_Convention& convention);
Convention toConvention(const tspace_Convention& convention);

/// Checks an execution. Null is valid and means the default.
Error checkExecution(const tspace_Execution* execution);

/// Checks or converts options. Null is valid and means the defaults.
Error checkOptions(const tspace_NormalOptions* given);
NormalOptions toOptions(const tspace_NormalOptions& options);
Error checkOptions(const tspace_TangentOptions* given);
TangentOptions toOptions(const tspace_TangentOptions& options);
TangentOutput toOutput(const tspace_TangentOutput& given);
Result<std::vector<CornerAttribute>> toAttributes(const tspace_CornerAttribute* attributes, std::size_t count,
                                                  const char* name);

/// C++ copies of the caller's callbacks. Must outlive the Execution that it returns, so it can be neither moved nor
/// copied.
class Hooks {
  public:
    /// Copies the callbacks of an execution. Null means the default execution.
    explicit Hooks(const tspace_Execution* execution);
    Hooks(const Hooks&) = delete;
    Hooks& operator=(const Hooks&) = delete;

    [[nodiscard]] Execution execution() const;

  private:
    Executor executor_;
    Allocator allocator_;
    std::uint32_t thread_count_ = 1;
    SimdTarget simd_ = SimdTarget::best;
};

}  // namespace tspace::c_api
