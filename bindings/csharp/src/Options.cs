// SPDX-License-Identifier: MIT
using System;
using System.Text;

namespace Tspace
{
    /// <summary>Reason for the failure of a call. The numbers are those of the C API, and are never reused.</summary>
    public enum ErrorCode
    {
        NullData = 1, CountMismatch = 2, IndexOutOfRange = 3, StrideTooSmall = 4, Misaligned = 5, TooLarge = 6,
        MissingAttribute = 7, InvalidOption = 8, OutOfMemory = 9, PlanMismatch = 10, Internal = 11
    }

    /// <summary>Error of a failed call, with a human-readable message and the location of the fault.</summary>
    public sealed class TspaceException : Exception
    {
        /// <summary>The kind of error.</summary>
        public ErrorCode Code { get; }
        /// <summary>Index of the invalid element, if any.</summary>
        public long? Element { get; }

        internal TspaceException(string message, ErrorCode code, long? element = null) : base(message)
        {
            Code = code;
            Element = element;
        }
    }

    /// <summary>Convention of a format or engine: determines the sign of tangents, and which side of a face is outside.
    /// There is no default.</summary>
    public readonly struct Convention
    {
        internal readonly Native.Convention Raw;

        private Convention(Native.Convention raw) { Raw = raw; }

        /// <summary>Returns a preset: "gltf", "opengl", "directx", "unreal", "unity", "blender" or "godot".</summary>
        public static unsafe Convention Preset(string name)
        {
            if (name == null) throw new ArgumentNullException(nameof(name));
            byte[] bytes = Encoding.UTF8.GetBytes(name + "\0");
            Native.Convention raw;
            Native.Error error;
            fixed (byte* text = bytes) Native.Check(Native.tspace_findConvention(text, &raw, &error), ref error);
            return new Convention(raw);
        }

        /// <summary>The mathematical convention: B points along increasing v, with the sign of the MikkTSpace
        /// reference.</summary>
        public static Convention OpenGL => Preset("opengl");
        /// <summary>glTF.</summary>
        public static Convention Gltf => Preset("gltf");
        /// <summary>Unity: left-handed, faces clockwise.</summary>
        public static Convention Unity => Preset("unity");
    }

    /// <summary>Options for tangents. A new instance holds the defaults.</summary>
    public sealed class TangentOptions
    {
        /// <summary>Determines the stored sign.</summary>
        public Convention Convention { get; set; }
        public Method Method { get; set; }
        public Ngons Ngons { get; set; }
        public FrameShape Frame { get; set; }
        /// <summary>Degrees; only for Mikktspace. Tangents of faces that differ by this or more are not
        /// averaged.</summary>
        public float AngularThresholdDeg { get; set; }
        public Pairing Pairing { get; set; }
        /// <summary>Number of refinement steps of Best after its fit: 0, 1 or 2.</summary>
        public int Refine { get; set; }
        /// <summary>Normalizes normals whose length differs from 1 by more than 0.00674.</summary>
        public bool NormalizeNormals { get; set; }
        /// <summary>Number of threads; int.MaxValue: one per core. Results have the same bits for any number.</summary>
        public int Threads { get; set; } = 1;

        public TangentOptions(Convention convention)
        {
            Native.TangentOptions raw = Prepared();
            Convention = convention;
            Method = (Method)raw.Method;
            Ngons = (Ngons)raw.Ngons;
            Frame = (FrameShape)raw.Frame;
            AngularThresholdDeg = raw.AngularThresholdDeg;
            Pairing = (Pairing)raw.Pairing;
            Refine = (int)raw.Refine;
        }

        private static unsafe Native.TangentOptions Prepared()
        {
            Native.TangentOptions raw;
            Native.Error error;
            Native.Check(Native.tspace_initTangentOptions(&raw, (uint)sizeof(Native.TangentOptions), &error), ref error);
            return raw;
        }

        internal Native.TangentOptions Raw()
        {
            Native.TangentOptions raw = Prepared();
            raw.Convention = Convention.Raw;
            raw.Method = (uint)Method;
            raw.Ngons = (uint)Ngons;
            raw.Frame = (uint)Frame;
            raw.AngularThresholdDeg = AngularThresholdDeg;
            raw.Pairing = (uint)Pairing;
            raw.Refine = (uint)Refine;
            raw.NormalizeNormals = NormalizeNormals ? 1u : 0u;
            // The C API rejects zero for both as uninitialized; no method uses both.
            if (AngularThresholdDeg == 0 && Refine == 0)
            {
                if (Method == Method.Best) raw.AngularThresholdDeg = 180;
                else raw.Refine = 1;
            }
            return raw;
        }

        internal static unsafe Native.Execution Execution(int threads)
        {
            if (threads < 1) throw new ArgumentOutOfRangeException(nameof(Threads), "Threads must be 1 or more");
            Native.Execution raw;
            Native.Error error;
            Native.Check(Native.tspace_initExecution(&raw, (uint)sizeof(Native.Execution), &error), ref error);
            raw.ThreadCount = threads == int.MaxValue ? uint.MaxValue : (uint)threads;
            return raw;
        }
    }

    /// <summary>Options for normals. A new instance holds the defaults.</summary>
    public sealed class NormalOptions
    {
        /// <summary>Convention whose handedness and winding define the outside of faces.</summary>
        public Convention Convention { get; set; }
        public NormalWeighting Weighting { get; set; }
        /// <summary>Degrees, 0..180: edges where face normals differ by more are hard. 180: no hard edges. -1: derived
        /// from the mesh.</summary>
        public float CreaseAngleDeg { get; set; }
        /// <summary>Welds vertices at the same position.</summary>
        public bool WeldPositions { get; set; }
        /// <summary>With WeldPositions: positions that differ by at most this in each coordinate are welded. 0: only
        /// equal positions. -1: twice the spacing of floats at the largest coordinate, applied only to positions with
        /// an edge of at least 32 times that length.</summary>
        public float WeldDistance { get; set; }
        /// <summary>Number of refinement steps of Best after its fit: 0, 1 or 2.</summary>
        public int Refine { get; set; }
        /// <summary>For noisy positions: 0: off; -1: the measured noise; up to 4: multiple of the measured
        /// noise.</summary>
        public float Denoise { get; set; }
        public int Threads { get; set; } = 1;

        public NormalOptions(Convention convention)
        {
            Native.NormalOptions raw = Prepared();
            Convention = convention;
            Weighting = (NormalWeighting)raw.Weighting;
            CreaseAngleDeg = raw.CreaseAngleDeg;
            WeldPositions = raw.WeldPositions != 0;
            WeldDistance = raw.WeldDistance;
            Refine = (int)raw.Refine;
            Denoise = raw.Denoise;
        }

        private static unsafe Native.NormalOptions Prepared()
        {
            Native.NormalOptions raw;
            Native.Error error;
            Native.Check(Native.tspace_initNormalOptions(&raw, (uint)sizeof(Native.NormalOptions), &error), ref error);
            return raw;
        }

        internal Native.NormalOptions Raw()
        {
            Native.NormalOptions raw = Prepared();
            raw.Convention = Convention.Raw;
            raw.Weighting = (uint)Weighting;
            raw.CreaseAngleDeg = CreaseAngleDeg;
            raw.WeldPositions = WeldPositions ? 1u : 0u;
            raw.WeldDistance = WeldDistance;
            // The C API rejects all-zero options as uninitialized; Flat, which is 0, does not use this option.
            raw.Refine = Weighting == NormalWeighting.Flat && Refine == 0 ? 1u : (uint)Refine;
            raw.Denoise = Denoise;
            return raw;
        }
    }
}
