// SPDX-License-Identifier: MIT
using System;
using System.Text;

namespace Tspace
{
    /// <summary>Why a call failed. The numbers are those of the C API, and never reused.</summary>
    public enum ErrorCode
    {
        NullData = 1, CountMismatch = 2, IndexOutOfRange = 3, StrideTooSmall = 4, Misaligned = 5, TooLarge = 6,
        MissingAttribute = 7, InvalidOption = 8, OutOfMemory = 9, PlanMismatch = 10, Internal = 11
    }

    /// <summary>What went wrong, in words for the person who has to mend it, and where.</summary>
    public sealed class TspaceException : Exception
    {
        /// <summary>The kind of error.</summary>
        public ErrorCode Code { get; }
        /// <summary>Index of the offending element, where there is one.</summary>
        public long? Element { get; }

        internal TspaceException(string message, ErrorCode code, long? element = null) : base(message)
        {
            Code = code;
            Element = element;
        }
    }

    /// <summary>What a format or engine means by its numbers: it decides the sign of tangents, and which side of a face is
    /// out. There is no default.</summary>
    public readonly struct Convention
    {
        internal readonly Native.Convention Raw;

        private Convention(Native.Convention raw) { Raw = raw; }

        /// <summary>"gltf", "opengl", "directx", "unreal", "unity", "blender" or "godot".</summary>
        public static unsafe Convention Preset(string name)
        {
            if (name == null) throw new ArgumentNullException(nameof(name));
            byte[] bytes = Encoding.UTF8.GetBytes(name + "\0");
            Native.Convention raw;
            Native.Error error;
            fixed (byte* text = bytes) Native.Check(Native.tspace_findConvention(text, &raw, &error), ref error);
            return new Convention(raw);
        }

        /// <summary>The mathematical reading: B along growing v, sign of the MikkTSpace reference.</summary>
        public static Convention OpenGL => Preset("opengl");
        /// <summary>glTF.</summary>
        public static Convention Gltf => Preset("gltf");
        /// <summary>Unity: left-handed, faces clockwise.</summary>
        public static Convention Unity => Preset("unity");
    }

    /// <summary>How tangents are computed. A new one has every default.</summary>
    public sealed class TangentOptions
    {
        /// <summary>Decides the stored sign.</summary>
        public Convention Convention { get; set; }
        public Method Method { get; set; }
        public Ngons Ngons { get; set; }
        public FrameShape Frame { get; set; }
        /// <summary>Degrees; Mikktspace alone. Faces whose tangents differ by this or more are not averaged.</summary>
        public float AngularThresholdDeg { get; set; }
        public Pairing Pairing { get; set; }
        /// <summary>Steps that Best takes after its fit: 0, 1 or 2.</summary>
        public int Refine { get; set; }
        /// <summary>Normals whose length is further from 1 than 0.00674 are scaled to length 1 first.</summary>
        public bool NormalizeNormals { get; set; }
        /// <summary>1, another number, or int.MaxValue for as many as there are cores. The bits are the same for any.</summary>
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
            // The C API refuses both of 0 as forgotten; no method looks at both.
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

    /// <summary>How normals are computed. A new one has every default.</summary>
    public sealed class NormalOptions
    {
        /// <summary>Its handedness and winding say which side is out.</summary>
        public Convention Convention { get; set; }
        public NormalWeighting Weighting { get; set; }
        /// <summary>Degrees, 0..180: faces are smoothed over an edge when their normals differ by no more. 180: never hard.
        /// -1: found by the mesh.</summary>
        public float CreaseAngleDeg { get; set; }
        /// <summary>Vertices at the same position are one point.</summary>
        public bool WeldPositions { get; set; }
        /// <summary>With WeldPositions: positions that differ by no more than this in each coordinate are one point. 0: only
        /// equal positions are. -1: twice the spacing of floats at the largest coordinate, where edges are 32 times that.</summary>
        public float WeldDistance { get; set; }
        /// <summary>Steps that Best takes after its fit: 0, 1 or 2.</summary>
        public int Refine { get; set; }
        /// <summary>For noisy positions: 0 is off, -1 by the measured noise, up to 4 so many times that.</summary>
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
            // The C API refuses all of 0 as forgotten; Flat, which is 0, does not look at this.
            raw.Refine = Weighting == NormalWeighting.Flat && Refine == 0 ? 1u : (uint)Refine;
            raw.Denoise = Denoise;
            return raw;
        }
    }
}
