// SPDX-License-Identifier: MIT
// Errors and their names, and those of convention presets.
#include "tspace/result.h"

#include <cstdarg>
#include <cstdio>
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

Error makeError(ErrorCode code, std::uint64_t element, const char* format, ...) {
    Error error{code, {}, element};
    char text[256];
    std::va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int length = std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (length >= 0 && static_cast<std::size_t>(length) < sizeof text) {
        error.message = text;
    } else if (length > 0) {  // only with a very long name
        error.message.resize(static_cast<std::size_t>(length));
        std::vsnprintf(error.message.data(), error.message.size() + 1, format, again);
    }
    va_end(again);
    return error;
}

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

}  // namespace tspace
