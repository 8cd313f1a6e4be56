// SPDX-License-Identifier: MIT
// Errors and their names, and those of convention presets.
#include "tspace/result.h"

#include <cstdarg>
#include <iterator>
#include <new>
#include <string_view>

#include "core/base/border.h"
#include "tspace/convention.h"

namespace tspace {

const char* errorName(ErrorCode code) {
    static constexpr std::uint32_t kFirstOfFiles = 100;
    static constexpr const char* kNames[] = {
        "ok",           "nullData", "countMismatch",    "indexOutOfRange", "strideTooSmall",
        "misaligned",   "tooLarge", "missingAttribute", "invalidOption",   "outOfMemory",
        "planMismatch", "internal", "cancelled"};
    static constexpr const char* kNamesOfFiles[] = {"invalidFile", "unsupportedFile", "forbiddenPath", "cannotRead",
                                                    "cannotWrite"};
    static_assert(std::size(kNames) == static_cast<std::size_t>(ErrorCode::cancelled) + 1);
    static_assert(std::size(kNamesOfFiles) == static_cast<std::size_t>(ErrorCode::cannotWrite) + 1 - kFirstOfFiles);
    const auto number = static_cast<std::uint32_t>(code);
    if (number < std::size(kNames)) return kNames[number];
    return number - kFirstOfFiles < std::size(kNamesOfFiles) ? kNamesOfFiles[number - kFirstOfFiles] : "unknown";
}

const Convention* findConvention(const char* name) {
    struct Preset {
        std::string_view name;
        Convention convention;
    };
    static constexpr Preset kPresets[] = {
        {"gltf", conventions::gltf},     {"opengl", conventions::opengl}, {"directx", conventions::directx},
        {"unreal", conventions::unreal}, {"unity", conventions::unity},   {"blender", conventions::blender},
        {"godot", conventions::godot},
    };
    if (name == nullptr) return nullptr;
    for (const Preset& preset : kPresets) {
        if (preset.name == name) return &preset.convention;
    }
    return nullptr;
}

namespace {

void append(std::string& text, std::size_t number) {
    char digits[20];
    std::size_t first = sizeof digits;
    do {
        digits[--first] = static_cast<char>('0' + number % 10);
        number /= 10;
    } while (number != 0);
    text.append(digits + first, sizeof digits - first);
}

}  // namespace

// The C library's printf would be 20 KB of a static program, and 4 of a compressed WebAssembly module.
Error makeError(ErrorCode code, std::uint64_t element, const char* format, ...) {
    Error error{code, {}, element};
    std::va_list arguments;
    va_start(arguments, format);
    for (; *format != 0; ++format) {
        if (*format != '%') {
            error.message += *format;
        } else if (*++format == 's') {
            error.message += va_arg(arguments, const char*);
        } else if (*format == 'z') {
            ++format;
            append(error.message, va_arg(arguments, std::size_t));
        } else {
            append(error.message, va_arg(arguments, unsigned));
        }
    }
    va_end(arguments);
    return error;
}

#ifdef __cpp_exceptions

void throwOutOfMemory() { throw OutOfMemory{}; }

Error caughtError() {
    // Strings of up to 15 characters take no memory.
    try {
        throw;
    } catch (const OutOfMemory&) {
        return {ErrorCode::outOfMemory, "out of memory"};
    } catch (const std::bad_alloc&) {
        return {ErrorCode::outOfMemory, "out of memory"};
    } catch (const Cancelled&) {
        return {ErrorCode::cancelled, "stopped before it was done"};
    } catch (...) {
        // A message of this length takes memory.
        try {
            return {ErrorCode::internal, "internal error: an exception reached the library's border"};
        } catch (...) {
            return {ErrorCode::internal, "internal error"};
        }
    }
}

#else

// The program's own: bindings without exceptions end the call from here.
extern "C" [[noreturn]] void tspace_endCallOutOfMemory(void);
void throwOutOfMemory() { tspace_endCallOutOfMemory(); }

#endif

}  // namespace tspace
