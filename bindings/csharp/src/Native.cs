// SPDX-License-Identifier: MIT
// The C API, as tspace.h declares it. The library checks sizes of sized structs: a layout that differs is an error of every
// call.
using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Tspace
{
    internal static unsafe class Native
    {
        // libtspace.so, tspace.dll, libtspace.dylib.
        private const string Library = "tspace";

        [StructLayout(LayoutKind.Sequential)]
        internal struct Error
        {
            public uint Code;
            public uint Reserved;
            public ulong Element;
            public fixed byte Message[240];
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct Span
        {
            public float* Data;
            public UIntPtr Count;
            public UIntPtr StrideBytes;

            internal Span(float* data, int count, int strideBytes)
            {
                Data = data;
                Count = (UIntPtr)(uint)count;
                StrideBytes = (UIntPtr)(uint)strideBytes;
            }
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct ByteSpan
        {
            public bool* Data;
            public UIntPtr Count;
            public UIntPtr StrideBytes;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct Indices
        {
            public void* Data;
            public UIntPtr Count;
            public uint Type;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct Mesh
        {
            public uint StructSize;
            public uint FaceSize;
            public Span Positions;
            public Span Normals;
            public Span Uvs;
            public Indices Indices;
            public uint* FaceSizes;
            public UIntPtr FaceCount;
            public Indices NormalIndices;
            public Indices UvIndices;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct Execution
        {
            public uint StructSize;
            public uint ThreadCount;
            public IntPtr Executor;
            public IntPtr Allocator;
            public uint Simd;
            public uint Reserved;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct Convention
        {
            public uint VAxis;
            public uint Green;
            public uint StoredSign;
            public uint Handedness;
            public uint Winding;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct TangentOptions
        {
            public uint StructSize;
            public uint Method;
            public Convention Convention;
            public uint Ngons;
            public uint Domain;
            public uint Frame;
            public float AngularThresholdDeg;
            public uint Pairing;
            public uint Refine;
            public uint NormalizeNormals;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct TangentReport
        {
            public uint StructSize;
            public uint ReferenceOrderAbandoned;
            public ulong TriangleCount;
            public ulong DegenerateTriangleCount;
            public ulong DegenerateUvCount;
            public ulong MirroredCount;
            public ulong SkippedFaceCount;
            public ulong GroupCount;
            public ulong DefaultCornerCount;
            public ulong NotFiniteCount;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct TangentOutput
        {
            public uint StructSize;
            public uint Reserved;
            public Span Tangents;
            public Span Bitangents;
            public Span MagnitudesS;
            public Span MagnitudesT;
            public ByteSpan HasTangent;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct Pose
        {
            public uint StructSize;
            public uint Reserved;
            public Span Positions;
            public Span Normals;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct TangentPlanInfo
        {
            public uint StructSize;
            public uint Method;
            public UIntPtr VertexCount;
            public UIntPtr CornerCount;
            public UIntPtr OutputCount;
            public UIntPtr MemoryBytes;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct NormalOptions
        {
            public uint StructSize;
            public uint Weighting;
            public Convention Convention;
            public float CreaseAngleDeg;
            public uint* SmoothingGroups;
            public UIntPtr SmoothingGroupCount;
            public uint SmoothingGroupsAreMasks;
            public uint WeldPositions;
            public uint Refine;
            public uint Reserved;
            public float Denoise;
            public float WeldDistance;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct SanitizeOptions
        {
            public uint StructSize;
            public uint OrthogonalizeAll;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct SanitizeReport
        {
            public uint StructSize;
            public uint Reserved;
            public ulong NotFiniteCount;
            public ulong ZeroCount;
            public ulong NotUnitCount;
            public ulong ParallelCount;
            public ulong BadSignCount;
            public ulong MixedSignCount;
            public ulong OrthogonalizedCount;
            public ulong NormalizedCount;
            public ulong FromNeighborCount;
            public ulong FromBasisCount;
            public ulong BadNormalCount;
            public ulong MendedCount;
            public ulong PlaceholderCount;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct IndexedFramesOptions
        {
            public uint StructSize;
            public uint MakeNormals;
            public uint Sanitize;
            public uint OrthogonalizeAll;
            public TangentOptions* Tangents;
            public NormalOptions* Normals;
            public IntPtr KeepApart;
            public UIntPtr KeepApartCount;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct IndexedFrames
        {
            public uint* Indices;
            public UIntPtr CornerCount;
            public uint* SourceVertices;
            public uint* SourceCorners;
            public float* Normals;
            public float* Tangents;
            public UIntPtr VertexCount;
            public IntPtr NormalReport;
            public TangentReport* TangentReport;
            public SanitizeReport* SanitizeReport;
        }

        [DllImport(Library)] internal static extern uint tspace_version();
        [DllImport(Library)] internal static extern uint tspace_findConvention(byte* name, Convention* made, Error* error);
        [DllImport(Library)] internal static extern UIntPtr tspace_cornerCount(Mesh* mesh);
        [DllImport(Library)] internal static extern uint tspace_validate(Mesh* mesh, Error* error);
        [DllImport(Library)] internal static extern uint tspace_initExecution(Execution* made, uint size, Error* error);
        [DllImport(Library)] internal static extern uint tspace_initTangentOptions(TangentOptions* made, uint size, Error* error);
        [DllImport(Library)] internal static extern uint tspace_initNormalOptions(NormalOptions* made, uint size, Error* error);
        [DllImport(Library)] internal static extern uint tspace_initSanitizeOptions(SanitizeOptions* made, uint size, Error* error);
        [DllImport(Library)] internal static extern uint tspace_initIndexedFramesOptions(IndexedFramesOptions* made, uint size, Error* error);
        [DllImport(Library)]
        internal static extern uint tspace_generateTangents(Mesh* mesh, TangentOptions* options, TangentOutput* made,
                                                            Execution* execution, TangentReport* report, Error* error);
        [DllImport(Library)]
        internal static extern uint tspace_planTangents(Mesh* mesh, TangentOptions* options, Execution* execution,
                                                        out IntPtr plan, Error* error);
        [DllImport(Library)]
        internal static extern uint tspace_evaluateTangents(IntPtr plan, Pose* pose, TangentOutput* made, Execution* execution,
                                                            TangentReport* report, Error* error);
        [DllImport(Library)]
        internal static extern uint tspace_describeTangentPlan(IntPtr plan, TangentPlanInfo* info, Error* error);
        [DllImport(Library)] internal static extern void tspace_destroyTangentPlan(IntPtr plan);
        [DllImport(Library)]
        internal static extern uint tspace_generateNormals(Mesh* mesh, NormalOptions* options, Span made, Execution* execution,
                                                           IntPtr report, Error* error);
        [DllImport(Library)]
        internal static extern uint tspace_sanitizeTangents(Mesh* mesh, SanitizeOptions* options, Span tangents,
                                                            Execution* execution, SanitizeReport* report, Error* error);
        [DllImport(Library)]
        internal static extern uint tspace_makeIndexedFrames(Mesh* mesh, IndexedFramesOptions* options, Execution* execution,
                                                             out IndexedFrames* frames, Error* error);
        [DllImport(Library)] internal static extern void tspace_destroyIndexedFrames(IndexedFrames* frames);

        internal static void Check(uint code, ref Error error)
        {
            if (code == 0) return;
            fixed (byte* message = error.Message)
            {
                int length = 0;
                while (length < 240 && message[length] != 0) ++length;
                throw new TspaceException(Encoding.UTF8.GetString(message, length), (ErrorCode)code,
                                          error.Element == ulong.MaxValue ? (long?)null : (long)error.Element);
            }
        }
    }
}
