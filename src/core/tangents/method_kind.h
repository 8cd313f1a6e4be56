// SPDX-License-Identifier: MIT
// Kinds of methods. In builds with a single method these functions are constant, so code for others is not compiled.
#pragma once

#include "core/base/build_parts.h"
#include "tspace/tangents.h"

namespace tspace {

constexpr bool isMikktspace(Method method) { return !kHasAllMethods || method == Method::mikktspace; }
/// Returns whether a method is computed by tangents/estimators rather than by sums.
constexpr bool isEstimated(Method method) {
    return kHasAllMethods && (method == Method::fast || method == Method::best);
}
/// Returns whether a method is implemented by tangents/mikktspace; the others have one result per vertex or face.
constexpr bool isGrouped(Method method) {
    return isMikktspace(method) || isEstimated(method) || method == Method::uniform || method == Method::angle ||
           method == Method::area;
}

/// Returns the amount of work for Parallel: estimators take several times as long as sums.
constexpr std::uint64_t tangentWork(Method method, std::uint64_t corners) {
    return (isEstimated(method) ? 4 : 1) * corners;
}

/// Use of a plan. kept: the plan outlives its mesh, and may be used for other poses; once: it is used once, within a
/// call.
enum class PlanUse { kept, once };
constexpr bool isKept(PlanUse use) { return kHasAllMethods && use == PlanUse::kept; }

}  // namespace tspace
