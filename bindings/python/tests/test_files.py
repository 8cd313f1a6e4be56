# SPDX-License-Identifier: MIT
"""Model files, on disk and in memory: results, reports as objects, and rejected input."""

import errno
import gc
import math
import os
import re
import tempfile
import unittest
from pathlib import Path

import numpy
import tspace
from glb import make_glb, read_glb
from support import needs_shared, same_bits, torus


def by_library(shape):
    return tspace.make_indexed_frames(*shape, convention="gltf")


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.shape = torus(10, 12)
        self.plain = make_glb(self.shape)
        self.framed = tspace.generate_bytes(self.plain)


class Generate(Files):
    def test_a_file_gets_the_tangents_of_the_library(self):
        source, target = self.folder / "plain.glb", self.folder / "framed.glb"
        source.write_bytes(self.plain)
        report = tspace.generate_file(source, str(target))
        self.assertTrue(report.ok and report.changed and report.exit_code == 0)
        self.assertEqual(report.totals.actions.generated, 1)
        self.assertEqual(report.primitives[0].triangles, 240)
        self.assertEqual(report.json["primitives"][0]["triangles"], 240)
        gltf, read = read_glb(target.read_bytes())
        primitive = gltf["meshes"][0]["primitives"][0]
        tangents = read(primitive["attributes"]["TANGENT"])[read(primitive["indices"])[:, 0]]
        made = by_library(self.shape)
        self.assertTrue(same_bits(tangents, made.tangents[made.indices]))

    def test_bytes_give_the_results_of_files(self):
        source, target = self.folder / "plain.glb", self.folder / "framed.glb"
        source.write_bytes(self.plain)
        tspace.generate_file(source, target, method="best", threads=2)
        for data in (
            self.plain,
            bytearray(self.plain),
            memoryview(self.plain),
            numpy.frombuffer(self.plain, numpy.uint8),
        ):
            made = tspace.generate_bytes(data, method="best")
            self.assertEqual(made, target.read_bytes())
            self.assertEqual(made.report.primitives[0].tangents.triangles, 240)
        dry = tspace.generate_bytes(self.plain, dry_run=True)
        self.assertEqual(dry, b"")
        self.assertTrue(dry.report.changed)

    def test_referenced_files_are_requested(self):
        text, data = make_glb(self.shape, uri="parts/a%20b.bin")
        asked = []

        def find(path):
            asked.append(path)
            return data

        by_function = tspace.generate_bytes(text, name="m.gltf", find_file=find)
        self.assertEqual(set(asked), {"parts/a b.bin"})
        by_dict = tspace.generate_bytes(text, name="m.gltf", find_file={"parts/a b.bin": bytearray(data)})
        self.assertEqual(by_dict, by_function)
        for missing in (None, {}, lambda path: None):
            with self.assertRaises(tspace.FileError) as caught:
                tspace.generate_bytes(text, name="m.gltf", find_file=missing)
            self.assertEqual(caught.exception.code, "invalidFile")

    def test_exceptions_of_find_file_are_propagated(self):
        text, _ = make_glb(self.shape, uri="a.bin")

        class Mine(Exception):
            pass

        def find(path):
            raise Mine(path)

        with self.assertRaisesRegex(Mine, "a.bin"):
            tspace.check(text, find_file=find)
        with self.assertRaisesRegex(TypeError, "a.bin.*must be bytes"):
            tspace.check(text, find_file=lambda path: 7)
        with self.assertRaisesRegex(TypeError, "find_file"):
            tspace.check(text, find_file=7)

    def test_green_is_inverted_and_restored(self):
        needs_shared("models")
        image = next(path for path in sorted(needs_shared("models").rglob("*.png")) if path.stat().st_size < 300000)
        once = tspace.flip_green_bytes(image.read_bytes())
        self.assertNotEqual(once, image.read_bytes())
        tspace.flip_green_file(image, self.folder / "once.png")
        self.assertEqual((self.folder / "once.png").read_bytes(), once)
        twice = tspace.flip_green_bytes(once)
        self.assertEqual(tspace.flip_green_bytes(twice), once)


    def test_heights_become_normals(self):
        image = next(path for path in sorted(needs_shared("models").rglob("*.png")) if path.stat().st_size < 300000)
        report = tspace.height_to_normal_file(image, self.folder / "normal.png", strength=2, bits=8, threads=2)
        self.assertEqual((report.bits, report.dry_run), (8, False))
        self.assertEqual((self.folder / "normal.png").read_bytes()[1:4], b"PNG")
        with self.assertRaisesRegex(tspace.UnknownOptionError, "strength"):
            tspace.height_to_normal_file(image, self.folder / "normal.png", strong=2)
        with self.assertRaises(tspace.ReadWriteError):
            tspace.height_to_normal_file(self.folder / "none.png", self.folder / "normal.png")

    def test_a_normal_map_is_converted(self):
        image = next(path for path in sorted(needs_shared("models").rglob("*.png")) if path.stat().st_size < 300000)
        normal, opposite, back = (self.folder / name for name in ("normal.png", "opposite.png", "back.png"))
        tspace.height_to_normal_file(image, normal, strength=2)
        report = tspace.convert_map_file(normal, opposite, to_convention="directx", threads=2)
        self.assertEqual((report.bits, report.dry_run, report.to), (16, False, None))
        self.assertGreater(report.max_change_deg, 0)
        tspace.convert_map_file(opposite, back, from_convention="directx")
        self.assertEqual(normal.read_bytes(), back.read_bytes())
        with self.assertRaisesRegex(tspace.Error, "mesh"):
            tspace.convert_map_file(normal, back, from_="object")
        with self.assertRaisesRegex(tspace.UnknownOptionError, "padding"):
            tspace.convert_map_file(normal, back, pading=2)

    def test_a_normal_map_becomes_a_texture(self):
        image = next(path for path in sorted(needs_shared("models").rglob("*.png")) if path.stat().st_size < 300000)
        normal = self.folder / "normal.png"
        tspace.height_to_normal_file(image, normal, strength=2)
        report = tspace.compress_map_file(normal, self.folder / "normal.ktx2", quality="quick", no_levels=True, threads=2)
        self.assertEqual((report.format, report.levels, report.bits_before), ("BC5", 1, 16))
        self.assertLessEqual(report.mean_error_deg, report.p99_error_deg)
        texture = tspace.compress_map_bytes(normal.read_bytes(), quality="quick", no_levels=True)
        self.assertEqual(texture, (self.folder / "normal.ktx2").read_bytes())
        self.assertEqual(texture.report.mean_error_deg, report.mean_error_deg)
        with self.assertRaisesRegex(tspace.UnknownOptionError, "quality"):
            tspace.compress_map_bytes(b"", qualitty="quick")
        with self.assertRaisesRegex(tspace.Error, "basisu"):
            tspace.compress_map_bytes(normal.read_bytes(), format="uastc")


def sheet(cells, bump, with_uvs):
    """Returns an OBJ of cells x cells quads over the unit square, with a wavy height."""
    at = [(x / cells, y / cells) for y in range(cells + 1) for x in range(cells + 1)]
    lines = ["s 1"] + [f"v {x} {y} {bump * math.sin(12 * x) * math.sin(9 * y)}" for x, y in at]
    lines += [f"vt {x} {y}" for x, y in at] if with_uvs else []
    for corner in (y * (cells + 1) + x + 1 for y in range(cells) for x in range(cells)):
        vertices = (corner, corner + 1, corner + cells + 2, corner + cells + 1)
        lines.append("f " + " ".join(f"{v}/{v}" if with_uvs else str(v) for v in vertices))
    return "\n".join(lines) + "\n"


class Bakes(Files):
    def setUp(self):
        super().setUp()
        self.low, self.high = self.folder / "low.obj", self.folder / "high.obj"
        self.low.write_text(sheet(4, 0, True))
        self.high.write_text(sheet(40, 0.02, False))

    def need_rays(self):
        """Skips the test if Embree is not installed."""
        try:
            tspace.bake_file(self.low, self.high, self.folder / "small.png", size=8)
        except tspace.FileError as error:
            if "Embree" not in str(error):
                raise
            self.skipTest(str(error))

    def test_a_high_poly_becomes_maps(self):
        self.need_rays()
        normal = self.folder / "normal.png"
        report = tspace.bake_file(self.low, str(self.high), normal, size="32x16", bits=8, maps=["normal", "ao"], samples=16)
        baked = report.files[0]
        self.assertEqual((report.exit_code, report.low_triangles, report.findings), (0, 32, []))
        self.assertEqual((baked.width, baked.height, baked.bits, baked.texels.missed), (32, 16, 8, 0))
        self.assertLess(baked.error.mean_deg, 5)
        self.assertEqual([layer.map for layer in baked.maps], ["ao"])
        self.assertEqual(report.output_files, [str(normal), str(self.folder / "normal_ao.png")])
        for path in report.output_files:
            self.assertEqual(Path(path).read_bytes()[1:4], b"PNG")
        content = normal.read_bytes()
        tspace.bake_file(self.low, self.high, normal, size="32x16", bits=8, threads=2)
        self.assertEqual(normal.read_bytes(), content)

    def test_a_bake_without_hits_reports_the_cause_and_writes_nothing(self):
        self.need_rays()
        far = self.folder / "far.obj"
        far.write_text("".join(f"v {x} {y} 1000\n" for x, y in ((0, 0), (1, 0), (0, 1))) + "f 1 2 3\n")
        report = tspace.bake_file(self.low, far, self.folder / "normal.png", size=32, reach=0.1)
        self.assertEqual((report.exit_code, report.output_files), (1, []))
        self.assertNotEqual(report.findings, [])
        self.assertFalse((self.folder / "normal.png").exists())

    def test_a_model_without_normals_is_finished(self):
        output, page = self.folder / "out.glb", self.folder / "page.html"
        report = tspace.finish_file(self.low, output, html=page)
        self.assertEqual((report.exit_code, report.bake, report.low), (0, None, ""))
        self.assertEqual(report.output_files, [str(output), str(page)])
        self.assertEqual(report.output_bytes, output.stat().st_size)
        model = report.models[0]
        self.assertTrue(model.made.primitives[0].normals_generated)
        self.assertEqual((model.made.exit_code, model.before.exit_code, report.check.exit_code), (0, 0, 0))
        self.assertEqual([finding.code for finding in report.check], [finding.code for finding in tspace.check(output)])
        self.assertEqual([finding.code for finding in model.before], [finding.code for finding in tspace.check(self.low)])

    def test_a_low_poly_is_finished_with_all_maps(self):
        self.need_rays()
        output = self.folder / "out.glb"
        report = tspace.finish_file(self.high, output, low=self.low, size=32, samples=4)
        self.assertEqual((len(report.models), report.low, report.bake.files[0].width), (2, str(self.low), 32))
        self.assertEqual(report.bake.high, str(self.high))
        self.assertTrue(all(Path(path).exists() for path in report.output_files))

    def test_invalid_calls_are_reported(self):
        out = self.folder / "out.png"
        with self.assertRaisesRegex(tspace.UnknownOptionError, "size"):
            tspace.bake_file(self.low, self.high, out, sise=32)
        with self.assertRaisesRegex(tspace.UnknownOptionError, "crease"):
            tspace.finish_file(self.high, self.folder / "out.glb", high=self.high)
        with self.assertRaisesRegex(tspace.InputError, "^size 0: must"):
            tspace.bake_file(self.low, self.high, out, size=0)
        with self.assertRaises(tspace.InputError) as caught:
            tspace.finish_file(self.high, self.folder / "out.gltf")
        self.assertEqual(caught.exception.code, "invalidOption")
        self.assertEqual(list(self.folder.glob("out*")), [])


class Failures(Files):
    def test_a_missing_file_is_a_file_not_found_error_with_its_name(self):
        missing = str(self.folder / "none.glb")
        output = str(self.folder / "out.glb")
        calls = (
            lambda: tspace.generate_file(missing, output),
            lambda: tspace.check(missing),
            lambda: tspace.inspect(missing),
            lambda: tspace.identify(missing),
            lambda: tspace.diff(missing, missing),
            lambda: tspace.flip_green_file(missing, self.folder / "out.png"),
            lambda: tspace.convert_map_file(missing, self.folder / "out.png"),
            lambda: tspace.height_to_normal_file(missing, self.folder / "out.png"),
            lambda: tspace.bake_file(missing, missing, self.folder / "out.png"),
            lambda: tspace.finish_file(missing, output),
        )
        for call in calls:
            with self.assertRaises(FileNotFoundError) as caught:
                call()
            error = caught.exception
            self.assertIsInstance(error, tspace.ReadWriteError)
            self.assertEqual((error.errno, error.filename), (errno.ENOENT, missing))
            self.assertIn("none.glb", str(error))

    def test_folders_and_unreadable_files_are_reported(self):
        with self.assertRaises(tspace.ReadWriteError) as caught:
            tspace.check(str(self.folder))
        self.assertEqual((caught.exception.errno, caught.exception.filename), (errno.EISDIR, str(self.folder)))
        if os.geteuid() != 0:  # the superuser may read every file
            secret = self.folder / "secret.glb"
            secret.write_bytes(self.framed)
            secret.chmod(0)
            with self.assertRaises(PermissionError):
                tspace.check(secret)

    def test_reports_have_a_one_line_repr(self):
        text = repr(tspace.check(self.framed))
        self.assertTrue(text.startswith("CheckReport(input=") and "\n" not in text and len(text) < 600, text)


class Look(Files):
    def test_bytes_of_an_obj_without_a_name_are_rejected_with_advice(self):
        obj = b"# a triangle\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
        for name in (None, "model", "model.glb"):
            with self.assertRaisesRegex(tspace.FileError, 'name="model.obj"'):
                tspace.check(obj, name=name)
        self.assertTrue(tspace.inspect(obj, name="a.obj").ok)
        for other in (b"hello", b""):
            with self.assertRaises(tspace.FileError) as failed:
                tspace.check(other)
            self.assertNotIn("name=", str(failed.exception))

    def test_check_gives_findings_as_objects(self):
        made = by_library(self.shape)
        arrays = [array[made.source_vertices] for array in (self.shape.positions, self.shape.normals, self.shape.uvs)]
        shape = type(self.shape)(*arrays, made.indices)
        half = numpy.where(arrays[0][:, :1] > 0, numpy.float32([[1, 1, 1, -1]]), numpy.float32(1))
        broken = make_glb(shape, made.tangents * half)
        report = tspace.check(broken)
        self.assertTrue(report)
        finding = report.findings[0]
        self.assertEqual((len(report), list(report)), (len(report.findings), report.findings))
        self.assertEqual((finding.code, finding.severity), ("signsWrong", "error"))
        self.assertEqual((finding.mesh, finding.primitive, finding.unit), (0, 0, "vertices"))
        self.assertTrue(0 < finding.count < finding.total == len(made.tangents))
        self.assertTrue(finding.message and finding.remedy and isinstance(finding.vertices, tuple))
        (command,) = finding.commands
        self.assertEqual((command.verb, command.inputs, command.placeholders), ("generate", (), ()))
        self.assertEqual([(option.name, option.value) for option in command.options], [("repair", "")])
        self.assertIn(command.line, finding.remedy)
        self.assertIn("tspace.generate_file(model, output, repair=True)", tspace.remedy_text(finding))
        self.assertNotIn("--", tspace.remedy_text(finding))
        self.assertEqual(hash(finding), hash(report.findings[0]), "it can be in a set")
        self.assertEqual(report.counts.error, len([f for f in report.findings if f.severity == "error"]))
        self.assertEqual(report.exit_code, 1)
        quiet = tspace.check(broken, ignore=["signsWrong"])
        self.assertNotIn("signsWrong", [f.code for f in quiet.findings])

    def test_identify_names_the_method(self):
        report = tspace.identify(self.framed)
        self.assertEqual((report.explanations[0].method, report.explanations[0].signs), ("mikktspace", "gltf"))
        self.assertEqual(report.method, "mikktspace")
        self.assertIn("mikktspace", report.verdict.lower())
        self.assertIsNone(tspace.identify(self.plain).method)

    def test_diff_measures_angles(self):
        self.assertTrue(tspace.diff(self.framed, self.framed).is_within_tolerance)
        (self.folder / "a.glb").write_bytes(self.framed)
        (self.folder / "b.glb").write_bytes(tspace.generate_bytes(self.plain, method="best"))
        report = tspace.diff(self.folder / "a.glb", self.folder / "b.glb", tolerance=1e-3)
        self.assertFalse(report.is_within_tolerance)
        self.assertGreater(report.tangents.max_deg, 0.01)
        self.assertEqual(report.sign_changes, 0)
        self.assertEqual(report, tspace.diff(self.folder / "a.glb", self.folder / "b.glb", tolerance=1e-3))

    def test_inspect_describes_the_file(self):
        report = tspace.inspect(self.plain, name="plain.glb")
        self.assertEqual(report.input, "plain.glb")
        self.assertIn("meshes", dir(report))

    def test_reports_list_their_members(self):
        with self.assertRaisesRegex(AttributeError, "no member .color.*verdict"):
            tspace.identify(self.framed).color


class Refused(Files):
    def refuses(self, kind, words, call, *arguments, **options):
        with self.assertRaisesRegex(kind, words) as caught:
            call(*arguments, **options)
        self.assertTrue(tspace.inspect(self.framed).ok)
        return caught.exception

    def test_missing_and_unwritable_files(self):
        missing = self.folder / "missing.glb"
        error = self.refuses(OSError, "missing.glb", tspace.generate_file, missing, self.folder / "out.glb")
        self.assertIsInstance(error, tspace.FileError)
        self.assertEqual(error.code, "cannotRead")
        self.assertFalse((self.folder / "out.glb").exists())
        (self.folder / "a.glb").write_bytes(self.plain)
        target = self.folder / "no" / "such" / "out.txt"
        self.refuses(tspace.Error, "", tspace.generate_file, self.folder / "a.glb", target)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["a.glb"])

    def test_arguments_of_wrong_types(self):
        for value in (None, 7, 1.5, object(), [1]):
            self.refuses(TypeError, "model must be bytes", tspace.check, value)
            self.refuses(TypeError, "input must be a path", tspace.generate_file, value, "out.glb")
            self.refuses(TypeError, "data must be bytes", tspace.generate_bytes, value)
        self.refuses(TypeError, "data must be bytes", tspace.generate_bytes, "chair.glb")
        self.refuses(TypeError, "both", tspace.diff, "a.glb", self.plain)
        self.refuses(tspace.InputError, "^angle 900: ", tspace.check, self.plain, angle=900)
        self.refuses(TypeError, "in memory", tspace.check, "a.glb", name="b.glb")
        self.refuses(ValueError, "input", tspace.generate_file, "a\0b.glb", "out.glb")
        self.refuses(TypeError, "name", tspace.check, self.plain, name=b"a")

    def test_options(self):
        for call in (tspace.generate_bytes, tspace.check, tspace.identify, tspace.inspect):
            error = self.refuses(TypeError, "unknown option .treshold.; .*memory_limit", call, self.plain, treshold=1)
            self.assertEqual(error.code, "invalidOption")
        self.refuses(tspace.InputError, "treshold.*worst", tspace.diff, self.plain, self.plain, treshold=1)
        self.refuses(TypeError, "values of options", tspace.generate_bytes, self.plain, method=object())

    def test_messages_name_options_as_arguments(self):
        out = self.folder / "out.png"
        calls = (
            (tspace.generate_bytes, (self.plain,), {"memory_limit": "3K"}, "^memory_limit 3K: "),
            (tspace.generate_bytes, (self.plain,), {"crease": 400}, "^crease 400: "),
            (tspace.generate_bytes, (self.plain,), {"weld_distance": -1}, "^weld_distance -1: .*auto"),
            (tspace.generate_bytes, (self.plain,), {"pack_drop": "all"}, "^pack_drop needs pack$"),
            (tspace.generate_bytes, (self.plain,), {"repair": True, "overwrite": True}, "^repair and overwrite cannot be used together$"),
            (tspace.diff, (self.plain, self.plain), {"worst": -1}, "^worst -1: "),
            (tspace.compress_map_file, (out, out), {"roughness_factor": 1}, "^roughness_factor needs roughness$"),
            (tspace.convert_map_file, (out, out), {"from_": "word"}, "^from_ word: "),
            (tspace.convert_map_file, (out, out), {"to_mesh": "a.glb"}, "^to_mesh needs mesh"),
        )
        for call, arguments, options, words in calls:
            with self.subTest(options=options):
                error = self.refuses(tspace.InputError, words, call, *arguments, **options)
                self.assertNotIn("--", str(error))
        # Words in quotes are the caller's, such as paths.
        path = str(self.folder / "a's --crease weld_auto.glb")
        self.refuses(tspace.FileError, re.escape(f"'{path}'"), tspace.check, path)

    def test_malformed_bytes(self):
        error = self.refuses(tspace.FileError, "", tspace.check, b"no model")
        self.assertIn(error.code, ("invalidFile", "unsupportedFile"))
        self.refuses(tspace.FileError, "", tspace.check, b"")
        for length in (1, 11, 20, 100, len(self.framed) // 2, len(self.framed) - 1):
            self.refuses(tspace.FileError, "", tspace.generate_bytes, self.framed[:length])

    def test_a_buffer_cannot_be_resized_during_a_call(self):
        text, data = make_glb(self.shape, uri="a.bin")
        model = bytearray(text)

        def find(path):
            with self.assertRaises(BufferError):
                model.clear()
            return data

        self.assertTrue(tspace.generate_bytes(model, name="m.gltf", find_file=find))
        model.clear()

    def test_corrupt_files_raise_or_are_read(self):
        paths = [path for path in sorted(needs_shared("bad").rglob("*")) if path.suffix in (".glb", ".gltf", ".obj")]
        small = [path for path in paths if path.stat().st_size < 100000][::3]
        self.assertGreater(len(small), 50)
        refused = 0
        for path in small:
            try:
                tspace.generate_bytes(path.read_bytes(), name=path.name, all=True)
            except tspace.FileError as error:
                refused += 1
                self.assertTrue(str(error))
            except MemoryError:
                refused += 1
        self.assertGreater(refused, 20)

    @unittest.skipUnless(Path("/proc/self/statm").exists(), "memory is read from /proc")
    def test_no_file_is_left_behind(self):
        def work():
            for _ in range(25):
                tspace.check(tspace.generate_bytes(self.plain))
                for broken in (self.framed[:-2000], b"no model"):
                    try:
                        tspace.generate_bytes(broken)
                    except tspace.FileError:
                        pass
            gc.collect()
            return int(Path("/proc/self/statm").read_text().split()[1]) * 4096

        work()
        before = work()
        self.assertLess(work() - before, 1e6)


if __name__ == "__main__":
    unittest.main()
