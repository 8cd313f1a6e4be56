// SPDX-License-Identifier: MIT
// Computes tangents with tspace for every model that Unity imports: copy this file into Assets/Editor, src/*.cs into
// Assets/Tspace, and libtspace.so, tspace.dll or libtspace.dylib into Assets/Plugins.
//
// Unity's importer keeps one tangent for each vertex that it creates. If corners of a vertex need different tangents (a
// UV map mirrored along an edge), this importer splits the vertex, with all of its attributes.
using System.Collections.Generic;
using System.Linq;
using Tspace;
using UnityEditor;
using UnityEngine;
using UnityEngine.Rendering;

public sealed class TspaceImporter : AssetPostprocessor
{
    // File name ending of the models to process; null: all models.
    private const string Suffix = null;

    private bool IsWanted => Suffix == null || System.IO.Path.GetFileNameWithoutExtension(assetPath).EndsWith(Suffix);

    public override uint GetVersion() { return 1; }

    private void OnPreprocessModel()
    {
        if (IsWanted) ((ModelImporter)assetImporter).importTangents = ModelImporterTangents.None;
    }

    private void OnPostprocessModel(GameObject root)
    {
        if (!IsWanted) return;
        IEnumerable<UnityEngine.Mesh> meshes = root.GetComponentsInChildren<MeshFilter>(true).Select(filter => filter.sharedMesh);
        meshes = meshes.Concat(root.GetComponentsInChildren<SkinnedMeshRenderer>(true).Select(skin => skin.sharedMesh));
        foreach (UnityEngine.Mesh mesh in meshes.Where(mesh => mesh != null).Distinct())
        {
            try { MakeTangents(mesh); }
            catch (TspaceException error) { Debug.LogWarning(assetPath + ": " + mesh.name + ": " + error.Message, mesh); }
        }
    }

    public static void MakeTangents(UnityEngine.Mesh mesh)
    {
        Vector2[] uvs = mesh.uv;
        if (uvs.Length == 0 || mesh.normals.Length == 0) return;
        int[][] parts = Enumerable.Range(0, mesh.subMeshCount)
            .Select(part => mesh.GetTopology(part) == MeshTopology.Triangles ? mesh.GetTriangles(part) : new int[0]).ToArray();
        if (parts.All(part => part.Length == 0)) return;
        int[] corners = parts.SelectMany(part => part).ToArray();

        IndexedFrames frames = Frames.MakeIndexedFrames(
            new Tspace.Mesh
            {
                Positions = Points.Of(mesh.vertices), Normals = Points.Of(mesh.normals), Uvs = Points.Of(uvs),
                Indices = Indices.Of(corners)
            },
            new TangentOptions(Convention.Unity) { Threads = int.MaxValue });

        int[] sources = frames.SourceVertices.Select(source => (int)source).ToArray();
        if (frames.VertexCount != mesh.vertexCount) Gather(mesh, sources);
        int first = 0;
        for (int part = 0; part < parts.Length; ++part)
        {
            if (parts[part].Length == 0) continue;
            int[] indices = new int[parts[part].Length];
            for (int i = 0; i < indices.Length; ++i) indices[i] = (int)frames.Indices[first + i];
            mesh.SetTriangles(indices, part, false);
            first += indices.Length;
        }
        Vector4[] tangents = new Vector4[frames.VertexCount];
        for (int v = 0; v < tangents.Length; ++v)
        {
            float[] t = frames.Tangents;
            tangents[v] = new Vector4(t[4 * v], t[4 * v + 1], t[4 * v + 2], t[4 * v + 3]);
        }
        mesh.tangents = tangents;
    }

    private sealed class Shape
    {
        public string Name;
        public float Weight;
        public Vector3[] Positions, Normals, Tangents;
    }

    private static T[] Take<T>(IList<T> all, int[] sources)
    {
        return all.Count == 0 ? new T[0] : sources.Select(source => all[source]).ToArray();
    }

    // Old vertices keep their positions, so that index lists remain valid until they are replaced.
    private static void Gather(UnityEngine.Mesh mesh, int[] sources)
    {
        if (sources.Length > 65535) mesh.indexFormat = IndexFormat.UInt32;
        Vector3[] normals = Take(mesh.normals, sources);
        Color[] colors = Take(mesh.colors, sources);
        BoneWeight[] bones = Take(mesh.boneWeights, sources);
        List<Vector4>[] uvs = new List<Vector4>[8];
        for (int channel = 0; channel < 8; ++channel)
        {
            List<Vector4> all = new List<Vector4>();
            mesh.GetUVs(channel, all);
            uvs[channel] = Take(all, sources).ToList();
        }
        List<Shape> shapes = new List<Shape>();
        for (int shape = 0; shape < mesh.blendShapeCount; ++shape)
        {
            for (int frame = 0; frame < mesh.GetBlendShapeFrameCount(shape); ++frame)
            {
                Vector3[] p = new Vector3[mesh.vertexCount], n = new Vector3[mesh.vertexCount], t = new Vector3[mesh.vertexCount];
                mesh.GetBlendShapeFrameVertices(shape, frame, p, n, t);
                shapes.Add(new Shape
                {
                    Name = mesh.GetBlendShapeName(shape), Weight = mesh.GetBlendShapeFrameWeight(shape, frame),
                    Positions = Take(p, sources), Normals = Take(n, sources), Tangents = Take(t, sources)
                });
            }
        }
        mesh.ClearBlendShapes();
        mesh.vertices = Take(mesh.vertices, sources);
        mesh.normals = normals;
        if (colors.Length != 0) mesh.colors = colors;
        if (bones.Length != 0) mesh.boneWeights = bones;
        for (int channel = 0; channel < 8; ++channel)
        {
            if (uvs[channel].Count != 0) mesh.SetUVs(channel, uvs[channel]);
        }
        foreach (Shape shape in shapes)
        {
            mesh.AddBlendShapeFrame(shape.Name, shape.Weight, shape.Positions, shape.Normals, shape.Tangents);
        }
    }
}
