// SPDX-License-Identifier: MIT
// One primitive against every method, and the verdict on the explanations of a file, in sentences for a person.
#pragma once

#include <string>
#include <vector>

#include "model/scene/scene.h"
#include "tspace/inspect.h"

namespace tspace {

// One primitive against every method.

/// Methods this near to the best, as a share of the corners, cannot be told apart from it.
inline constexpr double kTieShare = 0.005;

/// The methods that are tried, the best known first.
std::vector<Method> knownMethods();

/// Whether the stored tangents are so much nearer to those of `a` that it is no matter of rounding: by less than half of
/// the angle in the mean.
bool isCloser(const Explanation& a, const Explanation& b);

/// Every method with every UV set that has an area, in that order; then mikktspace on quads where that wins. The
/// primitive has triangles, normals, tangents and a UV set.
Result<std::vector<Explanation>> explainTangents(const ScenePrimitive& primitive, const IdentifyOptions& options);

/// The best first: most near corners, where one that is near to another corner of its vertex counts half; then the order
/// they came in. First of all comes, of those that cannot be told apart from the best, by their corners or by isCloser, one
/// along the texture's set, and of these the best known.
void sortExplanations(std::vector<Explanation>& explanations);

/// The best explanation along the texture's set, in one of its two readings; null: there is none.
const Explanation* bestReading(const PrimitiveIdentity& primitive, bool is_transformed);

/// Whether the texture's transform explains more corners than the UVs as they are. Signs count: a transform may mirror,
/// and leave every direction in place.
bool followsTransform(const PrimitiveIdentity& primitive);

/// Value of PrimitiveIdentity::skipped for data that an importer cannot read.
inline constexpr const char* kNotRead = "its tangents were not read";

/// All other members of `result` must be filled.
std::string verdictOf(const Identification& result);

}  // namespace tspace
