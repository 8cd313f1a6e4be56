// SPDX-License-Identifier: MIT
use crate::error::{checked, Error};
use crate::mesh::Mesh;
use crate::options::{prepared, Convention, Execution};
use crate::sys;
use std::ptr::null_mut;

/// How [`mend_winding`] decides. [`WindingOptions::new`] has every default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindingOptions {
    /// Its handedness and winding say which order of corners is right as seen from outside.
    pub convention: Convention,
    /// The mesh's normals say which side is out, where it has some and they agree. Default: true.
    pub use_normals: bool,
    /// Vertices at the same position are one point. Default: true.
    pub weld_positions: bool,
    /// With it: positions that differ by no more in each coordinate are one. -1: twice the spacing of floats. Default: 0.
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

/// Says for each face whether to turn it (to reverse its corners), so that neighbours are wound alike and the outside is
/// where the convention wants it.
pub fn mend_winding(mesh: &Mesh<'_>, options: &WindingOptions) -> Result<Vec<bool>, Error> {
    mesh.validate()?;
    let mut turned = vec![0u8; mesh.face_count()];
    let mut raw = prepared(sys::tspace_initWindingOptions);
    raw.convention = options.convention.raw();
    raw.use_normals = options.use_normals.into();
    raw.weld_positions = options.weld_positions.into();
    raw.weld_distance = options.weld_distance;
    let execution = options.execution.raw();
    // SAFETY: all pointers are to slices that outlive the call, with their lengths.
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
