// SPDX-License-Identifier: MIT
// Stubs of the Unity types that unity/TspaceImporter.cs uses, sufficient to run the importer on a mesh.
using System;
using System.Collections.Generic;
using System.Linq;

namespace UnityEngine
{
    public struct Vector2 { public float x, y; public Vector2(float x, float y) { this.x = x; this.y = y; } }
    public struct Vector3 { public float x, y, z; public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; } }
    public struct Vector4 { public float x, y, z, w; public Vector4(float x, float y, float z, float w) { this.x = x; this.y = y; this.z = z; this.w = w; } }
    public struct Color { public float r, g, b, a; }
    public struct BoneWeight { public int boneIndex0; public float weight0; }
    public enum MeshTopology { Triangles, Quads }
    public class Object { public string name; }
    public class Component : Object { }
    public class MeshFilter : Component { public Mesh sharedMesh; }
    public class SkinnedMeshRenderer : Component { public Mesh sharedMesh; }
    public class GameObject : Object { public T[] GetComponentsInChildren<T>(bool all) { return new T[0]; } }
    public static class Debug { public static void LogWarning(object text, Object about) { throw new Exception(text.ToString()); } }
    public class Mesh : Object
    {
        public Vector3[] vertices = new Vector3[0], normals = new Vector3[0];
        public Vector4[] tangents = new Vector4[0];
        public Vector2[] uv => uvs[0] == null ? new Vector2[0] : uvs[0].Select(v => new Vector2(v.x, v.y)).ToArray();
        public Color[] colors = new Color[0];
        public BoneWeight[] boneWeights = new BoneWeight[0];
        public List<Vector4>[] uvs = new List<Vector4>[8];
        public int[][] parts = new int[0][];
        public Rendering.IndexFormat indexFormat;
        public sealed class Shape { public string name; public float weight; public Vector3[] p, n, t; }
        public List<Shape> shapes = new List<Shape>();
        public int vertexCount => vertices.Length;
        public int subMeshCount => parts.Length;
        public int blendShapeCount => shapes.Count;
        public MeshTopology GetTopology(int part) { return MeshTopology.Triangles; }
        public int[] GetTriangles(int part) { return parts[part]; }
        public void SetTriangles(int[] list, int part, bool bounds) { parts[part] = list; }
        public void GetUVs(int channel, List<Vector4> all) { if (uvs[channel] != null) all.AddRange(uvs[channel]); }
        public void SetUVs(int channel, List<Vector4> all) { uvs[channel] = all; }
        public int GetBlendShapeFrameCount(int shape) { return 1; }
        public string GetBlendShapeName(int shape) { return shapes[shape].name; }
        public float GetBlendShapeFrameWeight(int shape, int frame) { return shapes[shape].weight; }
        public void GetBlendShapeFrameVertices(int shape, int frame, Vector3[] p, Vector3[] n, Vector3[] t)
        {
            shapes[shape].p.CopyTo(p, 0);
            shapes[shape].n.CopyTo(n, 0);
            shapes[shape].t.CopyTo(t, 0);
        }
        public void ClearBlendShapes() { shapes.Clear(); }
        public void AddBlendShapeFrame(string name, float weight, Vector3[] p, Vector3[] n, Vector3[] t) { shapes.Add(new Shape { name = name, weight = weight, p = p, n = n, t = t }); }
    }
}

namespace UnityEngine.Rendering
{
    public enum IndexFormat { UInt16, UInt32 }
}

namespace UnityEditor
{
    public class AssetImporter : UnityEngine.Object { }
    public enum ModelImporterTangents { None, Import, CalculateMikk }
    public class ModelImporter : AssetImporter { public ModelImporterTangents importTangents; }
    public class AssetPostprocessor
    {
        public string assetPath = "";
        public AssetImporter assetImporter;
        public virtual uint GetVersion() { return 0; }
    }
}
