// SPDX-License-Identifier: MIT
// Conversion of the numeric fields of C structs to and from their C++ counterparts. Other fields (spans, pointers) are
// converted by the function that converts the struct.
#pragma once

#include "core/c_api/c_convert.h"

#include "tspace/indexed_frames.h"
#include "tspace/normals.h"
#include "tspace/pack.h"
#include "tspace/plan_buffers.h"
#include "tspace/tangents.h"
#include "tspace/winding.h"

namespace tspace::c_api {

// Everything below is written by scripts/api.
static_assert(TSPACE_OK == static_cast<std::uint32_t>(ErrorCode::ok));
static_assert(TSPACE_ERROR_NULL_DATA == static_cast<std::uint32_t>(ErrorCode::nullData));
static_assert(TSPACE_ERROR_COUNT_MISMATCH == static_cast<std::uint32_t>(ErrorCode::countMismatch));
static_assert(TSPACE_ERROR_INDEX_OUT_OF_RANGE == static_cast<std::uint32_t>(ErrorCode::indexOutOfRange));
static_assert(TSPACE_ERROR_STRIDE_TOO_SMALL == static_cast<std::uint32_t>(ErrorCode::strideTooSmall));
static_assert(TSPACE_ERROR_MISALIGNED == static_cast<std::uint32_t>(ErrorCode::misaligned));
static_assert(TSPACE_ERROR_TOO_LARGE == static_cast<std::uint32_t>(ErrorCode::tooLarge));
static_assert(TSPACE_ERROR_MISSING_ATTRIBUTE == static_cast<std::uint32_t>(ErrorCode::missingAttribute));
static_assert(TSPACE_ERROR_INVALID_OPTION == static_cast<std::uint32_t>(ErrorCode::invalidOption));
static_assert(TSPACE_ERROR_OUT_OF_MEMORY == static_cast<std::uint32_t>(ErrorCode::outOfMemory));
static_assert(TSPACE_ERROR_PLAN_MISMATCH == static_cast<std::uint32_t>(ErrorCode::planMismatch));
static_assert(TSPACE_ERROR_INTERNAL == static_cast<std::uint32_t>(ErrorCode::internal));
static_assert(TSPACE_ERROR_CANCELLED == static_cast<std::uint32_t>(ErrorCode::cancelled));
static_assert(TSPACE_ERROR_INVALID_FILE == static_cast<std::uint32_t>(ErrorCode::invalidFile));
static_assert(TSPACE_ERROR_UNSUPPORTED_FILE == static_cast<std::uint32_t>(ErrorCode::unsupportedFile));
static_assert(TSPACE_ERROR_FORBIDDEN_PATH == static_cast<std::uint32_t>(ErrorCode::forbiddenPath));
static_assert(TSPACE_ERROR_CANNOT_READ == static_cast<std::uint32_t>(ErrorCode::cannotRead));
static_assert(TSPACE_ERROR_CANNOT_WRITE == static_cast<std::uint32_t>(ErrorCode::cannotWrite));
static_assert(TSPACE_NO_ELEMENT == kNoElement);
static_assert(TSPACE_INDEX_NONE == static_cast<std::uint32_t>(IndexType::none));
static_assert(TSPACE_INDEX_U8 == static_cast<std::uint32_t>(IndexType::u8));
static_assert(TSPACE_INDEX_U16 == static_cast<std::uint32_t>(IndexType::u16));
static_assert(TSPACE_INDEX_U32 == static_cast<std::uint32_t>(IndexType::u32));
static_assert(TSPACE_INDEX_CORNERS == static_cast<std::uint32_t>(IndexType::corners));
static_assert(TSPACE_MAX_CORNERS == kMaxCorners);
static_assert(TSPACE_SIMD_BEST == static_cast<std::uint32_t>(SimdTarget::best));
static_assert(TSPACE_SIMD_SCALAR == static_cast<std::uint32_t>(SimdTarget::scalar));
static_assert(TSPACE_SIMD_SSE2 == static_cast<std::uint32_t>(SimdTarget::sse2));
static_assert(TSPACE_SIMD_AVX2 == static_cast<std::uint32_t>(SimdTarget::avx2));
static_assert(TSPACE_SIMD_AVX512 == static_cast<std::uint32_t>(SimdTarget::avx512));
static_assert(TSPACE_SIMD_NEON == static_cast<std::uint32_t>(SimdTarget::neon));
static_assert(TSPACE_ALL_THREADS == kAllThreads);
static_assert(TSPACE_V_UNSET == static_cast<std::uint32_t>(VAxis::unset));
static_assert(TSPACE_V_UP == static_cast<std::uint32_t>(VAxis::up));
static_assert(TSPACE_V_DOWN == static_cast<std::uint32_t>(VAxis::down));
static_assert(TSPACE_GREEN_UP == static_cast<std::uint32_t>(Green::up));
static_assert(TSPACE_GREEN_DOWN == static_cast<std::uint32_t>(Green::down));
static_assert(TSPACE_SIGN_AS_IS == static_cast<std::uint32_t>(StoredSign::asIs));
static_assert(TSPACE_SIGN_NEGATED == static_cast<std::uint32_t>(StoredSign::negated));
static_assert(TSPACE_HANDEDNESS_RIGHT == static_cast<std::uint32_t>(Handedness::right));
static_assert(TSPACE_HANDEDNESS_LEFT == static_cast<std::uint32_t>(Handedness::left));
static_assert(TSPACE_WINDING_COUNTER_CLOCKWISE == static_cast<std::uint32_t>(Winding::counterClockwise));
static_assert(TSPACE_WINDING_CLOCKWISE == static_cast<std::uint32_t>(Winding::clockwise));
static_assert(TSPACE_METHOD_MIKKTSPACE == static_cast<std::uint32_t>(Method::mikktspace));
static_assert(TSPACE_METHOD_LENGYEL == static_cast<std::uint32_t>(Method::lengyel));
static_assert(TSPACE_METHOD_UNIFORM == static_cast<std::uint32_t>(Method::uniform));
static_assert(TSPACE_METHOD_ANGLE == static_cast<std::uint32_t>(Method::angle));
static_assert(TSPACE_METHOD_AREA == static_cast<std::uint32_t>(Method::area));
static_assert(TSPACE_METHOD_FLAT == static_cast<std::uint32_t>(Method::flat));
static_assert(TSPACE_METHOD_BASIS == static_cast<std::uint32_t>(Method::basis));
static_assert(TSPACE_METHOD_FAST == static_cast<std::uint32_t>(Method::fast));
static_assert(TSPACE_METHOD_BEST == static_cast<std::uint32_t>(Method::best));
static_assert(TSPACE_PAIRING_REFERENCE == static_cast<std::uint32_t>(Pairing::reference));
static_assert(TSPACE_PAIRING_CORRECTED == static_cast<std::uint32_t>(Pairing::corrected));
static_assert(TSPACE_NGONS_TRIANGULATE == static_cast<std::uint32_t>(Ngons::triangulate));
static_assert(TSPACE_NGONS_SKIP == static_cast<std::uint32_t>(Ngons::skip));
static_assert(TSPACE_DOMAIN_CORNER == static_cast<std::uint32_t>(OutputDomain::corner));
static_assert(TSPACE_DOMAIN_VERTEX == static_cast<std::uint32_t>(OutputDomain::vertex));
static_assert(TSPACE_FRAME_GRAM_SCHMIDT == static_cast<std::uint32_t>(FrameShape::gramSchmidt));
static_assert(TSPACE_FRAME_SYMMETRIC == static_cast<std::uint32_t>(FrameShape::symmetric));
static_assert(TSPACE_NORMAL_WEIGHTING_FLAT == static_cast<std::uint32_t>(NormalWeighting::flat));
static_assert(TSPACE_NORMAL_WEIGHTING_UNIFORM == static_cast<std::uint32_t>(NormalWeighting::uniform));
static_assert(TSPACE_NORMAL_WEIGHTING_AREA == static_cast<std::uint32_t>(NormalWeighting::area));
static_assert(TSPACE_NORMAL_WEIGHTING_ANGLE == static_cast<std::uint32_t>(NormalWeighting::angle));
static_assert(TSPACE_NORMAL_WEIGHTING_ANGLE_AREA == static_cast<std::uint32_t>(NormalWeighting::angleArea));
static_assert(TSPACE_NORMAL_WEIGHTING_MAX == static_cast<std::uint32_t>(NormalWeighting::max));
static_assert(TSPACE_NORMAL_WEIGHTING_BEST == static_cast<std::uint32_t>(NormalWeighting::best));
static_assert(TSPACE_NO_CORNER == kNoCorner);
static_assert(TSPACE_FRAME_FORMAT_FRAME32 == static_cast<std::uint32_t>(FrameFormat::frame32));
static_assert(TSPACE_FRAME_FORMAT_FRAME48 == static_cast<std::uint32_t>(FrameFormat::frame48));
static_assert(TSPACE_FRAME_FORMAT_FRAME64 == static_cast<std::uint32_t>(FrameFormat::frame64));
static_assert(TSPACE_FRAME_FORMAT_OCT32 == static_cast<std::uint32_t>(FrameFormat::oct32));
static_assert(TSPACE_FRAME_FORMAT_QTANGENT64 == static_cast<std::uint32_t>(FrameFormat::qtangent64));
static_assert(TSPACE_FRAME_FORMAT_SNORM8_PAIR == static_cast<std::uint32_t>(FrameFormat::snorm8Pair));
static_assert(TSPACE_FRAME_FORMAT_SNORM16_PAIR == static_cast<std::uint32_t>(FrameFormat::snorm16Pair));
static_assert(TSPACE_FRAME_FORMAT_GLTF_SNORM8 == static_cast<std::uint32_t>(FrameFormat::gltfSnorm8));
static_assert(TSPACE_FRAME_FORMAT_GLTF_SNORM16 == static_cast<std::uint32_t>(FrameFormat::gltfSnorm16));

inline void copyFields(const tspace_TangentOptions& from, TangentOptions& to) {
    to.method = static_cast<Method>(from.method);
    to.convention = toConvention(from.convention);
    to.ngons = static_cast<Ngons>(from.ngons);
    to.domain = static_cast<OutputDomain>(from.domain);
    to.frame = static_cast<FrameShape>(from.frame);
    to.angular_threshold_deg = from.angular_threshold_deg;
    to.pairing = static_cast<Pairing>(from.pairing);
    to.refine = from.refine;
    to.normalize_normals = from.normalize_normals != 0;
}
/// Returns an error for the first enumerator or flag that exceeds its largest value, or ok.
inline Error checkFields(const tspace_TangentOptions& options) {
    return firstError([&] { return checkChoice(options.method, TSPACE_METHOD_BEST, "method"); },
                      [&] { return checkConvention(options.convention); },
                      [&] { return checkChoice(options.ngons, TSPACE_NGONS_SKIP, "ngons"); },
                      [&] { return checkChoice(options.domain, TSPACE_DOMAIN_VERTEX, "domain"); },
                      [&] { return checkChoice(options.frame, TSPACE_FRAME_SYMMETRIC, "frame"); },
                      [&] { return checkChoice(options.pairing, TSPACE_PAIRING_CORRECTED, "pairing"); },
                      [&] { return checkChoice(options.normalize_normals, 1, "normalize_normals"); });
}

inline tspace_TangentReport toReport(const TangentReport& from) {
    tspace_TangentReport made;
    TSPACE_INIT(made);
    made.reference_order_abandoned = from.reference_order_abandoned ? 1 : 0;
    made.triangle_count = from.triangle_count;
    made.degenerate_triangle_count = from.degenerate_triangle_count;
    made.degenerate_uv_count = from.degenerate_uv_count;
    made.mirrored_count = from.mirrored_count;
    made.skipped_face_count = from.skipped_face_count;
    made.group_count = from.group_count;
    made.default_corner_count = from.default_corner_count;
    made.not_finite_count = from.not_finite_count;
    return made;
}

inline void copyFields(const tspace_NormalOptions& from, NormalOptions& to) {
    to.weighting = static_cast<NormalWeighting>(from.weighting);
    to.convention = toConvention(from.convention);
    to.crease_angle_deg = from.crease_angle_deg;
    to.smoothing_groups_are_masks = from.smoothing_groups_are_masks != 0;
    to.weld_positions = from.weld_positions != 0;
    to.refine = from.refine;
    to.denoise = from.denoise;
    to.weld_distance = from.weld_distance;
}
/// Returns an error for the first enumerator or flag that exceeds its largest value, or ok.
inline Error checkFields(const tspace_NormalOptions& options) {
    return firstError([&] { return checkChoice(options.weighting, TSPACE_NORMAL_WEIGHTING_BEST, "weighting"); },
                      [&] { return checkConvention(options.convention); },
                      [&] { return checkChoice(options.smoothing_groups_are_masks, 1, "smoothing_groups_are_masks"); },
                      [&] { return checkChoice(options.weld_positions, 1, "weld_positions"); });
}

inline tspace_NormalReport toReport(const NormalReport& from) {
    tspace_NormalReport made;
    TSPACE_INIT(made);
    made.face_count = from.face_count;
    made.degenerate_face_count = from.degenerate_face_count;
    made.fallback_corner_count = from.fallback_corner_count;
    made.noise = from.noise;
    made.crease_angle_deg = from.crease_angle_deg;
    return made;
}

inline tspace_PositionNoise toReport(const PositionNoise& from) {
    tspace_PositionNoise made;
    TSPACE_INIT(made);
    made.sigma = from.sigma;
    made.kink_share = from.kink_share;
    made.noise = from.noise;
    made.mean_edge = from.mean_edge;
    return made;
}

inline void copyFields(const tspace_SanitizeOptions& from, SanitizeOptions& to) {
    to.orthogonalize_all = from.orthogonalize_all != 0;
}
/// Returns an error for the first enumerator or flag that exceeds its largest value, or ok.
inline Error checkFields(const tspace_SanitizeOptions& options) {
    return firstError([&] { return checkChoice(options.orthogonalize_all, 1, "orthogonalize_all"); });
}

inline tspace_SanitizeReport toReport(const SanitizeReport& from) {
    tspace_SanitizeReport made;
    TSPACE_INIT(made);
    made.not_finite_count = from.not_finite_count;
    made.zero_count = from.zero_count;
    made.not_unit_count = from.not_unit_count;
    made.parallel_count = from.parallel_count;
    made.bad_sign_count = from.bad_sign_count;
    made.mixed_sign_count = from.mixed_sign_count;
    made.orthogonalized_count = from.orthogonalized_count;
    made.normalized_count = from.normalized_count;
    made.from_neighbor_count = from.from_neighbor_count;
    made.from_basis_count = from.from_basis_count;
    made.bad_normal_count = from.bad_normal_count;
    made.mended_count = from.mendedCount();
    made.placeholder_count = from.placeholder_count;
    return made;
}

inline void copyFields(const tspace_IndexedFramesOptions& from, IndexedFramesOptions& to) {
    to.make_normals = from.make_normals != 0;
    to.sanitize = from.sanitize != 0;
    to.orthogonalize_all = from.orthogonalize_all != 0;
}
/// Returns an error for the first enumerator or flag that exceeds its largest value, or ok.
inline Error checkFields(const tspace_IndexedFramesOptions& options) {
    return firstError([&] { return checkChoice(options.make_normals, 1, "make_normals"); },
                      [&] { return checkChoice(options.sanitize, 1, "sanitize"); },
                      [&] { return checkChoice(options.orthogonalize_all, 1, "orthogonalize_all"); });
}

inline tspace_PackReport toReport(const PackReport& from) {
    tspace_PackReport made;
    TSPACE_INIT(made);
    made.bad_normal_count = from.bad_normal_count;
    made.not_finite_count = from.not_finite_count;
    made.zero_count = from.zero_count;
    made.parallel_count = from.parallel_count;
    made.not_unit_count = from.not_unit_count;
    made.not_orthogonal_count = from.not_orthogonal_count;
    made.bad_sign_count = from.bad_sign_count;
    made.mended_count = from.mendedCount();
    return made;
}

inline void copyFields(const tspace_WindingOptions& from, WindingOptions& to) {
    to.convention = toConvention(from.convention);
    to.use_normals = from.use_normals != 0;
    to.weld_positions = from.weld_positions != 0;
    to.weld_distance = from.weld_distance;
}
/// Returns an error for the first enumerator or flag that exceeds its largest value, or ok.
inline Error checkFields(const tspace_WindingOptions& options) {
    return firstError([&] { return checkConvention(options.convention); },
                      [&] { return checkChoice(options.use_normals, 1, "use_normals"); },
                      [&] { return checkChoice(options.weld_positions, 1, "weld_positions"); });
}

inline tspace_WindingReport toReport(const WindingReport& from) {
    tspace_WindingReport made;
    TSPACE_INIT(made);
    made.face_count = from.face_count;
    made.turned_count = from.turned_count;
    made.conflict_count_before = from.conflict_count_before;
    made.conflict_count_after = from.conflict_count_after;
    made.component_count = from.component_count;
    made.turned_component_count = from.turned_component_count;
    made.by_normals_count = from.by_normals_count;
    made.by_volume_count = from.by_volume_count;
    made.by_nesting_count = from.by_nesting_count;
    made.by_winding_number_count = from.by_winding_number_count;
    made.by_majority_count = from.by_majority_count;
    made.small_count = from.small_count;
    made.one_sided_count = from.one_sided_count;
    return made;
}

}  // namespace tspace::c_api
