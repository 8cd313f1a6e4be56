// SPDX-License-Identifier: MIT
use crate::enums::NormalWeighting;
use crate::error::{checked, Error};
use crate::mesh::Mesh;
use crate::options::{prepared, Convention, Execution};
use crate::sys;
use crate::tangents::{new_report, span};

/// How normals are computed. [`NormalOptions::new`] has every default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalOptions<'a> {
    /// Its handedness and winding say which side is out.
    pub convention: Convention,
    /// Default: [`NormalWeighting::Angle`].
    pub weighting: NormalWeighting,
    /// Degrees, 0..180: faces are smoothed over an edge when their normals differ by no more. -1: found by the mesh.
    /// Default: 180, never hard.
    pub crease_angle_deg: f32,
    /// One number per face, or empty. Faces smooth together when their numbers are equal and not 0.
    pub smoothing_groups: &'a [u32],
    /// Faces smooth together when their numbers have a bit in common (3ds Max).
    pub smoothing_groups_are_masks: bool,
    /// Vertices at the same position are one point. Default: true.
    pub weld_positions: bool,
    /// Steps that [`NormalWeighting::Best`] takes after its fit: 0, 1 or 2. Default: 2.
    pub refine: u32,
    /// For noisy positions: 0 (the default) is off, -1 by the measured noise, up to 4 so many times that.
    pub denoise: f32,
    /// With `weld_positions`: positions that differ by no more in each coordinate are one. -1: twice the spacing of floats.
    /// Default: 0, only equal ones are.
    pub weld_distance: f32,
    /// Default: the calling thread.
    pub execution: Execution,
}

impl NormalOptions<'_> {
    /// The defaults.
    pub fn new(convention: Convention) -> Self {
        let raw = prepared(sys::tspace_initNormalOptions);
        NormalOptions {
            convention,
            weighting: NormalWeighting::default(),
            crease_angle_deg: raw.crease_angle_deg,
            smoothing_groups: &[],
            smoothing_groups_are_masks: false,
            weld_positions: raw.weld_positions != 0,
            refine: raw.refine,
            denoise: raw.denoise,
            weld_distance: raw.weld_distance,
            execution: Execution::default(),
        }
    }

    /// Points into self.
    pub(crate) fn raw(&self) -> sys::NormalOptions {
        let mut raw = prepared(sys::tspace_initNormalOptions);
        raw.weighting = self.weighting as u32;
        raw.convention = self.convention.raw();
        raw.crease_angle_deg = self.crease_angle_deg;
        if !self.smoothing_groups.is_empty() {
            raw.smoothing_groups = self.smoothing_groups.as_ptr();
            raw.smoothing_group_count = self.smoothing_groups.len();
        }
        raw.smoothing_groups_are_masks = self.smoothing_groups_are_masks.into();
        raw.weld_positions = self.weld_positions.into();
        raw.refine = self.refine;
        // The C API refuses all of 0 as forgotten; flat, which is 0, looks at none of the others.
        if self.weighting == NormalWeighting::Flat && self.refine == 0 {
            raw.refine = 1;
        }
        raw.denoise = self.denoise;
        raw.weld_distance = self.weld_distance;
        raw
    }
}

/// Counts of faces and defects of the input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct NormalReport {
    /// Faces with at least 3 corners.
    pub face_count: u64,
    /// Faces without a normal.
    pub degenerate_face_count: u64,
    /// Corners whose mean vanished: they got a substitute.
    pub fallback_corner_count: u64,
    /// What `denoise` removed, in mean edge lengths.
    pub noise: f32,
    /// The angle that edges were held against.
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

/// One unit normal per corner.
pub fn normals(mesh: &Mesh<'_>, options: &NormalOptions<'_>) -> Result<Vec<[f32; 3]>, Error> {
    mesh.validate()?;
    let mut made = vec![[0.0; 3]; mesh.corner_count()];
    normals_into(mesh, options, &mut made)?;
    Ok(made)
}

/// [`normals`] into the caller's slice, with counts.
pub fn normals_into(
    mesh: &Mesh<'_>,
    options: &NormalOptions<'_>,
    out: &mut [[f32; 3]],
) -> Result<NormalReport, Error> {
    let mut report = new_report(|report: &mut sys::NormalReport, size| report.struct_size = size);
    let execution = options.execution.raw();
    // SAFETY: all pointers are to slices that outlive the call, with their lengths.
    checked(|error| unsafe {
        sys::tspace_generateNormals(&mesh.raw(), &options.raw(), span(out), &execution, &mut report, error)
    })?;
    Ok(NormalReport::of(&report))
}
