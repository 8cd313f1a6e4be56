// SPDX-License-Identifier: MIT
// How the file readers give up: deep inside a parser an error is thrown as FileError, and the public function
// that started the work turns it into a Result. No exception leaves the library.
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

/// Thrown inside the asset layer only; caught by atFileBorder.
struct FileError {
    Error error;
};

/// Thrown where a function of the caller says that the call is over. Nobody between there and the border catches it.
struct CallerError {
    Error error;
};

/// `message` is one sentence without a line break; `place` a JSON pointer, line or byte offset.
[[noreturn]] void failFile(ErrorCode code, std::string message, std::string place = {});

/// Text from a file or of a user, fit to stand inside a one-line message: in quotation marks, valid UTF-8,
/// without control characters, cut after `limit` bytes.
std::string inQuotes(std::string_view text, std::size_t limit = 80);
std::string pathInQuotes(const Path& path);

/// The value of a Result, or its error thrown as FileError.
template <class T>
T valueOrThrow(Result<T> result) {
    if (!result) throw FileError{std::move(result).error()};
    return *std::move(result);
}

/// Runs `body`; where that throws a FileError, its error comes back. Bindings that are compiled without exceptions have
/// another way to come back (tryFile of a function and its context).
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

/// What is being thrown, where it is a FileError, a CallerError or one of std::filesystem; all else flies on. Only inside
/// a catch.
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
