// SPDX-License-Identifier: MIT
using System;
using System.Runtime.InteropServices;

namespace Tspace
{
    /// <summary>Indexed mesh with the same faces as the input. Corners share a vertex only if all their values are
    /// equal.</summary>
    public sealed class IndexedFrames
    {
        /// <summary>The new vertex of each corner.</summary>
        public uint[] Indices { get; internal set; }
        /// <summary>The old vertex that each new one copies: use it to gather other vertex attributes.</summary>
        public uint[] SourceVertices { get; internal set; }
        /// <summary>3 floats per new vertex.</summary>
        public float[] Normals { get; internal set; }
        /// <summary>4 floats per new vertex: unit tangent and sign.</summary>
        public float[] Tangents { get; internal set; }
        /// <summary>Number of output vertices, after splitting.</summary>
        public int VertexCount => SourceVertices.Length;
        public TangentReport Report { get; internal set; }
        /// <summary>Number of repaired tangents.</summary>
        public long MendedCount { get; internal set; }
    }

    /// <summary>Normals and tangents for meshes. Results are per corner: one vertex can need several tangents, so never
    /// write them through the old index list. MakeIndexedFrames creates a new one.</summary>
    public static unsafe class Frames
    {
        /// <summary>Version of the library: 10000 * major + 100 * minor + patch.</summary>
        public static int Version => (int)Native.tspace_version();

        /// <summary>Returns the number of corners of a mesh, after checking it. Tangents writes 4 floats per
        /// corner.</summary>
        public static int CornerCount(in Mesh mesh)
        {
            int count = 0;
            Pinned.Use(mesh, raw =>
            {
                Native.Error error;
                Native.Check(Native.tspace_validate(raw, &error), ref error);
                count = (int)Native.tspace_cornerCount(raw);
            });
            return count;
        }

        /// <summary>Returns 4 floats per corner: unit tangent T and the sign, B = sign * cross(N, T). The mesh needs
        /// normals, and UVs for all methods except Basis.</summary>
        public static float[] Tangents(in Mesh mesh, TangentOptions options)
        {
            float[] made = new float[4 * CornerCount(mesh)];
            Tangents(mesh, options, new Span<float>(made));
            return made;
        }

        /// <summary>Computes the same tangents as the overload that returns an array, writes them to the caller's
        /// memory, and returns counts. Optional outputs per corner, not written if empty: bitangents (3 floats),
        /// magnitudes (1), hasTangent (false if no face contributes to the corner).</summary>
        public static TangentReport Tangents(in Mesh mesh, TangentOptions options, Span<float> tangents,
                                             Span<float> bitangents = default, Span<float> magnitudesS = default,
                                             Span<float> magnitudesT = default, Span<bool> hasTangent = default)
        {
            if (options == null) throw new ArgumentNullException(nameof(options));
            Native.TangentOptions how = options.Raw();
            Native.Execution execution = TangentOptions.Execution(options.Threads);
            Native.TangentReport report = new Native.TangentReport { StructSize = (uint)sizeof(Native.TangentReport) };
            fixed (float* t = &MemoryMarshal.GetReference(tangents), b = &MemoryMarshal.GetReference(bitangents))
            fixed (float* u = &MemoryMarshal.GetReference(magnitudesS), v = &MemoryMarshal.GetReference(magnitudesT))
            fixed (bool* mask = &MemoryMarshal.GetReference(hasTangent))
            {
                Native.TangentOutput made = Output(t, Whole(tangents, 4));
                made.Bitangents = new Native.Span(b, Whole(bitangents, 3), 0);
                made.MagnitudesS = new Native.Span(u, magnitudesS.Length, 0);
                made.MagnitudesT = new Native.Span(v, magnitudesT.Length, 0);
                made.HasTangent = new Native.ByteSpan { Data = (byte*)mask, Count = (UIntPtr)(uint)hasTangent.Length };
                // Lambdas must not capture pointers to fixed locals, but may capture their addresses as numbers.
                IntPtr output = (IntPtr)(&made), counts = (IntPtr)(&report), choices = (IntPtr)(&how), run = (IntPtr)(&execution);
                Pinned.Use(mesh, raw =>
                {
                    Native.Error error;
                    uint code = Native.tspace_generateTangents(raw, (Native.TangentOptions*)choices,
                                                               (Native.TangentOutput*)output, (Native.Execution*)run,
                                                               (Native.TangentReport*)counts, &error);
                    Native.Check(code, ref error);
                });
            }
            return new TangentReport(report);
        }

        /// <summary>Returns 3 floats per corner: unit normals. Needs positions, and indices if the mesh has
        /// them.</summary>
        public static float[] Normals(in Mesh mesh, NormalOptions options)
        {
            if (options == null) throw new ArgumentNullException(nameof(options));
            float[] made = new float[3 * CornerCount(mesh)];
            Native.NormalOptions how = options.Raw();
            Native.Execution execution = TangentOptions.Execution(options.Threads);
            fixed (float* data = made)
            {
                Native.Span span = new Native.Span(data, made.Length / 3, 0);
                IntPtr choices = (IntPtr)(&how), run = (IntPtr)(&execution);
                Pinned.Use(mesh, raw =>
                {
                    Native.Error error;
                    uint code = Native.tspace_generateNormals(raw, (Native.NormalOptions*)choices, span,
                                                              (Native.Execution*)run, null, &error);
                    Native.Check(code, ref error);
                });
            }
            return made;
        }

        /// <summary>Repairs in place the tangents (4 floats per corner) that contain NaN or infinity, are zero, do not
        /// have unit length, are parallel to N, or have different signs within a face. Valid tangents keep all bits. Returns the number of repaired
        /// tangents.</summary>
        public static long Sanitize(in Mesh mesh, Span<float> tangents, bool orthogonalizeAll = false, int threads = 1)
        {
            Native.SanitizeOptions how;
            Native.Error failed;
            Native.Check(Native.tspace_initSanitizeOptions(&how, (uint)sizeof(Native.SanitizeOptions), &failed), ref failed);
            how.OrthogonalizeAll = orthogonalizeAll ? 1u : 0u;
            Native.Execution execution = TangentOptions.Execution(threads);
            Native.SanitizeReport report = new Native.SanitizeReport { StructSize = (uint)sizeof(Native.SanitizeReport) };
            fixed (float* data = &MemoryMarshal.GetReference(tangents))
            {
                Native.Span span = new Native.Span(data, Whole(tangents, 4), 0);
                IntPtr choices = (IntPtr)(&how), run = (IntPtr)(&execution), counts = (IntPtr)(&report);
                Pinned.Use(mesh, raw =>
                {
                    Native.Error error;
                    uint code = Native.tspace_sanitizeTangents(raw, (Native.SanitizeOptions*)choices, span,
                                                               (Native.Execution*)run, (Native.SanitizeReport*)counts,
                                                               &error);
                    Native.Check(code, ref error);
                });
            }
            return (long)report.MendedCount;
        }

        /// <summary>Computes missing normals (all normals with makeNormals) and tangents, repairs tangents (unless
        /// sanitize is false), and splits vertices whose corners differ. normals: options of the normals; null: the
        /// defaults.</summary>
        public static IndexedFrames MakeIndexedFrames(in Mesh mesh, TangentOptions options, NormalOptions normals = null,
                                                      bool makeNormals = false, bool sanitize = true)
        {
            if (options == null) throw new ArgumentNullException(nameof(options));
            Native.TangentOptions tangentsHow = options.Raw();
            Native.NormalOptions normalsHow = (normals ?? new NormalOptions(options.Convention)).Raw();
            Native.IndexedFramesOptions how;
            Native.Error failed;
            uint size = (uint)sizeof(Native.IndexedFramesOptions);
            Native.Check(Native.tspace_initIndexedFramesOptions(&how, size, &failed), ref failed);
            how.Tangents = &tangentsHow;
            how.Normals = &normalsHow;
            how.MakeNormals = makeNormals ? 1u : 0u;
            how.Sanitize = sanitize ? 1u : 0u;
            Native.Execution execution = TangentOptions.Execution(options.Threads);
            IntPtr choices = (IntPtr)(&how), run = (IntPtr)(&execution);
            IndexedFrames result = null;
            Pinned.Use(mesh, raw =>
            {
                Native.Error error;
                Native.IndexedFrames* made;
                uint code = Native.tspace_makeIndexedFrames(raw, (Native.IndexedFramesOptions*)choices,
                                                            (Native.Execution*)run, &made, &error);
                Native.Check(code, ref error);
                try
                {
                    int vertices = (int)made->VertexCount;
                    result = new IndexedFrames
                    {
                        Indices = new ReadOnlySpan<uint>(made->Indices, (int)made->CornerCount).ToArray(),
                        SourceVertices = new ReadOnlySpan<uint>(made->SourceVertices, vertices).ToArray(),
                        Normals = new ReadOnlySpan<float>(made->Normals, 3 * vertices).ToArray(),
                        Tangents = new ReadOnlySpan<float>(made->Tangents, 4 * vertices).ToArray(),
                        Report = new TangentReport(*made->TangentReport),
                        MendedCount = (long)made->SanitizeReport->MendedCount,
                    };
                }
                finally
                {
                    Native.tspace_destroyIndexedFrames(made);
                }
            });
            return result;
        }

        internal static Native.TangentOutput Output(float* tangents, int count)
        {
            return new Native.TangentOutput
            {
                StructSize = (uint)sizeof(Native.TangentOutput),
                Tangents = new Native.Span(tangents, count, 0),
            };
        }

        internal static int Whole(ReadOnlySpan<float> floats, int components)
        {
            if (floats.Length % components == 0) return floats.Length / components;
            throw new TspaceException(floats.Length + " floats cannot be divided into elements of " + components + " floats",
                                      ErrorCode.CountMismatch);
        }
    }

    /// <summary>Data of a mesh that does not change while it deforms. Immutable: many threads may evaluate
    /// it.</summary>
    public sealed unsafe class Plan : SafeHandle
    {
        /// <summary>Number of tangents of a pose.</summary>
        public int OutputCount { get; }

        /// <summary>Creates a plan. Inputs and errors are those of Frames.Tangents. The plan keeps no reference to the
        /// mesh.</summary>
        public Plan(in Mesh mesh, TangentOptions options) : base(IntPtr.Zero, true)
        {
            if (options == null) throw new ArgumentNullException(nameof(options));
            Native.TangentOptions how = options.Raw();
            Native.Execution execution = TangentOptions.Execution(options.Threads);
            IntPtr choices = (IntPtr)(&how), run = (IntPtr)(&execution), plan = IntPtr.Zero;
            Pinned.Use(mesh, raw =>
            {
                Native.Error error;
                IntPtr made;
                Native.Check(Native.tspace_planTangents(raw, (Native.TangentOptions*)choices, (Native.Execution*)run, &made,
                                                        &error), ref error);
                plan = made;
            });
            SetHandle(plan);
            Native.TangentPlanInfo info = new Native.TangentPlanInfo { StructSize = (uint)sizeof(Native.TangentPlanInfo) };
            Native.Error failed;
            Native.Check(Native.tspace_describeTangentPlan(plan, &info, &failed), ref failed);
            OutputCount = (int)info.OutputCount;
        }

        public override bool IsInvalid => handle == IntPtr.Zero;

        protected override bool ReleaseHandle()
        {
            Native.tspace_destroyTangentPlan(handle);
            return true;
        }

        /// <summary>Computes tangents for a pose, which must have as many positions and normals as the mesh. Writes
        /// 4 * OutputCount floats.</summary>
        public void Evaluate(Points positions, Points normals, Span<float> tangents, int threads = 1)
        {
            Native.Execution execution = TangentOptions.Execution(threads);
            bool held = false;
            try
            {
                DangerousAddRef(ref held);
                fixed (float* p = &MemoryMarshal.GetReference(positions.Floats))
                fixed (float* n = &MemoryMarshal.GetReference(normals.Floats))
                fixed (float* t = &MemoryMarshal.GetReference(tangents))
                {
                    Native.Pose pose = new Native.Pose
                    {
                        StructSize = (uint)sizeof(Native.Pose),
                        Positions = Pinned.Span(p, positions, 3),
                        Normals = Pinned.Span(n, normals, 3),
                    };
                    Native.TangentOutput made = Frames.Output(t, Frames.Whole(tangents, 4));
                    Native.Error error;
                    Native.Check(Native.tspace_evaluateTangents(handle, &pose, &made, &execution, null, &error), ref error);
                }
            }
            finally
            {
                if (held) DangerousRelease();
            }
        }
    }
}
