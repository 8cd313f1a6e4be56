// SPDX-License-Identifier: MIT
// The constants of NormalWeighting::best, for both ways of computing it.
#pragma once

namespace tspace::smooth {

// Where each doubt is even (the blend half and half), found by trying values on analytic surfaces with and without
// noise and on bevels (docs/accuracy.md).
inline constexpr double kNoise = 0.45;   // of the bend of the edges, what no normal explains
inline constexpr double kKink = 1.5;     // misfit of the sharp normals, in that of the robust ones
inline constexpr double kJump = 2.5;     // turn over the longest edge if all of it bent like the most bent one, in
                                         // radians, times the sine between the two means
inline constexpr double kTurn = 0.8;     // twice the sine of half the angle between the sharp normals at an edge's ends
inline constexpr double kSpread = 0.42;  // sine between fit and robust mean

// Of the quadratic part's own size: enough for rings with too few edges, and too little to matter elsewhere. Weighed as
// in the method `best` (tangents/estimators/quadratic_recovery_kernel.h): second derivatives by their Frobenius norm.
inline constexpr double kFitRidge = 3e-4, kFitRidgeShare = 0.3;

inline constexpr double kNoTrust = 1e12;  // so large that a blend has the bits of one side

}  // namespace tspace::smooth
