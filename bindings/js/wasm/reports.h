// SPDX-License-Identifier: MIT
// Stores the numbers of reports for JavaScript, in the order of their names in names.js. Each function starts at index
// `first`, and returns the index after its last number.
#pragma once

#include "exports.h"
#include "tspace/tspace.hpp"

namespace tspace::js {

// Everything below is written by scripts/api.
inline std::size_t keep(const TangentReport& from, std::size_t first = 0) {
    static constexpr std::uint64_t TangentReport::*kCounts[] = {
        &TangentReport::triangle_count,       &TangentReport::degenerate_triangle_count,
        &TangentReport::degenerate_uv_count,  &TangentReport::mirrored_count,
        &TangentReport::skipped_face_count,   &TangentReport::group_count,
        &TangentReport::default_corner_count, &TangentReport::not_finite_count};
    for (const auto count : kCounts) report[first++] = static_cast<double>(from.*count);
    report[first++] = static_cast<double>(from.reference_order_abandoned);
    return first;
}

inline std::size_t keep(const NormalReport& from, std::size_t first = 0) {
    static constexpr std::uint64_t NormalReport::*kCounts[] = {
        &NormalReport::face_count, &NormalReport::degenerate_face_count, &NormalReport::fallback_corner_count};
    for (const auto count : kCounts) report[first++] = static_cast<double>(from.*count);
    report[first++] = static_cast<double>(from.noise);
    report[first++] = static_cast<double>(from.crease_angle_deg);
    return first;
}

inline std::size_t keep(const PositionNoise& from, std::size_t first = 0) {
    report[first++] = static_cast<double>(from.sigma);
    report[first++] = static_cast<double>(from.kink_share);
    report[first++] = static_cast<double>(from.noise);
    report[first++] = static_cast<double>(from.mean_edge);
    return first;
}

inline std::size_t keep(const SanitizeReport& from, std::size_t first = 0) {
    static constexpr std::uint64_t SanitizeReport::*kCounts[] = {
        &SanitizeReport::not_finite_count,    &SanitizeReport::zero_count,           &SanitizeReport::not_unit_count,
        &SanitizeReport::parallel_count,      &SanitizeReport::placeholder_count,    &SanitizeReport::bad_sign_count,
        &SanitizeReport::mixed_sign_count,    &SanitizeReport::orthogonalized_count, &SanitizeReport::normalized_count,
        &SanitizeReport::from_neighbor_count, &SanitizeReport::from_basis_count,     &SanitizeReport::bad_normal_count};
    for (const auto count : kCounts) report[first++] = static_cast<double>(from.*count);
    report[first++] = static_cast<double>(from.mendedCount());
    return first;
}

inline std::size_t keep(const WindingReport& from, std::size_t first = 0) {
    static constexpr std::uint64_t WindingReport::*kCounts[] = {&WindingReport::face_count,
                                                                &WindingReport::turned_count,
                                                                &WindingReport::conflict_count_before,
                                                                &WindingReport::conflict_count_after,
                                                                &WindingReport::component_count,
                                                                &WindingReport::turned_component_count,
                                                                &WindingReport::by_normals_count,
                                                                &WindingReport::by_volume_count,
                                                                &WindingReport::by_nesting_count,
                                                                &WindingReport::by_winding_number_count,
                                                                &WindingReport::by_majority_count,
                                                                &WindingReport::small_count,
                                                                &WindingReport::one_sided_count};
    for (const auto count : kCounts) report[first++] = static_cast<double>(from.*count);
    return first;
}

inline std::size_t keep(const PackReport& from, std::size_t first = 0) {
    static constexpr std::uint64_t PackReport::*kCounts[] = {
        &PackReport::bad_normal_count, &PackReport::not_finite_count, &PackReport::zero_count,
        &PackReport::parallel_count,   &PackReport::not_unit_count,   &PackReport::not_orthogonal_count,
        &PackReport::bad_sign_count};
    for (const auto count : kCounts) report[first++] = static_cast<double>(from.*count);
    report[first++] = static_cast<double>(from.mendedCount());
    return first;
}

}  // namespace tspace::js
