// SPDX-License-Identifier: MIT
// Names of error codes and convention presets.
#include "tspace/result.h"

#include <string_view>

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

}  // namespace tspace
