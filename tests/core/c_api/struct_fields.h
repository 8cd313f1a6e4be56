// SPDX-License-Identifier: MIT
// Names of enumerators, and of the numbers in sized structs, for tests that are driven by tables.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tspace/tspace.h"

namespace tspace::test {

// Everything below is written by scripts/api.
/// The numbers of enumerators, by type and name.
inline const std::map<std::string, std::map<std::string, double>> kEnumerators = {
    {"ErrorCode",
     {{"ok", 0},
      {"null_data", 1},
      {"count_mismatch", 2},
      {"index_out_of_range", 3},
      {"stride_too_small", 4},
      {"misaligned", 5},
      {"too_large", 6},
      {"missing_attribute", 7},
      {"invalid_option", 8},
      {"out_of_memory", 9},
      {"plan_mismatch", 10},
      {"internal", 11},
      {"cancelled", 12},
      {"invalid_file", 100},
      {"unsupported_file", 101},
      {"forbidden_path", 102},
      {"cannot_read", 103},
      {"cannot_write", 104}}},
    {"IndexType", {{"none", 0}, {"u8", 1}, {"u16", 2}, {"u32", 4}, {"corners", 8}}},
    {"SimdTarget", {{"best", 0}, {"scalar", 1}, {"sse2", 2}, {"avx2", 3}, {"avx512", 4}, {"neon", 5}}},
    {"VAxis", {{"up", 1}, {"down", 2}}},
    {"Green", {{"up", 0}, {"down", 1}}},
    {"StoredSign", {{"as_is", 0}, {"negated", 1}}},
    {"Handedness", {{"right", 0}, {"left", 1}}},
    {"Winding", {{"counter_clockwise", 0}, {"clockwise", 1}}},
    {"Method",
     {{"mikktspace", 0},
      {"lengyel", 1},
      {"uniform", 2},
      {"angle", 3},
      {"area", 4},
      {"flat", 5},
      {"basis", 6},
      {"fast", 7},
      {"best", 8}}},
    {"Pairing", {{"reference", 0}, {"corrected", 1}}},
    {"Ngons", {{"triangulate", 0}, {"skip", 1}}},
    {"OutputDomain", {{"corner", 0}, {"vertex", 1}}},
    {"FrameShape", {{"gram_schmidt", 0}, {"symmetric", 1}}},
    {"NormalWeighting",
     {{"flat", 0}, {"uniform", 1}, {"area", 2}, {"angle", 3}, {"angle_area", 4}, {"max", 5}, {"best", 6}}},
    {"FrameFormat",
     {{"frame32", 0},
      {"frame48", 1},
      {"frame64", 2},
      {"oct32", 3},
      {"qtangent64", 4},
      {"snorm8_pair", 5},
      {"snorm16_pair", 6},
      {"gltf_snorm8", 7},
      {"gltf_snorm16", 8}}},
};

template <class Visit>
void visitFields(tspace_Indices& all, Visit visit) {
    visit("type", "IndexType", all.type);
}

template <class Visit>
void visitFields(tspace_Mesh& all, Visit visit) {
    visit("face_size", "uint32_t", all.face_size);
}

template <class Visit>
void visitFields(tspace_Execution& all, Visit visit) {
    visit("thread_count", "uint32_t", all.thread_count);
    visit("simd", "SimdTarget", all.simd);
}

template <class Visit>
void visitFields(tspace_Convention& all, Visit visit) {
    visit("v_axis", "VAxis", all.v_axis);
    visit("green", "Green", all.green);
    visit("stored_sign", "StoredSign", all.stored_sign);
    visit("handedness", "Handedness", all.handedness);
    visit("winding", "Winding", all.winding);
}

template <class Visit>
void visitFields(tspace_TangentOptions& all, Visit visit) {
    visit("method", "Method", all.method);
    visit("ngons", "Ngons", all.ngons);
    visit("domain", "OutputDomain", all.domain);
    visit("frame", "FrameShape", all.frame);
    visit("angular_threshold_deg", "float", all.angular_threshold_deg);
    visit("pairing", "Pairing", all.pairing);
    visit("refine", "uint32_t", all.refine);
    visit("normalize_normals", "uint32_t", all.normalize_normals);
}

template <class Visit>
void visitFields(tspace_TangentReport& all, Visit visit) {
    visit("reference_order_abandoned", "uint32_t", all.reference_order_abandoned);
    visit("triangle_count", "uint64_t", all.triangle_count);
    visit("degenerate_triangle_count", "uint64_t", all.degenerate_triangle_count);
    visit("degenerate_uv_count", "uint64_t", all.degenerate_uv_count);
    visit("mirrored_count", "uint64_t", all.mirrored_count);
    visit("skipped_face_count", "uint64_t", all.skipped_face_count);
    visit("group_count", "uint64_t", all.group_count);
    visit("default_corner_count", "uint64_t", all.default_corner_count);
    visit("not_finite_count", "uint64_t", all.not_finite_count);
}

template <class Visit>
void visitFields(tspace_TangentPlanInfo& all, Visit visit) {
    visit("method", "Method", all.method);
}

template <class Visit>
void visitFields(tspace_NormalOptions& all, Visit visit) {
    visit("weighting", "NormalWeighting", all.weighting);
    visit("crease_angle_deg", "float", all.crease_angle_deg);
    visit("smoothing_groups_are_masks", "uint32_t", all.smoothing_groups_are_masks);
    visit("weld_positions", "uint32_t", all.weld_positions);
    visit("refine", "uint32_t", all.refine);
    visit("denoise", "float", all.denoise);
    visit("weld_distance", "float", all.weld_distance);
}

template <class Visit>
void visitFields(tspace_NormalReport& all, Visit visit) {
    visit("face_count", "uint64_t", all.face_count);
    visit("degenerate_face_count", "uint64_t", all.degenerate_face_count);
    visit("fallback_corner_count", "uint64_t", all.fallback_corner_count);
    visit("noise", "float", all.noise);
    visit("crease_angle_deg", "float", all.crease_angle_deg);
}

template <class Visit>
void visitFields(tspace_PositionNoise& all, Visit visit) {
    visit("sigma", "float", all.sigma);
    visit("kink_share", "float", all.kink_share);
    visit("noise", "float", all.noise);
    visit("mean_edge", "double", all.mean_edge);
}

template <class Visit>
void visitFields(tspace_SanitizeOptions& all, Visit visit) {
    visit("orthogonalize_all", "uint32_t", all.orthogonalize_all);
}

template <class Visit>
void visitFields(tspace_SanitizeReport& all, Visit visit) {
    visit("not_finite_count", "uint64_t", all.not_finite_count);
    visit("zero_count", "uint64_t", all.zero_count);
    visit("not_unit_count", "uint64_t", all.not_unit_count);
    visit("parallel_count", "uint64_t", all.parallel_count);
    visit("bad_sign_count", "uint64_t", all.bad_sign_count);
    visit("mixed_sign_count", "uint64_t", all.mixed_sign_count);
    visit("orthogonalized_count", "uint64_t", all.orthogonalized_count);
    visit("normalized_count", "uint64_t", all.normalized_count);
    visit("from_neighbor_count", "uint64_t", all.from_neighbor_count);
    visit("from_basis_count", "uint64_t", all.from_basis_count);
    visit("bad_normal_count", "uint64_t", all.bad_normal_count);
    visit("mended_count", "uint64_t", all.mended_count);
    visit("placeholder_count", "uint64_t", all.placeholder_count);
}

template <class Visit>
void visitFields(tspace_IndexedFramesOptions& all, Visit visit) {
    visit("make_normals", "uint32_t", all.make_normals);
    visit("sanitize", "uint32_t", all.sanitize);
    visit("orthogonalize_all", "uint32_t", all.orthogonalize_all);
}

template <class Visit>
void visitFields(tspace_PackReport& all, Visit visit) {
    visit("bad_normal_count", "uint64_t", all.bad_normal_count);
    visit("not_finite_count", "uint64_t", all.not_finite_count);
    visit("zero_count", "uint64_t", all.zero_count);
    visit("parallel_count", "uint64_t", all.parallel_count);
    visit("not_unit_count", "uint64_t", all.not_unit_count);
    visit("not_orthogonal_count", "uint64_t", all.not_orthogonal_count);
    visit("bad_sign_count", "uint64_t", all.bad_sign_count);
    visit("mended_count", "uint64_t", all.mended_count);
}

template <class Visit>
void visitFields(tspace_WindingOptions& all, Visit visit) {
    visit("use_normals", "uint32_t", all.use_normals);
    visit("weld_positions", "uint32_t", all.weld_positions);
    visit("weld_distance", "float", all.weld_distance);
}

template <class Visit>
void visitFields(tspace_WindingReport& all, Visit visit) {
    visit("face_count", "uint64_t", all.face_count);
    visit("turned_count", "uint64_t", all.turned_count);
    visit("conflict_count_before", "uint64_t", all.conflict_count_before);
    visit("conflict_count_after", "uint64_t", all.conflict_count_after);
    visit("component_count", "uint64_t", all.component_count);
    visit("turned_component_count", "uint64_t", all.turned_component_count);
    visit("by_normals_count", "uint64_t", all.by_normals_count);
    visit("by_volume_count", "uint64_t", all.by_volume_count);
    visit("by_nesting_count", "uint64_t", all.by_nesting_count);
    visit("by_winding_number_count", "uint64_t", all.by_winding_number_count);
    visit("by_majority_count", "uint64_t", all.by_majority_count);
    visit("small_count", "uint64_t", all.small_count);
    visit("one_sided_count", "uint64_t", all.one_sided_count);
}

}  // namespace tspace::test
