// SPDX-License-Identifier: MIT
//! A mesh for Bevy: the call of `bevy_mikktspace`, and the call that needs no trait and splits vertices.
//!
//! Bevy stores attributes in vectors like these (`Mesh::ATTRIBUTE_POSITION` etc.), and tangents as `[f32; 4]`.

use tspace::mikktspace::{generate_tangents, Geometry};
use tspace::{Convention, IndexedFramesOptions, Mesh};

struct Bevy {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    indices: Vec<u32>,
    tangents: Vec<[f32; 4]>,
}

impl Bevy {
    fn vertex(&self, face: usize, vert: usize) -> usize {
        self.indices[3 * face + vert] as usize
    }
}

// Written as for bevy_mikktspace. The last function has a defect: corners of a vertex overwrite each other, so a
// mirrored UV map gets a wrong sign on one side.
impl Geometry for Bevy {
    fn num_faces(&self) -> usize {
        self.indices.len() / 3
    }
    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }
    fn position(&self, face: usize, vert: usize) -> [f32; 3] {
        self.positions[self.vertex(face, vert)]
    }
    fn normal(&self, face: usize, vert: usize) -> [f32; 3] {
        self.normals[self.vertex(face, vert)]
    }
    fn tex_coord(&self, face: usize, vert: usize) -> [f32; 2] {
        self.uvs[self.vertex(face, vert)]
    }
    fn set_tangent_encoded(&mut self, tangent: [f32; 4], face: usize, vert: usize) {
        let vertex = self.vertex(face, vert);
        self.tangents[vertex] = tangent;
    }
}

fn main() -> Result<(), tspace::Error> {
    // Two squares; the texture is mirrored on the second one, so the two shared vertices need two tangents each.
    let positions = (0..6).map(|v| [(v % 3) as f32, (v / 3) as f32, 0.0]).collect();
    let uvs = (0..6).map(|v| [if v % 3 == 1 { 1.0 } else { 0.0 }, (v / 3) as f32]).collect();
    let indices = vec![0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4];
    let mut bevy =
        Bevy { positions, normals: vec![[0.0, 0.0, 1.0]; 6], uvs, indices, tangents: vec![[0.0; 4]; 6] };

    assert!(generate_tangents(&mut bevy));
    println!("one tangent per vertex: {:?} at vertex 1", bevy.tangents[1]);

    let mesh = Mesh::new(&bevy.positions).normals(&bevy.normals).uvs(&bevy.uvs).indices(&bevy.indices);
    let frames = tspace::make_indexed_frames(&mesh, &IndexedFramesOptions::new(Convention::preset("opengl")?))?;
    for (vertex, &source) in frames.source_vertices.iter().enumerate().filter(|(_, &source)| source == 1) {
        println!("vertex {vertex} copies {source}: {:?}", frames.tangents[vertex]);
    }
    assert_eq!(frames.source_vertices.len(), 8);
    Ok(())
}
