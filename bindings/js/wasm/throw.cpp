// SPDX-License-Identifier: MIT
// Exceptions end the call and its instance, like running out of memory: no module catches them. Code for unwinding
// would be a tenth of the module, and a discarded instance needs no cleanup.
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <typeinfo>

#include "api/c_call.h"
#include "core/base/memory.h"
#include "exports.h"
#include "model/io/file_error.h"

using namespace tspace;

namespace {

[[noreturn]] void endCall(const Error& failure) {
    tspace_Error said{};
    c_files::finishCall(failure, &said);
    js::error = Error{failure.code, said.message};
    js::error.element = failure.element;
    tspace_js_endCall(static_cast<int>(failure.code));
}

}  // namespace

extern "C" {

/// Calls function(context) and returns 0; returns 1 if it ended with an error of the file layer.
__attribute__((import_module("env"), import_name("attempt"))) int tspace_js_attempt(void (*function)(void*),
                                                                                    void* context);

void* __cxa_allocate_exception(std::size_t bytes) noexcept { return std::malloc(bytes); }
void __cxa_free_exception(void* memory) noexcept { std::free(memory); }

void __cxa_throw(void* thrown, std::type_info* type, void (*)(void*)) {
    if (*type == typeid(FileError)) endCall(static_cast<const FileError*>(thrown)->error);
    if (*type == typeid(CallerError)) endCall(static_cast<const CallerError*>(thrown)->error);
    const bool is_memory = *type == typeid(OutOfMemory) || *type == typeid(std::bad_alloc) ||
                           *type == typeid(std::length_error) || *type == typeid(std::bad_array_new_length);
    tspace_js_endCall(static_cast<int>(is_memory ? ErrorCode::outOfMemory : ErrorCode::internal));
}
void __cxa_rethrow() { tspace_js_endCall(static_cast<int>(ErrorCode::internal)); }

}  // extern "C"

namespace tspace {

std::optional<Error> tryFile(void (*body)(void*), void* context) {
    if (tspace_js_attempt(body, context) == 0) return {};
    return js::error;
}

}  // namespace tspace
