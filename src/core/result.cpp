// SPDX-License-Identifier: MIT
// Errors and their names, and those of convention presets.
#include "tspace/result.h"

#include <cstdarg>
#include <new>
#include <string_view>

#include "core/border.h"
#include "tspace/convention.h"

namespace tspace {

const char* errorName(ErrorCode code) {
    switch (code) {
        case ErrorCode::ok:
            return "ok";
        case ErrorCode::nullData:
            return "nullData";
        case ErrorCode::countMismatch:
            return "countMismatch";
        case ErrorCode::indexOutOfRange:
            return "indexOutOfRange";
        case ErrorCode::strideTooSmall:
            return "strideTooSmall";
        case ErrorCode::misaligned:
            return "misaligned";
        case ErrorCode::tooLarge:
            return "tooLarge";
        case ErrorCode::missingAttribute:
            return "missingAttribute";
        case ErrorCode::invalidOption:
            return "invalidOption";
        case ErrorCode::outOfMemory:
            return "outOfMemory";
        case ErrorCode::planMismatch:
            return "planMismatch";
        case ErrorCode::internal:
            return "internal";
        case ErrorCode::invalidFile:
            return "invalidFile";
        case ErrorCode::unsupportedFile:
            return "unsupportedFile";
        case ErrorCode::forbiddenPath:
            return "forbiddenPath";
        case ErrorCode::cannotRead:
            return "cannotRead";
        case ErrorCode::cannotWrite:
            return "cannotWrite";
    }
    return "unknown";
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
    try {
        throw;
    } catch (const OutOfMemory&) {
        return {ErrorCode::outOfMemory, "out of memory"};
    } catch (const std::bad_alloc&) {
        return {ErrorCode::outOfMemory, "out of memory"};
    } catch (...) {
        return {ErrorCode::internal, "internal error: an exception reached the library's border"};
    }
}

#else

// The program's own: bindings without exceptions end the call from here.
extern "C" [[noreturn]] void tspace_endCallOutOfMemory(void);
void throwOutOfMemory() { tspace_endCallOutOfMemory(); }

#endif

}  // namespace tspace
