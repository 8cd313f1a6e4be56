// SPDX-License-Identifier: MIT
// Shared by the WebAssembly modules: exported names, and the state of one call. There is only one thread, so calls
// never overlap.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tspace/result.h"

#define TSPACE_JS_EXPORT(name) __attribute__((export_name(#name)))

extern "C" {
/// Makes JavaScript throw: an error with this code (9 out of memory, 11 internal) ends the call and discards the
/// instance.
__attribute__((import_module("env"), import_name("endCall"), noreturn)) void tspace_js_endCall(int code);
__attribute__((noreturn)) void tspace_endCallOutOfMemory();

TSPACE_JS_EXPORT(allocate) void* tspace_js_allocate(std::size_t bytes);
TSPACE_JS_EXPORT(release) void tspace_js_release(void* memory);
}

namespace tspace::js {

/// Error of the last call that failed.
extern Error& error;

/// Numbers of the last call's report, in the order of the struct's fields; a call with several reports stores them one
/// after the other.
inline constexpr std::size_t kReportNumbers = 32;
extern double report[kReportNumbers];

/// Returns the result's error code, 0 for success; keeps the error.
template <class T>
std::uint32_t codeOf(Result<T>& result) {
    if (result) return 0;
    error = std::move(result).error();
    return static_cast<std::uint32_t>(error.code);
}

}  // namespace tspace::js
