// SPDX-License-Identifier: MIT
use crate::enums::FrameFormat;
use crate::error::{checked, mismatch, Error};
use crate::mesh::Points;
use crate::sys;
use crate::tangents::span;
use std::ptr::null_mut;

impl FrameFormat {
    /// Returns the bytes of one frame.
    pub fn bytes(self) -> usize {
        // SAFETY: no pointers.
        unsafe { sys::tspace_frameBytes(self as u32) }
    }
}

/// Packs frames independently of each other. Invalid frames are repaired first.
pub fn pack_frames<'a>(
    normals: impl Into<Points<'a, 3>>,
    tangents: impl Into<Points<'a, 4>>,
    format: FrameFormat,
) -> Result<Vec<u8>, Error> {
    let (normals, tangents) = (normals.into(), tangents.into());
    let mut bytes = vec![0u8; normals.len() * format.bytes()];
    // SAFETY: `bytes` has space for all frames, and lengths are checked.
    checked(|error| unsafe {
        sys::tspace_packFrames(
            normals.span(),
            tangents.span(),
            format as u32,
            bytes.as_mut_ptr().cast(),
            bytes.len(),
            null_mut(),
            error,
        )
    })?;
    Ok(bytes)
}

/// Unit normals and tangents with their sign.
pub type Frames = (Vec<[f32; 3]>, Vec<[f32; 4]>);

/// Unpacks frames. Every sequence of bytes is valid.
pub fn unpack_frames(bytes: &[u8], format: FrameFormat) -> Result<Frames, Error> {
    if bytes.len() % format.bytes() != 0 {
        let message = format!("the number of bytes, {}, is not a multiple of the {} bytes of a frame", bytes.len(), format.bytes());
        return Err(mismatch(message));
    }
    let count = bytes.len() / format.bytes();
    let (mut normals, mut tangents) = (vec![[0.0; 3]; count], vec![[0.0; 4]; count]);
    // SAFETY: lengths are checked above.
    checked(|error| unsafe {
        sys::tspace_unpackFrames(
            bytes.as_ptr().cast(),
            bytes.len(),
            format as u32,
            span(&mut normals),
            span(&mut tangents),
            error,
        )
    })?;
    Ok((normals, tangents))
}
