// SPDX-License-Identifier: MIT
use crate::error::{checked, mismatch, Error};
use crate::mesh::Points;
use crate::sys;
use crate::tangents::span;
use std::ptr::null_mut;

/// A code for N, T and the sign; `docs/concepts/pack.md` has what each costs in degrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FrameFormat {
    /// 4 bytes, 0.135 degrees.
    Frame32 = 0,
    /// 6 bytes, 0.0042.
    Frame48 = 1,
    /// 8 bytes, 0.00015.
    Frame64 = 2,
    /// 4 bytes, 0.165; the cheapest to decode of these.
    Oct32 = 3,
    /// 8 bytes, 0.004: a quaternion.
    Qtangent64 = 4,
    /// 8 bytes, 0.391: T and N as snorm8.
    Snorm8Pair = 5,
    /// 16 bytes, 0.00152: T and N as snorm16.
    Snorm16Pair = 6,
    /// 7 bytes, 0.391: as KHR_mesh_quantization stores them.
    GltfSnorm8 = 7,
    /// 14 bytes, 0.00152.
    GltfSnorm16 = 8,
}

impl FrameFormat {
    /// Bytes of one frame.
    pub fn bytes(self) -> usize {
        // SAFETY: no pointers.
        unsafe { sys::tspace_frameBytes(self as u32) }
    }
}

/// Packs frames, each by itself. What is broken is mended first.
pub fn pack_frames<'a>(
    normals: impl Into<Points<'a, 3>>,
    tangents: impl Into<Points<'a, 4>>,
    format: FrameFormat,
) -> Result<Vec<u8>, Error> {
    let (normals, tangents) = (normals.into(), tangents.into());
    let mut bytes = vec![0u8; normals.len() * format.bytes()];
    // SAFETY: `bytes` has room for all frames, and lengths are checked.
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

/// Unpacks frames. All bytes are frames.
pub fn unpack_frames(bytes: &[u8], format: FrameFormat) -> Result<Frames, Error> {
    if bytes.len() % format.bytes() != 0 {
        let message = format!("{} bytes are no whole frames of {}", bytes.len(), format.bytes());
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
