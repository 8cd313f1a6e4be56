# SPDX-License-Identifier: MIT
"""Operators of the buttons. Each supports undo, and reports its result or its error in the status bar."""

import os
import tempfile

import bpy
import numpy

from . import meshes, tool
from .tool import Failed

COLORS = "tspace"
TEXT = "tspace check"
# A report of ERROR would raise an exception in scripts, and the check did not fail.
_LEVELS = {"error": {"WARNING"}, "warning": {"WARNING"}, "note": {"INFO"}}


def chosen_meshes(context):
    """Returns the selected mesh objects, the active object first."""
    things = [thing for thing in context.selected_objects if thing.type == "MESH"]
    active = context.active_object
    if active in things:
        things.remove(active)
        things.insert(0, active)
    elif not things and active and active.type == "MESH":
        things = [active]
    if not things:
        raise Failed("no mesh is selected")
    return things


def paint(mesh, values):
    """Stores a value per loop as a color attribute, from 0 (white) to 1 (red), and shows it in the viewport (Solid, Attribute)."""
    if COLORS in mesh.color_attributes:
        mesh.color_attributes.remove(mesh.color_attributes[COLORS])
    attribute = mesh.color_attributes.new(name=COLORS, type="FLOAT_COLOR", domain="CORNER")
    fade = 1 - numpy.clip(values, 0, 1)
    colors = numpy.column_stack([numpy.ones_like(fade), fade, fade, numpy.ones_like(fade)])
    attribute.data.foreach_set("color", colors.astype(numpy.float32).ravel())
    mesh.color_attributes.active_color = attribute


def select_faces(mesh, faces):
    chosen = numpy.zeros(len(mesh.polygons), bool)
    chosen[faces] = True
    mesh.polygons.foreach_set("select", chosen)
    for part in (mesh.vertices, mesh.edges):
        part.foreach_set("select", numpy.zeros(len(part), bool))
    used = numpy.zeros(len(mesh.vertices), bool)
    corners = meshes.gathered(mesh.loops, "vertex_index", 1, numpy.int32)
    used[corners[numpy.repeat(chosen, meshes.gathered(mesh.polygons, "loop_total", 1, numpy.int32))]] = True
    mesh.vertices.foreach_set("select", used)
    mesh.update()


class Tspace(bpy.types.Operator):
    """Base class of the operators."""

    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        was_editing = context.mode == "EDIT_MESH"
        if was_editing:  # edits are stored in the mesh only when Edit Mode ends
            bpy.ops.object.mode_set(mode="OBJECT")
        try:
            with tempfile.TemporaryDirectory() as folder:
                self.run(context, folder)
        except Failed as failed:
            self.report({"ERROR"}, str(failed))
            return {"CANCELLED"}
        finally:
            if was_editing and context.mode == "OBJECT":
                bpy.ops.object.mode_set(mode="EDIT")
        return {"FINISHED"}


class TSPACE_OT_check(Tspace):
    bl_idname = "tspace.check"
    bl_label = "Check"
    bl_description = "Find errors in normals, tangents, UVs and normal maps; select and color the faces, and list how to fix them"

    def run(self, context, folder):
        lines, worst, count = [], "note", 0
        for thing in chosen_meshes(context):
            findings, faces = self.findings(thing, folder)
            select_faces(thing.data, faces)
            wrong = numpy.zeros(len(thing.data.polygons))
            wrong[faces] = 1
            loops = meshes.gathered(thing.data.polygons, "loop_total", 1, numpy.int32)
            paint(thing.data, numpy.repeat(wrong, loops))
            thing["tspace"] = [f"{finding['severity']}: {finding['message']}" for finding in findings]
            thing["tspace_remedies"] = [finding["remedy"] for finding in findings]
            for finding in findings:
                count += 1
                worst = min(worst, finding["severity"], key=("error", "warning", "note").index)
                lines += [f"{thing.name}: {finding['severity']}: {finding['code']}", f"  {finding['message']}", f"  fix: {finding['remedy']}", ""]
        text = bpy.data.texts.get(TEXT) or bpy.data.texts.new(TEXT)
        text.clear()
        text.write("\n".join(lines) or "Nothing was found.\n")
        if count:
            self.report(_LEVELS[worst], f'{lines[0]}: {lines[1].strip()} ({count} findings: see the text "{TEXT}")')
        else:
            self.report({"INFO"}, "tspace found no errors in tangents, normals, UVs and normal maps")

    def findings(self, thing, folder):
        mesh = thing.data
        arrays = meshes.Arrays(mesh, with_tangents=True)
        materials = [slot.material for slot in thing.material_slots]
        uris = []
        for number, material in enumerate(materials):
            image = meshes.normal_image(material)
            uris.append(f"{number}.png" if image else None)
            if image:
                meshes.write_png(os.path.join(folder, uris[-1]), image)
        path = os.path.join(folder, "mesh.glb")
        meshes.write_glb(path, thing.name, arrays, materials, uris)
        ignored = "tangentsMissing" if arrays.tangents is None else "tangentsUnused"
        findings = tool.report("check", "--ignore", ignored, path)["files"][0]["findings"]
        faces = [arrays.faces_of_loops(finding["vertices"]) for finding in findings if finding["severity"] != "note"]
        codes = {finding["code"] for finding in findings}
        if "uvsDegenerate" in codes:
            faces.append(arrays.faces_without_uv_area())
        if "normalsAgainstWinding" in codes:
            faces.append(arrays.faces_with_normals_against_winding())
        if arrays.has_ngons:
            sizes = meshes.gathered(mesh.polygons, "loop_total", 1, numpy.int32)
            ngons = numpy.flatnonzero(sizes > 4)
            faces.append(ngons)
            findings.insert(0, {
                "severity": "warning", "code": "ngons",
                "message": f"{len(ngons)} faces have more than 4 corners and were not checked, because Blender computes no tangents for them",
                "remedy": "Triangulate these faces, or add the modifier Triangulate, before baking and exporting.",
            })
        return findings, numpy.unique(numpy.concatenate(faces)).astype(int) if faces else numpy.empty(0, int)


class TSPACE_OT_compare(Tspace):
    bl_idname = "tspace.compare"
    bl_label = "Compare Tangents"
    bl_description = "Show the angle between Blender's tangents and those of another method as colors; red marks the limit and above"

    method: bpy.props.EnumProperty(name="Method", items=[(name, name, "") for name in ("mikktspace", "best", "fast", "angle", "area", "lengyel")])
    limit: bpy.props.FloatProperty(name="Red", description="Degrees", default=1, min=0.001, max=180)

    def run(self, context, folder):
        thing = chosen_meshes(context)[0]
        arrays = meshes.Arrays(thing.data, with_tangents=True)
        if arrays.tangents is None:
            raise Failed("Blender computes no tangents for faces with more than 4 corners; triangulate them first")
        theirs = arrays.tangents
        arrays.tangents = None
        path, made = (os.path.join(folder, name) for name in ("mesh.glb", "made.glb"))
        meshes.write_glb(path, thing.name, arrays, [], [])
        faces = ("--faces", "quads") if self.method == "mikktspace" else ()  # Blender computes on its own faces
        tool.report("generate", path, "-o", made, "--all", "--method", self.method, "--no-sanitize", *faces)
        ours = read_tangents(made, arrays)
        chord = numpy.linalg.norm(ours[:, :3].astype(float) - theirs[:, :3], axis=1)
        angles = numpy.degrees(2 * numpy.arcsin(numpy.clip(chord / 2, 0, 1)))
        signs = int((ours[:, 3] != theirs[:, 3]).sum())
        paint(thing.data, angles / self.limit)
        thing["tspace_angle"] = float(angles.max())
        self.report({"INFO"}, f"{self.method}: mean {angles.mean():.4f}, largest {angles.max():.4f} degrees from Blender's; {signs} signs differ")


def read_tangents(path, arrays):
    """Returns the tangent of each loop from a GLB that was written from `arrays`. Vertices may have been split; the order of corners is unchanged."""
    import json
    import struct

    with open(path, "rb") as file:
        data = file.read()
    length = struct.unpack_from("<I", data, 12)[0]
    document, binary = json.loads(data[20 : 20 + length]), data[28 + length :]

    def numbers(index, kind, width):
        accessor = document["accessors"][index]
        view = document["bufferViews"][accessor["bufferView"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        step = view.get("byteStride", 4 * width)
        raw = numpy.frombuffer(binary, numpy.uint8, step * (accessor["count"] - 1) + 4 * width, start)
        rows = numpy.lib.stride_tricks.as_strided(raw, (accessor["count"], 4 * width), (step, 1))
        return numpy.ascontiguousarray(rows).view(kind).reshape(-1, width)

    result = numpy.zeros((len(arrays.positions), 4), numpy.float32)
    for primitive, number in zip(document["meshes"][0]["primitives"], numpy.unique(arrays.material_of_triangle)):
        corners = arrays.triangles[arrays.material_of_triangle == number].ravel()
        accessor = document["accessors"][primitive["indices"]]
        kinds = {5125: numpy.uint32, 5123: numpy.uint16, 5121: numpy.uint8}
        view = document["bufferViews"][accessor["bufferView"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        made = numpy.frombuffer(binary, kinds[accessor["componentType"]], accessor["count"], start)
        result[corners] = numbers(primitive["attributes"]["TANGENT"], numpy.float32, 4)[made]
    return result


class TSPACE_OT_bake(Tspace):
    bl_idname = "tspace.bake"
    bl_label = "Bake Normal Map"
    bl_description = "Bake the other selected meshes onto the active one as a normal map, and report its error in degrees"

    size: bpy.props.IntProperty(name="Size", default=1024, min=1, max=16384)
    bits: bpy.props.EnumProperty(name="Bits", items=[("16", "16", ""), ("8", "8", "")])
    convention: bpy.props.EnumProperty(name="For", items=[(name, name, "") for name in ("blender", "gltf", "directx", "unreal", "unity", "godot")])

    def run(self, context, folder):
        low, *others = chosen_meshes(context)
        if low != context.active_object or not others:
            raise Failed("select the high poly first, then the low poly, so that the low poly is the active object")
        low_path, high_path, image_path = (os.path.join(folder, name) for name in ("low.glb", "high.glb", "map.png"))
        with meshes.Standing(low, context) as mesh:
            arrays = meshes.Arrays(mesh, with_tangents=True)
            if arrays.tangents is None:
                raise Failed("the low poly has faces with more than 4 corners; triangulate it first, so that every program triangulates it identically")
            # One primitive: a map of the object, whatever its materials.
            arrays.material_of_triangle[:] = 0
            meshes.write_glb(low_path, low.name, arrays, [], [])
        high = [self.high(thing, context) for thing in others]
        meshes.write_glb(high_path, low.name, joined(high), [], [])
        report = tool.report("bake", low_path, "--high", high_path, "--match", "all", "-o", image_path, "--size", self.size,
                             "--bits", self.bits, "--convention", self.convention)
        image = meshes.load_map(image_path, f"{low.name} normal")
        error = report["files"][0]["error"]
        image["tspace_mean_degrees"], image["tspace_p99_degrees"] = error["meanDeg"], error["p99Deg"]
        context.scene.tspace.image = image
        level = {"WARNING"} if report["findings"] or error["missed"] else {"INFO"}
        words = f'"{image.name}": mean error {error["meanDeg"]:.3f} degrees, 99 % below {error["p99Deg"]:.2f}'
        if error["missed"]:
            words += f"; {error['missed']} of {error['missed'] + error['points']} samples did not hit the high poly"
        self.report(level, words)

    @staticmethod
    def high(thing, context):
        with meshes.Standing(thing, context) as mesh:
            if not mesh.uv_layers:
                mesh.uv_layers.new()
            return meshes.Arrays(mesh, with_tangents=False)


def joined(parts):
    """Joins several meshes into the first one."""
    first = parts[0]
    starts = numpy.cumsum([0] + [len(part.positions) for part in parts[:-1]])
    first.triangles = numpy.concatenate([part.triangles + start for part, start in zip(parts, starts)])
    for name in ("positions", "normals", "uvs"):
        setattr(first, name, numpy.concatenate([getattr(part, name) for part in parts]))
    first.material_of_triangle = numpy.zeros(len(first.triangles), numpy.int32)
    return first


class TSPACE_OT_convert_map(Tspace):
    bl_idname = "tspace.convert_map"
    bl_label = "Convert Map"
    bl_description = "Convert the map for another program or from object space, using the tangent frames of the active mesh"

    space: bpy.props.EnumProperty(name="From", items=[("tangent", "Tangent space", ""), ("object", "Object space", "")])
    convention: bpy.props.EnumProperty(name="To", items=[(name, name, "") for name in ("blender", "gltf", "directx", "unreal", "unity", "godot")])

    def run(self, context, folder):
        image = context.scene.tspace.image
        if image is None:
            raise Failed("choose the image first")
        thing = chosen_meshes(context)[0]
        arrays = meshes.Arrays(thing.data, with_tangents=True)
        arrays.material_of_triangle[:] = 0
        mesh_path, map_path, made = (os.path.join(folder, name) for name in ("mesh.glb", "map.png", "made.png"))
        meshes.write_glb(mesh_path, thing.name, arrays, [], [])
        meshes.write_png(map_path, image)
        report = tool.report("convert-map", map_path, "-o", made, "--mesh", mesh_path, "--from", self.space, "--from-convention", "blender",
                             "--to-convention", self.convention)
        new = meshes.load_map(made, f"{image.name} {self.convention}")
        context.scene.tspace.image = new
        level = {"WARNING"} if report["warnings"] else {"INFO"}
        words = f'"{new.name}": {report["converted"]} texels, rotated by {report["meanChangeDeg"]:.3f} degrees on average'
        self.report(level, "; ".join([words, *(warning if isinstance(warning, str) else warning["message"] for warning in report["warnings"])]))


class TSPACE_OT_flip_green(Tspace):
    bl_idname = "tspace.flip_green"
    bl_label = "Flip Green"
    bl_description = "Convert a DirectX normal map to OpenGL, or back, in a new image"

    def run(self, context, folder):
        image = context.scene.tspace.image
        if image is None:
            raise Failed("choose the image first")
        path, made = (os.path.join(folder, name) for name in ("map.png", "made.png"))
        meshes.write_png(path, image)
        tool.report("flip-green", path, "-o", made)
        new = meshes.load_map(made, f"{image.name} flipped")
        context.scene.tspace.image = new
        self.report({"INFO"}, f'"{new.name}": green was inverted, the other channels are unchanged')


CLASSES = (TSPACE_OT_check, TSPACE_OT_compare, TSPACE_OT_bake, TSPACE_OT_convert_map, TSPACE_OT_flip_green)
