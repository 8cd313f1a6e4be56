// SPDX-License-Identifier: MIT
// Shared by all functions of the C API: C structs become C++ ones, and Results become codes.
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

/// Writes `error` to the caller's struct, which may be null, and returns its code. Takes no memory, as there may be none.
tspace_ErrorCode finish(const Error& error, tspace_Error* out) noexcept;

/// Appends to the message as much as it has room for; no half of a UTF-8 character.
void appendMessage(std::string_view text, tspace_Error& to) noexcept;

/// Writes the error of `result`, or that there is none, and returns its code.
template <class Value>
tspace_ErrorCode finishResult(const Result<Value>& result, tspace_Error* out) noexcept {
    return result ? finish(Error{ErrorCode::ok}, out) : finish(result.error(), out);
}

/// Runs `body`, which returns a Result<Done>, at the C border.
template <class Body>
tspace_ErrorCode atCBorder(tspace_Error* out, Body&& body) noexcept {
    return finishResult<Done>(atBorder(body), out);
}

/// Every size that `Struct` had in a header, the last one now; a program may have been compiled with any of them. Whoever
/// appends a field keeps the list, and appends the new size: an older one says which fields are there. A field that would lie
/// in what was padding comes behind a `reserved` one, since its size would be that of the struct without it.
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

/// An Error with code ok when `size` is one that the struct has or had. Null is a struct that was not given: fine here.
Error checkStructSize(std::uint32_t size, std::span<const std::size_t> known, const char* name);

template <class Struct>
Error checkSized(const Struct* sized, const char* name) {
    if (sized == nullptr) return {ErrorCode::ok};
    return checkStructSize(sized->struct_size, kSizes<Struct>, name);
}

/// Like checkSized, for a struct that must not be null.
template <class Struct>
Error checkNeeded(const Struct* sized, const char* name) {
    if (sized == nullptr) return makeError(ErrorCode::nullData, kNoElement, "%s is null", name);
    return checkSized(sized, name);
}

/// The fields that the caller has given, and defaults for the others.
template <class Struct>
Struct orDefault(const Struct* given) {
    Struct whole;
    TSPACE_INIT(whole);
    if (given != nullptr) std::memcpy(&whole, given, std::min<std::size_t>(given->struct_size, sizeof(Struct)));
    return whole;
}

/// Writes those fields of a report that its caller knows.
template <class Struct>
void give(Struct report, Struct* to) {
    if (to == nullptr) return;
    report.struct_size = to->struct_size;
    std::memcpy(to, &report, to->struct_size);
}

/// Checks that options were prepared. `has_defaults` is false where every field with a default other than 0 is 0, as in a
/// struct of zeros from a language without TSPACE_INIT, whose tangents nothing would say to be other ones. `name` is that
/// of tspace_init<name>, `fields` are these.
Error checkPrepared(bool has_defaults, const char* name, const char* fields);

/// Checks that a choice or flag is not above its largest value.
Error checkChoice(std::uint32_t value, std::uint32_t largest, const char* name);

/// The first of several checks that failed, or ok. Later ones are not looked at.
template <class... Checks>
Error firstError(Checks&&... checks) {
    Error error{ErrorCode::ok};
    static_cast<void>((((error = checks()).code == ErrorCode::ok) && ...));
    return error;
}

/// A C span of floats as a span of T (float, Vec2, Vec3, Vec4); stride 0 becomes tight.
template <class T>
StridedSpan<const T> toSpan(const tspace_ConstSpan& span) {
    return {reinterpret_cast<const T*>(span.data), span.count, span.stride_bytes == 0 ? sizeof(T) : span.stride_bytes};
}
template <class T>
StridedSpan<T> toSpan(const tspace_Span& span) {
    return {reinterpret_cast<T*>(span.data), span.count, span.stride_bytes == 0 ? sizeof(T) : span.stride_bytes};
}

IndexView toIndices(const tspace_Indices& indices);

/// The mesh without checks; only its struct size must be right.
MeshView toMesh(const tspace_Mesh& mesh);

/// Null, struct size, and null arrays with a count that C++ types cannot express. Everything else is
/// validate()'s.
Error checkMesh(const tspace_Mesh* mesh);

Error checkConvention(const tspace_Convention& convention);
Convention toConvention(const tspace_Convention& convention);

/// Null: the default.
Error checkExecution(const tspace_Execution* execution);

/// Null: defaults.
Error checkOptions(const tspace_NormalOptions* given);
NormalOptions toOptions(const tspace_NormalOptions& options);
Error checkOptions(const tspace_TangentOptions* given);
TangentOptions toOptions(const tspace_TangentOptions& options);
Result<std::vector<CornerAttribute>> toAttributes(const tspace_CornerAttribute* attributes, std::size_t count,
                                                  const char* name);

/// C++ copies of the caller's hooks. Must outlive the Execution it gives, so it neither moves nor is copied.
class Hooks {
  public:
    /// Null: the default.
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
