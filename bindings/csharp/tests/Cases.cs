// SPDX-License-Identifier: MIT
// Runs the cases that all languages share (tests/cases/arrays.json), except those of calls that this binding lacks.
using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Reflection;
using Tspace;
using Members = System.Collections.Generic.Dictionary<string, object>;

/// <summary>Reader for the table: objects are Members, lists List, numbers double. Texts have no escapes.</summary>
internal sealed class JsonReader
{
    private readonly string text;
    private int at;

    internal JsonReader(string text) { this.text = text; }

    private bool Skip(string prefix)
    {
        while (char.IsWhiteSpace(text[at])) ++at;
        if (string.CompareOrdinal(text, at, prefix, 0, prefix.Length) != 0) return false;
        at += prefix.Length;
        return true;
    }

    private string Text()
    {
        int end = text.IndexOf('"', at);
        string found = text.Substring(at, end - at);
        at = end + 1;
        return found;
    }

    internal object Value()
    {
        if (Skip("null")) return null;
        if (Skip("true")) return true;
        if (Skip("false")) return false;
        if (Skip("\"")) return Text();
        if (Skip("["))
        {
            List<object> list = new List<object>();
            for (; !Skip("]"); Skip(",")) list.Add(Value());
            return list;
        }
        if (Skip("{"))
        {
            Members members = new Members();
            for (; !Skip("}"); Skip(","))
            {
                Skip("\"");
                string name = Text();
                Skip(":");
                members[name] = Value();
            }
            return members;
        }
        int first = at;
        while ("+-.eE0123456789".IndexOf(text[at]) >= 0) ++at;
        double number = double.Parse(text.Substring(first, at - first), CultureInfo.InvariantCulture);
        return text[first] == '-' ? -Math.Abs(number) : number;  // Mono parses "-0.0" as 0
    }
}

internal static class Cases
{
    private static readonly string[] Calls = { "tangents", "normals", "sanitize", "make_indexed_frames" };
    /// /// <summary>Features that this binding lacks; cases that need them are tested in other languages.</summary>
    private static readonly string[] Lacks =
        { "domain", "normal_indices", "uv_indices", "smoothing_groups", "orthogonalize_all" };

    private static object Get(Members members, string name) { return members.TryGetValue(name, out object found) ? found : null; }
    private static float[] Floats(object list)
    {
        return ((List<object>)list ?? new List<object>()).Select(one => (float)(double)one).ToArray();
    }
    private static uint[] Integers(object list)
    {
        return ((List<object>)list ?? new List<object>()).Select(one => (uint)(double)one).ToArray();
    }
    private static string Pascal(string name)
    {
        return string.Concat(name.Split('_').Select(part => char.ToUpperInvariant(part[0]) + part.Substring(1)));
    }

    private static string Snake(string name)
    {
        return string.Concat(name.Select((one, i) => char.IsUpper(one) ? (i > 0 ? "_" : "") + char.ToLowerInvariant(one) : one.ToString()));
    }

    private static Mesh MeshOf(Members arrays)
    {
        Mesh mesh = new Mesh
        {
            Positions = Points.Of(new ReadOnlySpan<float>(Floats(Get(arrays, "positions")))),
            Normals = Points.Of(new ReadOnlySpan<float>(Floats(Get(arrays, "normals")))),
            Uvs = Points.Of(new ReadOnlySpan<float>(Floats(Get(arrays, "uvs")))),
            FaceSize = (int)(double)(Get(arrays, "face_size") ?? 0.0), FaceSizes = Integers(Get(arrays, "face_sizes"))
        };
        if (arrays.ContainsKey("indices")) mesh.Indices = Indices.Of(Integers(arrays["indices"]));
        return mesh;
    }

    /// <summary>Sets the given options that are properties of `options`; the others are arguments of calls.</summary>
    private static T With<T>(T options, Members given)
    {
        foreach (KeyValuePair<string, object> option in given)
        {
            PropertyInfo property = typeof(T).GetProperty(Pascal(option.Key));
            if (property == null || option.Key == "convention") continue;
            Type type = property.PropertyType;
            object value = type.IsEnum ? Enum.Parse(type, Pascal((string)option.Value)) : Convert.ChangeType(option.Value, type);
            property.SetValue(options, value);
        }
        return options;
    }

    private static Members Run(string call, Members arrays, Members options)
    {
        Mesh mesh = MeshOf(arrays);
        Convention convention = options.ContainsKey("convention") ? Convention.Preset((string)options["convention"]) : default;
        if (call == "sanitize")
        {
            float[] repaired = Floats(options["tangents"]);
            long count = Frames.Sanitize(mesh, repaired);
            return new Members { ["tangents"] = repaired, ["report"] = new Members { ["mended_count"] = (double)count } };
        }
        if (call == "normals") return new Members { ["normals"] = Frames.Normals(mesh, With(new NormalOptions(convention), options)) };
        TangentOptions how = With(new TangentOptions(convention), options);
        if (call == "make_indexed_frames")
        {
            Func<string, bool, bool> isSet = (name, otherwise) => (bool)(Get(options, name) ?? otherwise);
            IndexedFrames frames = Frames.MakeIndexedFrames(mesh, how, null, isSet("make_normals", false), isSet("sanitize", true));
            return new Members
            {
                ["indices"] = frames.Indices, ["source_vertices"] = frames.SourceVertices, ["normals"] = frames.Normals,
                ["tangents"] = frames.Tangents, ["tangents_report"] = Fields(frames.Report)
            };
        }
        int corners = Frames.CornerCount(mesh);
        float[] t = new float[4 * corners], b = new float[3 * corners], s = new float[corners], u = new float[corners];
        bool[] has = new bool[corners];
        TangentReport report = Frames.Tangents(mesh, how, t, b, s, u, has);
        using (Plan plan = new Plan(mesh, how))
        {
            float[] posed = new float[4 * corners];
            plan.Evaluate(mesh.Positions, mesh.Normals, posed);
            if (!posed.SequenceEqual(t)) throw new Exception("a plan gives other tangents");
        }
        return new Members
        {
            ["tangents"] = t, ["bitangents"] = b, ["magnitudes_s"] = s, ["magnitudes_t"] = u, ["report"] = Fields(report),
            ["has_tangent"] = has.Select(one => one ? 1u : 0u).ToArray()
        };
    }

    private static Members Fields(TangentReport report)
    {
        return typeof(TangentReport).GetProperties().ToDictionary(field => Snake(field.Name), field => (object)Convert.ToDouble(field.GetValue(report)));
    }

    private static bool Same(object got, object wanted)
    {
        if (got is uint[] list) return list.SequenceEqual(Integers(wanted));
        if (got is float[] floats)
            return floats.Select(BitConverter.GetBytes).SelectMany(one => one).SequenceEqual(Floats(wanted).Select(BitConverter.GetBytes).SelectMany(one => one));
        return ((Members)got).All(field => !((Members)wanted).ContainsKey(field.Key) || field.Value.Equals(((Members)wanted)[field.Key]));
    }

    /// <summary>Runs all cases, and returns how many there were; throws for the first that fails.</summary>
    internal static int RunAll(string json)
    {
        Members table = (Members)new JsonReader(json).Value(), meshes = (Members)table["meshes"];
        int count = 0;
        foreach (Members one in (List<object>)table["cases"])
        {
            string call = (string)one["call"], name = (string)one["name"];
            Members arrays = new Members(one.ContainsKey("mesh") ? (Members)meshes[(string)one["mesh"]] : new Members());
            foreach (KeyValuePair<string, object> change in (Members)Get(one, "change") ?? new Members()) arrays[change.Key] = change.Value;
            Members options = (Members)Get(one, "options") ?? new Members();
            if (!Calls.Contains(call) || Lacks.Any(lack => options.ContainsKey(lack) || arrays.ContainsKey(lack))) continue;
            ++count;
            Members made = null;
            TspaceException thrown = null;
            try { made = Run(call, arrays, options); }
            catch (TspaceException error) { thrown = error; }
            Members expected = (Members)Get(one, "error");
            if (expected == null != (thrown == null)) throw new Exception(name + ": " + (thrown?.Message ?? "no error"));
            if (expected != null)
            {
                bool isSame = thrown.Code.ToString() == Pascal((string)expected["code"]) &&
                              (!expected.ContainsKey("element") || thrown.Element == (long)(double)expected["element"]);
                if (!isSame) throw new Exception(name + ": " + thrown.Code + " " + thrown.Element + " " + thrown.Message);
                continue;
            }
            foreach (KeyValuePair<string, object> output in (Members)one["gives"])
                if (made.ContainsKey(output.Key) && !Same(made[output.Key], output.Value)) throw new Exception(name + ": " + output.Key);
        }
        return count;
    }
}
