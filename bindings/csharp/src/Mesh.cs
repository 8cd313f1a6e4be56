// SPDX-License-Identifier: MIT
using System;
using System.Runtime.InteropServices;

namespace Tspace
{
    /// <summary>Points of 2, 3 or 4 floats, contiguous or interleaved with other vertex data. Borrows memory.</summary>
    public readonly ref struct Points
    {
        internal readonly ReadOnlySpan<float> Floats;
        internal readonly int StrideFloats;

        private Points(ReadOnlySpan<float> floats, int strideFloats)
        {
            Floats = floats;
            StrideFloats = strideFloats;
        }

        /// <summary>Creates points from contiguous floats.</summary>
        public static Points Of(ReadOnlySpan<float> floats) { return new Points(floats, 0); }

        /// <summary>Creates points from structs of floats, such as Vector3 of Unity or of System.Numerics.</summary>
        public static Points Of<T>(ReadOnlySpan<T> vectors) where T : struct
        {
            return new Points(MemoryMarshal.Cast<T, float>(vectors), 0);
        }

        /// <summary>Creates points from an array of structs of floats.</summary>
        public static Points Of<T>(T[] vectors) where T : struct { return Of<T>(new ReadOnlySpan<T>(vectors)); }

        /// <summary>Creates points from the floats at first, first + stride, ..., as in interleaved vertices.</summary>
        public static Points Interleaved(ReadOnlySpan<float> floats, int first, int stride)
        {
            if (stride < 1) throw new ArgumentOutOfRangeException(nameof(stride));
            return new Points(floats.Slice(first), stride);
        }

        internal int Count(int components)
        {
            if (Floats.IsEmpty) return 0;
            if (StrideFloats == 0)
            {
                if (Floats.Length % components != 0)
                {
                    throw new TspaceException(Floats.Length + " floats cannot be divided into elements of " + components + " floats",
                                              ErrorCode.CountMismatch);
                }
                return Floats.Length / components;
            }
            if (StrideFloats < components)
            {
                throw new TspaceException("the stride of " + StrideFloats + " floats is less than the " + components +
                                          " floats of an element", ErrorCode.StrideTooSmall);
            }
            return Floats.Length < components ? 0 : (Floats.Length - components) / StrideFloats + 1;
        }
    }

    /// <summary>The vertex of each corner, with 16 or 32 bits.</summary>
    public readonly ref struct Indices
    {
        internal readonly ReadOnlySpan<byte> Bytes;
        internal readonly uint Type;

        private Indices(ReadOnlySpan<byte> bytes, uint type)
        {
            Bytes = bytes;
            Type = type;
        }

        public static Indices Of(ReadOnlySpan<uint> list) { return new Indices(MemoryMarshal.AsBytes(list), 4); }
        public static Indices Of(ReadOnlySpan<ushort> list) { return new Indices(MemoryMarshal.AsBytes(list), 2); }
        /// <summary>Creates indices from signed integers, as used by Unity; negative ones are out of range.</summary>
        public static Indices Of(ReadOnlySpan<int> list) { return new Indices(MemoryMarshal.AsBytes(list), 4); }
        public static Indices Of(uint[] list) { return Of(new ReadOnlySpan<uint>(list)); }
        public static Indices Of(ushort[] list) { return Of(new ReadOnlySpan<ushort>(list)); }
        public static Indices Of(int[] list) { return Of(new ReadOnlySpan<int>(list)); }

        internal int Count => Type == 0 ? 0 : Bytes.Length / (int)Type;
    }

    /// <summary>Mesh that borrows its arrays. Positions are always required; each function documents what else it
    /// needs.</summary>
    public ref struct Mesh
    {
        /// <summary>3 floats per vertex.</summary>
        public Points Positions;
        /// <summary>3 floats per vertex, used as given.</summary>
        public Points Normals;
        /// <summary>2 floats per vertex.</summary>
        public Points Uvs;
        /// <summary>The vertex of each corner. Default: corner c is vertex c.</summary>
        public Indices Indices;
        /// <summary>Corners of every face; 0 means 3.</summary>
        public int FaceSize;
        /// <summary>Number of corners of each face, if faces have different sizes.</summary>
        public ReadOnlySpan<uint> FaceSizes;
    }

    /// <summary>Receives a mesh whose arrays are pinned while `call` runs.</summary>
    internal unsafe delegate void WithMesh(Native.Mesh* mesh);

    internal static unsafe class Pinned
    {
        internal static Native.Span Span(float* data, in Points points, int components)
        {
            return new Native.Span(data, points.Count(components), 4 * points.StrideFloats);
        }

        internal static void Use(in Mesh mesh, WithMesh call)
        {
            if (mesh.FaceSize < 0) throw new TspaceException("FaceSize is negative", ErrorCode.InvalidOption);
            fixed (float* positions = &MemoryMarshal.GetReference(mesh.Positions.Floats))
            fixed (float* normals = &MemoryMarshal.GetReference(mesh.Normals.Floats))
            fixed (float* uvs = &MemoryMarshal.GetReference(mesh.Uvs.Floats))
            fixed (byte* indices = &MemoryMarshal.GetReference(mesh.Indices.Bytes))
            fixed (uint* sizes = &MemoryMarshal.GetReference(mesh.FaceSizes))
            {
                Native.Mesh raw = new Native.Mesh();
                raw.StructSize = (uint)sizeof(Native.Mesh);
                raw.FaceSize = (uint)mesh.FaceSize;
                raw.Positions = Span(positions, mesh.Positions, 3);
                raw.Normals = Span(normals, mesh.Normals, 3);
                raw.Uvs = Span(uvs, mesh.Uvs, 2);
                if (mesh.Indices.Type != 0)
                {
                    raw.Indices.Data = indices;
                    raw.Indices.Count = (UIntPtr)(uint)mesh.Indices.Count;
                    raw.Indices.Type = mesh.Indices.Type;
                }
                if (!mesh.FaceSizes.IsEmpty)
                {
                    raw.FaceSizes = sizes;
                    raw.FaceCount = (UIntPtr)(uint)mesh.FaceSizes.Length;
                }
                call(&raw);
            }
        }
    }
}
