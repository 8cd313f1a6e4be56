// SPDX-License-Identifier: MIT
//! The C API, as `tspace.h` declares it. Sized structs are checked by the library: a layout that differs is an error of
//! every call, and `tests/` compares the sizes.
#![allow(dead_code)]

use std::os::raw::{c_char, c_void};

/// The function that prepares a sized struct.
pub type Init<Struct> = unsafe extern "C" fn(*mut Struct, u32, *mut Error) -> u32;

// Everything below is written by scripts/api.
pub const NO_ELEMENT: u64 = 0xffffffffffffffff;
pub const MAX_CORNERS: u32 = 0x7fffffff;
pub const ALL_THREADS: u32 = 0xffffffff;
pub const NO_CORNER: u32 = 0xffffffff;
pub const OK: u32 = 0;
pub const ERROR_NULL_DATA: u32 = 1;
pub const ERROR_COUNT_MISMATCH: u32 = 2;
pub const ERROR_INDEX_OUT_OF_RANGE: u32 = 3;
pub const ERROR_STRIDE_TOO_SMALL: u32 = 4;
pub const ERROR_MISALIGNED: u32 = 5;
pub const ERROR_TOO_LARGE: u32 = 6;
pub const ERROR_MISSING_ATTRIBUTE: u32 = 7;
pub const ERROR_INVALID_OPTION: u32 = 8;
pub const ERROR_OUT_OF_MEMORY: u32 = 9;
pub const ERROR_PLAN_MISMATCH: u32 = 10;
pub const ERROR_INTERNAL: u32 = 11;
pub const ERROR_CANCELLED: u32 = 12;
pub const ERROR_INVALID_FILE: u32 = 100;
pub const ERROR_UNSUPPORTED_FILE: u32 = 101;
pub const ERROR_FORBIDDEN_PATH: u32 = 102;
pub const ERROR_CANNOT_READ: u32 = 103;
pub const ERROR_CANNOT_WRITE: u32 = 104;
pub const INDEX_NONE: u32 = 0;
pub const INDEX_U8: u32 = 1;
pub const INDEX_U16: u32 = 2;
pub const INDEX_U32: u32 = 4;
pub const INDEX_CORNERS: u32 = 8;
pub const SIMD_BEST: u32 = 0;
pub const SIMD_SCALAR: u32 = 1;
pub const SIMD_SSE2: u32 = 2;
pub const SIMD_AVX2: u32 = 3;
pub const SIMD_AVX512: u32 = 4;
pub const SIMD_NEON: u32 = 5;
pub const V_UNSET: u32 = 0;
pub const V_UP: u32 = 1;
pub const V_DOWN: u32 = 2;
pub const GREEN_UP: u32 = 0;
pub const GREEN_DOWN: u32 = 1;
pub const SIGN_AS_IS: u32 = 0;
pub const SIGN_NEGATED: u32 = 1;
pub const HANDEDNESS_RIGHT: u32 = 0;
pub const HANDEDNESS_LEFT: u32 = 1;
pub const WINDING_COUNTER_CLOCKWISE: u32 = 0;
pub const WINDING_CLOCKWISE: u32 = 1;
pub const METHOD_MIKKTSPACE: u32 = 0;
pub const METHOD_LENGYEL: u32 = 1;
pub const METHOD_UNIFORM: u32 = 2;
pub const METHOD_ANGLE: u32 = 3;
pub const METHOD_AREA: u32 = 4;
pub const METHOD_FLAT: u32 = 5;
pub const METHOD_BASIS: u32 = 6;
pub const METHOD_FAST: u32 = 7;
pub const METHOD_BEST: u32 = 8;
pub const PAIRING_REFERENCE: u32 = 0;
pub const PAIRING_CORRECTED: u32 = 1;
pub const NGONS_TRIANGULATE: u32 = 0;
pub const NGONS_SKIP: u32 = 1;
pub const DOMAIN_CORNER: u32 = 0;
pub const DOMAIN_VERTEX: u32 = 1;
pub const FRAME_GRAM_SCHMIDT: u32 = 0;
pub const FRAME_SYMMETRIC: u32 = 1;
pub const NORMAL_WEIGHTING_FLAT: u32 = 0;
pub const NORMAL_WEIGHTING_UNIFORM: u32 = 1;
pub const NORMAL_WEIGHTING_AREA: u32 = 2;
pub const NORMAL_WEIGHTING_ANGLE: u32 = 3;
pub const NORMAL_WEIGHTING_ANGLE_AREA: u32 = 4;
pub const NORMAL_WEIGHTING_MAX: u32 = 5;
pub const NORMAL_WEIGHTING_BEST: u32 = 6;
pub const FRAME_FORMAT_FRAME32: u32 = 0;
pub const FRAME_FORMAT_FRAME48: u32 = 1;
pub const FRAME_FORMAT_FRAME64: u32 = 2;
pub const FRAME_FORMAT_OCT32: u32 = 3;
pub const FRAME_FORMAT_QTANGENT64: u32 = 4;
pub const FRAME_FORMAT_SNORM8_PAIR: u32 = 5;
pub const FRAME_FORMAT_SNORM16_PAIR: u32 = 6;
pub const FRAME_FORMAT_GLTF_SNORM8: u32 = 7;
pub const FRAME_FORMAT_GLTF_SNORM16: u32 = 8;

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Error {
    pub code: u32,
    pub reserved: u32,
    pub element: u64,
    pub message: [c_char; 240],
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct ConstSpan {
    pub data: *const f32,
    pub count: usize,
    pub stride_bytes: usize,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Span {
    pub data: *mut f32,
    pub count: usize,
    pub stride_bytes: usize,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct ByteSpan {
    pub data: *mut u8,
    pub count: usize,
    pub stride_bytes: usize,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Indices {
    pub data: *const c_void,
    pub count: usize,
    pub kind: u32,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Mesh {
    pub struct_size: u32,
    pub face_size: u32,
    pub positions: ConstSpan,
    pub normals: ConstSpan,
    pub uvs: ConstSpan,
    pub indices: Indices,
    pub face_sizes: *const u32,
    pub face_count: usize,
    pub normal_indices: Indices,
    pub uv_indices: Indices,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Executor {
    pub run: Option<unsafe extern "C" fn(*mut c_void, usize, Option<unsafe extern "C" fn(*mut c_void, usize)>, *mut c_void)>,
    pub user: *mut c_void,
    pub concurrency: u32,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Allocator {
    pub allocate: Option<unsafe extern "C" fn(*mut c_void, usize, usize) -> *mut c_void>,
    pub release: Option<unsafe extern "C" fn(*mut c_void, *mut c_void, usize, usize)>,
    pub user: *mut c_void,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Execution {
    pub struct_size: u32,
    pub thread_count: u32,
    pub executor: *const Executor,
    pub allocator: *const Allocator,
    pub simd: u32,
    pub reserved: u32,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Convention {
    pub v_axis: u32,
    pub green: u32,
    pub stored_sign: u32,
    pub handedness: u32,
    pub winding: u32,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct TangentOptions {
    pub struct_size: u32,
    pub method: u32,
    pub convention: Convention,
    pub ngons: u32,
    pub domain: u32,
    pub frame: u32,
    pub angular_threshold_deg: f32,
    pub pairing: u32,
    pub refine: u32,
    pub normalize_normals: u32,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct TangentReport {
    pub struct_size: u32,
    pub reference_order_abandoned: u32,
    pub triangle_count: u64,
    pub degenerate_triangle_count: u64,
    pub degenerate_uv_count: u64,
    pub mirrored_count: u64,
    pub skipped_face_count: u64,
    pub group_count: u64,
    pub default_corner_count: u64,
    pub not_finite_count: u64,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct TangentOutput {
    pub struct_size: u32,
    pub reserved: u32,
    pub tangents: Span,
    pub bitangents: Span,
    pub magnitudes_s: Span,
    pub magnitudes_t: Span,
    pub has_tangent: ByteSpan,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct MeshJob {
    pub mesh: *const Mesh,
    pub options: *const TangentOptions,
    pub out: *const TangentOutput,
    pub report: *mut TangentReport,
    pub error: *mut Error,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Pose {
    pub struct_size: u32,
    pub reserved: u32,
    pub positions: ConstSpan,
    pub normals: ConstSpan,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct TangentPlanInfo {
    pub struct_size: u32,
    pub method: u32,
    pub vertex_count: usize,
    pub corner_count: usize,
    pub output_count: usize,
    pub memory_bytes: usize,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Triangulation {
    pub corners: *const u32,
    pub faces: *const u32,
    pub triangle_count: usize,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Vec2 {
    pub x: f32,
    pub y: f32,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Vec3 {
    pub x: f32,
    pub y: f32,
    pub z: f32,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Vec4 {
    pub x: f32,
    pub y: f32,
    pub z: f32,
    pub w: f32,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Frame {
    pub tangent: Vec3,
    pub bitangent: Vec3,
    pub normal: Vec3,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Mat3 {
    pub rows: [Vec3; 3],
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct FaceFrame {
    pub tangent: Vec3,
    pub bitangent: Vec3,
    pub determinant: f32,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct NormalOptions {
    pub struct_size: u32,
    pub weighting: u32,
    pub convention: Convention,
    pub crease_angle_deg: f32,
    pub smoothing_groups: *const u32,
    pub smoothing_group_count: usize,
    pub smoothing_groups_are_masks: u32,
    pub weld_positions: u32,
    pub refine: u32,
    pub reserved: u32,
    pub denoise: f32,
    pub weld_distance: f32,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct NormalReport {
    pub struct_size: u32,
    pub reserved: u32,
    pub face_count: u64,
    pub degenerate_face_count: u64,
    pub fallback_corner_count: u64,
    pub noise: f32,
    pub crease_angle_deg: f32,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct PositionNoise {
    pub struct_size: u32,
    pub sigma: f32,
    pub kink_share: f32,
    pub noise: f32,
    pub mean_edge: f64,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct SanitizeOptions {
    pub struct_size: u32,
    pub orthogonalize_all: u32,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct SanitizeReport {
    pub struct_size: u32,
    pub reserved: u32,
    pub not_finite_count: u64,
    pub zero_count: u64,
    pub not_unit_count: u64,
    pub parallel_count: u64,
    pub bad_sign_count: u64,
    pub mixed_sign_count: u64,
    pub orthogonalized_count: u64,
    pub normalized_count: u64,
    pub from_neighbor_count: u64,
    pub from_basis_count: u64,
    pub bad_normal_count: u64,
    pub mended_count: u64,
    pub placeholder_count: u64,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct CornerAttribute {
    pub data: *const f32,
    pub stride_bytes: usize,
    pub component_count: u32,
    pub tolerance: f32,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct SplitResult {
    pub indices: *const u32,
    pub corner_count: usize,
    pub source_vertices: *const u32,
    pub source_corners: *const u32,
    pub vertex_count: usize,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct IndexedFramesOptions {
    pub struct_size: u32,
    pub make_normals: u32,
    pub sanitize: u32,
    pub orthogonalize_all: u32,
    pub tangents: *const TangentOptions,
    pub normals: *const NormalOptions,
    pub keep_apart: *const CornerAttribute,
    pub keep_apart_count: usize,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct IndexedFrames {
    pub indices: *const u32,
    pub corner_count: usize,
    pub source_vertices: *const u32,
    pub source_corners: *const u32,
    pub normals: *const f32,
    pub tangents: *const f32,
    pub vertex_count: usize,
    pub normal_report: *const NormalReport,
    pub tangent_report: *const TangentReport,
    pub sanitize_report: *const SanitizeReport,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct PlanBufferOptions {
    pub struct_size: u32,
    pub reserved: u32,
    pub indices: *const u32,
    pub index_count: usize,
    pub source_corners: *const u32,
    pub source_corner_count: usize,
    pub mesh: *const Mesh,
    pub normals: *const NormalOptions,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct PlanBuffers {
    pub words: *const u32,
    pub word_count: usize,
    pub result_count: usize,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct FrameErrorBound {
    pub normal_deg: f64,
    pub tangent_deg: f64,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct PackReport {
    pub struct_size: u32,
    pub reserved: u32,
    pub bad_normal_count: u64,
    pub not_finite_count: u64,
    pub zero_count: u64,
    pub parallel_count: u64,
    pub not_unit_count: u64,
    pub not_orthogonal_count: u64,
    pub bad_sign_count: u64,
    pub mended_count: u64,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct WindingOptions {
    pub struct_size: u32,
    pub convention: Convention,
    pub use_normals: u32,
    pub weld_positions: u32,
    pub weld_distance: f32,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct WindingReport {
    pub struct_size: u32,
    pub reserved: u32,
    pub face_count: u64,
    pub turned_count: u64,
    pub conflict_count_before: u64,
    pub conflict_count_after: u64,
    pub component_count: u64,
    pub turned_component_count: u64,
    pub by_normals_count: u64,
    pub by_volume_count: u64,
    pub by_nesting_count: u64,
    pub by_winding_number_count: u64,
    pub by_majority_count: u64,
    pub small_count: u64,
    pub one_sided_count: u64,
}

#[repr(C)]
pub struct Arena {
    _private: [u8; 0],
}

#[repr(C)]
pub struct TangentPlan {
    _private: [u8; 0],
}

extern "C" {
    pub fn tspace_version() -> u32;
    pub fn tspace_errorName(code: u32) -> *const c_char;
    pub fn tspace_cornerCount(mesh: *const Mesh) -> usize;
    pub fn tspace_faceCount(mesh: *const Mesh) -> usize;
    pub fn tspace_validate(mesh: *const Mesh, error: *mut Error) -> u32;
    pub fn tspace_initExecution(execution: *mut Execution, struct_size: u32, error: *mut Error) -> u32;
    pub fn tspace_createArena(arena: *mut *mut Arena, error: *mut Error) -> u32;
    pub fn tspace_arenaAllocator(arena: *const Arena) -> *const Allocator;
    pub fn tspace_arenaHeldBytes(arena: *const Arena) -> usize;
    pub fn tspace_arenaUsedBytes(arena: *const Arena) -> usize;
    pub fn tspace_trimArena(arena: *mut Arena);
    pub fn tspace_destroyArena(arena: *mut Arena);
    pub fn tspace_findConvention(name: *const c_char, out: *mut Convention, error: *mut Error) -> u32;
    pub fn tspace_signFactor(convention: Convention) -> f32;
    pub fn tspace_normalFactor(convention: Convention) -> f32;
    pub fn tspace_methodName(method: u32) -> *const c_char;
    pub fn tspace_initTangentOptions(options: *mut TangentOptions, struct_size: u32, error: *mut Error) -> u32;
    pub fn tspace_generateTangents(mesh: *const Mesh, options: *const TangentOptions, out: *const TangentOutput, execution: *const Execution, report: *mut TangentReport, error: *mut Error) -> u32;
    pub fn tspace_generateTangentsOfMeshes(jobs: *const MeshJob, job_count: usize, execution: *const Execution, error: *mut Error) -> u32;
    pub fn tspace_planTangents(mesh: *const Mesh, options: *const TangentOptions, execution: *const Execution, plan: *mut *mut TangentPlan, error: *mut Error) -> u32;
    pub fn tspace_evaluateTangents(plan: *const TangentPlan, pose: *const Pose, out: *const TangentOutput, execution: *const Execution, report: *mut TangentReport, error: *mut Error) -> u32;
    pub fn tspace_describeTangentPlan(plan: *const TangentPlan, info: *mut TangentPlanInfo, error: *mut Error) -> u32;
    pub fn tspace_destroyTangentPlan(plan: *mut TangentPlan);
    pub fn tspace_triangulate(mesh: *const Mesh, result: *mut *mut Triangulation, error: *mut Error) -> u32;
    pub fn tspace_destroyTriangulation(result: *mut Triangulation);
    pub fn tspace_faceFrame(positions: *const Vec3, uvs: *const Vec2) -> FaceFrame;
    pub fn tspace_faceFrameFromPath(positions: *const Vec3, uvs: *const Vec2) -> FaceFrame;
    pub fn tspace_determinant(frame: Frame) -> f32;
    pub fn tspace_frameSign(frame: Frame) -> f32;
    pub fn tspace_rebuildBitangent(normal: Vec3, tangent: Vec4) -> Vec3;
    pub fn tspace_orthonormalize(frame: Frame) -> Frame;
    pub fn tspace_packTangent(frame: Frame) -> Vec4;
    pub fn tspace_basisFromNormal(unit_normal: Vec3) -> Frame;
    pub fn tspace_tangentToObject(frame: Frame) -> Mat3;
    pub fn tspace_objectToTangentOrthonormal(frame: Frame) -> Mat3;
    pub fn tspace_objectToTangent(frame: Frame, out: *mut Mat3) -> i32;
    pub fn tspace_transform(m: Mat3, v: Vec3) -> Vec3;
    pub fn tspace_toTangentSpace(frame: Frame, direction: Vec3) -> Vec3;
    pub fn tspace_toObjectSpace(frame: Frame, direction: Vec3) -> Vec3;
    pub fn tspace_decodeNormal(texel: Vec3, scale: f32, green: u32) -> Vec3;
    pub fn tspace_tileUv(uv: Vec2, tiling: Vec2, offset: Vec2) -> Vec2;
    pub fn tspace_lambert(frame: Frame, light_direction: Vec3, tangent_space_normal: Vec3) -> f32;
    pub fn tspace_objectNormal(frame: Frame, tangent_space_normal: Vec3) -> Vec3;
    pub fn tspace_objectNormalMikktspace(interpolated_normal: Vec3, interpolated_tangent: Vec4, tangent_space_normal: Vec3) -> Vec3;
    pub fn tspace_initNormalOptions(options: *mut NormalOptions, struct_size: u32, error: *mut Error) -> u32;
    pub fn tspace_generateNormals(mesh: *const Mesh, options: *const NormalOptions, out: Span, execution: *const Execution, report: *mut NormalReport, error: *mut Error) -> u32;
    pub fn tspace_measurePositionNoise(mesh: *const Mesh, execution: *const Execution, noise: *mut PositionNoise, error: *mut Error) -> u32;
    pub fn tspace_initSanitizeOptions(options: *mut SanitizeOptions, struct_size: u32, error: *mut Error) -> u32;
    pub fn tspace_sanitizeTangents(mesh: *const Mesh, options: *const SanitizeOptions, tangents: Span, execution: *const Execution, report: *mut SanitizeReport, error: *mut Error) -> u32;
    pub fn tspace_splitVertices(indices: *const Indices, vertex_count: usize, corner_count: usize, attributes: *const CornerAttribute, attribute_count: usize, execution: *const Execution, result: *mut *mut SplitResult, error: *mut Error) -> u32;
    pub fn tspace_destroySplitResult(result: *mut SplitResult);
    pub fn tspace_initIndexedFramesOptions(options: *mut IndexedFramesOptions, struct_size: u32, error: *mut Error) -> u32;
    pub fn tspace_makeIndexedFrames(mesh: *const Mesh, options: *const IndexedFramesOptions, execution: *const Execution, frames: *mut *mut IndexedFrames, error: *mut Error) -> u32;
    pub fn tspace_destroyIndexedFrames(frames: *mut IndexedFrames);
    pub fn tspace_planBuffers(plan: *const TangentPlan, options: *const PlanBufferOptions, execution: *const Execution, buffers: *mut *mut PlanBuffers, error: *mut Error) -> u32;
    pub fn tspace_destroyPlanBuffers(buffers: *mut PlanBuffers);
    pub fn tspace_frameBytes(format: u32) -> usize;
    pub fn tspace_frameErrorBound(format: u32) -> FrameErrorBound;
    pub fn tspace_packFrames(normals: ConstSpan, tangents: ConstSpan, format: u32, out: *mut c_void, out_bytes: usize, report: *mut PackReport, error: *mut Error) -> u32;
    pub fn tspace_unpackFrames(bytes: *const c_void, byte_count: usize, format: u32, normals: Span, tangents: Span, error: *mut Error) -> u32;
    pub fn tspace_initWindingOptions(options: *mut WindingOptions, struct_size: u32, error: *mut Error) -> u32;
    pub fn tspace_mendWinding(mesh: *const Mesh, options: *const WindingOptions, turned: *mut u8, turned_count: usize, execution: *const Execution, report: *mut WindingReport, error: *mut Error) -> u32;
}
