// SPDX-License-Identifier: MIT
// The C API, as tspace.h declares it. The library checks sizes of sized structs: a layout that differs is an error of
// every call.
using System;
using System.Runtime.InteropServices;

namespace Tspace
{
    internal static unsafe partial class Native
    {
        // libtspace.so, tspace.dll, libtspace.dylib.
        private const string Library = "tspace";

        // Everything below is written by scripts/api.

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct Error
        {
            public uint Code;
            public uint Reserved;
            public ulong Element;
            public fixed byte Message[240];
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct Span
        {
            public float* Data;
            public UIntPtr Count;
            public UIntPtr StrideBytes;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct ByteSpan
        {
            public byte* Data;
            public UIntPtr Count;
            public UIntPtr StrideBytes;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct Indices
        {
            public void* Data;
            public UIntPtr Count;
            public uint Type;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct Mesh
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
        internal partial struct Executor
        {
            public IntPtr Run;
            public void* User;
            public uint Concurrency;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct Allocator
        {
            public IntPtr Allocate;
            public IntPtr Release;
            public void* User;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct Execution
        {
            public uint StructSize;
            public uint ThreadCount;
            public Executor* Executor;
            public Allocator* Allocator;
            public uint Simd;
            public uint Reserved;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct Convention
        {
            public uint VAxis;
            public uint Green;
            public uint StoredSign;
            public uint Handedness;
            public uint Winding;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct TangentOptions
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
        internal partial struct TangentReport
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
        internal partial struct TangentOutput
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
        internal partial struct MeshJob
        {
            public Mesh* Mesh;
            public TangentOptions* Options;
            public TangentOutput* Out;
            public TangentReport* Report;
            public Error* Error;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct Pose
        {
            public uint StructSize;
            public uint Reserved;
            public Span Positions;
            public Span Normals;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct TangentPlanInfo
        {
            public uint StructSize;
            public uint Method;
            public UIntPtr VertexCount;
            public UIntPtr CornerCount;
            public UIntPtr OutputCount;
            public UIntPtr MemoryBytes;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct Triangulation
        {
            public uint* Corners;
            public uint* Faces;
            public UIntPtr TriangleCount;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct Vec2
        {
            public float X;
            public float Y;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct Vec3
        {
            public float X;
            public float Y;
            public float Z;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct Vec4
        {
            public float X;
            public float Y;
            public float Z;
            public float W;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct Frame
        {
            public Vec3 Tangent;
            public Vec3 Bitangent;
            public Vec3 Normal;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct Mat3
        {
            public Vec3 Rows0, Rows1, Rows2;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct FaceFrame
        {
            public Vec3 Tangent;
            public Vec3 Bitangent;
            public float Determinant;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct NormalOptions
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
        internal partial struct NormalReport
        {
            public uint StructSize;
            public uint Reserved;
            public ulong FaceCount;
            public ulong DegenerateFaceCount;
            public ulong FallbackCornerCount;
            public float Noise;
            public float CreaseAngleDeg;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct PositionNoise
        {
            public uint StructSize;
            public float Sigma;
            public float KinkShare;
            public float Noise;
            public double MeanEdge;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct SanitizeOptions
        {
            public uint StructSize;
            public uint OrthogonalizeAll;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct SanitizeReport
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
        internal partial struct CornerAttribute
        {
            public float* Data;
            public UIntPtr StrideBytes;
            public uint ComponentCount;
            public float Tolerance;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct SplitResult
        {
            public uint* Indices;
            public UIntPtr CornerCount;
            public uint* SourceVertices;
            public uint* SourceCorners;
            public UIntPtr VertexCount;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct IndexedFramesOptions
        {
            public uint StructSize;
            public uint MakeNormals;
            public uint Sanitize;
            public uint OrthogonalizeAll;
            public TangentOptions* Tangents;
            public NormalOptions* Normals;
            public CornerAttribute* KeepApart;
            public UIntPtr KeepApartCount;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct IndexedFrames
        {
            public uint* Indices;
            public UIntPtr CornerCount;
            public uint* SourceVertices;
            public uint* SourceCorners;
            public float* Normals;
            public float* Tangents;
            public UIntPtr VertexCount;
            public NormalReport* NormalReport;
            public TangentReport* TangentReport;
            public SanitizeReport* SanitizeReport;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct PlanBufferOptions
        {
            public uint StructSize;
            public uint Reserved;
            public uint* Indices;
            public UIntPtr IndexCount;
            public uint* SourceCorners;
            public UIntPtr SourceCornerCount;
            public Mesh* Mesh;
            public NormalOptions* Normals;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct PlanBuffers
        {
            public uint* Words;
            public UIntPtr WordCount;
            public UIntPtr ResultCount;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct FrameErrorBound
        {
            public double NormalDeg;
            public double TangentDeg;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct PackReport
        {
            public uint StructSize;
            public uint Reserved;
            public ulong BadNormalCount;
            public ulong NotFiniteCount;
            public ulong ZeroCount;
            public ulong ParallelCount;
            public ulong NotUnitCount;
            public ulong NotOrthogonalCount;
            public ulong BadSignCount;
            public ulong MendedCount;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct WindingOptions
        {
            public uint StructSize;
            public Convention Convention;
            public uint UseNormals;
            public uint WeldPositions;
            public float WeldDistance;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal partial struct WindingReport
        {
            public uint StructSize;
            public uint Reserved;
            public ulong FaceCount;
            public ulong TurnedCount;
            public ulong ConflictCountBefore;
            public ulong ConflictCountAfter;
            public ulong ComponentCount;
            public ulong TurnedComponentCount;
            public ulong ByNormalsCount;
            public ulong ByVolumeCount;
            public ulong ByNestingCount;
            public ulong ByWindingNumberCount;
            public ulong ByMajorityCount;
            public ulong SmallCount;
            public ulong OneSidedCount;
        }

        [DllImport(Library)] internal static extern uint tspace_version();
        [DllImport(Library)] internal static extern byte* tspace_errorName(uint @code);
        [DllImport(Library)] internal static extern UIntPtr tspace_cornerCount(Mesh* @mesh);
        [DllImport(Library)] internal static extern UIntPtr tspace_faceCount(Mesh* @mesh);
        [DllImport(Library)] internal static extern uint tspace_validate(Mesh* @mesh, Error* @error);
        [DllImport(Library)] internal static extern uint tspace_initExecution(Execution* @execution, uint @struct_size, Error* @error);
        [DllImport(Library)] internal static extern uint tspace_createArena(IntPtr* @arena, Error* @error);
        [DllImport(Library)] internal static extern Allocator* tspace_arenaAllocator(IntPtr @arena);
        [DllImport(Library)] internal static extern UIntPtr tspace_arenaHeldBytes(IntPtr @arena);
        [DllImport(Library)] internal static extern UIntPtr tspace_arenaUsedBytes(IntPtr @arena);
        [DllImport(Library)] internal static extern void tspace_trimArena(IntPtr @arena);
        [DllImport(Library)] internal static extern void tspace_destroyArena(IntPtr @arena);
        [DllImport(Library)] internal static extern uint tspace_findConvention(byte* @name, Convention* @out, Error* @error);
        [DllImport(Library)] internal static extern float tspace_signFactor(Convention @convention);
        [DllImport(Library)] internal static extern float tspace_normalFactor(Convention @convention);
        [DllImport(Library)] internal static extern byte* tspace_methodName(uint @method);
        [DllImport(Library)] internal static extern uint tspace_initTangentOptions(TangentOptions* @options, uint @struct_size, Error* @error);
        [DllImport(Library)] internal static extern uint tspace_generateTangents(Mesh* @mesh, TangentOptions* @options, TangentOutput* @out, Execution* @execution, TangentReport* @report, Error* @error);
        [DllImport(Library)] internal static extern uint tspace_generateTangentsOfMeshes(MeshJob* @jobs, UIntPtr @job_count, Execution* @execution, Error* @error);
        [DllImport(Library)] internal static extern uint tspace_planTangents(Mesh* @mesh, TangentOptions* @options, Execution* @execution, IntPtr* @plan, Error* @error);
        [DllImport(Library)] internal static extern uint tspace_evaluateTangents(IntPtr @plan, Pose* @pose, TangentOutput* @out, Execution* @execution, TangentReport* @report, Error* @error);
        [DllImport(Library)] internal static extern uint tspace_describeTangentPlan(IntPtr @plan, TangentPlanInfo* @info, Error* @error);
        [DllImport(Library)] internal static extern void tspace_destroyTangentPlan(IntPtr @plan);
        [DllImport(Library)] internal static extern uint tspace_triangulate(Mesh* @mesh, Triangulation** @result, Error* @error);
        [DllImport(Library)] internal static extern void tspace_destroyTriangulation(Triangulation* @result);
        [DllImport(Library)] internal static extern FaceFrame tspace_faceFrame(Vec3* @positions, Vec2* @uvs);
        [DllImport(Library)] internal static extern FaceFrame tspace_faceFrameFromPath(Vec3* @positions, Vec2* @uvs);
        [DllImport(Library)] internal static extern float tspace_determinant(Frame @frame);
        [DllImport(Library)] internal static extern float tspace_frameSign(Frame @frame);
        [DllImport(Library)] internal static extern Vec3 tspace_rebuildBitangent(Vec3 @normal, Vec4 @tangent);
        [DllImport(Library)] internal static extern Frame tspace_orthonormalize(Frame @frame);
        [DllImport(Library)] internal static extern Vec4 tspace_packTangent(Frame @frame);
        [DllImport(Library)] internal static extern Frame tspace_basisFromNormal(Vec3 @unit_normal);
        [DllImport(Library)] internal static extern Mat3 tspace_tangentToObject(Frame @frame);
        [DllImport(Library)] internal static extern Mat3 tspace_objectToTangentOrthonormal(Frame @frame);
        [DllImport(Library)] internal static extern int tspace_objectToTangent(Frame @frame, Mat3* @out);
        [DllImport(Library)] internal static extern Vec3 tspace_transform(Mat3 @m, Vec3 @v);
        [DllImport(Library)] internal static extern Vec3 tspace_toTangentSpace(Frame @frame, Vec3 @direction);
        [DllImport(Library)] internal static extern Vec3 tspace_toObjectSpace(Frame @frame, Vec3 @direction);
        [DllImport(Library)] internal static extern Vec3 tspace_decodeNormal(Vec3 @texel, float @scale, uint @green);
        [DllImport(Library)] internal static extern Vec2 tspace_tileUv(Vec2 @uv, Vec2 @tiling, Vec2 @offset);
        [DllImport(Library)] internal static extern float tspace_lambert(Frame @frame, Vec3 @light_direction, Vec3 @tangent_space_normal);
        [DllImport(Library)] internal static extern Vec3 tspace_objectNormal(Frame @frame, Vec3 @tangent_space_normal);
        [DllImport(Library)] internal static extern Vec3 tspace_objectNormalMikktspace(Vec3 @interpolated_normal, Vec4 @interpolated_tangent, Vec3 @tangent_space_normal);
        [DllImport(Library)] internal static extern uint tspace_initNormalOptions(NormalOptions* @options, uint @struct_size, Error* @error);
        [DllImport(Library)] internal static extern uint tspace_generateNormals(Mesh* @mesh, NormalOptions* @options, Span @out, Execution* @execution, NormalReport* @report, Error* @error);
        [DllImport(Library)] internal static extern uint tspace_measurePositionNoise(Mesh* @mesh, Execution* @execution, PositionNoise* @noise, Error* @error);
        [DllImport(Library)] internal static extern uint tspace_initSanitizeOptions(SanitizeOptions* @options, uint @struct_size, Error* @error);
        [DllImport(Library)] internal static extern uint tspace_sanitizeTangents(Mesh* @mesh, SanitizeOptions* @options, Span @tangents, Execution* @execution, SanitizeReport* @report, Error* @error);
        [DllImport(Library)] internal static extern uint tspace_splitVertices(Indices* @indices, UIntPtr @vertex_count, UIntPtr @corner_count, CornerAttribute* @attributes, UIntPtr @attribute_count, Execution* @execution, SplitResult** @result, Error* @error);
        [DllImport(Library)] internal static extern void tspace_destroySplitResult(SplitResult* @result);
        [DllImport(Library)] internal static extern uint tspace_initIndexedFramesOptions(IndexedFramesOptions* @options, uint @struct_size, Error* @error);
        [DllImport(Library)] internal static extern uint tspace_makeIndexedFrames(Mesh* @mesh, IndexedFramesOptions* @options, Execution* @execution, IndexedFrames** @frames, Error* @error);
        [DllImport(Library)] internal static extern void tspace_destroyIndexedFrames(IndexedFrames* @frames);
        [DllImport(Library)] internal static extern uint tspace_planBuffers(IntPtr @plan, PlanBufferOptions* @options, Execution* @execution, PlanBuffers** @buffers, Error* @error);
        [DllImport(Library)] internal static extern void tspace_destroyPlanBuffers(PlanBuffers* @buffers);
        [DllImport(Library)] internal static extern UIntPtr tspace_frameBytes(uint @format);
        [DllImport(Library)] internal static extern FrameErrorBound tspace_frameErrorBound(uint @format);
        [DllImport(Library)] internal static extern uint tspace_packFrames(Span @normals, Span @tangents, uint @format, void* @out, UIntPtr @out_bytes, PackReport* @report, Error* @error);
        [DllImport(Library)] internal static extern uint tspace_unpackFrames(void* @bytes, UIntPtr @byte_count, uint @format, Span @normals, Span @tangents, Error* @error);
        [DllImport(Library)] internal static extern uint tspace_initWindingOptions(WindingOptions* @options, uint @struct_size, Error* @error);
        [DllImport(Library)] internal static extern uint tspace_mendWinding(Mesh* @mesh, WindingOptions* @options, byte* @turned, UIntPtr @turned_count, Execution* @execution, WindingReport* @report, Error* @error);
    }
}
