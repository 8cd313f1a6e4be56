// SPDX-License-Identifier: MIT
using System;
using System.Text;

namespace Tspace
{
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

        internal Convention(Native.Convention raw) { Raw = raw; }

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
        /// <summary>The convention of glTF: v = 0 is the top row of the image.</summary>
        public static Convention Gltf => Preset("gltf");
        /// <summary>Unity: left-handed, faces clockwise.</summary>
        public static Convention Unity => Preset("unity");
    }

    public sealed partial class TangentOptions
    {
        private Native.TangentOptions fields = Prepared();

        /// <summary>Number of threads; int.MaxValue: one per core. Results have the same bits for any
        /// number.</summary>
        public int Threads { get; set; } = 1;

        public TangentOptions(Convention convention) { Convention = convention; }

        private static unsafe Native.TangentOptions Prepared()
        {
            Native.TangentOptions raw;
            Native.Error error;
            Native.Check(Native.tspace_initTangentOptions(&raw, (uint)sizeof(Native.TangentOptions), &error), ref error);
            return raw;
        }

        internal Native.TangentOptions Raw()
        {
            Native.TangentOptions raw = fields;
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

    public sealed partial class NormalOptions
    {
        private Native.NormalOptions fields = Prepared();

        /// <summary>Number of threads; int.MaxValue: one per core. Results have the same bits for any
        /// number.</summary>
        public int Threads { get; set; } = 1;

        public NormalOptions(Convention convention) { Convention = convention; }

        private static unsafe Native.NormalOptions Prepared()
        {
            Native.NormalOptions raw;
            Native.Error error;
            Native.Check(Native.tspace_initNormalOptions(&raw, (uint)sizeof(Native.NormalOptions), &error), ref error);
            return raw;
        }

        internal Native.NormalOptions Raw()
        {
            Native.NormalOptions raw = fields;
            // The C API rejects all-zero options as uninitialized; Flat, which is 0, does not use this option.
            if (Weighting == NormalWeighting.Flat && Refine == 0) raw.Refine = 1;
            return raw;
        }
    }

    public readonly partial struct TangentReport
    {
        private readonly Native.TangentReport fields;

        internal TangentReport(in Native.TangentReport raw) { fields = raw; }
    }
}
