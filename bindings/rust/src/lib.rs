// SPDX-License-Identifier: MIT
//! Normals and tangent frames for meshes: T, B, N and the sign that normal maps need.
//!
//! A *corner* is a pair of a face and one of its vertices; corners are numbered face by face. A *vertex* is one entry of
//! the vertex arrays. One vertex can need several tangents (at UV seams, and where the UV map is mirrored), so results are
//! per corner. The *sign* is the fourth number of a tangent: `B = sign * cross(N, T)`. Its meaning depends on the format, so
//! every call needs a *convention*.
//!
//! An indexed mesh with tangents, in one call:
//!
//! ```
//! # fn main() -> Result<(), tspace::Error> {
//! use tspace::{Convention, IndexedFramesOptions, Mesh};
//!
//! let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0f32]];
//! let uvs = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0f32]];
//! let indices = [0u32, 1, 2, 0, 2, 3];
//! let mesh = Mesh::new(&positions).uvs(&uvs).indices(&indices);
//! let frames = tspace::make_indexed_frames(&mesh, &IndexedFramesOptions::new(Convention::preset("gltf")?))?;
//! assert_eq!(frames.tangents[0], [1.0, 0.0, 0.0, 1.0]);
//! let new_positions: Vec<[f32; 3]> = frames.source_vertices.iter().map(|&v| positions[v as usize]).collect();
//! # assert_eq!(new_positions.len(), frames.normals.len());
//! # Ok(())
//! # }
//! ```
//!
//! The same in separate steps: [`tangents`] per corner, repaired by [`sanitize`], then [`split`]. For a mesh that deforms, use a
//! [`Plan`]. For code that calls `bevy_mikktspace`, its trait is in [`mikktspace`] (versions up to 0.16) or
//! [`bevy_mikktspace`] (0.17 and 1.0).
//!
//! - Slices are used without a copy, including interleaved ones ([`Points::interleaved`]). Nothing is kept after a call.
//! - Results have the same bits on every CPU, for any number of threads, and in every language binding of tspace.
//! - Invalid geometry (NaN, faces without area) is not an error: reports count it, and [`sanitize`] repairs the result.
//! - Nothing is printed. A panic is a defect of this crate.

pub mod bevy_mikktspace;
mod callbacks;
mod enums;
mod error;
mod frames;
mod mesh;
pub mod mikktspace;
mod normals;
mod options;
mod pack;
mod structs;
mod sys;
mod tangents;
#[cfg(test)]
mod tests;
mod winding;

pub use enums::{
    ErrorCode, FrameFormat, FrameShape, Green, Handedness, Method, Ngons, NormalWeighting, OutputDomain, Pairing, StoredSign, VAxis, Winding,
};
pub use error::Error;
pub use frames::{
    make_indexed_frames, sanitize, split, triangulate, Attribute, IndexedFrames, IndexedFramesOptions, Split, Triangles,
};
pub use mesh::{Indices, Mesh, Points};
pub use normals::{normals, normals_into};
pub use options::{Convention, Execution};
pub use pack::{pack_frames, unpack_frames};
pub use structs::{NormalOptions, NormalReport, SanitizeReport, TangentOptions, TangentReport, WindingOptions};
pub use tangents::{tangents, tangents_full, tangents_into, Plan, Tangents};
pub use winding::fix_winding;
/// The former name of [`fix_winding`].
pub use winding::fix_winding as mend_winding;

/// Version of the library: 10000 * major + 100 * minor + patch.
pub fn version() -> u32 {
    // SAFETY: no arguments.
    unsafe { sys::tspace_version() }
}
