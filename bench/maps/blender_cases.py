# SPDX-License-Identifier: MIT
"""Writes test models like those that artists bake, and bakes them with Blender (Cycles, selected to active).

blender -b --factory-startup --python blender_cases.py -- FOLDER SIZE CASE...
blender -b --factory-startup --python blender_cases.py -- --whole FOLDER: writes a model of a million triangles, as low.glb,
  high.glb and whole.blend
blender -b FOLDER/whole.blend --python blender_cases.py -- --bake FOLDER SIZE
The first command writes these files to FOLDER/CASE:
- low.gltf, whose materials refer to map.png or map.MATERIAL.png;
- high.glb;
- seen.glb, which is high.glb with the tiny marker triangles of low.gltf, so that a renderer frames both models equally;
- cage.glb, for the cases that have a cage;
- the maps that Blender bakes: blender-no without a cage, blender-cage with an automatic cage, blender-file with cage.glb.
"""
import json
import math
import os
import sys

import bmesh
import bpy
from mathutils import Matrix, Vector, noise

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import blender_cycles  # noqa: E402

REACH = 0.1


def active(thing):
    bpy.ops.object.select_all(action="DESELECT")
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing


def made(mesh, name):
    """Creates an object from a bmesh."""
    data = bpy.data.meshes.new(name)
    mesh.to_mesh(data)
    mesh.free()
    thing = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(thing)
    return thing


def box(size, at=(0, 0, 0), name="box"):
    mesh = bmesh.new()
    bmesh.ops.create_cube(mesh, size=1, matrix=Matrix.Translation(at) @ Matrix.Diagonal((*size, 1)))
    return made(mesh, name)


def tube(radius, length, at, axis="Z", segments=32, top=None, name="tube"):
    turn = {"X": Matrix.Rotation(math.pi / 2, 4, "Y"), "Y": Matrix.Rotation(math.pi / 2, 4, "X"), "Z": Matrix()}[axis]
    mesh = bmesh.new()
    bmesh.ops.create_cone(
        mesh,
        cap_ends=True,
        segments=segments,
        radius1=radius,
        radius2=radius if top is None else top,
        depth=length,
        matrix=Matrix.Translation(at) @ turn,
    )
    return made(mesh, name)


def ball(radius, subdivisions, name="ball"):
    mesh = bmesh.new()
    bmesh.ops.create_icosphere(mesh, subdivisions=subdivisions, radius=radius)
    return made(mesh, name)


def modified(thing, kind, **settings):
    modifier = thing.modifiers.new(kind, kind)
    for key, value in settings.items():
        setattr(modifier, key, value)
    active(thing)
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    return thing


def beveled(thing, width, segments=3):
    smooth(modified(thing, "BEVEL", width=width, segments=segments, limit_method="ANGLE"))
    return modified(thing, "WEIGHTED_NORMAL", keep_sharp=True)


def smooth(thing, hard_over=None):
    thing.data.polygons.foreach_set("use_smooth", [True] * len(thing.data.polygons))
    thing.data.use_auto_smooth = True
    thing.data.auto_smooth_angle = math.pi if hard_over is None else math.radians(hard_over)
    return thing


def joined(things, name="high"):
    bpy.ops.object.select_all(action="DESELECT")
    for thing in things:
        thing.select_set(True)
    bpy.context.view_layer.objects.active = things[0]
    bpy.ops.object.join()
    things[0].name = name
    return things[0]


def triangulated(thing):
    return modified(thing, "TRIANGULATE", keep_custom_normals=True)


def unwrapped(thing, degrees=66):
    active(thing)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.smart_project(angle_limit=math.radians(degrees), island_margin=0.02)
    bpy.ops.object.mode_set(mode="OBJECT")
    return thing


def moved(thing, place):
    """Moves every vertex to place(its position)."""
    for vertex in thing.data.vertices:
        vertex.co = place(vertex.co.copy())
    thing.data.update()
    return thing


def lumps(at, height=0.05):
    return height * (noise.noise(2 * at) + 0.3 * noise.noise(5 * at))


def lifted(thing, height):
    """Moves vertices along the direction from the center of the model."""
    return moved(thing, lambda at: at + height(at) * at.normalized())


# Each of the following functions creates one case and returns its low poly and high poly.


def rib(size, at):
    return beveled(box(size, at), 0.012)


def ribs():
    """Creates separate shells that are partly inside the base mesh."""
    top = [rib((0.1, 1.0, 0.1), (x, 0, 0.5)) for x in (-0.6, -0.3, 0, 0.3, 0.6)]
    side = [rib((1.4, 0.08, 0.08), (0, -0.7, z)) for z in (-0.25, 0, 0.25)]
    return top + side + [rib((0.09, 0.9, 0.6), (1, 0, 0))]


def base():
    return box((2, 1.4, 1))


def monkey():
    bpy.ops.mesh.primitive_monkey_add()
    high = smooth(modified(bpy.context.object, "SUBSURF", levels=4))
    low = high.copy()
    low.data = high.data.copy()
    bpy.context.collection.objects.link(low)
    modified(low, "DECIMATE", ratio=1377 / 251904)
    return unwrapped(smooth(low)), high


def mirrored_x(thing, aside):
    """Returns the half with x > 0 and its mirror image, which has the same UVs, or UVs that are moved by 1."""
    active(thing)
    mesh = bmesh.new()
    mesh.from_mesh(thing.data)
    everything = mesh.verts[:] + mesh.edges[:] + mesh.faces[:]
    bmesh.ops.bisect_plane(mesh, geom=everything, plane_co=(0, 0, 0), plane_no=(-1, 0, 0), clear_outer=True)
    mesh.to_mesh(thing.data)
    mesh.free()
    unwrapped(thing)
    return modified(thing, "MIRROR", use_axis=(True, False, False), offset_u=1 if aside else 0)


def bevels():
    low = modified(base(), "BEVEL", width=0.06, segments=1, limit_method="ANGLE")
    low = modified(smooth(mirrored_x(low, True)), "WEIGHTED_NORMAL")
    return low, joined([beveled(base(), 0.06, 4)] + ribs())


def hard_edges():
    return unwrapped(smooth(base(), 30)), joined([beveled(base(), 0.03)] + ribs())


def all_smooth():
    return unwrapped(smooth(base())), joined([beveled(base(), 0.03)] + ribs())


def organic():
    low = smooth(lifted(ball(1, 4), lambda at: lumps(at, 0.25)))
    high = smooth(lifted(ball(1, 8), lambda at: lumps(at, 0.25) + 0.004 * noise.noise(40 * at)))
    # Create one UV island around each vertex of an icosahedron, and rotate each island by a different angle.
    corners = ball(1, 1)
    centers = [vertex.co.normalized() for vertex in corners.data.vertices]
    bpy.data.objects.remove(corners)
    uvs = low.data.uv_layers.new(name="UVMap").data
    for polygon in low.data.polygons:
        island = max(range(len(centers)), key=lambda i: centers[i].dot(polygon.center.normalized()))
        up = centers[island]
        across = up.orthogonal().normalized()
        turn = Matrix.Rotation(math.radians(37 * island), 2)
        for loop in polygon.loop_indices:
            at = low.data.vertices[low.data.loops[loop].vertex_index].co.normalized()
            u, v = turn @ Vector((at.dot(across), at.dot(up.cross(across))))
            uvs[loop].uv = ((island % 4 + 0.5 + 0.6 * u) / 4, (island // 4 + 0.5 + 0.6 * v) / 3)
    return low, high


def bolts():
    heads = [
        beveled(tube(0.09, 0.05, (x, y, 0.54), segments=6), 0.01)
        for x in (-0.75, -0.25, 0.25, 0.75)
        for y in (-0.45, 0.45)
    ]
    sides = [beveled(tube(0.07, 0.04, (x, -0.73, z), "Y", 24), 0.01) for x in (-0.6, 0, 0.6) for z in (-0.3, 0.3)]
    pipe = smooth(tube(0.06, 1.6, (0, 0, 0.53), "X"), 30)
    return heads + sides + [pipe]


def floaters():
    return unwrapped(smooth(base(), 30)), joined([beveled(base(), 0.03)] + bolts())


def two_materials():
    low, high = unwrapped(smooth(base(), 30)), joined([beveled(base(), 0.03)] + ribs())
    for name in ("body", "trim"):
        low.data.materials.append(bpy.data.materials.new(name))
    for polygon in low.data.polygons:
        polygon.material_index = 0 if abs(polygon.normal.z) > 0.5 else 1
    return low, high


def halves(symmetric):
    def height(at):
        side = Vector((abs(at.x), at.y, at.z))
        return lumps(side, 0.2)

    def fine(at):
        return 0.006 * noise.noise(25 * (Vector((abs(at.x), at.y, at.z)) if symmetric else at))

    low = mirrored_x(smooth(lifted(ball(1, 4), height)), False)
    return smooth(low), smooth(lifted(ball(1, 8), lambda at: height(at) + fine(at)))


def scaled():
    low = unwrapped(smooth(lifted(ball(0.8, 4), lambda at: lumps(at, 0.1))))
    high = smooth(lifted(ball(0.8, 8), lambda at: lumps(at, 0.1) + 0.005 * noise.noise(30 * at)))
    low.scale = high.scale = (1, 2.5, 0.6)
    return low, high


def fingers():
    def finger(i, segments, rings):
        thing = tube(0.1, 1.6, (0.215 * i, 0, 0), "Z", segments)
        mesh = bmesh.new()
        mesh.from_mesh(thing.data)
        long = [edge for edge in mesh.edges if abs((edge.verts[0].co - edge.verts[1].co).z) > 1]
        bmesh.ops.subdivide_edges(mesh, edges=long, cuts=rings, use_grid_fill=True)
        mesh.to_mesh(thing.data)
        mesh.free()
        return thing

    def wavy(at):
        out = Vector((at.x - 0.215 * round(at.x / 0.215), at.y, 0))
        return at + (0.004 * math.sin(40 * at.z) + 0.004 * noise.noise(12 * at)) * out.normalized()

    low = joined([finger(i, 10, 3) for i in range(4)], "low")
    high = joined([moved(finger(i, 96, 200), wavy) for i in range(4)])
    return unwrapped(smooth(low, 60)), smooth(high, 60)


def slab():
    thin = (2, 1.2, 0.02)
    high = modified(box(thin), "SUBSURF", levels=7, subdivision_type="SIMPLE")

    def dented(at):
        edge = min(1, 8 * min(1 - abs(at.x), 0.6 - abs(at.y)))
        depth = 0.004 * edge * noise.noise(12 * at + Vector((0, 0, 100 if at.z > 0 else 0)))
        return at + Vector((0, 0, depth * (1 if at.z > 0 else -1) if abs(at.z) > 0.009 else 0))

    return unwrapped(smooth(box(thin), 30)), smooth(moved(high, dented), 30)


def pocket():
    def tray(thing):
        mesh = bmesh.new()
        mesh.from_mesh(thing.data)
        (top,) = [face for face in mesh.faces if face.normal.z > 0.9]
        bmesh.ops.inset_individual(mesh, faces=[top], thickness=0.25)
        bmesh.ops.translate(mesh, verts=top.verts[:], vec=(0, 0, -0.5))
        mesh.to_mesh(thing.data)
        mesh.free()
        return thing

    return unwrapped(smooth(tray(base()), 30)), beveled(tray(base()), 0.03)


CASES = {
    "a": monkey,
    "b1": bevels,
    "b2": hard_edges,
    "b3": all_smooth,
    "c": organic,
    "d": floaters,
    "e": two_materials,
    "f": lambda: halves(True),
    "fa": lambda: halves(False),
    "g2": scaled,
    "h1": fingers,
    "h2": slab,
    "h3": pocket,
}
WITH_CAGE = ("b2", "d")


def cage_of(low):
    """Creates a cage: the low poly with each vertex moved by the reach along the mean normal of its faces."""
    cage = low.copy()
    cage.data = low.data.copy()
    bpy.context.collection.objects.link(cage)
    normals = [Vector() for _ in cage.data.vertices]
    cage.data.calc_loop_triangles()
    for polygon in cage.data.polygons:
        corners = [cage.data.vertices[i].co for i in polygon.vertices]
        for i, vertex in enumerate(polygon.vertices):
            a, b = corners[i - 1] - corners[i], corners[(i + 1) % len(corners)] - corners[i]
            normals[vertex] += a.angle(b, 0) * polygon.normal
    for vertex, normal in zip(cage.data.vertices, normals):
        vertex.co += REACH * normal.normalized()
    return cage


def marks(things):
    """Adds triangles too small to be visible at the corners of a box around all models."""
    corners = [thing.matrix_world @ vertex.co for thing in things for vertex in thing.data.vertices]
    sides = [(min(at[i] for at in corners) - 0.01, max(at[i] for at in corners) + 0.01) for i in range(3)]
    mesh = bmesh.new()
    for x in sides[0]:
        for y in sides[1]:
            for z in sides[2]:
                mesh.faces.new([mesh.verts.new(Vector((x, y, z)) + 1e-5 * Vector(by)) for by in ((0, 0, 0), (1, 0, 0), (0, 1, 0))])
    return made(mesh, "marks")


def export(path, things):
    bpy.ops.object.select_all(action="DESELECT")
    for thing in things:
        thing.select_set(True)
    is_binary = path.endswith(".glb")
    has_tangents = os.path.basename(path).startswith("low")
    bpy.ops.export_scene.gltf(
        filepath=path,
        export_format="GLB" if is_binary else "GLTF_SEPARATE",
        use_selection=True,
        export_tangents=has_tangents,
        export_apply=True,
    )


def name_maps(path):
    """Adds the normal map to each material of a glTF file."""
    with open(path, encoding="utf-8") as file:
        model = json.load(file)
    model["images"], model["textures"] = [], []
    for i, material in enumerate(model["materials"]):
        model["images"].append({"uri": f"map.{material['name']}.png" if len(model["materials"]) > 1 else "map.png"})
        model["textures"].append({"source": i})
        material["normalTexture"] = {"index": i}
    with open(path, "w", encoding="utf-8") as file:
        json.dump(model, file)


def bake(low, high, folder, size, word, **options):
    images = []
    for slot in low.material_slots:
        image = bpy.data.images.new("normal", size, size, alpha=False, float_buffer=True)
        image.colorspace_settings.name = "Non-Color"
        blender_cycles.target(slot.material, image)
        images.append((slot.material.name, image))
    blender_cycles.select(low, high)
    bpy.ops.object.bake(
        type="NORMAL",
        use_selected_to_active=True,
        margin=16,
        normal_space="TANGENT",
        cage_extrusion=REACH,
        max_ray_distance=2 * REACH,
        **options,
    )
    for name, image in images:
        part = f".{name}" if len(images) > 1 else ""
        blender_cycles.save_numbers(image, os.path.join(folder, f"blender-{word}{part}.png"))


def begin(make):
    """Creates an empty scene and adds the low poly and the high poly of a case."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    noise.seed_set(1)
    low, high = make()
    triangulated(low)
    if not low.material_slots:
        low.data.materials.append(bpy.data.materials.new("baked"))
    low.name, high.name = "part_low", "part_high"
    return low, high


def run(case, folder, size):
    low, high = begin(CASES[case])
    blender_cycles.set_up(1)
    os.makedirs(folder, exist_ok=True)
    # The cage is a copy of the low poly alone; the markers are exported after it, as in low.gltf.
    cage = cage_of(low) if case in WITH_CAGE else None
    corners = marks([low, high])
    export(os.path.join(folder, "low.gltf"), [low, corners])
    export(os.path.join(folder, "high.glb"), [high])
    export(os.path.join(folder, "seen.glb"), [high, corners])
    name_maps(os.path.join(folder, "low.gltf"))
    bake(low, high, folder, size, "no")
    bake(low, high, folder, size, "cage", use_cage=True)
    if cage is not None:
        export(os.path.join(folder, "cage.glb"), [cage, corners])
        bake(low, high, folder, size, "file", use_cage=True, cage_object=cage.name)
    triangles = [sum(len(polygon.vertices) - 2 for polygon in thing.data.polygons) for thing in (low, high)]
    print(f"MADE {case} {triangles[0]} {triangles[1]}", flush=True)


def million():
    """Creates a closed shape with details a few texels wide in a map of 2048 x 2048."""
    mesh = bmesh.new()
    bmesh.ops.create_uvsphere(mesh, u_segments=1000, v_segments=501, radius=1)
    high = lifted(made(mesh, "high"), lambda at: lumps(at, 0.1) + 0.0006 * noise.noise(120 * at))
    return unwrapped(smooth(lifted(ball(1, 4), lambda at: lumps(at, 0.1)))), smooth(high)


def main():
    arguments = sys.argv[sys.argv.index("--") + 1 :]
    if arguments[0] == "--whole":
        os.makedirs(arguments[1], exist_ok=True)
        low, high = begin(million)
        high.data.use_auto_smooth = False
        export(os.path.join(arguments[1], "low.glb"), [low])
        export(os.path.join(arguments[1], "high.glb"), [high])
        bpy.ops.wm.save_as_mainfile(filepath=os.path.join(os.path.abspath(arguments[1]), "whole.blend"))
        return
    if arguments[0] == "--bake":
        blender_cycles.set_up(1)
        bake(bpy.data.objects["part_low"], bpy.data.objects["part_high"], arguments[1], int(arguments[2]), "no")
        return
    folder, size, *cases = arguments
    for case in cases or CASES:
        run(case, os.path.join(folder, case), int(size))


main()
