// SPDX-License-Identifier: MIT
use crate::error::{checked, mismatch, Error};
use crate::mesh::{Indices, Mesh};
use crate::options::{prepared, Convention, Execution};
use crate::structs::{NormalOptions, NormalReport, SanitizeReport, TangentOptions, TangentReport};
use crate::sys;
use crate::tangents::{new_report, span};
use std::ptr::{null, null_mut};

/// Repairs in place the tangents that contain NaN or infinity, are zero, do not have unit length, are parallel to N, or
/// have different signs within a face.
/// Valid tangents keep all bits, unless `orthogonalize_all`. The mesh needs normals.
pub fn sanitize(
    mesh: &Mesh<'_>,
    tangents: &mut [[f32; 4]],
    orthogonalize_all: bool,
    execution: Execution,
) -> Result<SanitizeReport, Error> {
    let mut options = prepared(sys::tspace_initSanitizeOptions);
    options.orthogonalize_all = orthogonalize_all.into();
    let mut report = new_report(|report: &mut sys::SanitizeReport, size| report.struct_size = size);
    // SAFETY: all pointers refer to slices that outlive the call, with their lengths.
    checked(|error| unsafe {
        sys::tspace_sanitizeTangents(&mesh.raw(), &options, span(tangents), &execution.raw(), &mut report, error)
    })?;
    Ok(SanitizeReport::of(&report))
}

/// Values per corner, `N` floats each, by which [`split`] distinguishes vertices.
#[derive(Clone, Copy, Debug)]
pub struct Attribute<'a> {
    floats: &'a [f32],
    components: usize,
    tolerance: f32,
}

impl<'a> Attribute<'a> {
    /// Creates an attribute whose values are equal only if all bits are equal.
    pub fn new<const N: usize>(values: &'a [[f32; N]]) -> Self {
        // SAFETY: arrays of arrays of floats are contiguous floats.
        let floats = unsafe { std::slice::from_raw_parts(values.as_ptr().cast::<f32>(), values.len() * N) };
        Attribute { floats, components: N, tolerance: 0.0 }
    }

    /// Sets the maximum difference of each component between equal values.
    pub fn tolerance(mut self, tolerance: f32) -> Self {
        self.tolerance = tolerance;
        self
    }

    fn corner_count(&self) -> usize {
        self.floats.len() / self.components.max(1)
    }

    fn raw(&self) -> sys::CornerAttribute {
        sys::CornerAttribute {
            data: self.floats.as_ptr(),
            stride_bytes: 0,
            component_count: self.components as u32,
            tolerance: self.tolerance,
        }
    }
}

/// The new index buffer, and the source of each new vertex.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Split {
    /// The new vertex of each corner.
    pub indices: Vec<u32>,
    /// The old vertex that each new one copies; use it to gather vertex attributes.
    pub source_vertices: Vec<u32>,
    /// A corner whose values each new vertex has; `None` if no corner uses it.
    pub source_corners: Vec<Option<u32>>,
}

/// Returns a copy of numbers that the library allocated.
///
/// # Safety
/// `data` points to `count` numbers, or `count` is 0.
unsafe fn copied<T: Clone>(data: *const T, count: usize) -> Vec<T> {
    if count == 0 {
        Vec::new()
    } else {
        std::slice::from_raw_parts(data, count).to_vec()
    }
}

fn corners(list: Vec<u32>) -> Vec<Option<u32>> {
    list.into_iter().map(|corner| if corner == u32::MAX { None } else { Some(corner) }).collect()
}

/// Splits vertices whose corners differ in any attribute. Old vertices keep their positions, copies are appended.
pub fn split<'a>(
    indices: impl Into<Indices<'a>>,
    vertex_count: usize,
    attributes: &[Attribute<'_>],
    execution: Execution,
) -> Result<Split, Error> {
    let indices = indices.into().raw();
    let corner_count = attributes.first().map_or(indices.count, Attribute::corner_count);
    if let Some(other) = attributes.iter().find(|attribute| attribute.corner_count() != corner_count) {
        let message = format!("the attributes have different numbers of corners: {} and {}", corner_count, other.corner_count());
        return Err(mismatch(message));
    }
    let raw: Vec<_> = attributes.iter().map(Attribute::raw).collect();
    let mut made = null_mut();
    // SAFETY: all pointers refer to slices that outlive the call; the library's result is copied, then freed.
    unsafe {
        checked(|error| {
            sys::tspace_splitVertices(
                &indices,
                vertex_count,
                corner_count,
                raw.as_ptr(),
                raw.len(),
                &execution.raw(),
                &mut made,
                error,
            )
        })?;
        let split = Split {
            indices: copied((*made).indices, (*made).corner_count),
            source_vertices: copied((*made).source_vertices, (*made).vertex_count),
            source_corners: corners(copied((*made).source_corners, (*made).vertex_count)),
        };
        sys::tspace_destroySplitResult(made);
        Ok(split)
    }
}

/// Triangles of a polygon mesh.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Triangles {
    /// Three corners of the mesh per triangle, with the original winding.
    pub corners: Vec<u32>,
    /// The original face of each triangle.
    pub faces: Vec<u32>,
}

/// Splits every face with 4 or more corners into triangles: quads along the diagonal that MikkTSpace chooses, n-gons by
/// ear clipping.
pub fn triangulate(mesh: &Mesh<'_>) -> Result<Triangles, Error> {
    let mut made = null_mut();
    // SAFETY: all pointers refer to slices that outlive the call; the library's result is copied, then freed.
    unsafe {
        checked(|error| sys::tspace_triangulate(&mesh.raw(), &mut made, error))?;
        let triangles = Triangles {
            corners: copied((*made).corners, 3 * (*made).triangle_count),
            faces: copied((*made).faces, (*made).triangle_count),
        };
        sys::tspace_destroyTriangulation(made);
        Ok(triangles)
    }
}

/// Options for [`make_indexed_frames`]. [`IndexedFramesOptions::new`] sets the defaults.
#[derive(Clone, Copy, Debug)]
pub struct IndexedFramesOptions<'a> {
    /// Options for tangents; its execution applies to all steps.
    pub tangents: TangentOptions,
    /// Options for computed normals. Its convention is ignored: that of `tangents` is used.
    pub normals: NormalOptions<'a>,
    /// Recompute normals even if the mesh has them; missing normals are always computed.
    pub make_normals: bool,
    /// Repair invalid tangents. Default: true.
    pub sanitize: bool,
    /// Also make every valid tangent unit and orthogonal to N.
    pub orthogonalize_all: bool,
    /// Further attributes per corner that must not be merged.
    pub keep_apart: &'a [Attribute<'a>],
}

impl IndexedFramesOptions<'_> {
    /// Creates options with the library's defaults.
    pub fn new(convention: Convention) -> Self {
        let raw = prepared(sys::tspace_initIndexedFramesOptions);
        IndexedFramesOptions {
            tangents: TangentOptions::new(convention),
            normals: NormalOptions::new(convention),
            make_normals: raw.make_normals != 0,
            sanitize: raw.sanitize != 0,
            orthogonalize_all: raw.orthogonalize_all != 0,
            keep_apart: &[],
        }
    }
}

/// Indexed mesh with the same faces as the input.
#[derive(Clone, Debug, PartialEq)]
pub struct IndexedFrames {
    /// The new vertex of each corner.
    pub indices: Vec<u32>,
    /// The old vertex that each new vertex copies.
    pub source_vertices: Vec<u32>,
    /// The first corner that uses each new vertex; `None` if no corner does.
    pub source_corners: Vec<Option<u32>>,
    /// One normal per new vertex.
    pub normals: Vec<[f32; 3]>,
    /// One per new vertex: unit tangent and sign.
    pub tangents: Vec<[f32; 4]>,
    /// Set if normals were computed.
    pub normal_report: Option<NormalReport>,
    /// Counts of tangents.
    pub tangent_report: TangentReport,
    /// Counts of repaired values.
    pub sanitize_report: SanitizeReport,
}

/// Computes missing normals and tangents, repairs invalid tangents, and splits vertices whose corners differ.
pub fn make_indexed_frames(mesh: &Mesh<'_>, options: &IndexedFramesOptions<'_>) -> Result<IndexedFrames, Error> {
    let corner_count = mesh.corner_count();
    if let Some(wrong) = options.keep_apart.iter().find(|attribute| attribute.corner_count() != corner_count) {
        let message = format!("keep_apart has {} entries, but the number of corners is {corner_count}", wrong.corner_count());
        return Err(mismatch(message));
    }
    let (tangents, normals) = (options.tangents.raw(), options.normals.raw());
    let keep_apart: Vec<_> = options.keep_apart.iter().map(Attribute::raw).collect();
    let mut raw = prepared(sys::tspace_initIndexedFramesOptions);
    raw.make_normals = options.make_normals.into();
    raw.sanitize = options.sanitize.into();
    raw.orthogonalize_all = options.orthogonalize_all.into();
    raw.tangents = &tangents;
    raw.normals = &normals;
    raw.keep_apart = if keep_apart.is_empty() { null() } else { keep_apart.as_ptr() };
    raw.keep_apart_count = keep_apart.len();
    let execution = options.tangents.execution.raw();
    let mut made = null_mut();
    // SAFETY: all pointers refer to slices that outlive the call; the library's result is copied, then freed.
    unsafe {
        checked(|error| sys::tspace_makeIndexedFrames(&mesh.raw(), &raw, &execution, &mut made, error))?;
        let frames = &*made;
        let count = frames.vertex_count;
        let result = IndexedFrames {
            indices: copied(frames.indices, frames.corner_count),
            source_vertices: copied(frames.source_vertices, count),
            source_corners: corners(copied(frames.source_corners, count)),
            normals: copied(frames.normals.cast(), count),
            tangents: copied(frames.tangents.cast(), count),
            normal_report: frames.normal_report.as_ref().map(NormalReport::of),
            tangent_report: frames.tangent_report.as_ref().map(TangentReport::of).unwrap_or_default(),
            sanitize_report: frames.sanitize_report.as_ref().map(SanitizeReport::of).unwrap_or_default(),
        };
        sys::tspace_destroyIndexedFrames(made);
        Ok(result)
    }
}
