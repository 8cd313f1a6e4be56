// SPDX-License-Identifier: MIT
// ExistingTangents::repair: which pools keep the tangents that they have.
#pragma once

#include <span>

#include "asset/gltf/generate_plan.h"

namespace tspace::gltf {

/// Takes the pools whose tangents are good out of the plan, and says so in their reports; adds a note to the reports of
/// those whose tangents are wrong. A pool keeps all its tangents or none, because its vertices are split together.
/// Pools are judged at the same time. Fails as reading the pools' attributes does.
void keepGoodPools(const Document& document, std::span<const Primitive> primitives, const GenerateOptions& options,
                   GeneratePlan& plan);

}  // namespace tspace::gltf
