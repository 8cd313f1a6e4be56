// SPDX-License-Identifier: MIT
//! Options and reports, with the fields of the C API.

use crate::enums::*;
use crate::options::{prepared, Convention, Execution};
use crate::sys;

// Everything below is written by scripts/api.

/// Options of generateTangents: first those for all methods, then those of a single method, which others ignore.
/// [`TangentOptions::new`] sets the defaults.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TangentOptions {
    /// The default is what bakers and glTF expect.
    pub method: Method,
    /// Determines the stored sign; there is no default: "gltf" for glTF; "opengl" stores the raw sign, as the
    /// reference does. If unset: invalidOption.
    pub convention: Convention,
    /// By default every corner gets a tangent.
    pub ngons: Ngons,
    /// `vertex` for `lengyel` and `basis` only: other methods have several results per vertex.
    pub domain: OutputDomain,
    /// `symmetric` is rejected for `mikktspace`, whose results are those of the reference, and for `basis`, which
    /// uses no UVs. The default is what bakers and engines expect.
    pub frame: FrameShape,
    /// Angular threshold in degrees, 0 to 180: faces of a group whose tangents (or bitangents) differ by this or
    /// more are not averaged. 180 is the default of the reference and of every baker. As in the reference, any float
    /// is accepted, but only its cosine is used: 270 has the effect of 90. With NaN no two faces are averaged.
    pub angular_threshold_deg: f32,
    /// The default is bit-identical to every other MikkTSpace.
    pub pairing: Pairing,
    /// Number of refinement steps after the fit: 0, 1 or 2. A step changes each frame so that, interpolated along
    /// the edges around it, it reproduces these edges, as far as they agree. 1: a fifth less shading error. 2:
    /// another twentieth less.
    pub refine: u32,
    /// true: normalize normals whose length deviates from 1 by more than 8-bit rounding does (0.00674) before they
    /// are used; all others, and those without a direction, keep their bits. false, the default: use normals as
    /// given, as the reference does. A tangent is then not perpendicular to a normal that is not unit: on a sphere
    /// it deviates by up to 28 degrees at length 2.
    pub normalize_normals: bool,
    /// Default: the calling thread.
    pub execution: Execution,
}

impl TangentOptions {
    /// The defaults.
    pub fn new(convention: Convention) -> Self {
        let raw = prepared(sys::tspace_initTangentOptions);
        TangentOptions {
            method: Method::default(),
            convention,
            ngons: Ngons::default(),
            domain: OutputDomain::default(),
            frame: FrameShape::default(),
            angular_threshold_deg: raw.angular_threshold_deg,
            pairing: Pairing::default(),
            refine: raw.refine,
            normalize_normals: raw.normalize_normals != 0,
            execution: Execution::default(),
        }
    }

    pub(crate) fn fields(&self) -> sys::TangentOptions {
        let mut raw = prepared(sys::tspace_initTangentOptions);
        raw.method = self.method as u32;
        raw.convention = self.convention.raw();
        raw.ngons = self.ngons as u32;
        raw.domain = self.domain as u32;
        raw.frame = self.frame as u32;
        raw.angular_threshold_deg = self.angular_threshold_deg;
        raw.pairing = self.pairing as u32;
        raw.refine = self.refine;
        raw.normalize_normals = self.normalize_normals.into();
        raw
    }
}

/// Options of generateNormals: first those that apply to all weightings, then those that apply to some.
/// [`NormalOptions::new`] sets the defaults.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalOptions<'a> {
    /// The default does not depend on how faces were triangulated.
    pub weighting: NormalWeighting,
    /// Handedness and winding define the outside of faces. Default: glTF.
    pub convention: Convention,
    /// Maximum angle between the normals of two faces whose shared edge is smooth, in degrees, 0..180 (plus 1e-6 rad
    /// for rounding). Default: 180, because no angle suits all models: no hard edges (except from smoothing groups),
    /// and all faces at a point are smoothed together, including faces that share only this point. -1: chosen for
    /// each mesh, as the middle of the widest gap in the histogram of edge angles, after noise of positions is
    /// filtered out. NormalReport contains the angle that was used.
    pub crease_angle_deg: f32,
    /// One number per face, or empty. Faces are smoothed together only if their numbers are equal and not 0 (OBJ
    /// `s`), or, with `smoothing_groups_are_masks`, if they have a bit in common (3ds Max). Smoothing is transitive:
    /// if A is smooth with B and B with C around a point, all three share one normal.
    pub smoothing_groups: &'a [u32],
    pub smoothing_groups_are_masks: bool,
    /// true: weld vertices with equal positions (so UV seams stay smooth); false: weld by index only.
    pub weld_positions: bool,
    /// Number of refinement steps after the fit: 0, 1 or 2. A step moves each normal so that, interpolated along the
    /// edges around it, it is perpendicular to these edges, as far as they agree. 1: a third less error at vertices
    /// and in the shading between them. 2: another quarter less.
    pub refine: u32,
    /// Denoising for meshes with noisy positions: scans, marching cubes of a noisy field. Vertices are not moved; at
    /// each vertex the normals of quadratic surfaces through two and three rings are blended with the normal of
    /// `best`, weighted by their expected errors. 0, the default: off. -1: by the measured noise; if there is none,
    /// or it looks like shape (CAD, bevels, decimated meshes), results are bit-identical to those with 0. Above 0,
    /// up to 4: factor of the measured noise, without that check; 3 suits noise that is smooth from vertex to
    /// vertex, which cannot be distinguished from detail. Hard edges are preserved: no surface is fitted across
    /// them.
    pub denoise: f32,
    /// With `weld_positions`: weld distance, in mesh units. Vertices whose positions differ by at most this in each
    /// coordinate are welded to the one with the lowest index. Useful for meshes that are closed only up to
    /// rounding, such as a torus whose last ring has sin(2 pi) = -2.4e-16 instead of 0. 0, the default: only equal
    /// positions. -1: twice the spacing of floats at the largest coordinate, and only at positions with an edge of
    /// at least 32 times that length. Vertices are processed in order: each is welded to the first earlier vertex
    /// within the distance that was not welded itself, so chains of close positions are not all welded together.
    pub weld_distance: f32,
    /// Default: the calling thread.
    pub execution: Execution,
}

impl NormalOptions<'_> {
    /// The defaults.
    pub fn new(convention: Convention) -> Self {
        let raw = prepared(sys::tspace_initNormalOptions);
        NormalOptions {
            weighting: NormalWeighting::default(),
            convention,
            crease_angle_deg: raw.crease_angle_deg,
            smoothing_groups: &[],
            smoothing_groups_are_masks: raw.smoothing_groups_are_masks != 0,
            weld_positions: raw.weld_positions != 0,
            refine: raw.refine,
            denoise: raw.denoise,
            weld_distance: raw.weld_distance,
            execution: Execution::default(),
        }
    }

    pub(crate) fn fields(&self) -> sys::NormalOptions {
        let mut raw = prepared(sys::tspace_initNormalOptions);
        raw.weighting = self.weighting as u32;
        raw.convention = self.convention.raw();
        raw.crease_angle_deg = self.crease_angle_deg;
        raw.smoothing_groups = if self.smoothing_groups.is_empty() { std::ptr::null() } else { self.smoothing_groups.as_ptr() };
        raw.smoothing_groups_are_masks = self.smoothing_groups_are_masks.into();
        raw.weld_positions = self.weld_positions.into();
        raw.refine = self.refine;
        raw.denoise = self.denoise;
        raw.weld_distance = self.weld_distance;
        raw.smoothing_group_count = self.smoothing_groups.len();
        raw
    }
}

/// [`WindingOptions::new`] sets the defaults.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindingOptions {
    /// Handedness and winding define the corner order of a face seen from outside. Default: glTF.
    pub convention: Convention,
    /// true: the mesh's normals, if present and consistent within a component, decide which side of it is outside.
    pub use_normals: bool,
    /// true: weld vertices with equal positions (so a non-indexed mesh is a connected surface); false: weld by index
    /// only.
    pub weld_positions: bool,
    /// With `weld_positions`: maximum difference per coordinate of welded positions. Same meaning as
    /// `weld_distance`. 0, the default: only equal positions. -1: derived from the spacing of floats.
    pub weld_distance: f32,
    /// Default: the calling thread.
    pub execution: Execution,
}

impl WindingOptions {
    /// The defaults.
    pub fn new(convention: Convention) -> Self {
        let raw = prepared(sys::tspace_initWindingOptions);
        WindingOptions {
            convention,
            use_normals: raw.use_normals != 0,
            weld_positions: raw.weld_positions != 0,
            weld_distance: raw.weld_distance,
            execution: Execution::default(),
        }
    }

    pub(crate) fn fields(&self) -> sys::WindingOptions {
        let mut raw = prepared(sys::tspace_initWindingOptions);
        raw.convention = self.convention.raw();
        raw.use_normals = self.use_normals.into();
        raw.weld_positions = self.weld_positions.into();
        raw.weld_distance = self.weld_distance;
        raw
    }
}

/// Counts of triangles, groups and defects of the input. Invalid geometry never makes a call fail.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct TangentReport {
    /// `mikktspace`: the input would drive the reference into quadratic time, so one of its steps was skipped. This
    /// is either the sort (with `reference`; the corrected pairing was used for the last bucket; only crafted inputs
    /// cause this), or the angular test (a group of more than 4096 faces whose tangents spread too far was not
    /// split).
    pub reference_order_abandoned: bool,
    /// Processed triangles, after triangulation of quads and n-gons.
    pub triangle_count: u64,
    /// Triangles with two corners at the same position.
    pub degenerate_triangle_count: u64,
    /// Triangles without UV area: they use the frames of their neighbors.
    pub degenerate_uv_count: u64,
    /// Triangles that show the image mirrored, in the chosen convention.
    pub mirrored_count: u64,
    /// Faces for which nothing was computed.
    pub skipped_face_count: u64,
    /// Groups: sets of corners that share one tangent.
    pub group_count: u64,
    /// Outputs without a tangent from any face: default of the method.
    pub default_corner_count: u64,
    /// Outputs whose tangent has a NaN or infinity.
    pub not_finite_count: u64,
}

impl TangentReport {
    pub(crate) fn of(raw: &sys::TangentReport) -> Self {
        TangentReport {
            reference_order_abandoned: raw.reference_order_abandoned != 0,
            triangle_count: raw.triangle_count,
            degenerate_triangle_count: raw.degenerate_triangle_count,
            degenerate_uv_count: raw.degenerate_uv_count,
            mirrored_count: raw.mirrored_count,
            skipped_face_count: raw.skipped_face_count,
            group_count: raw.group_count,
            default_corner_count: raw.default_corner_count,
            not_finite_count: raw.not_finite_count,
        }
    }
}

/// Counts of faces and defects of the input. Invalid geometry never makes the call fail.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct NormalReport {
    /// Faces with at least 3 corners.
    pub face_count: u64,
    /// Faces without a normal (zero area or not finite).
    pub degenerate_face_count: u64,
    /// Corners whose mean vanished and was replaced (see generateNormals).
    pub fallback_corner_count: u64,
    /// Noise that `denoise` removed: standard deviation of positions along the normal, in mean edge lengths. 0:
    /// denoising was off or found no noise, and changed no bit.
    pub noise: f32,
    /// Crease angle that was used: as given, or as derived from the mesh (for noisy positions, an angle between
    /// smoothed faces). `flat`: 0.
    pub crease_angle_deg: f32,
}

impl NormalReport {
    pub(crate) fn of(raw: &sys::NormalReport) -> Self {
        NormalReport {
            face_count: raw.face_count,
            degenerate_face_count: raw.degenerate_face_count,
            fallback_corner_count: raw.fallback_corner_count,
            noise: raw.noise,
            crease_angle_deg: raw.crease_angle_deg,
        }
    }
}

/// Corners repaired, by cause (the first that applies, in this order) and by fix.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct SanitizeReport {
    /// NaN or infinity in the tangent.
    pub not_finite_count: u64,
    /// Length 0 (or too small to normalize).
    pub zero_count: u64,
    /// Length off by more than 5e-4 (the glTF validator's tolerance).
    pub not_unit_count: u64,
    /// Within 1 degree of +N or -N: no frame can be built.
    pub parallel_count: u64,
    /// Sign not exactly +1 or -1.
    pub bad_sign_count: u64,
    /// Sign changed because the signs of the face's corners differed.
    pub mixed_sign_count: u64,
    /// Valid tangents changed by orthogonalize_all.
    pub orthogonalized_count: u64,
    /// Fix: its own direction, made unit and orthogonal to N.
    pub normalized_count: u64,
    /// Fix: direction of a valid corner of the same face or position.
    pub from_neighbor_count: u64,
    /// Fix: basis from N (Duff et al. 2017).
    pub from_basis_count: u64,
    /// Corners whose N is zero or not finite: only a unit tangent is guaranteed.
    pub bad_normal_count: u64,
    /// Returns the number of corners that were written: the sum of the causes.
    pub mended_count: u64,
    /// Exactly (1, 0, 0), and not perpendicular to N.
    pub placeholder_count: u64,
}

impl SanitizeReport {
    pub(crate) fn of(raw: &sys::SanitizeReport) -> Self {
        SanitizeReport {
            not_finite_count: raw.not_finite_count,
            zero_count: raw.zero_count,
            not_unit_count: raw.not_unit_count,
            parallel_count: raw.parallel_count,
            bad_sign_count: raw.bad_sign_count,
            mixed_sign_count: raw.mixed_sign_count,
            orthogonalized_count: raw.orthogonalized_count,
            normalized_count: raw.normalized_count,
            from_neighbor_count: raw.from_neighbor_count,
            from_basis_count: raw.from_basis_count,
            bad_normal_count: raw.bad_normal_count,
            mended_count: raw.mended_count,
            placeholder_count: raw.placeholder_count,
        }
    }
}
