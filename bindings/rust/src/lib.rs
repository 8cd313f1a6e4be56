// SPDX-License-Identifier: MIT
//! Normals and tangent frames for meshes: the (T, B, N) and the sign that normal maps need.
//!
//! A *corner* is one (face, local vertex) pair; corners are numbered face after face. A *vertex* is one entry of the vertex
//! arrays. One vertex can need several tangents (at UV seams, where the UV map is mirrored), so results come per corner; the
//! *sign* is the fourth number of a tangent: `B = sign * cross(N, T)`. A *convention* says what a format means by it, so it
//! must be named.
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
//! The same in steps: [`tangents`] per corner, mended by [`sanitize`], then [`split`]. A mesh that deforms takes a [`Plan`].
//! Code that calls `bevy_mikktspace` finds its trait in [`mikktspace`] (versions up to 0.16) or [`bevy_mikktspace`] (0.17 and 1.0).
//!
//! - Slices are read where they lie, interleaved ones too ([`Points::interleaved`]). Nothing is kept after a call.
//! - Results have the same bits on every CPU, for any number of threads, and in every language that tspace has.
//! - Broken geometry (NaN, faces without area) is no error: reports count it, and [`sanitize`] mends the result.
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
mod sys;
mod tangents;
#[cfg(test)]
mod tests;
mod winding;

pub use enums::{
    FrameFormat, FrameShape, Green, Handedness, Method, Ngons, NormalWeighting, OutputDomain, Pairing, StoredSign, VAxis, Winding,
};
pub use error::{Error, ErrorCode};
pub use frames::{
    make_indexed_frames, sanitize, split, triangulate, Attribute, IndexedFrames, IndexedFramesOptions, SanitizeReport,
    Split, Triangles,
};
pub use mesh::{Indices, Mesh, Points};
pub use normals::{normals, normals_into, NormalOptions, NormalReport};
pub use options::{Convention, Execution};
pub use pack::{pack_frames, unpack_frames};
pub use tangents::{
    tangents, tangents_full, tangents_into, Plan, TangentOptions, TangentReport, Tangents,
};
pub use winding::{mend_winding, WindingOptions};

/// Version of the library: 10000 * major + 100 * minor + patch.
pub fn version() -> u32 {
    // SAFETY: no arguments.
    unsafe { sys::tspace_version() }
}
