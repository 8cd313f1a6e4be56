// SPDX-License-Identifier: MIT
//! Choices, with the numbers of the C API. Written by scripts/api.

/// How tangents are computed. `docs/concepts/methods/` has a page for each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Method {
    /// Bit for bit the result of the MikkTSpace reference implementation (Mikkelsen 2008), for triangles and quads.
    #[default]
    Mikktspace = 0,
    /// Sum of the unnormalised dP/du and dP/dv of the faces at a vertex index, Gram-Schmidt against N, sign from the
    /// bitangent (Lengyel 2001). Never splits: all corners of one vertex index get one tangent.
    Lengyel = 1,
    /// Weighted mean of unit face tangents in the groups of `Mikktspace` with corrected pairing. The weight of a
    /// face at a corner is 1, the corner angle, or the face's area.
    Uniform = 2,
    Angle = 3,
    Area = 4,
    /// The face's own dP/du at each of its corners, made orthogonal to that corner's N.
    Flat = 5,
    /// No UVs: an orthonormal basis from N alone (Duff et al. 2017). No such basis is continuous over a closed
    /// surface.
    Basis = 6,
    /// Two weighted sums of dP/du in the groups of `Angle`: one that is accurate on smooth surfaces (Max 1999), one
    /// that is robust on bevels and noise, mixed by the angle between them. More accurate than all weighted means,
    /// and hardly dearer than `Uniform`.
    Fast = 7,
    /// A quadratic map from UVs to the tangent plane, fitted to the edges around each vertex (polynomial preserving
    /// recovery, Zhang and Naga 2005), in the groups of `Angle`; where the fit is doubtful it becomes a robust mean.
    /// The error of its tangents falls with the square of the edge length, not with the length as that of all
    /// others.
    Best = 8,
}

/// How `mikktspace` finds neighbouring faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Pairing {
    /// With the reference's defect: the last bucket of its edge list is not sorted.
    #[default]
    Reference = 0,
    /// Without it: grouping no longer depends on the order of faces.
    Corrected = 1,
}

/// What happens to faces with more than 4 corners, which the MikkTSpace reference ignores.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Ngons {
    /// Cut as by triangulate(); results come back per corner of the n-gon.
    #[default]
    Triangulate = 0,
    /// As the reference: nothing is computed, outputs are 0.
    Skip = 1,
}

/// What one entry of the outputs belongs to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum OutputDomain {
    #[default]
    Corner = 0,
    /// One entry per vertex of the mesh: `lengyel` and `basis`, whose results are the same at all corners of a
    /// vertex. Every entry has the bits that the vertex's corners would get. Vertices that no used face names get 0.
    Vertex = 1,
}

/// Which orthonormal frame stands for dP/du and dP/dv, where UVs are sheared and the two are not perpendicular.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FrameShape {
    /// T is the direction of dP/du, and the shader's `sign * cross(N, T)` is off from dP/dv by the shear.
    #[default]
    GramSchmidt = 0,
    /// T is the bisector of dP/du and of the direction perpendicular to dP/dv (Löwdin 1950): both are off by half of
    /// the shear. Nearer to what the UVs say, but not what a baker or an engine with another tangent space expects.
    Symmetric = 1,
}

/// How much a face counts in the mean at one of its corners. e1, e2 are the edges at the corner, a the interior
/// angle between them (above 180 degrees where a polygon is reflex).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum NormalWeighting {
    /// No averaging: each corner gets its face's unit normal, as glTF asks where normals are missing.
    Flat = 0,
    /// 1: mean of unit face normals (Gouraud 1971).
    Uniform = 1,
    /// The face's area (|e1 x e2| / 2 for a triangle): large faces count more.
    Area = 2,
    /// a: independent of tessellation (Thuermer & Wuethrich 1998).
    #[default]
    Angle = 3,
    /// a * area.
    AngleArea = 4,
    /// sin(a) / (|e1| |e2|): exact on a sphere (Max 1999).
    Max = 5,
    /// No mean: the normal of a quadratic surface through the edges at the point. Where these look like noise or a
    /// bevel it is the mean of `AngleArea`, and in between a blend. The most accurate, and the slowest.
    Best = 6,
}

/// How a frame is stored, and how far N and T may be off (frameErrorBound), in degrees. Numbers are little-endian;
/// "word" is all bytes of one frame as one unsigned number. The enumerators' values are stable and never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FrameFormat {
    /// 4 bytes, 0.135: (rotation << 1) | mirrored. The rotation is a cell of a lattice in one of 24 charts.
    Frame32 = 0,
    /// 6 bytes, N 0.0037 and T 0.0042: ((i * 46339 + j) << 17) | (angle << 1) | mirrored; i, j on a warped
    /// octahedron, 65,536 angles.
    Frame48 = 1,
    /// 8 bytes, N 0.0001 and T 0.00015: i:21 | j:21 | angle:21 | mirrored:1 from the top; as frame48, finer.
    Frame64 = 2,
    /// 4 bytes, N 0.15 and T 0.165: i:10 | j:10 | angle:11 | mirrored:1 from the top; the cheapest to decode of the
    /// codes of 4 bytes.
    Oct32 = 3,
    /// 8 bytes, 0.004: the quaternion x, y, z, w of the rotation (T, N x T, N) as snorm16; w is never 0, its sign is
    /// the sign.
    Qtangent64 = 4,
    /// 8 bytes, 0.391: T.xyz, 127, N.xyz, sign as snorm8: the order of Unreal's TangentX and TangentZ.
    Snorm8Pair = 5,
    /// 16 bytes, 0.00152: the same as snorm16.
    Snorm16Pair = 6,
    /// 7 bytes, 0.391: TANGENT (4 snorm8), then NORMAL (3 snorm8), as KHR_mesh_quantization stores them, without
    /// padding.
    GltfSnorm8 = 7,
    /// 14 bytes, 0.00152: the same as snorm16.
    GltfSnorm16 = 8,
}

/// Position of v = 0 in the texture. It decides every sign, so it has no default.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VAxis {
    /// v = 0 is the bottom row of the image (OpenGL, Blender, Unity).
    Up = 1,
    /// v = 0 is the top row of the image (glTF, DirectX, Unreal, Godot).
    Down = 2,
}

/// Meaning of a large green value in a normal map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Green {
    /// Towards the top row of the image ("OpenGL", +Y).
    Up = 0,
    /// Towards the bottom row ("DirectX", -Y).
    Down = 1,
}

/// Whether the stored sign is the one of `B = sign * cross(N, T)` or its negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StoredSign {
    AsIs = 0,
    Negated = 1,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Handedness {
    Right = 0,
    Left = 1,
}

/// Order of a face's vertices as seen from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Winding {
    CounterClockwise = 0,
    Clockwise = 1,
}
