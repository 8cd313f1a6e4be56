// SPDX-License-Identifier: MIT
use crate::enums::NormalWeighting;
use crate::error::{checked, Error};
use crate::mesh::Mesh;
use crate::structs::{NormalOptions, NormalReport};
use crate::sys;
use crate::tangents::{new_report, span};

impl NormalOptions<'_> {
    /// Returns the struct of the C API, which refers to slices of `self`.
    pub(crate) fn raw(&self) -> sys::NormalOptions {
        let mut raw = self.fields();
        // The C API rejects all-zero options as uninitialized; flat, which is 0, uses none of the other options.
        if self.weighting == NormalWeighting::Flat && self.refine == 0 {
            raw.refine = 1;
        }
        raw
    }
}

/// Computes one unit normal per corner.
pub fn normals(mesh: &Mesh<'_>, options: &NormalOptions<'_>) -> Result<Vec<[f32; 3]>, Error> {
    mesh.validate()?;
    let mut made = vec![[0.0; 3]; mesh.corner_count()];
    normals_into(mesh, options, &mut made)?;
    Ok(made)
}

/// Computes the same normals as [`normals`], writes them to the caller's slice, and returns counts.
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
