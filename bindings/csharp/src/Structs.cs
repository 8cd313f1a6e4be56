// SPDX-License-Identifier: MIT
// Options and reports, with the fields of the C API.
namespace Tspace
{
    // Everything below is written by scripts/api.
    /// <summary>Options of generateTangents: first those for all methods, then those of a single method, which
    /// others ignore. A new instance holds the defaults.</summary>
    public sealed partial class TangentOptions
    {
        /// <summary>The default is what bakers and glTF expect.</summary>
        public Method Method { get => (Method)fields.Method; set => fields.Method = (uint)value; }
        /// <summary>Determines the stored sign; there is no default: "gltf" for glTF; "opengl" stores the raw sign,
        /// as the reference does. If unset: invalidOption.</summary>
        public Convention Convention { get => new Convention(fields.Convention); set => fields.Convention = value.Raw; }
        /// <summary>By default every corner gets a tangent.</summary>
        public Ngons Ngons { get => (Ngons)fields.Ngons; set => fields.Ngons = (uint)value; }
        /// <summary>`symmetric` is rejected for `mikktspace`, whose results are those of the reference, and for
        /// `basis`, which uses no UVs. The default is what bakers and engines expect.</summary>
        public FrameShape Frame { get => (FrameShape)fields.Frame; set => fields.Frame = (uint)value; }
        /// <summary>Angular threshold in degrees, 0 to 180: faces of a group whose tangents (or bitangents) differ
        /// by this or more are not averaged. 180 is the default of the reference and of every baker. As in the
        /// reference, any float is accepted, but only its cosine is used: 270 has the effect of 90. With NaN no two
        /// faces are averaged.</summary>
        public float AngularThresholdDeg { get => fields.AngularThresholdDeg; set => fields.AngularThresholdDeg = value; }
        /// <summary>The default is bit-identical to every other MikkTSpace.</summary>
        public Pairing Pairing { get => (Pairing)fields.Pairing; set => fields.Pairing = (uint)value; }
        /// <summary>Number of refinement steps after the fit: 0, 1 or 2. A step changes each frame so that,
        /// interpolated along the edges around it, it reproduces these edges, as far as they agree. 1: a fifth less
        /// shading error. 2: another twentieth less.</summary>
        public int Refine { get => (int)fields.Refine; set => fields.Refine = (uint)value; }
        /// <summary>true: normalize normals whose length deviates from 1 by more than 8-bit rounding does (0.00674)
        /// before they are used; all others, and those without a direction, keep their bits. false, the default: use
        /// normals as given, as the reference does. A tangent is then not perpendicular to a normal that is not
        /// unit: on a sphere it deviates by up to 28 degrees at length 2.</summary>
        public bool NormalizeNormals { get => fields.NormalizeNormals != 0; set => fields.NormalizeNormals = value ? 1u : 0u; }
    }

    /// <summary>Options of generateNormals: first those that apply to all weightings, then those that apply to some.
    /// A new instance holds the defaults.</summary>
    public sealed partial class NormalOptions
    {
        /// <summary>The default does not depend on how faces were triangulated.</summary>
        public NormalWeighting Weighting { get => (NormalWeighting)fields.Weighting; set => fields.Weighting = (uint)value; }
        /// <summary>Handedness and winding define the outside of faces. Default: glTF.</summary>
        public Convention Convention { get => new Convention(fields.Convention); set => fields.Convention = value.Raw; }
        /// <summary>Maximum angle between the normals of two faces whose shared edge is smooth, in degrees, 0..180
        /// (plus 1e-6 rad for rounding). Default: 180, because no angle suits all models: no hard edges (except from
        /// smoothing groups), and all faces at a point are smoothed together, including faces that share only this
        /// point. -1: chosen for each mesh, as the middle of the widest gap in the histogram of edge angles, after
        /// noise of positions is filtered out. NormalReport contains the angle that was used.</summary>
        public float CreaseAngleDeg { get => fields.CreaseAngleDeg; set => fields.CreaseAngleDeg = value; }
        /// <summary>true: weld vertices with equal positions (so UV seams stay smooth); false: weld by index
        /// only.</summary>
        public bool WeldPositions { get => fields.WeldPositions != 0; set => fields.WeldPositions = value ? 1u : 0u; }
        /// <summary>Number of refinement steps after the fit: 0, 1 or 2. A step moves each normal so that,
        /// interpolated along the edges around it, it is perpendicular to these edges, as far as they agree. 1: a
        /// third less error at vertices and in the shading between them. 2: another quarter less.</summary>
        public int Refine { get => (int)fields.Refine; set => fields.Refine = (uint)value; }
        /// <summary>Denoising for meshes with noisy positions: scans, marching cubes of a noisy field. Vertices are
        /// not moved; at each vertex the normals of quadratic surfaces through two and three rings are blended with
        /// the normal of `best`, weighted by their expected errors. 0, the default: off. -1: by the measured noise;
        /// if there is none, or it looks like shape (CAD, bevels, decimated meshes), results are bit-identical to
        /// those with 0. Above 0, up to 4: factor of the measured noise, without that check; 3 suits noise that is
        /// smooth from vertex to vertex, which cannot be distinguished from detail. Hard edges are preserved: no
        /// surface is fitted across them.</summary>
        public float Denoise { get => fields.Denoise; set => fields.Denoise = value; }
        /// <summary>With `weld_positions`: weld distance, in mesh units. Vertices whose positions differ by at most
        /// this in each coordinate are welded to the one with the lowest index. Useful for meshes that are closed
        /// only up to rounding, such as a torus whose last ring has sin(2 pi) = -2.4e-16 instead of 0. 0, the
        /// default: only equal positions. -1: twice the spacing of floats at the largest coordinate, and only at
        /// positions with an edge of at least 32 times that length. Vertices are processed in order: each is welded
        /// to the first earlier vertex within the distance that was not welded itself, so chains of close positions
        /// are not all welded together.</summary>
        public float WeldDistance { get => fields.WeldDistance; set => fields.WeldDistance = value; }
    }

    /// <summary>Counts of triangles, groups and defects of the input. Invalid geometry never makes a call
    /// fail.</summary>
    public readonly partial struct TangentReport
    {
        /// <summary>`mikktspace`: the input would drive the reference into quadratic time, so one of its steps was
        /// skipped. This is either the sort (with `reference`; the corrected pairing was used for the last bucket;
        /// only crafted inputs cause this), or the angular test (a group of more than 4096 faces whose tangents
        /// spread too far was not split).</summary>
        public bool ReferenceOrderAbandoned { get => fields.ReferenceOrderAbandoned != 0; }
        /// <summary>Processed triangles, after triangulation of quads and n-gons.</summary>
        public long TriangleCount { get => (long)fields.TriangleCount; }
        /// <summary>Triangles with two corners at the same position.</summary>
        public long DegenerateTriangleCount { get => (long)fields.DegenerateTriangleCount; }
        /// <summary>Triangles without UV area: they use the frames of their neighbors.</summary>
        public long DegenerateUvCount { get => (long)fields.DegenerateUvCount; }
        /// <summary>Triangles that show the image mirrored, in the chosen convention.</summary>
        public long MirroredCount { get => (long)fields.MirroredCount; }
        /// <summary>Faces for which nothing was computed.</summary>
        public long SkippedFaceCount { get => (long)fields.SkippedFaceCount; }
        /// <summary>Groups: sets of corners that share one tangent.</summary>
        public long GroupCount { get => (long)fields.GroupCount; }
        /// <summary>Outputs without a tangent from any face: default of the method.</summary>
        public long DefaultCornerCount { get => (long)fields.DefaultCornerCount; }
        /// <summary>Outputs whose tangent has a NaN or infinity.</summary>
        public long NotFiniteCount { get => (long)fields.NotFiniteCount; }
    }
}
