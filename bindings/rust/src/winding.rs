// SPDX-License-Identifier: MIT
use crate::error::{checked, Error};
use crate::mesh::Mesh;
use crate::options::{prepared, Convention, Execution};
use crate::sys;
use std::ptr::null_mut;

/// Options for [`mend_winding`]. [`WindingOptions::new`] sets the defaults.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindingOptions {
    /// Convention whose handedness and winding define the correct order of corners, seen from outside.
    pub convention: Convention,
    /// The mesh's normals, if consistent, define the outside. Default: true.
    pub use_normals: bool,
    /// Weld vertices at the same position. Default: true.
    pub weld_positions: bool,
    /// With `weld_positions`: positions that differ by at most this in each coordinate are welded. -1: twice the
    /// spacing of floats. Default: 0.
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
}

/// Returns, for each face, whether to flip it (reverse its corners), so that neighbors have consistent winding and the
/// outside is where the convention requires it.
pub fn mend_winding(mesh: &Mesh<'_>, options: &WindingOptions) -> Result<Vec<bool>, Error> {
    mesh.validate()?;
    let mut turned = vec![0u8; mesh.face_count()];
    let mut raw = prepared(sys::tspace_initWindingOptions);
    raw.convention = options.convention.raw();
    raw.use_normals = options.use_normals.into();
    raw.weld_positions = options.weld_positions.into();
    raw.weld_distance = options.weld_distance;
    let execution = options.execution.raw();
    // SAFETY: all pointers refer to slices that outlive the call, with their lengths.
    checked(|error| unsafe {
        sys::tspace_mendWinding(
            &mesh.raw(),
            &raw,
            turned.as_mut_ptr(),
            turned.len(),
            &execution,
            null_mut(),
            error,
        )
    })?;
    Ok(turned.into_iter().map(|turn| turn != 0).collect())
}
