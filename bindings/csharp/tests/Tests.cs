// SPDX-License-Identifier: MIT
// Tests of the C# binding: each function Test... is one test, named after the tested property. Arguments: the table of cases
// that all languages share, and the folder of test data; without the folder the golden meshes are skipped with a message.
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
using System.Threading;
using Tspace;

internal sealed class Golden
{
    internal string Name;
    internal float Threshold;
    internal uint[] FaceSizes, Results;
    internal float[] Inputs;

    internal static Golden Read(string path)
    {
        byte[] bytes = File.ReadAllBytes(path);
        uint[] words = new uint[bytes.Length / 4];
        Buffer.BlockCopy(bytes, 0, words, 0, bytes.Length);
        int faces = (int)words[1], corners = (int)words[2];
        float[] inputs = new float[8 * corners];
        Buffer.BlockCopy(words, 4 * (5 + faces), inputs, 0, 4 * inputs.Length);
        float[] threshold = new float[1];
        Buffer.BlockCopy(words, 12, threshold, 0, 4);
        return new Golden
        {
            Name = Path.GetFileName(path), Threshold = threshold[0], Inputs = inputs,
            FaceSizes = words.Skip(5).Take(faces).ToArray(), Results = words.Skip(5 + faces + 8 * corners).ToArray()
        };
    }

    // docs/concepts/methods/mikktspace.md does not promise identical bits for other values.
    internal bool IsPromised => Inputs.All(value => Math.Abs(value) < 1.6e38f);

    internal Mesh Mesh()
    {
        return new Mesh
        {
            Positions = Points.Interleaved(Inputs, 0, 8), Normals = Points.Interleaved(Inputs, Math.Min(3, Inputs.Length), 8),
            Uvs = Points.Interleaved(Inputs, Math.Min(6, Inputs.Length), 8), FaceSizes = FaceSizes
        };
    }

    internal TangentOptions Options()
    {
        return new TangentOptions(Convention.OpenGL) { AngularThresholdDeg = Threshold, Ngons = Ngons.Skip };
    }
}

// Same layout as Unity's vector.
[StructLayout(LayoutKind.Sequential)]
internal struct Vector3
{
    public float X, Y, Z;
    public Vector3(float x, float y, float z) { X = x; Y = y; Z = z; }
}

[StructLayout(LayoutKind.Sequential)]
internal struct Vector2
{
    public float X, Y;
    public Vector2(float x, float y) { X = x; Y = y; }
}

internal static class Tests
{
    private static string cases, shared;

    private static void Check(bool condition, string what)
    {
        if (!condition) throw new Exception("not so: " + what);
    }

    private static TspaceException Fails(Action call)
    {
        try { call(); }
        catch (TspaceException error) { return error; }
        throw new Exception("no error");
    }

    private static uint Bits(float value) { return (uint)BitConverter.ToInt32(BitConverter.GetBytes(value), 0); }

    private static bool Same(float value, uint word)
    {
        bool wordIsNan = (word & 0x7fffffff) > 0x7f800000;
        return Bits(value) == word || (float.IsNaN(value) && wordIsNan);
    }

    private static List<Golden> Goldens()
    {
        string folder = shared == null ? null : Path.Combine(shared, "golden", "mikktspace");
        if (folder == null || !Directory.Exists(folder))
        {
            Console.WriteLine("  skipped: the golden meshes are missing");
            return new List<Golden>();
        }
        string[] paths = Directory.GetFiles(folder, "*.tsg");
        Array.Sort(paths, StringComparer.Ordinal);
        Check(paths.Length == 400, "there are 400 golden meshes");
        List<Golden> promised = paths.Select(Golden.Read).Where(golden => golden.IsPromised).ToList();
        Check(promised.Count > 300, "most of them have promised bits");
        return promised;
    }

    private static readonly Vector3[] Positions =
        { new Vector3(0, 0, 0), new Vector3(1, 0, 0), new Vector3(1, 1, 0), new Vector3(0, 1, 0) };
    private static readonly Vector3[] Normals = Enumerable.Repeat(new Vector3(0, 0, 1), 4).ToArray();
    private static readonly Vector2[] Uvs = { new Vector2(0, 1), new Vector2(1, 1), new Vector2(1, 0), new Vector2(0, 0) };
    private static readonly int[] Indices = { 0, 1, 2, 0, 2, 3 };

    private static Mesh Square()
    {
        return new Mesh
        {
            Positions = Points.Of(Positions), Normals = Points.Of(Normals), Uvs = Points.Of(Uvs), Indices = Tspace.Indices.Of(Indices)
        };
    }

    public static void TestEveryWordEqualsTheReference()
    {
        foreach (Golden golden in Goldens())
        {
            int corners = golden.Results.Length / 10;
            float[] t = new float[4 * corners], b = new float[3 * corners], s = new float[corners], u = new float[corners];
            foreach (int threads in new[] { 1, 3 })
            {
                TangentOptions options = golden.Options();
                options.Threads = threads;
                Frames.Tangents(golden.Mesh(), options, t, b, s, u);
                for (int c = 0; c < corners; ++c)
                {
                    float[] got = { t[4 * c], t[4 * c + 1], t[4 * c + 2], b[3 * c], b[3 * c + 1], b[3 * c + 2], s[c], u[c] };
                    bool same = Same(t[4 * c + 3], golden.Results[10 * c + 9]);
                    for (int i = 0; i < 8; ++i) same &= Same(got[i], golden.Results[10 * c + i]);
                    Check(same, golden.Name + " corner " + c);
                }
            }
        }
    }

    public static void TestAPlanGivesTheBitsOfTheCallInManyThreads()
    {
        foreach (Golden golden in Goldens().Take(60))
        {
            float[] expected = Frames.Tangents(golden.Mesh(), golden.Options());
            using (Plan plan = new Plan(golden.Mesh(), golden.Options()))
            {
                Check(4 * plan.OutputCount == expected.Length, "a plan says its output");
                Exception failed = null;
                Thread[] threads = Enumerable.Range(0, 3).Select(_ => new Thread(() =>
                {
                    try
                    {
                        float[] posed = new float[expected.Length];
                        plan.Evaluate(Points.Interleaved(golden.Inputs, 0, 8),
                                      Points.Interleaved(golden.Inputs, Math.Min(3, golden.Inputs.Length), 8), posed);
                        for (int i = 0; i < posed.Length; ++i) Check(Same(posed[i], Bits(expected[i])), golden.Name);
                    }
                    catch (Exception error) { failed = error; }
                })).ToArray();
                foreach (Thread thread in threads) thread.Start();
                foreach (Thread thread in threads) thread.Join();
                if (failed != null) throw failed;
            }
        }
    }

    public static void TestTheCasesOfAllLanguages()
    {
        Check(Cases.RunAll(File.ReadAllText(cases)) > 60, "this binding has most calls on arrays");
    }

    public static void TestInvalidInputIsAnErrorWithItsLocation()
    {
        TangentOptions gltf = new TangentOptions(Convention.Gltf);
        TspaceException error = Fails(() =>
        {
            Mesh mesh = Square();
            mesh.Indices = Tspace.Indices.Of(new[] { 0, 1, -1 });
            Frames.Tangents(mesh, gltf);
        });
        Check(error.Code == ErrorCode.IndexOutOfRange && error.Element == 2 && error.Message.Contains("corner 2"), error.Message);
        Check(Fails(() => Frames.Tangents(Square(), gltf, new float[24], hasTangent: new bool[5])).Code ==
              ErrorCode.CountMismatch, "a mask of another length");
        Check(Fails(() => Frames.Tangents(Square(), gltf, new float[4])).Code == ErrorCode.CountMismatch, "too few results");
        Check(Fails(() => Frames.Tangents(Square(), gltf, new float[23])).Code == ErrorCode.CountMismatch, "no whole results");
        Check(Fails(() =>
        {
            Mesh mesh = Square();
            mesh.Uvs = Points.Interleaved(new float[8], 0, 1);
            Frames.Tangents(mesh, gltf);
        }).Code == ErrorCode.StrideTooSmall, "a stride less than a point");
        Check(Fails(() => Frames.Tangents(Square(), new TangentOptions(default))).Code == ErrorCode.InvalidOption,
              "a convention has no default");
        Check(Fails(() => Convention.Preset("quake")).Code == ErrorCode.InvalidOption, "an unknown preset");
    }

    private static int Main(string[] arguments)
    {
        cases = arguments[0];
        shared = arguments.Length > 1 ? arguments[1] : null;
        int failed = 0;
        MethodInfo[] tests = typeof(Tests).GetMethods(BindingFlags.Public | BindingFlags.Static);
        foreach (MethodInfo test in tests.Where(test => test.Name.StartsWith("Test")))
        {
            try
            {
                test.Invoke(null, null);
                Console.WriteLine("ok: " + test.Name.Substring(4));
            }
            catch (TargetInvocationException error)
            {
                Console.WriteLine("FAILED: " + test.Name.Substring(4) + ": " + error.InnerException);
                ++failed;
            }
        }
        return failed == 0 ? 0 : 1;
    }
}
