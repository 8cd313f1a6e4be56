// SPDX-License-Identifier: MIT
//! Runs the cases that all languages share: `tests/cases/arrays.json` of the repository.

use super::json::Json;
use crate::*;

/// Flat arrays of a mesh in the table of cases. A [`Mesh`] borrows them.
struct Arrays {
    positions: Vec<f32>,
    normals: Vec<f32>,
    uvs: Vec<f32>,
    lists: [Vec<u32>; 4],
    face_size: u32,
}

impl Arrays {
    fn new(mesh: &Json, change: &Json) -> Arrays {
        let get = |name: &str| if change.members().iter().any(|(member, _)| member == name) { change.get(name) } else { mesh.get(name) };
        let [positions, normals, uvs] = ["positions", "normals", "uvs"].map(|name| get(name).floats());
        let lists = ["indices", "normal_indices", "uv_indices", "face_sizes"].map(|name| get(name).integers());
        Arrays { positions, normals, uvs, lists, face_size: get("face_size").number_or(3.0) as u32 }
    }

    fn mesh(&self) -> Mesh<'_> {
        let [indices, normal_indices, uv_indices, face_sizes] = &self.lists;
        let mesh = Mesh::new(points::<3>(&self.positions)).normals(points::<3>(&self.normals)).uvs(points::<2>(&self.uvs));
        let mesh = mesh.indices(list(indices)).normal_indices(list(normal_indices)).uv_indices(list(uv_indices));
        mesh.face_size(self.face_size).face_sizes(face_sizes)
    }
}

fn list(numbers: &[u32]) -> Indices<'_> {
    if numbers.is_empty() { Indices::None } else { Indices::U32(numbers) }
}

fn points<const N: usize>(floats: &[f32]) -> Points<'_, N> {
    Points::interleaved(floats, 0, N).unwrap()
}

fn rows<const N: usize>(list: &Json) -> Vec<[f32; N]> {
    list.floats().chunks_exact(N).map(|row| row.try_into().unwrap()).collect()
}

/// Returns the enumerator with a name of the table; underscores and case are ignored.
fn choice<T: std::fmt::Debug + Copy>(name: &Json, values: &[T]) -> T {
    let name = name.text().replace('_', "");
    *values.iter().find(|value| format!("{value:?}").eq_ignore_ascii_case(&name)).unwrap()
}

fn convention(options: &Json) -> Convention {
    Convention::preset(options.get("convention").text()).unwrap()
}

/// Sets the listed fields, if the options of the case have them.
macro_rules! set {
    ($made:ident, $options:ident, $($field:ident: $value:expr),*) => {
        $(if !matches!($options.get(stringify!($field)), Json::Null) {
            $made.$field = ($value)($options.get(stringify!($field)));
        })*
    };
}

fn float(value: &Json) -> f32 {
    value.number() as f32
}

fn integer(value: &Json) -> u32 {
    value.number() as u32
}

fn tangent_options(options: &Json) -> TangentOptions {
    use Method::*;
    let mut made = TangentOptions::new(convention(options));
    set!(made, options,
        method: |name| choice(name, &[Mikktspace, Lengyel, Uniform, Angle, Area, Flat, Basis, Fast, Best]),
        ngons: |name| choice(name, &[Ngons::Triangulate, Ngons::Skip]),
        domain: |name| choice(name, &[OutputDomain::Corner, OutputDomain::Vertex]),
        frame: |name| choice(name, &[FrameShape::GramSchmidt, FrameShape::Symmetric]),
        pairing: |name| choice(name, &[Pairing::Reference, Pairing::Corrected]),
        angular_threshold_deg: float, refine: integer, normalize_normals: Json::is_true);
    made
}

fn normal_options<'a>(options: &Json, groups: &'a [u32]) -> NormalOptions<'a> {
    use NormalWeighting::*;
    let mut made = NormalOptions { smoothing_groups: groups, ..NormalOptions::new(convention(options)) };
    set!(made, options,
        weighting: |name| choice(name, &[Flat, Uniform, Angle, Area, AngleArea, Max, Best]),
        crease_angle_deg: float, denoise: float, weld_distance: float, refine: integer,
        smoothing_groups_are_masks: Json::is_true, weld_positions: Json::is_true);
    made
}

/// Outputs of a call: numbers by name, and reports as text, in which each field is "name: value".
#[derive(Default)]
struct Made(Vec<(&'static str, Vec<f64>)>, Vec<(&'static str, String)>);

impl Made {
    fn floats<const N: usize>(mut self, name: &'static str, values: &[[f32; N]]) -> Made {
        self.0.push((name, values.iter().flatten().map(|&value| f64::from(value)).collect()));
        self
    }
    fn list<T: Copy + Into<f64>>(mut self, name: &'static str, values: &[T]) -> Made {
        self.0.push((name, values.iter().map(|&value| value.into()).collect()));
        self
    }
    fn corners(self, values: &[Option<u32>]) -> Made {
        self.list("source_corners", &values.iter().map(|corner| corner.unwrap_or(u32::MAX)).collect::<Vec<_>>())
    }
    fn report(mut self, name: &'static str, report: &impl std::fmt::Debug) -> Made {
        self.1.push((name, format!("{report:?}").replace(" }", ",")));
        self
    }

    fn check(&self, name: &str, wanted: &Json, case: &str) {
        if let Some((_, got)) = self.0.iter().find(|(output, _)| *output == name) {
            let same = |(a, b): (&f64, &f32)| (*a as f32).to_bits() == b.to_bits();
            let wanted = wanted.floats();
            assert!(got.len() == wanted.len() && got.iter().zip(&wanted).all(same), "{case}: {name} is {got:?}");
        } else if let Some((_, report)) = self.1.iter().find(|(output, _)| *output == name) {
            let report = report.to_lowercase();
            for (field, value) in wanted.members() {
                // Debug shows whole floats as "0.0".
                let shown = [value.text().replace('_', ""), float(value).to_string(), format!("{:?}", float(value))];
                let is_there = shown.iter().any(|value| report.contains(&format!("{field}: {value},")));
                assert!(is_there, "{case}: {field} of {report}");
            }
        }
    }
}

fn run(call: &str, arrays: &Arrays, options: &Json) -> Result<Made, Error> {
    let (mesh, made, execution) = (arrays.mesh(), Made::default(), Execution::OneThread);
    match call {
        "tangents" => {
            let options = tangent_options(options);
            let full = tangents_full(&mesh, &options)?;
            let posed = Plan::new(&mesh, &options)?.evaluate(points::<3>(&arrays.positions), points::<3>(&arrays.normals), execution)?;
            assert_eq!(posed, full.tangents);
            let has: Vec<u8> = full.has_tangent.iter().map(|&has| has.into()).collect();
            let made = made.floats("tangents", &full.tangents).floats("bitangents", &full.bitangents).list("has_tangent", &has);
            Ok(made.list("magnitudes_s", &full.magnitudes_s).list("magnitudes_t", &full.magnitudes_t).report("report", &full.report))
        }
        "normals" => {
            let groups = options.get("smoothing_groups").integers();
            let options = normal_options(options, &groups);
            let mut out = normals(&mesh, &options)?;
            let report = normals_into(&mesh, &options, &mut out)?;
            Ok(made.floats("normals", &out).report("report", &report))
        }
        "sanitize" => {
            let mut tangents = rows::<4>(options.get("tangents"));
            let report = sanitize(&mesh, &mut tangents, options.get("orthogonalize_all").is_true(), execution)?;
            Ok(made.floats("tangents", &tangents).report("report", &report))
        }
        "make_indexed_frames" => {
            let mut given = IndexedFramesOptions::new(convention(options));
            given.tangents = tangent_options(options);
            set!(given, options, make_normals: Json::is_true, sanitize: Json::is_true);
            let frames = make_indexed_frames(&mesh, &given)?;
            let made = made.list("indices", &frames.indices).list("source_vertices", &frames.source_vertices);
            let made = made.corners(&frames.source_corners).floats("normals", &frames.normals).floats("tangents", &frames.tangents);
            let made = made.report("normals_report", &frames.normal_report).report("tangents_report", &frames.tangent_report);
            Ok(made.report("sanitize_report", &frames.sanitize_report))
        }
        "mend_winding" => {
            let mut given = WindingOptions::new(convention(options));
            set!(given, options, use_normals: Json::is_true, weld_positions: Json::is_true);
            let turned: Vec<u8> = fix_winding(&mesh, &given)?.into_iter().map(u8::from).collect();
            Ok(made.list("turned", &turned))
        }
        "triangulate" => {
            let triangles = triangulate(&mesh)?;
            Ok(made.list("corners", &triangles.corners).list("faces", &triangles.faces))
        }
        "split" => run_split(options),
        "pack" => {
            let formats = [
                FrameFormat::Frame32, FrameFormat::Frame48, FrameFormat::Frame64, FrameFormat::Oct32, FrameFormat::Qtangent64,
                FrameFormat::Snorm8Pair, FrameFormat::Snorm16Pair, FrameFormat::GltfSnorm8, FrameFormat::GltfSnorm16,
            ];
            let format = choice(options.get("format"), &formats);
            let bytes = pack_frames(&rows::<3>(options.get("normals")), &rows::<4>(options.get("tangents")), format)?;
            let (normals, tangents) = unpack_frames(&bytes, format)?;
            Ok(made.list("bytes", &bytes).floats("normals", &normals).floats("tangents", &tangents))
        }
        "convention" => Convention::preset(options.get("name").text()).map(|preset| made.report("convention", &preset)),
        other => panic!("{other}"),
    }
}

fn run_split(options: &Json) -> Result<Made, Error> {
    let tolerance = options.get("tolerance").number_or(0.0) as f32;
    let indices = options.get("indices").integers();
    let (ones, pairs): (Vec<_>, Vec<_>) = options.get("attributes").list().iter().partition(|one| one.get("size").number() == 1.0);
    let ones: Vec<_> = ones.iter().map(|one| rows::<1>(one.get("data"))).collect();
    let pairs: Vec<_> = pairs.iter().map(|one| rows::<2>(one.get("data"))).collect();
    let attributes = ones.iter().map(|rows| Attribute::new(rows)).chain(pairs.iter().map(|rows| Attribute::new(rows)));
    let attributes: Vec<_> = attributes.map(|attribute| attribute.tolerance(tolerance)).collect();
    let made = split(list(&indices), options.get("vertex_count").number() as usize, &attributes, Execution::OneThread)?;
    Ok(Made::default().list("indices", &made.indices).list("source_vertices", &made.source_vertices).corners(&made.source_corners))
}

#[test]
fn every_case_of_the_table() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/cases/arrays.json");
    let text = match std::fs::read_to_string(path) {
        Ok(text) => text,
        Err(_) => return eprintln!("skipped: {path} does not exist"),
    };
    let table = Json::parse(&text);
    for case in table.get("cases").list() {
        let (name, call, wanted) = (case.get("name").text(), case.get("call").text(), case.get("error"));
        if call == "plan_buffers" || call == "position_noise" {
            continue; // this crate has no such function
        }
        let arrays = Arrays::new(table.get("meshes").get(case.get("mesh").text()), case.get("change"));
        match run(call, &arrays, case.get("options")) {
            Ok(made) => {
                assert!(matches!(wanted, Json::Null), "{name}: no error");
                case.get("gives").members().iter().for_each(|(output, wanted)| made.check(output, wanted, name));
            }
            Err(error) => {
                assert!(format!("{:?}", error.code).eq_ignore_ascii_case(wanted.get("code").text()), "{name}: {error}");
                let element = error.element.map_or(-1.0, |element| element as f64);
                assert_eq!(element, wanted.get("element").number_or(element), "{name}: {error}");
            }
        }
    }
}
