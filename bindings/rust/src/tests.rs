// SPDX-License-Identifier: MIT
//! Golden meshes are in the repository's test data: `TSPACE_SHARED_DIR`, or `shared` next to the repository.

mod cases;
mod json;

use crate::*;
use std::path::PathBuf;

fn shared() -> PathBuf {
    match std::env::var_os("TSPACE_SHARED_DIR") {
        Some(folder) => folder.into(),
        None => PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared"),
    }
}

/// A mesh with the results of the MikkTSpace reference.
struct Golden {
    name: String,
    threshold: f32,
    face_sizes: Vec<u32>,
    inputs: Vec<f32>,
    results: Vec<u32>,
}

impl Golden {
    fn read(path: &std::path::Path) -> Golden {
        let bytes = std::fs::read(path).unwrap();
        let words: Vec<u32> =
            bytes.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
        assert_eq!(words[0], 0x3147_5354);
        let (faces, corners) = (words[1] as usize, words[2] as usize);
        let (inputs, results) = words[5 + faces..].split_at(8 * corners);
        Golden {
            name: path.display().to_string(),
            threshold: f32::from_bits(words[3]),
            face_sizes: words[5..5 + faces].to_vec(),
            inputs: inputs.iter().map(|&word| f32::from_bits(word)).collect(),
            results: results.to_vec(),
        }
    }

    /// Returns whether identical bits are promised (docs/concepts/methods/mikktspace.md).
    fn is_promised(&self) -> bool {
        self.inputs.iter().all(|value| value.abs() < 1.6e38)
    }

    fn mesh(&self) -> Mesh<'_> {
        Mesh::new(Points::interleaved(&self.inputs, 0, 8).unwrap())
            .normals(Points::<3>::interleaved(&self.inputs, 3, 8).unwrap())
            .uvs(Points::<2>::interleaved(&self.inputs, 6, 8).unwrap())
            .face_sizes(&self.face_sizes)
    }

    fn options(&self) -> TangentOptions {
        TangentOptions {
            angular_threshold_deg: self.threshold,
            ngons: Ngons::Skip,
            ..TangentOptions::new(Convention::preset("opengl").unwrap())
        }
    }
}

fn goldens() -> Vec<Golden> {
    let folder = shared().join("golden/mikktspace");
    let mut paths: Vec<PathBuf> = match std::fs::read_dir(&folder) {
        Ok(entries) => entries.map(|entry| entry.unwrap().path()).collect(),
        Err(_) => {
            eprintln!("skipped: {} is missing", folder.display());
            return Vec::new();
        }
    };
    paths.sort();
    let all: Vec<Golden> = paths.iter().map(|path| Golden::read(path)).collect();
    assert_eq!(all.len(), 400);
    let promised: Vec<Golden> = all.into_iter().filter(Golden::is_promised).collect();
    assert!(promised.len() > 300);
    promised
}

fn same(a: f32, word: u32) -> bool {
    a.to_bits() == word || (a.is_nan() && f32::from_bits(word).is_nan())
}

fn gltf() -> Convention {
    Convention::preset("gltf").unwrap()
}

#[test]
fn every_word_equals_the_reference() {
    for golden in goldens() {
        for execution in [Execution::OneThread, Execution::Threads(3)] {
            let made = tangents_full(&golden.mesh(), &TangentOptions { execution, ..golden.options() }).unwrap();
            for (corner, words) in golden.results.chunks_exact(10).enumerate() {
                let (t, b) = (made.tangents[corner], made.bitangents[corner]);
                let s = [made.magnitudes_s[corner], made.magnitudes_t[corner]];
                let got = [t[0], t[1], t[2], b[0], b[1], b[2], s[0], s[1]];
                let is_same = got.iter().zip(words).all(|(&a, &word)| same(a, word)) && same(t[3], words[9]);
                assert!(is_same, "{} corner {corner}", golden.name);
            }
        }
    }
}

struct Callbacks<'a> {
    golden: &'a Golden,
    firsts: Vec<usize>,
    got: Vec<u32>,
    none_count: usize,
}

impl Callbacks<'_> {
    fn at(&self, face: usize, vert: usize) -> &[f32] {
        &self.golden.inputs[8 * (self.firsts[face] + vert)..]
    }
}

impl mikktspace::Geometry for Callbacks<'_> {
    fn num_faces(&self) -> usize {
        self.golden.face_sizes.len()
    }
    fn num_vertices_of_face(&self, face: usize) -> usize {
        self.golden.face_sizes[face] as usize
    }
    fn position(&self, face: usize, vert: usize) -> [f32; 3] {
        self.at(face, vert)[..3].try_into().unwrap()
    }
    fn normal(&self, face: usize, vert: usize) -> [f32; 3] {
        self.at(face, vert)[3..6].try_into().unwrap()
    }
    fn tex_coord(&self, face: usize, vert: usize) -> [f32; 2] {
        self.at(face, vert)[6..8].try_into().unwrap()
    }
    fn set_tangent_encoded(&mut self, tangent: [f32; 4], face: usize, vert: usize) {
        self.keep(tangent, face, vert);
    }
}

impl bevy_mikktspace::Geometry for Callbacks<'_> {
    fn num_faces(&self) -> usize {
        mikktspace::Geometry::num_faces(self)
    }
    fn num_vertices_of_face(&self, face: usize) -> usize {
        mikktspace::Geometry::num_vertices_of_face(self, face)
    }
    fn position(&self, face: usize, vert: usize) -> [f32; 3] {
        mikktspace::Geometry::position(self, face, vert)
    }
    fn normal(&self, face: usize, vert: usize) -> [f32; 3] {
        mikktspace::Geometry::normal(self, face, vert)
    }
    fn tex_coord(&self, face: usize, vert: usize) -> [f32; 2] {
        mikktspace::Geometry::tex_coord(self, face, vert)
    }
    fn set_tangent(&mut self, space: Option<bevy_mikktspace::TangentSpace>, face: usize, vert: usize) {
        self.none_count += usize::from(space.is_none());
        self.keep(space.unwrap_or_default().tangent_encoded(), face, vert);
    }
}

impl<'a> Callbacks<'a> {
    fn new(golden: &'a Golden) -> Self {
        let mut firsts = vec![0];
        for &corners in &golden.face_sizes {
            firsts.push(firsts.last().unwrap() + corners as usize);
        }
        Callbacks { golden, firsts, got: vec![0; 4 * golden.results.len() / 10], none_count: 0 }
    }
    fn keep(&mut self, tangent: [f32; 4], face: usize, vert: usize) {
        let corner = self.firsts[face] + vert;
        for (i, value) in tangent.iter().enumerate() {
            self.got[4 * corner + i] = value.to_bits();
        }
    }
    fn is_reference(&self) -> bool {
        self.golden.results.chunks_exact(10).zip(self.got.chunks_exact(4)).all(|(words, got)| {
            (0..3).all(|i| same(f32::from_bits(got[i]), words[i])) && same(f32::from_bits(got[3]), words[9])
        })
    }
}

#[test]
fn both_bevy_mikktspace_traits_equal_the_reference() {
    for golden in goldens().iter().filter(|golden| golden.threshold == 180.0) {
        let mut old = Callbacks::new(golden);
        mikktspace::generate_tangents(&mut old);
        assert!(old.is_reference(), "{}", golden.name);
        for threshold in [None, Some(-1.0)] {
            let mut new = Callbacks::new(golden);
            match threshold {
                None => bevy_mikktspace::generate_tangents(&mut new).unwrap(),
                Some(cosine) => bevy_mikktspace::generate_tangents_with_threshold(&mut new, cosine).unwrap(),
            }
            assert!(new.is_reference(), "{}", golden.name);
            let report = tangents_full(&golden.mesh(), &golden.options()).unwrap().report;
            assert_eq!(new.none_count as u64, report.default_corner_count, "{}", golden.name);
        }
    }
}

#[test]
fn an_empty_mesh_is_not_an_error_for_the_new_trait() {
    let golden = Golden { name: String::new(), threshold: 180.0, face_sizes: vec![], inputs: vec![], results: vec![] };
    let mut callbacks = Callbacks::new(&golden);
    assert!(!mikktspace::generate_tangents(&mut callbacks));
    bevy_mikktspace::generate_tangents(&mut callbacks).unwrap();
}

#[test]
fn invalid_input_is_an_error_with_its_location() {
    let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
    let mesh = Mesh::new(&positions).normals(&[[0.0, 0.0, 1.0]; 3]).uvs(&[[0.0, 1.0]; 3]);
    let error = tangents(&mesh.indices(&[0u16, 1, 9]), &TangentOptions::new(gltf())).unwrap_err();
    assert!(error.to_string().contains("corner 2"), "{error}");
    let error = tangents_into(&mesh, &TangentOptions::new(gltf()), &mut [[0.0; 4]; 2]).unwrap_err();
    assert_eq!(error.code, ErrorCode::CountMismatch);
    assert_eq!(Points::<3>::interleaved(&[0.0; 9], 0, 2).unwrap_err().code, ErrorCode::StrideTooSmall);
    assert!(Points::<3>::interleaved(&[0.0; 9], 10, 3).is_err());
    assert_eq!(Points::<3>::interleaved(&[0.0; 9], 1, 3).unwrap().len(), 2);
    assert_eq!(unpack_frames(&[0; 5], FrameFormat::Frame32).unwrap_err().code, ErrorCode::CountMismatch);
}
