// SPDX-License-Identifier: MIT
// Choices, with the numbers of the C API. Written by scripts/api.
namespace Tspace
{
    /// <summary>How tangents are computed. `docs/concepts/methods/` has a page for each.</summary>
    public enum Method : uint
    {
        /// <summary>Bit for bit the result of the MikkTSpace reference implementation (Mikkelsen 2008), for
        /// triangles and quads.</summary>
        Mikktspace = 0,
        /// <summary>Sum of the unnormalised dP/du and dP/dv of the faces at a vertex index, Gram-Schmidt against N,
        /// sign from the bitangent (Lengyel 2001). Never splits: all corners of one vertex index get one
        /// tangent.</summary>
        Lengyel = 1,
        /// <summary>Weighted mean of unit face tangents in the groups of `Mikktspace` with corrected pairing. The
        /// weight of a face at a corner is 1, the corner angle, or the face's area.</summary>
        Uniform = 2,
        Angle = 3,
        Area = 4,
        /// <summary>The face's own dP/du at each of its corners, made orthogonal to that corner's N.</summary>
        Flat = 5,
        /// <summary>No UVs: an orthonormal basis from N alone (Duff et al. 2017). No such basis is continuous over a
        /// closed surface.</summary>
        Basis = 6,
        /// <summary>Two weighted sums of dP/du in the groups of `Angle`: one that is accurate on smooth surfaces
        /// (Max 1999), one that is robust on bevels and noise, mixed by the angle between them. More accurate than
        /// all weighted means, and hardly dearer than `Uniform`.</summary>
        Fast = 7,
        /// <summary>A quadratic map from UVs to the tangent plane, fitted to the edges around each vertex
        /// (polynomial preserving recovery, Zhang and Naga 2005), in the groups of `Angle`; where the fit is
        /// doubtful it becomes a robust mean. The error of its tangents falls with the square of the edge length,
        /// not with the length as that of all others.</summary>
        Best = 8,
    }

    /// <summary>How `mikktspace` finds neighbouring faces.</summary>
    public enum Pairing : uint
    {
        /// <summary>With the reference's defect: the last bucket of its edge list is not sorted.</summary>
        Reference = 0,
        /// <summary>Without it: grouping no longer depends on the order of faces.</summary>
        Corrected = 1,
    }

    /// <summary>What happens to faces with more than 4 corners, which the MikkTSpace reference ignores.</summary>
    public enum Ngons : uint
    {
        /// <summary>Cut as by triangulate(); results come back per corner of the n-gon.</summary>
        Triangulate = 0,
        /// <summary>As the reference: nothing is computed, outputs are 0.</summary>
        Skip = 1,
    }

    /// <summary>Which orthonormal frame stands for dP/du and dP/dv, where UVs are sheared and the two are not
    /// perpendicular.</summary>
    public enum FrameShape : uint
    {
        /// <summary>T is the direction of dP/du, and the shader's `sign * cross(N, T)` is off from dP/dv by the
        /// shear.</summary>
        GramSchmidt = 0,
        /// <summary>T is the bisector of dP/du and of the direction perpendicular to dP/dv (Löwdin 1950): both are
        /// off by half of the shear. Nearer to what the UVs say, but not what a baker or an engine with another
        /// tangent space expects.</summary>
        Symmetric = 1,
    }

    /// <summary>How much a face counts in the mean at one of its corners. e1, e2 are the edges at the corner, a the
    /// interior angle between them (above 180 degrees where a polygon is reflex).</summary>
    public enum NormalWeighting : uint
    {
        /// <summary>No averaging: each corner gets its face's unit normal, as glTF asks where normals are
        /// missing.</summary>
        Flat = 0,
        /// <summary>1: mean of unit face normals (Gouraud 1971).</summary>
        Uniform = 1,
        /// <summary>The face's area (|e1 x e2| / 2 for a triangle): large faces count more.</summary>
        Area = 2,
        /// <summary>a: independent of tessellation (Thuermer &amp; Wuethrich 1998).</summary>
        Angle = 3,
        /// <summary>a * area.</summary>
        AngleArea = 4,
        /// <summary>sin(a) / (|e1| |e2|): exact on a sphere (Max 1999).</summary>
        Max = 5,
        /// <summary>No mean: the normal of a quadratic surface through the edges at the point. Where these look like
        /// noise or a bevel it is the mean of `AngleArea`, and in between a blend. The most accurate, and the
        /// slowest.</summary>
        Best = 6,
    }
}
