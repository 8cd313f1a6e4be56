// SPDX-License-Identifier: MIT
// Error reporting of tspace: return values, never exceptions. Invalid geometry is not an error: reports count it.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>

namespace tspace {

/// Reason why a call failed. The numbers are stable, equal in C and C++, and never reused.
enum class ErrorCode : std::uint32_t {
    ok = 0,                 ///< not an error
    nullData = 1,           ///< a required pointer is null, or a null array has a nonzero count
    countMismatch = 2,      ///< two arrays that must have equal lengths differ in length
    indexOutOfRange = 3,    ///< an index is not less than the number of vertices; `element` is its position
    strideTooSmall = 4,     ///< elements of a span would overlap
    misaligned = 5,         ///< a pointer or stride is not a multiple of its element's alignment
    tooLarge = 6,           ///< a size exceeds a limit: the sum of face sizes, or a limit stated by the function
    missingAttribute = 7,   ///< the method needs an attribute (normals, UVs) that the mesh does not have
    invalidOption = 8,      ///< an option has a value outside its stated range
    outOfMemory = 9,        ///< the allocator returned null
    planMismatch = 10,      ///< arrays do not fit the plan they are evaluated with
    internal = 11,          ///< a bug in tspace; please report it
    cancelled = 12,         ///< a callback of the caller canceled the call; no result was returned or written
    invalidFile = 100,      ///< asset layer: the file violates its format; the error states where
    unsupportedFile = 101,  ///< asset layer: the file is valid, but needs a feature that this version does not support
    forbiddenPath = 102,    ///< asset layer: a URI leads outside the folder of the model
    cannotRead = 103,       ///< asset layer: a file cannot be opened or read
    cannotWrite = 104,      ///< asset layer: a file cannot be written; nothing was changed
};

/// Returns the stable lowerCamelCase identifier of a code, for logs and JSON ("indexOutOfRange"); "unknown" for other
/// numbers. Static memory.
const char* errorName(ErrorCode code);

/// Thrown by a progress callback to cancel the call, which then fails with ErrorCode::cancelled.
struct Cancelled {};

/// Value of `element` for an error that concerns no particular element.
inline constexpr std::uint64_t kNoElement = ~std::uint64_t{0};

/// Description and location of an error, for the person who has to fix it.
struct Error {
    ErrorCode code = ErrorCode::internal;
    std::string message = {};            ///< one sentence, no line break
    std::uint64_t element = kNoElement;  ///< index of the offending element, or kNoElement
    std::string place = {};              ///< asset layer: file, and JSON pointer or line; otherwise empty
};

/// Holds a T or an Error. Test it with `if (result)` before use.
template <class T>
class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    explicit operator bool() const { return state_.index() == 0; }
    [[nodiscard]] bool ok() const { return state_.index() == 0; }

    /// Returns the value. Requires ok().
    T& operator*() & { return *std::get_if<0>(&state_); }
    const T& operator*() const& { return *std::get_if<0>(&state_); }
    T&& operator*() && { return std::move(*std::get_if<0>(&state_)); }
    T* operator->() { return std::get_if<0>(&state_); }
    const T* operator->() const { return std::get_if<0>(&state_); }

    /// Returns the error. Requires !ok().
    [[nodiscard]] const Error& error() const& { return *std::get_if<1>(&state_); }
    [[nodiscard]] Error&& error() && { return std::move(*std::get_if<1>(&state_)); }

  private:
    std::variant<T, Error> state_;
};

/// Value type of a Result without data.
struct Done {};

}  // namespace tspace
