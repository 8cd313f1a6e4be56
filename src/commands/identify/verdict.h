// SPDX-License-Identifier: MIT
// Compares one primitive with every method, and describes the explanations of a file in sentences.
#pragma once

#include <string>
#include <vector>

#include "model/scene/scene.h"
#include "tspace/inspect.h"

namespace tspace {

// Comparison of one primitive with every method.

/// Methods whose share of corners is this close to the best are considered equal to it.
inline constexpr double kTieShare = 0.005;

/// Returns the methods that are tried, the best-known first.
std::vector<Method> knownMethods();

/// Returns whether the stored tangents are clearly closer to the results of `a` than to those of `b`: the mean angle of
/// `a` is less than half that of `b`, beyond rounding. A mean of exactly 0 is closer than any other.
bool isCloser(const Explanation& a, const Explanation& b);

/// For each UV set that has area, explains the tangents with every method, and with mikktspace on quads if that
/// explains more. The primitive must have triangles, normals, tangents and a UV set.
Result<std::vector<Explanation>> explainTangents(const ScenePrimitive& primitive, const IdentifyOptions& options);

/// Sorts explanations by score: the number of near corners, where a corner that is near only to the result of another
/// corner of its vertex counts half. Ties keep their order. Among explanations that are equal to the best (in their
/// corners, and according to isCloser), one with the UV set of the texture is first, and among several of them the
/// best-known method.
void sortExplanations(std::vector<Explanation>& explanations);

/// Returns the best explanation that uses the UV set of the texture, transformed if `is_transformed`; null: none.
const Explanation* bestReading(const PrimitiveIdentity& primitive, bool is_transformed);

/// Returns whether the transformed UVs explain more corners than the stored UVs. Signs are compared too, because a
/// transform that mirrors may keep every direction.
bool followsTransform(const PrimitiveIdentity& primitive);

/// Value of PrimitiveIdentity::skipped for tangents that the importer cannot read.
inline constexpr const char* kNotRead =
    "its tangents, if any, were not read, because the importer does not support them in this format";

/// Describes the result in sentences. All other members of `result` must be filled.
std::string verdictOf(const Identification& result);

}  // namespace tspace
