// SPDX-License-Identifier: MIT
// Errors of the file layer: parsers throw FileError, and atFileBorder converts it to a Result. No exception leaves the
// library.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/base/border.h"
#include "model/io/path.h"
#include "tspace/result.h"

namespace tspace {

/// Thrown in src/model and higher layers; caught by atFileBorder.
struct FileError {
    Error error;
};

/// Thrown when a callback of the caller ends the call. Only atFileBorder catches it.
struct CallerError {
    Error error;
};

/// Throws a FileError. `message`: one sentence without a line break; `place`: JSON pointer, line or byte offset.
[[noreturn]] void failFile(ErrorCode code, std::string message, std::string place = {});

/// Quotes text from a file or a user for a one-line message: valid UTF-8, without control characters, cut after `limit`
/// bytes.
std::string inQuotes(std::string_view text, std::size_t limit = 80);
std::string pathInQuotes(const Path& path);

/// Returns the value of a Result, or throws its error as FileError.
template <class T>
T valueOrThrow(Result<T> result) {
    if (!result) throw FileError{std::move(result).error()};
    return *std::move(result);
}

/// Runs `body` and returns the error of a FileError that it throws. Bindings without exceptions implement the overload
/// for a function and its context, which ends `body` in another way.
#ifdef TSPACE_THROWS_END_CALL
std::optional<Error> tryFile(void (*body)(void*), void* context);
template <class Body>
std::optional<Error> tryFile(Body&& body) {
    return tryFile([](void* context) { (*static_cast<std::remove_reference_t<Body>*>(context))(); }, &body);
}
#else
template <class Body>
std::optional<Error> tryFile(Body&& body) {
    try {
        body();
    } catch (const FileError& failure) {
        return failure.error;
    }
    return {};
}
#endif

/// Returns the error of the current exception if it is a FileError, a CallerError or an exception of std::filesystem;
/// rethrows any other exception. Must be called inside a catch block.
Error fileErrorInFlight();

/// Runs `body`, which returns a Result and may throw FileError or CallerError.
template <class Body>
auto atFileBorder(Body&& body) -> std::invoke_result_t<Body> {
    return atBorder([&]() -> std::invoke_result_t<Body> {
        try {
            return body();
        } catch (...) {
            return fileErrorInFlight();
        }
    });
}

}  // namespace tspace
