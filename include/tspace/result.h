// SPDX-License-Identifier: MIT
// How tspace reports failure: values, never exceptions. Broken geometry is not a failure: it is counted in reports.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>

namespace tspace {

/// Why a call failed. The numbers are stable, the same in C and C++, and never reused.
enum class ErrorCode : std::uint32_t {
    ok = 0,                 ///< not an error
    nullData = 1,           ///< a pointer is null although it is needed, or its count is not zero
    countMismatch = 2,      ///< two arrays that must have the same length do not
    indexOutOfRange = 3,    ///< an index is not smaller than the number of vertices; `element` is its position
    strideTooSmall = 4,     ///< elements of a span would overlap
    misaligned = 5,         ///< a pointer or stride is not a multiple of its element's alignment
    tooLarge = 6,           ///< a size does not fit: the sum of face sizes, or a limit stated by the function
    missingAttribute = 7,   ///< the method needs an attribute (normals, UVs) that the mesh does not have
    invalidOption = 8,      ///< an option has a value outside its stated range
    outOfMemory = 9,        ///< the allocator returned null
    planMismatch = 10,      ///< arrays do not fit the plan they are evaluated with
    internal = 11,          ///< a defect of tspace; please report it
    cancelled = 12,         ///< the caller ended the call from a function of its own; nothing was made or written
    invalidFile = 100,      ///< asset layer: the file breaks its format; the error says where
    unsupportedFile = 101,  ///< asset layer: valid, but needs a feature that this version does not have
    forbiddenPath = 102,    ///< asset layer: a URI leads outside the model's folder
    cannotRead = 103,       ///< asset layer: a file cannot be opened or read
    cannotWrite = 104,      ///< asset layer: a file cannot be written; nothing was changed
};

/// Stable identifier of a code in lowerCamelCase, for logs and JSON ("indexOutOfRange"); "unknown" for other numbers.
/// Static memory.
const char* errorName(ErrorCode code);

/// For a caller's progress function to throw: ends the call with ErrorCode::cancelled.
struct Cancelled {};

/// Element of an error that is about no element in particular.
inline constexpr std::uint64_t kNoElement = ~std::uint64_t{0};

/// What went wrong, in words for the person who has to mend it, and where.
struct Error {
    ErrorCode code = ErrorCode::internal;
    std::string message = {};            ///< one sentence, no line break
    std::uint64_t element = kNoElement;  ///< index of the offending element, or kNoElement
    std::string place = {};              ///< asset layer: file and JSON pointer or line; else empty
};

/// Either a T or an Error. Test with `if (result)` before use.
template <class T>
class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    explicit operator bool() const { return state_.index() == 0; }
    [[nodiscard]] bool ok() const { return state_.index() == 0; }

    /// The value; only when ok().
    T& operator*() & { return *std::get_if<0>(&state_); }
    const T& operator*() const& { return *std::get_if<0>(&state_); }
    T&& operator*() && { return std::move(*std::get_if<0>(&state_)); }
    T* operator->() { return std::get_if<0>(&state_); }
    const T* operator->() const { return std::get_if<0>(&state_); }

    /// The error; only when not ok().
    [[nodiscard]] const Error& error() const& { return *std::get_if<1>(&state_); }
    [[nodiscard]] Error&& error() && { return std::move(*std::get_if<1>(&state_)); }

  private:
    std::variant<T, Error> state_;
};

/// Success without a value.
struct Done {};

}  // namespace tspace
