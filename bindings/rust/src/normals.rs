// SPDX-License-Identifier: MIT
use crate::enums::NormalWeighting;
use crate::error::{checked, Error};
use crate::mesh::Mesh;
use crate::options::{prepared, Convention, Execution};
use crate::sys;
use crate::tangents::{new_report, span};

/// Options for normals. [`NormalOptions::new`] sets the defaults.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalOptions<'a> {
    /// Convention whose handedness and winding define the outside of faces.
    pub convention: Convention,
    /// Default: [`NormalWeighting::Angle`].
    pub weighting: NormalWeighting,
    /// Degrees, 0..180: edges where face normals differ by more are hard. -1: derived from the mesh. Default: 180, no
    /// hard edges.
    pub crease_angle_deg: f32,
    /// One number per face, or empty. Two faces are smoothed if their numbers are equal and not 0.
    pub smoothing_groups: &'a [u32],
    /// Two faces are smoothed if their numbers share a bit (3ds Max).
    pub smoothing_groups_are_masks: bool,
    /// Weld vertices at the same position. Default: true.
    pub weld_positions: bool,
    /// Number of refinement steps of [`NormalWeighting::Best`]: 0, 1 or 2. Default: 2.
    pub refine: u32,
    /// For noisy positions: 0 (the default): off; -1: the measured noise; up to 4: multiple of the measured noise.
    pub denoise: f32,
    /// With `weld_positions`: positions that differ by at most this in each coordinate are welded. -1: twice the
    /// spacing of floats. Default: 0, only equal positions.
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
        // The C API rejects all-zero options as uninitialized; flat, which is 0, uses none of the other options.
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
    /// Corners whose weighted mean is zero and that got a fallback.
    pub fallback_corner_count: u64,
    /// Noise that `denoise` removed, in mean edge lengths.
    pub noise: f32,
    /// The crease angle that was used.
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

/// Computes one unit normal per corner.
pub fn normals(mesh: &Mesh<'_>, options: &NormalOptions<'_>) -> Result<Vec<[f32; 3]>, Error> {
    mesh.validate()?;
    let mut made = vec![[0.0; 3]; mesh.corner_count()];
    normals_into(mesh, options, &mut made)?;
    Ok(made)
}

/// Like [`normals`], into the caller's slice, with counts.
pub fn normals_into(
    mesh: &Mesh<'_>,
    options: &NormalOptions<'_>,
    out: &mut [[f32; 3]],
) -> Result<NormalReport, Error> {
    let mut report = new_report(|report: &mut sys::NormalReport, size| report.struct_size = size);
    let execution = options.execution.raw();
    // SAFETY: all pointers refer to slices that outlive the call, with their lengths.
    checked(|error| unsafe {
        sys::tspace_generateNormals(&mesh.raw(), &options.raw(), span(out), &execution, &mut report, error)
    })?;
    Ok(NormalReport::of(&report))
}
