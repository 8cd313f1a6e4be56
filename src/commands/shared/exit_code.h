// SPDX-License-Identifier: MIT
// Exit codes of the tool, which its JSON also contains, and the exit code of each error.
#pragma once

#include <algorithm>

#include "tspace/result.h"

namespace tspace::report {

/// Exit code of the tool. Larger codes are more severe: the result for several files is the largest of their codes.
enum class ExitCode : int {
    done = 0,
    findings = 1,           ///< a checking command found faults
    usage = 2,              ///< invalid command line
    badInput = 3,           ///< a file is invalid, not supported, or leads outside its folder
    cannotReadOrWrite = 4,  ///< a file cannot be read or written, or the caller canceled the call
    internal = 5,           ///< out of memory, or a defect of tspace
};

inline ExitCode worse(ExitCode a, ExitCode b) { return std::max(a, b); }

inline ExitCode exitCodeOf(ErrorCode code) {
    switch (code) {
        case ErrorCode::ok: return ExitCode::done;
        case ErrorCode::invalidOption: return ExitCode::usage;
        case ErrorCode::invalidFile:
        case ErrorCode::unsupportedFile:
        case ErrorCode::forbiddenPath:
        case ErrorCode::indexOutOfRange:
        case ErrorCode::countMismatch:
        case ErrorCode::missingAttribute:
        case ErrorCode::tooLarge: return ExitCode::badInput;
        case ErrorCode::cannotRead:
        case ErrorCode::cannotWrite:
        case ErrorCode::cancelled: return ExitCode::cannotReadOrWrite;
        case ErrorCode::nullData:
        case ErrorCode::strideTooSmall:
        case ErrorCode::misaligned:
        case ErrorCode::outOfMemory:
        case ErrorCode::planMismatch:
        case ErrorCode::internal: break;
    }
    return ExitCode::internal;
}

}  // namespace tspace::report
