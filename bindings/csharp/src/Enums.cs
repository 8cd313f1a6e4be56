// SPDX-License-Identifier: MIT
// Choices, with the numbers of the C API.
namespace Tspace
{
    // Everything below is written by scripts/api.
    /// <summary>Reason why a call failed. The numbers are stable, equal in C and C++, and never reused.</summary>
    public enum ErrorCode : uint
    {
        /// <summary>Not an error.</summary>
        Ok = 0,
        /// <summary>A required pointer is null, or a null array has a nonzero count.</summary>
        NullData = 1,
        /// <summary>Two arrays that must have equal lengths differ in length.</summary>
        CountMismatch = 2,
        /// <summary>An index is not less than the number of vertices; `element` is its position.</summary>
        IndexOutOfRange = 3,
        /// <summary>Elements of a span would overlap.</summary>
        StrideTooSmall = 4,
        /// <summary>A pointer or stride is not a multiple of its element's alignment.</summary>
        Misaligned = 5,
        /// <summary>A size exceeds a limit: the sum of face sizes, or a limit stated by the function.</summary>
        TooLarge = 6,
        /// <summary>The method needs an attribute (normals, UVs) that the mesh does not have.</summary>
        MissingAttribute = 7,
        /// <summary>An option has a value outside its stated range.</summary>
        InvalidOption = 8,
        /// <summary>The allocator returned null.</summary>
        OutOfMemory = 9,
        /// <summary>Arrays do not fit the plan they are evaluated with.</summary>
        PlanMismatch = 10,
        /// <summary>A bug in tspace; please report it.</summary>
        Internal = 11,
        /// <summary>A callback of the caller canceled the call; no result was returned or written.</summary>
        Cancelled = 12,
        /// <summary>Asset layer: the file violates its format; the error states where.</summary>
        InvalidFile = 100,
        /// <summary>Asset layer: the file is valid, but needs a feature that this version does not
        /// support.</summary>
        UnsupportedFile = 101,
        /// <summary>Asset layer: a URI leads outside the folder of the model.</summary>
        ForbiddenPath = 102,
        /// <summary>Asset layer: a file cannot be opened or read.</summary>
        CannotRead = 103,
        /// <summary>Asset layer: a file cannot be written; nothing was changed.</summary>
        CannotWrite = 104,
    }

    /// <summary>Method of computing tangents. `docs/concepts/methods/` has a page for each.</summary>
    public enum Method : uint
    {
        /// <summary>Bit-identical to the MikkTSpace reference implementation (Mikkelsen 2008), for triangles and
        /// quads.</summary>
        Mikktspace = 0,
        /// <summary>Sum of the unnormalized dP/du and dP/dv of the faces at a vertex index, Gram-Schmidt against N,
        /// sign from the bitangent (Lengyel 2001). Never splits: all corners of a vertex index get the same
        /// tangent.</summary>
        Lengyel = 1,
        /// <summary>Weighted mean of unit face tangents in the groups of `Mikktspace` with corrected pairing. The
        /// weight of a face at a corner is 1 (`Uniform`), the corner angle (`Angle`), or the face's area
        /// (`Area`).</summary>
        Uniform = 2,
        Angle = 3,
        Area = 4,
        /// <summary>The face's own dP/du at each of its corners, orthogonalized against that corner's N.</summary>
        Flat = 5,
        /// <summary>Orthonormal basis from N, without UVs (Duff et al. 2017). No such basis is continuous over a
        /// closed surface.</summary>
        Basis = 6,
        /// <summary>Two weighted sums of dP/du in the groups of `Angle`: one that is accurate on smooth surfaces
        /// (Max 1999), and one that is robust on bevels and noise, blended by the angle between them. More accurate
        /// than all weighted means, at little more cost than `Uniform`.</summary>
        Fast = 7,
        /// <summary>Quadratic map from UVs to the tangent plane, fitted to the edges around each vertex (polynomial
        /// preserving recovery, Zhang and Naga 2005), in the groups of `Angle`; if the fit is unreliable, a robust
        /// mean. The error of its tangents decreases with the square of the edge length; the error of all other
        /// methods decreases linearly.</summary>
        Best = 8,
    }

    /// <summary>Rule by which `mikktspace` pairs neighboring faces.</summary>
    public enum Pairing : uint
    {
        /// <summary>With the reference's bug: the last bucket of its edge list is not sorted.</summary>
        Reference = 0,
        /// <summary>Without the bug: grouping does not depend on the order of faces.</summary>
        Corrected = 1,
    }

    /// <summary>Treatment of faces with more than 4 corners, which the MikkTSpace reference ignores.</summary>
    public enum Ngons : uint
    {
        /// <summary>Triangulated by triangulate(); results are per corner of the n-gon.</summary>
        Triangulate = 0,
        /// <summary>Skipped, as in the reference: all outputs are 0.</summary>
        Skip = 1,
    }

    /// <summary>Orthonormal frame that replaces dP/du and dP/dv where sheared UVs make them
    /// non-perpendicular.</summary>
    public enum FrameShape : uint
    {
        /// <summary>T is the direction of dP/du; the shader's `sign * cross(N, T)` deviates from dP/dv by the
        /// shear.</summary>
        GramSchmidt = 0,
        /// <summary>T is the bisector of dP/du and the direction perpendicular to dP/dv (Löwdin 1950): both deviate
        /// by half of the shear. Closer to the UVs, but not what bakers and engines with another tangent space
        /// expect.</summary>
        Symmetric = 1,
    }

    /// <summary>Weight of a face in the mean at one of its corners. e1 and e2 are the edges at the corner, a is the
    /// interior angle between them (above 180 degrees at reflex corners of a polygon).</summary>
    public enum NormalWeighting : uint
    {
        /// <summary>No averaging: each corner gets its face's unit normal, as glTF requires for missing
        /// normals.</summary>
        Flat = 0,
        /// <summary>1: mean of unit face normals (Gouraud 1971).</summary>
        Uniform = 1,
        /// <summary>Area of the face (|e1 x e2| / 2 for a triangle).</summary>
        Area = 2,
        /// <summary>a: independent of the tessellation (Thuermer &amp; Wuethrich 1998).</summary>
        Angle = 3,
        /// <summary>a * area.</summary>
        AngleArea = 4,
        /// <summary>sin(a) / (|e1| |e2|): exact on a sphere (Max 1999).</summary>
        Max = 5,
        /// <summary>Normal of a quadratic surface fitted to the edges at the point. If the edges look like noise or
        /// a bevel, the mean of `AngleArea`; in between, a blend of both. The most accurate and the
        /// slowest.</summary>
        Best = 6,
    }
}
