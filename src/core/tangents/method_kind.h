// SPDX-License-Identifier: MIT
// Kinds of methods. With TSPACE_MIKKTSPACE_ONLY there is only one method, and code for the others is not compiled.
#pragma once

#include "tspace/tangents.h"

namespace tspace {

#ifdef TSPACE_MIKKTSPACE_ONLY

inline constexpr Method kLastMethod = Method::mikktspace;
/// In this build every call creates a plan, which takes half of the code size and twice the time.
inline constexpr bool kHasOnePass = false;
constexpr bool isMikktspace(Method) { return true; }
constexpr bool isEstimated(Method) { return false; }
constexpr bool isGrouped(Method) { return true; }

#else

inline constexpr Method kLastMethod = Method::best;
inline constexpr bool kHasOnePass = true;
constexpr bool isMikktspace(Method method) { return method == Method::mikktspace; }
/// Returns whether a method is computed by tangents/estimators rather than by sums.
constexpr bool isEstimated(Method method) { return method == Method::fast || method == Method::best; }
/// Returns whether a method is implemented by tangents/mikktspace; the others have one result per vertex or face.
constexpr bool isGrouped(Method method) {
    return isMikktspace(method) || isEstimated(method) || method == Method::uniform || method == Method::angle ||
           method == Method::area;
}

#endif

/// Returns the amount of work for Parallel: estimators take several times as long as sums.
constexpr std::uint64_t tangentWork(Method method, std::uint64_t corners) {
    return (isEstimated(method) ? 4 : 1) * corners;
}

/// Use of a plan. kept: the plan outlives its mesh, and may be used for other poses; once: it is used once, within a
/// call.
enum class PlanUse { kept, once };

}  // namespace tspace
