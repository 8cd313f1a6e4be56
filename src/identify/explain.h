// SPDX-License-Identifier: MIT
// One primitive against every method.
#pragma once

#include <vector>

#include "asset/scene.h"
#include "tspace/identify.h"

namespace tspace {

/// The methods that are tried, the best known first.
std::vector<Method> knownMethods();

/// Every method with every UV set, in that order. The primitive has triangles, normals, tangents and a UV set.
Result<std::vector<Explanation>> explainTangents(const ScenePrimitive& primitive, const IdentifyOptions& options);

/// The best first: most near corners, then most corners near at their vertex, then the order they came in.
void sortExplanations(std::vector<Explanation>& explanations);

}  // namespace tspace
