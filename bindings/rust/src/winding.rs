// SPDX-License-Identifier: MIT
use crate::error::{checked, Error};
use crate::mesh::Mesh;
use crate::structs::WindingOptions;
use crate::sys;
use std::ptr::null_mut;

/// Returns, for each face, whether to flip it (reverse its corners), so that neighbors have consistent winding and the
/// outside is where the convention requires it.
pub fn fix_winding(mesh: &Mesh<'_>, options: &WindingOptions) -> Result<Vec<bool>, Error> {
    mesh.validate()?;
    let mut turned = vec![0u8; mesh.face_count()];
    let raw = options.fields();
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
