// SPDX-License-Identifier: MIT
//! Reads meshes through callbacks as the reference does, for the traits of other crates.

use crate::{tangents_full, Convention, Error, Mesh, Ngons, TangentOptions, Tangents};

pub(crate) trait Reader {
    fn num_faces(&self) -> usize;
    fn num_vertices_of_face(&self, face: usize) -> usize;
    /// Returns position, normal and UV of a corner.
    fn corner(&self, face: usize, vert: usize) -> ([f32; 3], [f32; 3], [f32; 2]);
}

/// Tangents for the corners of triangles and quads.
pub(crate) struct Made {
    face_sizes: Vec<u32>,
    pub(crate) tangents: Tangents,
}

impl Made {
    /// Iterates over the face and corner of each result.
    pub(crate) fn corners(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let corners_of = |(face, &size): (usize, &u32)| (0..size as usize).map(move |vert| (face, vert));
        self.face_sizes.iter().enumerate().flat_map(corners_of)
    }
}

/// Computes tangents, after reading every corner once. Faces with fewer than 3 or more than 4 corners are ignored.
pub(crate) fn generate(reader: &impl Reader, angular_threshold_deg: f32) -> Result<Made, Error> {
    let (mut positions, mut normals, mut uvs) = (Vec::new(), Vec::new(), Vec::new());
    let face_sizes: Vec<u32> = (0..reader.num_faces())
        .map(|face| reader.num_vertices_of_face(face))
        .map(|corners| if corners == 3 || corners == 4 { corners as u32 } else { 0 })
        .collect();
    for (face, &corners) in face_sizes.iter().enumerate() {
        for vert in 0..corners as usize {
            let (position, normal, uv) = reader.corner(face, vert);
            positions.push(position);
            normals.push(normal);
            uvs.push(uv);
        }
    }
    let options = TangentOptions {
        ngons: Ngons::Skip,
        angular_threshold_deg,
        ..TangentOptions::new(Convention::preset("opengl")?)
    };
    let mesh = Mesh::new(&positions).normals(&normals).uvs(&uvs).face_sizes(&face_sizes);
    let tangents = tangents_full(&mesh, &options)?;
    Ok(Made { face_sizes, tangents })
}
