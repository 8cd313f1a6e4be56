// SPDX-License-Identifier: MIT
#pragma once

namespace tspace {

/// Whether a plan outlives the mesh it was made from (and may see other poses), or is used up on it at once.
enum class PlanUse { kept, once };

}  // namespace tspace
