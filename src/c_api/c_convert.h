// SPDX-License-Identifier: MIT
// What every function of the C API does: turn C structs into C++ ones, and Results into codes.
#pragma once

#include <bit>
#include <cstddef>
#include <string>

#include "core/border.h"
#include "tspace/convention.h"
#include "tspace/execution.h"
#include "tspace/mesh.h"
#include "tspace/result.h"
#include "tspace/tspace.h"

namespace tspace::c_api {

/// Writes `error` to the caller's struct, which may be null, and returns its code.
tspace_ErrorCode finish(const Error& error, tspace_Error* out) noexcept;

/// Runs `body`, which returns a Result<Done>, at the C border.
template <class Body>
tspace_ErrorCode atCBorder(tspace_Error* out, Body&& body) noexcept {
    const Result<Done> result = atBorder(body);
    return finish(result ? Error{ErrorCode::ok} : result.error(), out);
}

/// An Error with code ok when `size` is the one of `Struct`. Null is a struct that was not given: fine here.
Error checkStructSize(std::uint32_t size, std::size_t expected, const char* name);

template <class Struct>
Error checkSized(const Struct* sized, const char* name) {
    return sized == nullptr ? Error{ErrorCode::ok} : checkStructSize(sized->struct_size, sizeof(Struct), name);
}

/// The same for a struct that must be given.
template <class Struct>
Error checkNeeded(const Struct* sized, const char* name) {
    if (sized == nullptr) return makeError(ErrorCode::nullData, kNoElement, "%s is null", name);
    return checkSized(sized, name);
}

/// The given struct, or one of defaults. Only after checkSized.
template <class Struct>
Struct orDefault(const Struct* given) {
    if (given != nullptr) return *given;
    Struct defaults;
    TSPACE_INIT(defaults);
    return defaults;
}

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

/// The number of steps that the C constant means.
constexpr std::uint32_t toRefine(tspace_Refine refine) {
    return refine == TSPACE_REFINE_NONE ? 0 : refine == TSPACE_REFINE_DEFAULT ? 1 : refine;
}

IndexView toIndices(const tspace_Indices& indices);

/// The mesh without checks; only its struct size must be right.
MeshView toMesh(const tspace_Mesh& mesh);

/// Null, struct size, and null arrays with a count that C++ types cannot express. Everything else is
/// validate()'s.
Error checkMesh(const tspace_Mesh* mesh);

Error checkConvention(const tspace_Convention& convention);
Convention toConvention(const tspace_Convention& convention);

Error checkExecution(const tspace_Execution& execution);

/// C++ copies of the caller's hooks. Must outlive the Execution it gives, so it neither moves nor is copied.
class Hooks {
  public:
    Hooks() = default;
    explicit Hooks(const tspace_Execution& execution);
    Hooks(const Hooks&) = delete;
    Hooks& operator=(const Hooks&) = delete;

    [[nodiscard]] Execution execution() const;

  private:
    Executor executor_;
    Allocator allocator_;
    unsigned thread_count_ = 0;
    SimdTarget simd_ = SimdTarget::best;
};

}  // namespace tspace::c_api
