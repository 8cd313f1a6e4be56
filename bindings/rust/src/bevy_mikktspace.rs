// SPDX-License-Identifier: MIT
//! Drop-in replacement for the crate `bevy_mikktspace` 0.17 and 1.0: same trait, types and functions. Results are
//! bit-identical to the MikkTSpace reference in C. (In a test of 4,000 random meshes over few points, where many
//! triangles are duplicated or degenerate, results of the crate differ from the reference at 1 % of the corners.)
//! Replace `bevy_mikktspace::` by `tspace::bevy_mikktspace::`. The trait of `mikktspace` 0.3 and of `bevy_mikktspace`
//! up to 0.16 is in [`mikktspace`](crate::mikktspace).
//!
//! [`Geometry`] has no parameter `Ops`, with which `no_std` programs provide their own square roots.
//!
//! ```
//! use tspace::bevy_mikktspace::{generate_tangents, GenerateTangentSpaceError, Geometry, TangentSpace};
//!
//! struct Triangle {
//!     tangents: [[f32; 4]; 3],
//! }
//! impl Geometry for Triangle {
//!     fn num_faces(&self) -> usize { 1 }
//!     fn num_vertices_of_face(&self, _face: usize) -> usize { 3 }
//!     fn position(&self, _face: usize, vert: usize) -> [f32; 3] { [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]][vert] }
//!     fn normal(&self, _face: usize, _vert: usize) -> [f32; 3] { [0.0, 0.0, 1.0] }
//!     fn tex_coord(&self, _face: usize, vert: usize) -> [f32; 2] { [[0.0; 2], [1.0, 0.0], [0.0, 1.0]][vert] }
//!     fn set_tangent(&mut self, tangent_space: Option<TangentSpace>, _face: usize, vert: usize) {
//!         self.tangents[vert] = tangent_space.unwrap_or_default().tangent_encoded();
//!     }
//! }
//!
//! # fn main() -> Result<(), GenerateTangentSpaceError> {
//! let mut triangle = Triangle { tangents: [[0.0; 4]; 3] };
//! generate_tangents(&mut triangle)?;
//! assert_eq!(triangle.tangents, [[1.0, 0.0, 0.0, 1.0]; 3]);
//! # Ok(())
//! # }
//! ```

use crate::callbacks::{generate, Reader};
use crate::Error;

/// Callbacks that read a mesh and receive its tangents.
pub trait Geometry {
    /// Number of faces.
    fn num_faces(&self) -> usize;
    /// Number of corners of a face. Faces with fewer than 3 or more than 4 corners are ignored.
    fn num_vertices_of_face(&self, face: usize) -> usize;
    /// Position of a corner.
    fn position(&self, face: usize, vert: usize) -> [f32; 3];
    /// Normal of a corner.
    fn normal(&self, face: usize, vert: usize) -> [f32; 3];
    /// UV of a corner.
    fn tex_coord(&self, face: usize, vert: usize) -> [f32; 2];
    /// Receives the result of a corner; `None` if no face contributes to it.
    fn set_tangent(&mut self, tangent_space: Option<TangentSpace>, face: usize, vert: usize);
}

/// The result of a corner. The default is the reference's value for corners to which no face contributes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TangentSpace {
    tangent: [f32; 3],
    bi_tangent: [f32; 3],
    magnitudes: [f32; 2],
    is_orientation_preserving: bool,
}

impl Default for TangentSpace {
    fn default() -> Self {
        TangentSpace {
            tangent: [1.0, 0.0, 0.0],
            bi_tangent: [0.0, 1.0, 0.0],
            magnitudes: [1.0; 2],
            is_orientation_preserving: false,
        }
    }
}

impl TangentSpace {
    /// Unit tangent.
    pub const fn tangent(&self) -> [f32; 3] {
        self.tangent
    }

    /// Unit bitangent: the direction of dP/dv, in general different from cross(N, T).
    pub const fn bi_tangent(&self) -> [f32; 3] {
        self.bi_tangent
    }

    /// Mean length of dP/du.
    pub const fn tangent_magnitude(&self) -> f32 {
        self.magnitudes[0]
    }

    /// Mean length of dP/dv.
    pub const fn bi_tangent_magnitude(&self) -> f32 {
        self.magnitudes[1]
    }

    /// False if the UVs are mirrored.
    pub const fn is_orientation_preserving(&self) -> bool {
        self.is_orientation_preserving
    }

    /// Unit tangent and the sign of `B = sign * cross(N, T)`.
    pub const fn tangent_encoded(&self) -> [f32; 4] {
        let sign = if self.is_orientation_preserving { 1.0 } else { -1.0 };
        [self.tangent[0], self.tangent[1], self.tangent[2], sign]
    }
}

/// Reason why there are no tangents.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GenerateTangentSpaceError {
    /// The library failed: out of memory, or more than 715,827,882 triangles.
    Failed(Error),
}

impl std::fmt::Display for GenerateTangentSpaceError {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let GenerateTangentSpaceError::Failed(error) = self;
        error.fmt(formatter)
    }
}

impl std::error::Error for GenerateTangentSpaceError {}

struct Reading<'a, G: ?Sized>(&'a G);

impl<G: Geometry + ?Sized> Reader for Reading<'_, G> {
    fn num_faces(&self) -> usize {
        self.0.num_faces()
    }
    fn num_vertices_of_face(&self, face: usize) -> usize {
        self.0.num_vertices_of_face(face)
    }
    fn corner(&self, face: usize, vert: usize) -> ([f32; 3], [f32; 3], [f32; 2]) {
        (self.0.position(face, vert), self.0.normal(face, vert), self.0.tex_coord(face, vert))
    }
}

/// Computes tangents like the MikkTSpace reference. A mesh without triangles and quads gets none, which is not an
/// error.
pub fn generate_tangents<G: Geometry + ?Sized>(geometry: &mut G) -> Result<(), GenerateTangentSpaceError> {
    generate_with_degrees(geometry, 180.0)
}

/// [`generate_tangents`] with a threshold from -1 (off) to 1: faces are averaged if the cosine of the angle between
/// their tangents is larger. The library takes the angle in degrees, so the cosine that it compares with may differ
/// from `threshold` by 2e-7; -1 is exact.
pub fn generate_tangents_with_threshold<G: Geometry + ?Sized>(
    geometry: &mut G,
    threshold: f32,
) -> Result<(), GenerateTangentSpaceError> {
    generate_with_degrees(geometry, f64::from(threshold.clamp(-1.0, 1.0)).acos().to_degrees() as f32)
}

fn generate_with_degrees<G: Geometry + ?Sized>(geometry: &mut G, degrees: f32) -> Result<(), GenerateTangentSpaceError> {
    let made = generate(&Reading(geometry), degrees).map_err(GenerateTangentSpaceError::Failed)?;
    for (corner, (face, vert)) in made.corners().enumerate() {
        let tangents = &made.tangents;
        let [x, y, z, sign] = tangents.tangents[corner];
        let space = TangentSpace {
            tangent: [x, y, z],
            bi_tangent: tangents.bitangents[corner],
            magnitudes: [tangents.magnitudes_s[corner], tangents.magnitudes_t[corner]],
            is_orientation_preserving: sign > 0.0,
        };
        geometry.set_tangent(tangents.has_tangent[corner].then_some(space), face, vert);
    }
    Ok(())
}
