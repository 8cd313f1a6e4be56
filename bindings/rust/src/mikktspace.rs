// SPDX-License-Identifier: MIT
//! Drop-in replacement for the crates `mikktspace` 0.3 and `bevy_mikktspace` up to 0.16: same trait, same function, and
//! bit-identical results. The trait of versions 0.17 and 1.0 of `bevy_mikktspace` is in
//! [`bevy_mikktspace`](crate::bevy_mikktspace).
//!
//! ```
//! use tspace::mikktspace::{generate_tangents, Geometry};
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
//!     fn set_tangent_encoded(&mut self, tangent: [f32; 4], _face: usize, vert: usize) { self.tangents[vert] = tangent }
//! }
//!
//! let mut triangle = Triangle { tangents: [[0.0; 4]; 3] };
//! assert!(generate_tangents(&mut triangle));
//! assert_eq!(triangle.tangents, [[1.0, 0.0, 0.0, 1.0]; 3]);
//! ```

use crate::callbacks::{generate, Reader};

/// Callbacks that read a mesh and receive its tangents, like those of the reference.
pub trait Geometry {
    /// Number of faces of the mesh.
    fn num_faces(&self) -> usize;
    /// Number of corners of a face. Faces with fewer than 3 or more than 4 corners are ignored.
    fn num_vertices_of_face(&self, face: usize) -> usize;
    /// Position of a corner.
    fn position(&self, face: usize, vert: usize) -> [f32; 3];
    /// Normal of a corner.
    fn normal(&self, face: usize, vert: usize) -> [f32; 3];
    /// UV of a corner.
    fn tex_coord(&self, face: usize, vert: usize) -> [f32; 2];

    /// Receives the complete result of a corner. The default implementation calls [`Geometry::set_tangent_encoded`].
    #[allow(clippy::too_many_arguments)]
    fn set_tangent(
        &mut self,
        tangent: [f32; 3],
        _bi_tangent: [f32; 3],
        _f_mag_s: f32,
        _f_mag_t: f32,
        bi_tangent_preserves_orientation: bool,
        face: usize,
        vert: usize,
    ) {
        let sign = if bi_tangent_preserves_orientation { 1.0 } else { -1.0 };
        self.set_tangent_encoded([tangent[0], tangent[1], tangent[2], sign], face, vert);
    }

    /// Receives the result of a corner: the tangent, and the sign of `B = sign * cross(N, T)`.
    fn set_tangent_encoded(&mut self, _tangent: [f32; 4], _face: usize, _vert: usize) {}
}

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

/// Computes tangents like the MikkTSpace reference. Returns false, without setting anything, if the mesh has no
/// triangles or quads.
///
/// Unlike the reference, it reads all corners first, so that callbacks are called once per corner.
pub fn generate_tangents<G: Geometry + ?Sized>(geometry: &mut G) -> bool {
    let made = match generate(&Reading(geometry), 180.0) {
        Ok(made) if !made.tangents.tangents.is_empty() => made,
        _ => return false,
    };
    for (corner, (face, vert)) in made.corners().enumerate() {
        let tangents = &made.tangents;
        let [x, y, z, sign] = tangents.tangents[corner];
        geometry.set_tangent(
            [x, y, z],
            tangents.bitangents[corner],
            tangents.magnitudes_s[corner],
            tangents.magnitudes_t[corner],
            sign > 0.0,
            face,
            vert,
        );
    }
    true
}
