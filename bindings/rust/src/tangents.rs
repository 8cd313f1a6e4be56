// SPDX-License-Identifier: MIT
use crate::enums::{Method, OutputDomain};
use crate::error::{checked, mismatch, Error};
use crate::mesh::{Mesh, Points};
use crate::options::Execution;
use crate::structs::{TangentOptions, TangentReport};
use crate::sys;
use std::mem::{size_of, MaybeUninit};
use std::ptr::null_mut;

impl TangentOptions {
    pub(crate) fn raw(&self) -> sys::TangentOptions {
        let mut raw = self.fields();
        // The C API rejects zero for both as uninitialized; no method uses both.
        if raw.angular_threshold_deg == 0.0 && raw.refine == 0 {
            if self.method == Method::Best {
                raw.angular_threshold_deg = 180.0;
            } else {
                raw.refine = 1;
            }
        }
        raw
    }

    fn count(&self, mesh: &Mesh<'_>) -> usize {
        match self.domain {
            OutputDomain::Corner => mesh.corner_count(),
            OutputDomain::Vertex => mesh.vertex_count(),
        }
    }
}

/// All outputs of a method, one entry per corner (or vertex).
#[derive(Clone, Debug, PartialEq)]
pub struct Tangents {
    /// Unit tangent and sign.
    pub tangents: Vec<[f32; 4]>,
    /// Unit direction of dP/dv; in general different from cross(N, T).
    pub bitangents: Vec<[f32; 3]>,
    /// Mean length of dP/du; 1 for methods that do not compute it.
    pub magnitudes_s: Vec<f32>,
    /// Mean length of dP/dv; 1 for methods that do not compute it.
    pub magnitudes_t: Vec<f32>,
    /// False if no face contributes to the entry: the method's default was written, or the entry is zero (corners of
    /// skipped faces, unused vertices).
    pub has_tangent: Vec<bool>,
    /// Counts of faces, corners and defects of the input.
    pub report: TangentReport,
}

impl Tangents {
    fn empty(count: usize) -> Self {
        Tangents {
            tangents: vec![[0.0; 4]; count],
            bitangents: vec![[0.0; 3]; count],
            magnitudes_s: vec![0.0; count],
            magnitudes_t: vec![0.0; count],
            has_tangent: vec![false; count],
            report: TangentReport::default(),
        }
    }

    fn output(&mut self) -> sys::TangentOutput {
        // A bool is a byte of 0 or 1, and the library writes only these values.
        let has_tangent = &mut self.has_tangent;
        sys::TangentOutput {
            bitangents: span(&mut self.bitangents),
            magnitudes_s: span_of_floats(&mut self.magnitudes_s),
            magnitudes_t: span_of_floats(&mut self.magnitudes_t),
            has_tangent: sys::ByteSpan { data: has_tangent.as_mut_ptr().cast(), count: has_tangent.len(), stride_bytes: 0 },
            ..tangents_only(&mut self.tangents)
        }
    }
}

pub(crate) fn span<const N: usize>(points: &mut [[f32; N]]) -> sys::Span {
    sys::Span { data: points.as_mut_ptr().cast(), count: points.len(), stride_bytes: 0 }
}

fn span_of_floats(floats: &mut [f32]) -> sys::Span {
    sys::Span { data: floats.as_mut_ptr(), count: floats.len(), stride_bytes: 0 }
}

fn no_span() -> sys::Span {
    sys::Span { data: null_mut(), count: 0, stride_bytes: 0 }
}

fn tangents_only(tangents: &mut [[f32; 4]]) -> sys::TangentOutput {
    sys::TangentOutput {
        struct_size: size_of::<sys::TangentOutput>() as u32,
        reserved: 0,
        tangents: span(tangents),
        bitangents: no_span(),
        magnitudes_s: no_span(),
        magnitudes_t: no_span(),
        has_tangent: sys::ByteSpan { data: null_mut(), count: 0, stride_bytes: 0 },
    }
}

/// Returns a zeroed report with its size set.
pub(crate) fn new_report<Report>(set_size: impl FnOnce(&mut Report, u32)) -> Report {
    // SAFETY: reports consist of numbers.
    let mut report = unsafe { MaybeUninit::<Report>::zeroed().assume_init() };
    set_size(&mut report, size_of::<Report>() as u32);
    report
}

fn tangent_report() -> sys::TangentReport {
    new_report(|report: &mut sys::TangentReport, size| report.struct_size = size)
}

fn generate(mesh: &Mesh<'_>, options: &TangentOptions, out: &sys::TangentOutput) -> Result<TangentReport, Error> {
    let mut report = tangent_report();
    let execution = options.execution.raw();
    // SAFETY: all pointers refer to slices that outlive the call, with their lengths.
    checked(|error| unsafe {
        sys::tspace_generateTangents(&mesh.raw(), &options.raw(), out, &execution, &mut report, error)
    })?;
    Ok(TangentReport::of(&report))
}

/// Computes one tangent per corner, with its sign: `[x, y, z, sign]`, `B = sign * cross(N, T)`.
///
/// The mesh needs normals, and UVs for all methods except [`Method::Basis`]. Do not write results through the old index
/// list, since corners of a vertex can differ: [`make_indexed_frames`](crate::make_indexed_frames) or
/// [`split`](crate::split) create a new one.
pub fn tangents(mesh: &Mesh<'_>, options: &TangentOptions) -> Result<Vec<[f32; 4]>, Error> {
    mesh.validate()?;
    let mut made = vec![[0.0; 4]; options.count(mesh)];
    tangents_into(mesh, options, &mut made)?;
    Ok(made)
}

/// Computes the same tangents as [`tangents`], writes them to the caller's slice, and returns counts.
///
/// Additional error: `CountMismatch` if the length of `out` differs from the number of corners.
pub fn tangents_into(mesh: &Mesh<'_>, options: &TangentOptions, out: &mut [[f32; 4]]) -> Result<TangentReport, Error> {
    generate(mesh, options, &tangents_only(out))
}

/// Like [`tangents`], with bitangents, magnitudes, counts, and a mask of entries to which a face contributes.
pub fn tangents_full(mesh: &Mesh<'_>, options: &TangentOptions) -> Result<Tangents, Error> {
    mesh.validate()?;
    let mut made = Tangents::empty(options.count(mesh));
    made.report = generate(mesh, options, &made.output())?;
    Ok(made)
}

/// Data of a mesh that does not change while it deforms: adjacency, groups, splits, UVs. Borrows nothing, and may be
/// evaluated by many threads concurrently.
///
/// ```
/// # fn main() -> Result<(), tspace::Error> {
/// # let positions = [[0.0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
/// # let (normals, uvs) = ([[0.0f32, 0.0, 1.0]; 3], [[0.0f32, 0.0], [1.0, 0.0], [0.0, 1.0]]);
/// use tspace::{Convention, Execution, Mesh, Plan, TangentOptions};
/// let mesh = Mesh::new(&positions).normals(&normals).uvs(&uvs);
/// let plan = Plan::new(&mesh, &TangentOptions::new(Convention::preset("gltf")?))?;
/// let posed = plan.evaluate(&positions, &normals, Execution::OneThread)?;
/// assert_eq!(posed.len(), 3);
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Plan {
    raw: *mut sys::TangentPlan,
    output_count: usize,
}

// SAFETY: a plan is immutable, and the library allows any thread to evaluate and destroy it.
unsafe impl Send for Plan {}
// SAFETY: a plan is immutable, and the library allows any thread to evaluate and destroy it.
unsafe impl Sync for Plan {}

impl Plan {
    /// Creates a plan; inputs and errors like [`tangents`].
    pub fn new(mesh: &Mesh<'_>, options: &TangentOptions) -> Result<Plan, Error> {
        let mut plan = Plan { raw: null_mut(), output_count: 0 };
        let execution = options.execution.raw();
        // SAFETY: pointers refer to slices that outlive the call; the plan is null after an error.
        checked(|error| unsafe {
            sys::tspace_planTangents(&mesh.raw(), &options.raw(), &execution, &mut plan.raw, error)
        })?;
        plan.output_count = plan.info()?.output_count;
        Ok(plan)
    }

    /// Returns the number of tangents of a pose.
    pub fn output_count(&self) -> usize {
        self.output_count
    }

    /// Returns the memory of the plan in bytes.
    pub fn memory_bytes(&self) -> usize {
        self.info().map_or(0, |info| info.memory_bytes)
    }

    /// Computes tangents for a pose. `positions` and `normals` must have as many entries as those of the mesh.
    pub fn evaluate<'a>(
        &self,
        positions: impl Into<Points<'a, 3>>,
        normals: impl Into<Points<'a, 3>>,
        execution: Execution,
    ) -> Result<Vec<[f32; 4]>, Error> {
        let mut made = vec![[0.0; 4]; self.output_count];
        self.evaluate_into(positions, normals, execution, &mut made)?;
        Ok(made)
    }

    /// Computes the same tangents as [`Plan::evaluate`], writes them to the caller's slice of [`Plan::output_count`]
    /// entries, and returns counts.
    pub fn evaluate_into<'a>(
        &self,
        positions: impl Into<Points<'a, 3>>,
        normals: impl Into<Points<'a, 3>>,
        execution: Execution,
        out: &mut [[f32; 4]],
    ) -> Result<TangentReport, Error> {
        if out.len() != self.output_count {
            return Err(mismatch(format!("out has {} entries, but the plan has {} results", out.len(), self.output_count)));
        }
        let out = tangents_only(out);
        let pose = sys::Pose {
            struct_size: size_of::<sys::Pose>() as u32,
            reserved: 0,
            positions: positions.into().span(),
            normals: normals.into().span(),
        };
        let (mut report, execution) = (tangent_report(), execution.raw());
        // SAFETY: the plan exists, and all pointers refer to slices that outlive the call, with their lengths.
        checked(|error| unsafe {
            sys::tspace_evaluateTangents(self.raw, &pose, &out, &execution, &mut report, error)
        })?;
        Ok(TangentReport::of(&report))
    }

    fn info(&self) -> Result<sys::TangentPlanInfo, Error> {
        let mut info = new_report(|info: &mut sys::TangentPlanInfo, size| info.struct_size = size);
        // SAFETY: the plan exists.
        checked(|error| unsafe { sys::tspace_describeTangentPlan(self.raw, &mut info, error) })?;
        Ok(info)
    }
}

impl Drop for Plan {
    fn drop(&mut self) {
        // SAFETY: the plan is not used after this; null is allowed.
        unsafe { sys::tspace_destroyTangentPlan(self.raw) }
    }
}
