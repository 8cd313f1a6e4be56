// SPDX-License-Identifier: MIT
use crate::enums::ErrorCode;
use crate::error::{checked, mismatch, Error};
use crate::sys;
use std::marker::PhantomData;
use std::mem::size_of;
use std::os::raw::c_void;
use std::ptr::null;

/// Points of `N` floats, contiguous or interleaved with other vertex data. Borrowed; created from `&[[f32; N]]` by
/// `into()`.
#[derive(Clone, Copy, Debug)]
pub struct Points<'a, const N: usize> {
    data: *const f32,
    count: usize,
    stride_bytes: usize,
    borrowed: PhantomData<&'a [f32]>,
}

// SAFETY: the struct is a shared slice of floats.
unsafe impl<const N: usize> Send for Points<'_, N> {}
// SAFETY: the struct is a shared slice of floats.
unsafe impl<const N: usize> Sync for Points<'_, N> {}

impl<'a, const N: usize> Points<'a, N> {
    /// Creates points from the floats at `first`, `first + stride`, ..., as in interleaved vertices. Incomplete points
    /// at the end are ignored.
    ///
    /// Errors: `StrideTooSmall` if `stride` is less than `N`, `CountMismatch` if `first` is beyond the end.
    pub fn interleaved(floats: &'a [f32], first: usize, stride: usize) -> Result<Self, Error> {
        if stride < N {
            let message = format!("the stride is {stride} floats, but each element has {N}");
            return Err(Error { code: ErrorCode::StrideTooSmall, element: None, message });
        }
        let rest = match floats.get(first..) {
            Some(rest) => rest,
            None => return Err(mismatch(format!("first is {first}, but the slice has only {} floats", floats.len()))),
        };
        let count = if rest.len() < N { 0 } else { (rest.len() - N) / stride + 1 };
        Ok(Points { data: rest.as_ptr(), count, stride_bytes: stride * size_of::<f32>(), borrowed: PhantomData })
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Returns whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    pub(crate) fn none() -> Self {
        Points { data: null(), count: 0, stride_bytes: 0, borrowed: PhantomData }
    }

    pub(crate) fn span(&self) -> sys::ConstSpan {
        let data = if self.count == 0 { null() } else { self.data };
        sys::ConstSpan { data, count: self.count, stride_bytes: self.stride_bytes }
    }
}

impl<'a, const N: usize> From<&'a [[f32; N]]> for Points<'a, N> {
    fn from(points: &'a [[f32; N]]) -> Self {
        Points { data: points.as_ptr().cast(), count: points.len(), stride_bytes: 0, borrowed: PhantomData }
    }
}

impl<'a, const N: usize> From<&'a Vec<[f32; N]>> for Points<'a, N> {
    fn from(points: &'a Vec<[f32; N]>) -> Self {
        points.as_slice().into()
    }
}

impl<'a, const N: usize, const M: usize> From<&'a [[f32; N]; M]> for Points<'a, N> {
    fn from(points: &'a [[f32; N]; M]) -> Self {
        points.as_slice().into()
    }
}

/// The vertex of each corner. Created from `&[u32]` and `&[u16]` by `into()`.
#[derive(Clone, Copy, Debug)]
pub enum Indices<'a> {
    /// Corner c uses vertex c. For lists of normals and UVs: use the mesh's indices.
    None,
    /// 16 bit each.
    U16(&'a [u16]),
    /// 32 bit each.
    U32(&'a [u32]),
    /// Only for lists of normals and UVs: one entry per corner.
    Corners,
}

impl Indices<'_> {
    pub(crate) fn raw(&self) -> sys::Indices {
        fn some<T>(list: &[T], kind: u32) -> sys::Indices {
            sys::Indices { data: list.as_ptr().cast::<c_void>(), count: list.len(), kind }
        }
        match self {
            Indices::None => sys::Indices { data: null(), count: 0, kind: sys::INDEX_NONE },
            Indices::U16(list) => some(list, sys::INDEX_U16),
            Indices::U32(list) => some(list, sys::INDEX_U32),
            Indices::Corners => sys::Indices { data: null(), count: 0, kind: sys::INDEX_CORNERS },
        }
    }
}

macro_rules! indices_from {
    ($type:ty, $variant:ident) => {
        impl<'a> From<&'a [$type]> for Indices<'a> {
            fn from(list: &'a [$type]) -> Self {
                Indices::$variant(list)
            }
        }
        impl<'a> From<&'a Vec<$type>> for Indices<'a> {
            fn from(list: &'a Vec<$type>) -> Self {
                Indices::$variant(list)
            }
        }
        impl<'a, const N: usize> From<&'a [$type; N]> for Indices<'a> {
            fn from(list: &'a [$type; N]) -> Self {
                Indices::$variant(list)
            }
        }
    };
}
indices_from!(u16, U16);
indices_from!(u32, U32);

/// Mesh that borrows its arrays. Positions are always required; each function documents what else it needs.
///
/// ```
/// # let (positions, normals, uvs) = ([[0.0f32; 3]; 4], [[0.0f32, 0.0, 1.0]; 4], [[0.0f32; 2]; 4]);
/// let mesh = tspace::Mesh::new(&positions).normals(&normals).uvs(&uvs).indices(&[0u16, 1, 2, 3]).face_size(4);
/// assert_eq!(mesh.corner_count(), 4);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    pub(crate) positions: Points<'a, 3>,
    normals: Points<'a, 3>,
    uvs: Points<'a, 2>,
    indices: Indices<'a>,
    normal_indices: Indices<'a>,
    uv_indices: Indices<'a>,
    face_size: u32,
    face_sizes: &'a [u32],
}

impl<'a> Mesh<'a> {
    /// Creates a mesh of triangles without indices: corner c is vertex c.
    pub fn new(positions: impl Into<Points<'a, 3>>) -> Self {
        Mesh {
            positions: positions.into(),
            normals: Points::none(),
            uvs: Points::none(),
            indices: Indices::None,
            normal_indices: Indices::None,
            uv_indices: Indices::None,
            face_size: 3,
            face_sizes: &[],
        }
    }

    /// Sets one normal per vertex, used as given (never normalized).
    pub fn normals(mut self, normals: impl Into<Points<'a, 3>>) -> Self {
        self.normals = normals.into();
        self
    }

    /// Sets one UV per vertex.
    pub fn uvs(mut self, uvs: impl Into<Points<'a, 2>>) -> Self {
        self.uvs = uvs.into();
        self
    }

    /// Sets the vertex of each corner.
    pub fn indices(mut self, indices: impl Into<Indices<'a>>) -> Self {
        self.indices = indices.into();
        self
    }

    /// Sets the entry of `normals` for each corner. `normals` may then have any length, as in FBX, USD and OBJ.
    pub fn normal_indices(mut self, indices: impl Into<Indices<'a>>) -> Self {
        self.normal_indices = indices.into();
        self
    }

    /// Sets the entry of `uvs` for each corner.
    pub fn uv_indices(mut self, indices: impl Into<Indices<'a>>) -> Self {
        self.uv_indices = indices.into();
        self
    }

    /// Sets the number of corners of every face. Default: 3.
    pub fn face_size(mut self, corners: u32) -> Self {
        self.face_size = corners;
        self
    }

    /// Sets the number of corners of each face, if faces have different sizes. Faces with fewer than 3 corners are
    /// ignored.
    pub fn face_sizes(mut self, corners: &'a [u32]) -> Self {
        self.face_sizes = corners;
        self
    }

    /// Returns the number of corners of the mesh, which is the length of results.
    pub fn corner_count(&self) -> usize {
        // SAFETY: raw() refers to slices that live as long as self.
        unsafe { sys::tspace_cornerCount(&self.raw()) }
    }

    /// Returns the number of faces of the mesh.
    pub fn face_count(&self) -> usize {
        // SAFETY: raw() refers to slices that live as long as self.
        unsafe { sys::tspace_faceCount(&self.raw()) }
    }

    /// Checks lengths and all indices. Every function that takes a mesh calls this first.
    pub fn validate(&self) -> Result<(), Error> {
        // SAFETY: raw() refers to slices that live as long as self.
        checked(|error| unsafe { sys::tspace_validate(&self.raw(), error) })
    }

    pub(crate) fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    pub(crate) fn raw(&self) -> sys::Mesh {
        sys::Mesh {
            struct_size: size_of::<sys::Mesh>() as u32,
            face_size: self.face_size,
            positions: self.positions.span(),
            normals: self.normals.span(),
            uvs: self.uvs.span(),
            indices: self.indices.raw(),
            face_sizes: if self.face_sizes.is_empty() { null() } else { self.face_sizes.as_ptr() },
            face_count: self.face_sizes.len(),
            normal_indices: self.normal_indices.raw(),
            uv_indices: self.uv_indices.raw(),
        }
    }
}
