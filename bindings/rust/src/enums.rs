// SPDX-License-Identifier: MIT
//! Choices, with the numbers of the C API.

// Everything below is written by scripts/api.

/// Method of computing tangents. `docs/concepts/methods/` has a page for each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Method {
    /// Bit-identical to the MikkTSpace reference implementation (Mikkelsen 2008), for triangles and quads.
    #[default]
    Mikktspace = 0,
    /// Sum of the unnormalized dP/du and dP/dv of the faces at a vertex index, Gram-Schmidt against N, sign from the
    /// bitangent (Lengyel 2001). Never splits: all corners of a vertex index get the same tangent.
    Lengyel = 1,
    /// Weighted mean of unit face tangents in the groups of `Mikktspace` with corrected pairing. The weight of a
    /// face at a corner is 1 (`Uniform`), the corner angle (`Angle`), or the face's area (`Area`).
    Uniform = 2,
    Angle = 3,
    Area = 4,
    /// The face's own dP/du at each of its corners, orthogonalized against that corner's N.
    Flat = 5,
    /// Orthonormal basis from N, without UVs (Duff et al. 2017). No such basis is continuous over a closed surface.
    Basis = 6,
    /// Two weighted sums of dP/du in the groups of `Angle`: one that is accurate on smooth surfaces (Max 1999), and
    /// one that is robust on bevels and noise, blended by the angle between them. More accurate than all weighted
    /// means, at little more cost than `Uniform`.
    Fast = 7,
    /// Quadratic map from UVs to the tangent plane, fitted to the edges around each vertex (polynomial preserving
    /// recovery, Zhang and Naga 2005), in the groups of `Angle`; if the fit is unreliable, a robust mean. The error
    /// of its tangents decreases with the square of the edge length; the error of all other methods decreases
    /// linearly.
    Best = 8,
}

/// Rule by which `mikktspace` pairs neighboring faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Pairing {
    /// With the reference's bug: the last bucket of its edge list is not sorted.
    #[default]
    Reference = 0,
    /// Without the bug: grouping does not depend on the order of faces.
    Corrected = 1,
}

/// Treatment of faces with more than 4 corners, which the MikkTSpace reference ignores.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Ngons {
    /// Triangulated by triangulate(); results are per corner of the n-gon.
    #[default]
    Triangulate = 0,
    /// Skipped, as in the reference: all outputs are 0.
    Skip = 1,
}

/// Element type of the outputs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum OutputDomain {
    #[default]
    Corner = 0,
    /// One entry per vertex of the mesh: for `lengyel` and `basis`, whose results are equal at all corners of a
    /// vertex. Each entry is bit-identical to the result at every corner of the vertex. Vertices that no used face
    /// refers to get 0.
    Vertex = 1,
}

/// Orthonormal frame that replaces dP/du and dP/dv where sheared UVs make them non-perpendicular.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FrameShape {
    /// T is the direction of dP/du; the shader's `sign * cross(N, T)` deviates from dP/dv by the shear.
    #[default]
    GramSchmidt = 0,
    /// T is the bisector of dP/du and the direction perpendicular to dP/dv (Löwdin 1950): both deviate by half of
    /// the shear. Closer to the UVs, but not what bakers and engines with another tangent space expect.
    Symmetric = 1,
}

/// Weight of a face in the mean at one of its corners. e1 and e2 are the edges at the corner, a is the interior
/// angle between them (above 180 degrees at reflex corners of a polygon).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum NormalWeighting {
    /// No averaging: each corner gets its face's unit normal, as glTF requires for missing normals.
    Flat = 0,
    /// 1: mean of unit face normals (Gouraud 1971).
    Uniform = 1,
    /// Area of the face (|e1 x e2| / 2 for a triangle).
    Area = 2,
    /// a: independent of the tessellation (Thuermer & Wuethrich 1998).
    #[default]
    Angle = 3,
    /// a * area.
    AngleArea = 4,
    /// sin(a) / (|e1| |e2|): exact on a sphere (Max 1999).
    Max = 5,
    /// Normal of a quadratic surface fitted to the edges at the point. If the edges look like noise or a bevel, the
    /// mean of `AngleArea`; in between, a blend of both. The most accurate and the slowest.
    Best = 6,
}

/// Storage format of a frame, with the maximum error of N and T (frameErrorBound) in degrees. Numbers are
/// little-endian; "word" means all bytes of one frame as one unsigned number. The enumerators' values are stable and
/// never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FrameFormat {
    /// 4 bytes, 0.135: (rotation << 1) | mirrored. The rotation is a cell of a lattice in one of 24 charts.
    Frame32 = 0,
    /// 6 bytes, N 0.0037 and T 0.0042: ((i * 46339 + j) << 17) | (angle << 1) | mirrored; i, j on a warped
    /// octahedron, 65,536 angles.
    Frame48 = 1,
    /// 8 bytes, N 0.0001 and T 0.00015: i:21 | j:21 | angle:21 | mirrored:1 from the top; like frame48, but finer.
    Frame64 = 2,
    /// 4 bytes, N 0.15 and T 0.165: i:10 | j:10 | angle:11 | mirrored:1 from the top; the 4-byte format that is
    /// cheapest to decode.
    Oct32 = 3,
    /// 8 bytes, 0.004: the quaternion x, y, z, w of the rotation (T, N x T, N) as snorm16; w is never 0, and its
    /// sign is the sign of the frame.
    Qtangent64 = 4,
    /// 8 bytes, 0.391: T.xyz, 127, N.xyz, sign as snorm8: the order of Unreal's TangentX and TangentZ.
    Snorm8Pair = 5,
    /// 16 bytes, 0.00152: like `Snorm8Pair`, but as snorm16.
    Snorm16Pair = 6,
    /// 7 bytes, 0.391: TANGENT (4 snorm8), then NORMAL (3 snorm8), as KHR_mesh_quantization stores them, without
    /// padding.
    GltfSnorm8 = 7,
    /// 14 bytes, 0.00152: like `GltfSnorm8`, but as snorm16.
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

/// Whether the stored sign is the sign in `B = sign * cross(N, T)` or its negative.
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

/// Reason why a call failed. The numbers are stable, equal in C and C++, and never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorCode {
    /// A required pointer is null, or a null array has a nonzero count.
    NullData,
    /// Two arrays that must have equal lengths differ in length.
    CountMismatch,
    /// An index is not less than the number of vertices; `element` is its position.
    IndexOutOfRange,
    /// Elements of a span would overlap.
    StrideTooSmall,
    /// A pointer or stride is not a multiple of its element's alignment.
    Misaligned,
    /// A size exceeds a limit: the sum of face sizes, or a limit stated by the function.
    TooLarge,
    /// The method needs an attribute (normals, UVs) that the mesh does not have.
    MissingAttribute,
    /// An option has a value outside its stated range.
    InvalidOption,
    /// The allocator returned null.
    OutOfMemory,
    /// Arrays do not fit the plan they are evaluated with.
    PlanMismatch,
    /// A bug in tspace; please report it.
    Internal,
    /// A callback of the caller canceled the call; no result was returned or written.
    Cancelled,
    /// Asset layer: the file violates its format; the error states where.
    InvalidFile,
    /// Asset layer: the file is valid, but needs a feature that this version does not support.
    UnsupportedFile,
    /// Asset layer: a URI leads outside the folder of the model.
    ForbiddenPath,
    /// Asset layer: a file cannot be opened or read.
    CannotRead,
    /// Asset layer: a file cannot be written; nothing was changed.
    CannotWrite,
    /// An error number that this crate does not know.
    Other(u32),
}

impl ErrorCode {
    pub(crate) fn of(code: u32) -> ErrorCode {
        match code {
            1 => ErrorCode::NullData,
            2 => ErrorCode::CountMismatch,
            3 => ErrorCode::IndexOutOfRange,
            4 => ErrorCode::StrideTooSmall,
            5 => ErrorCode::Misaligned,
            6 => ErrorCode::TooLarge,
            7 => ErrorCode::MissingAttribute,
            8 => ErrorCode::InvalidOption,
            9 => ErrorCode::OutOfMemory,
            10 => ErrorCode::PlanMismatch,
            11 => ErrorCode::Internal,
            12 => ErrorCode::Cancelled,
            100 => ErrorCode::InvalidFile,
            101 => ErrorCode::UnsupportedFile,
            102 => ErrorCode::ForbiddenPath,
            103 => ErrorCode::CannotRead,
            104 => ErrorCode::CannotWrite,
            other => ErrorCode::Other(other),
        }
    }
}
