// SPDX-License-Identifier: MIT
// Tests the importer for Unity on a mesh whose texture is mirrored; UnityStubs.cs replaces Unity.
using System;
using System.Linq;
using UnityEngine;

internal static class UnityTests
{
    private static int Main()
    {
        Mesh mesh = new Mesh
        {
            vertices = Enumerable.Range(0, 6).Select(v => new Vector3(v % 3, v / 3, 0)).ToArray(),
            normals = Enumerable.Repeat(new Vector3(0, 0, -1), 6).ToArray(),
            boneWeights = Enumerable.Range(0, 6).Select(v => new BoneWeight { boneIndex0 = v }).ToArray(),
            parts = new[] { new[] { 0, 4, 1, 0, 3, 4 }, new[] { 1, 5, 2, 1, 4, 5 } }
        };
        mesh.uvs[0] = Enumerable.Range(0, 6).Select(v => new Vector4(v % 3 == 1 ? 1 : 0, v / 3, 0, 0)).ToList();
        Vector3[] moved = Enumerable.Range(0, 6).Select(v => new Vector3(0, 0, v)).ToArray();
        mesh.AddBlendShapeFrame("smile", 100, moved, new Vector3[6], new Vector3[6]);
        TspaceImporter.MakeTangents(mesh);

        bool isRight = mesh.vertexCount == 8 && mesh.tangents.Length == 8 && mesh.normals.Length == 8 && mesh.uv.Length == 8;
        isRight &= mesh.boneWeights[6].boneIndex0 == 1 && mesh.boneWeights[7].boneIndex0 == 4;
        isRight &= mesh.blendShapeCount == 1 && mesh.shapes[0].p[7].z == 4;
        foreach (int[] part in mesh.parts)
        {
            float x = mesh.tangents[part[0]].x, w = mesh.tangents[part[0]].w;
            // T points along increasing u, and the two mirrored halves have opposite signs.
            isRight &= part.All(v => mesh.tangents[v].x == x && mesh.tangents[v].w == w) && x == (part == mesh.parts[0] ? 1 : -1);
        }
        isRight &= mesh.tangents[mesh.parts[0][0]].w == -mesh.tangents[mesh.parts[1][0]].w;
        // B = cross(N, T) * w points along increasing v.
        isRight &= -mesh.tangents[0].x * mesh.tangents[0].w == 1;
        Console.WriteLine(isRight ? "ok: the importer for Unity splits mirrored vertices with all that hangs on them" : "FAILED: the importer for Unity");
        return isRight ? 0 : 1;
    }
}
