// SPDX-License-Identifier: MIT
// The border of the library: checks of the caller's spans, and no exception gets out.
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

/// An error with a message as printf makes it, of %s, %u and %zu. In one place: strings that are put together take 2 KB of
/// code each.
[[gnu::format(printf, 3, 4)]] Error makeError(ErrorCode code, std::uint64_t element, const char* format, ...);

/// The Error for the exception that is being handled. Throws nothing, even without free memory.
Error caughtError();

/// Runs `body`, which returns a Result, and turns running out of memory (and any defect of our own) into an Error.
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

/// Returns the result of `body`, or 0 or null if it runs out of memory. Other exceptions pass through. Without exceptions the
/// program terminates there.
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

/// For checkSpan: any length is right.
inline constexpr std::size_t kAnyCount = ~std::size_t{0};

/// Checks pointer, stride, alignment and length of one span. `name` is how messages call it. Returns an Error with code
/// ok when all is well.
Error checkSpan(const void* data, std::size_t count, std::size_t stride_bytes, std::size_t element_bytes,
                std::size_t expected_count, const char* name);

template <class T>
Error checkSpan(const StridedSpan<T>& span, std::size_t expected_count, const char* name) {
    return checkSpan(span.data, span.count, span.stride_bytes, sizeof(T), expected_count, name);
}

/// The checks of validate(). With `parallel`, all threads check indices.
Error checkMesh(const MeshView& mesh, Parallel* parallel = nullptr);

/// Checks that there are indices and that each is below `vertex_count`, with `parallel` by all threads. Error as
/// checkSpan.
Error checkIndices(const IndexView& indices, std::size_t vertex_count, Parallel* parallel = nullptr);

/// The options of a call, and what it runs on: below the border both go the same ways.
template <class Options>
struct Call : Options {
    Execution execution = {};
};

}  // namespace tspace
