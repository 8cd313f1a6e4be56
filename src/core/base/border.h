// SPDX-License-Identifier: MIT
// API boundary of the library: checks of the caller's spans, and conversion of exceptions to errors.
#pragma once

#include <new>
#include <stdexcept>
#include <type_traits>

#include "core/base/memory.h"
#include "tspace/execution.h"
#include "tspace/mesh.h"
#include "tspace/result.h"

namespace tspace {

class Parallel;

/// Returns an error with a message in printf format (%s, %u and %zu only). One function for all messages, because each
/// concatenation of strings would take 2 KB of code.
[[gnu::format(printf, 3, 4)]] Error makeError(ErrorCode code, std::uint64_t element, const char* format, ...);

/// Returns the Error for the exception that is being handled. Never throws, even without free memory.
Error caughtError();

/// Calls `body`, which returns a Result, and converts out-of-memory exceptions (and internal defects) to an Error.
template <class Body>
auto atBorder(Body&& body) -> std::invoke_result_t<Body> {
#ifdef __cpp_exceptions
    try {
        return body();
    } catch (...) {
        return caughtError();
    }
#else
    return body();
#endif
}

/// Returns the result of `body`, or 0 or null if it runs out of memory. Other exceptions propagate. In builds without
/// exceptions, a lack of memory terminates the program.
template <class Body>
auto withMemory(Body&& body) -> std::invoke_result_t<Body> {
#ifdef __cpp_exceptions
    try {
        return body();
    } catch (const std::bad_alloc&) {
        return {};
    } catch (const std::length_error&) {
        return {};
    } catch (const OutOfMemory&) {
        return {};
    }
#else
    return body();
#endif
}

/// Expected count of a span whose length checkSpan does not check.
inline constexpr std::size_t kAnyCount = ~std::size_t{0};

/// Checks pointer, stride, alignment and length of a span. `name` identifies it in messages. Returns an Error with code
/// ok if the span is valid.
Error checkSpan(const void* data, std::size_t count, std::size_t stride_bytes, std::size_t element_bytes,
                std::size_t expected_count, const char* name);

template <class T>
Error checkSpan(const StridedSpan<T>& span, std::size_t expected_count, const char* name) {
    return checkSpan(span.data, span.count, span.stride_bytes, sizeof(T), expected_count, name);
}

/// Performs the checks of validate(). With `parallel`, all threads check indices.
Error checkMesh(const MeshView& mesh, Parallel* parallel = nullptr);

/// Checks type, pointer and alignment of `indices`, and that each index is below `vertex_count`; with `parallel`, on
/// all threads. Returns an Error like checkSpan.
Error checkIndices(const IndexView& indices, std::size_t vertex_count, Parallel* parallel = nullptr);

/// Options and execution of a call, which are passed together below the API boundary.
template <class Options>
struct Call : Options {
    Execution execution = {};
};

}  // namespace tspace
