// SPDX-License-Identifier: MIT
//! The C API, as `tspace.h` declares it. Sized structs are checked by the library: a layout that differs is an error of
//! every call, and `tests/` compares the sizes.

use std::os::raw::{c_char, c_void};

pub const OK: u32 = 0;
pub const NO_ELEMENT: u64 = u64::MAX;
pub const INDEX_NONE: u32 = 0;
pub const INDEX_U16: u32 = 2;
pub const INDEX_U32: u32 = 4;
pub const INDEX_CORNERS: u32 = 8;

#[repr(C)]
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
pub struct Execution {
    pub struct_size: u32,
    pub thread_count: u32,
    pub executor: *const c_void,
    pub allocator: *const c_void,
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
pub struct Pose {
    pub struct_size: u32,
    pub reserved: u32,
    pub positions: ConstSpan,
    pub normals: ConstSpan,
}

#[repr(C)]
pub struct TangentPlanInfo {
    pub struct_size: u32,
    pub method: u32,
    pub vertex_count: usize,
    pub corner_count: usize,
    pub output_count: usize,
    pub memory_bytes: usize,
}

#[repr(C)]
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
pub struct WindingOptions {
    pub struct_size: u32,
    pub convention: Convention,
    pub use_normals: u32,
    pub weld_positions: u32,
    pub weld_distance: f32,
}

#[repr(C)]
pub struct CornerAttribute {
    pub data: *const f32,
    pub stride_bytes: usize,
    pub component_count: u32,
    pub tolerance: f32,
}

#[repr(C)]
pub struct SplitResult {
    pub indices: *const u32,
    pub corner_count: usize,
    pub source_vertices: *const u32,
    pub source_corners: *const u32,
    pub vertex_count: usize,
}

#[repr(C)]
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
pub struct Triangulation {
    pub corners: *const u32,
    pub faces: *const u32,
    pub triangle_count: usize,
}

#[repr(C)]
pub struct TangentPlan {
    _private: [u8; 0],
}

// What a struct is prepared by.
pub type Init<Struct> = unsafe extern "C" fn(*mut Struct, u32, *mut Error) -> u32;

extern "C" {
    pub fn tspace_version() -> u32;
    pub fn tspace_findConvention(name: *const c_char, out: *mut Convention, error: *mut Error) -> u32;
    pub fn tspace_cornerCount(mesh: *const Mesh) -> usize;
    pub fn tspace_faceCount(mesh: *const Mesh) -> usize;
    pub fn tspace_validate(mesh: *const Mesh, error: *mut Error) -> u32;
    pub fn tspace_initExecution(execution: *mut Execution, struct_size: u32, error: *mut Error) -> u32;
    pub fn tspace_initTangentOptions(options: *mut TangentOptions, struct_size: u32, error: *mut Error) -> u32;
    pub fn tspace_initNormalOptions(options: *mut NormalOptions, struct_size: u32, error: *mut Error) -> u32;
    pub fn tspace_initWindingOptions(options: *mut WindingOptions, struct_size: u32, error: *mut Error) -> u32;
    pub fn tspace_initSanitizeOptions(options: *mut SanitizeOptions, struct_size: u32, error: *mut Error) -> u32;
    pub fn tspace_initIndexedFramesOptions(
        options: *mut IndexedFramesOptions,
        struct_size: u32,
        error: *mut Error,
    ) -> u32;
    pub fn tspace_generateTangents(
        mesh: *const Mesh,
        options: *const TangentOptions,
        out: *const TangentOutput,
        execution: *const Execution,
        report: *mut TangentReport,
        error: *mut Error,
    ) -> u32;
    pub fn tspace_planTangents(
        mesh: *const Mesh,
        options: *const TangentOptions,
        execution: *const Execution,
        plan: *mut *mut TangentPlan,
        error: *mut Error,
    ) -> u32;
    pub fn tspace_evaluateTangents(
        plan: *const TangentPlan,
        pose: *const Pose,
        out: *const TangentOutput,
        execution: *const Execution,
        report: *mut TangentReport,
        error: *mut Error,
    ) -> u32;
    pub fn tspace_describeTangentPlan(plan: *const TangentPlan, info: *mut TangentPlanInfo, error: *mut Error) -> u32;
    pub fn tspace_destroyTangentPlan(plan: *mut TangentPlan);
    pub fn tspace_generateNormals(
        mesh: *const Mesh,
        options: *const NormalOptions,
        out: Span,
        execution: *const Execution,
        report: *mut NormalReport,
        error: *mut Error,
    ) -> u32;
    pub fn tspace_sanitizeTangents(
        mesh: *const Mesh,
        options: *const SanitizeOptions,
        tangents: Span,
        execution: *const Execution,
        report: *mut SanitizeReport,
        error: *mut Error,
    ) -> u32;
    pub fn tspace_mendWinding(
        mesh: *const Mesh,
        options: *const WindingOptions,
        turned: *mut u8,
        turned_count: usize,
        execution: *const Execution,
        report: *mut c_void,
        error: *mut Error,
    ) -> u32;
    pub fn tspace_splitVertices(
        indices: *const Indices,
        vertex_count: usize,
        corner_count: usize,
        attributes: *const CornerAttribute,
        attribute_count: usize,
        execution: *const Execution,
        result: *mut *mut SplitResult,
        error: *mut Error,
    ) -> u32;
    pub fn tspace_destroySplitResult(result: *mut SplitResult);
    pub fn tspace_triangulate(mesh: *const Mesh, result: *mut *mut Triangulation, error: *mut Error) -> u32;
    pub fn tspace_destroyTriangulation(result: *mut Triangulation);
    pub fn tspace_makeIndexedFrames(
        mesh: *const Mesh,
        options: *const IndexedFramesOptions,
        execution: *const Execution,
        frames: *mut *mut IndexedFrames,
        error: *mut Error,
    ) -> u32;
    pub fn tspace_destroyIndexedFrames(frames: *mut IndexedFrames);
    pub fn tspace_frameBytes(format: u32) -> usize;
    pub fn tspace_packFrames(
        normals: ConstSpan,
        tangents: ConstSpan,
        format: u32,
        out: *mut c_void,
        out_bytes: usize,
        report: *mut c_void,
        error: *mut Error,
    ) -> u32;
    pub fn tspace_unpackFrames(
        bytes: *const c_void,
        byte_count: usize,
        format: u32,
        normals: Span,
        tangents: Span,
        error: *mut Error,
    ) -> u32;
}

