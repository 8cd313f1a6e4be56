# SPDX-License-Identifier: MIT
"""Runs inside Blender: installs the add-on from its zip and uses each button. Arguments: ZIP [PICTURE].

    blender --background --factory-startup --python-exit-code 1 --python run.py -- tspace_addon.zip
"""

import math
import os
import pathlib
import sys

import bpy
import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import add_on  # noqa: E402

arguments = sys.argv[sys.argv.index("--") + 1 :]
module = add_on.install(arguments[0])


def check(condition, words):
    if not condition:
        raise SystemExit(f"FAILED: {words}")
    print(f"ok: {words}")


def fails(call, words):
    try:
        call()
    except RuntimeError as error:
        check(words in str(error), f"refused: {words}")
        return
    raise SystemExit(f"FAILED: not refused: {words}")


def new_mesh(add, name, **options):
    bpy.ops.object.select_all(action="DESELECT")
    add(**options)
    thing = bpy.context.active_object
    thing.name = thing.data.name = name
    return thing


def use(*things):
    """Selects these objects; the first one becomes active."""
    bpy.ops.object.select_all(action="DESELECT")
    for thing in things:
        thing.select_set(True)
    bpy.context.view_layer.objects.active = things[0]


def selected_faces(thing):
    return [polygon.index for polygon in thing.data.polygons if polygon.select]


def red_faces(thing):
    attribute = thing.data.color_attributes["tspace"]
    loops = [polygon.loop_start for polygon in thing.data.polygons]
    return [face for face, loop in enumerate(loops) if attribute.data[loop].color[1] < 0.5]


def numbers(image):
    values = numpy.empty(len(image.pixels), numpy.float32)
    image.pixels.foreach_get(values)
    return values.reshape(-1, 4)


for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)

fails(bpy.ops.tspace.check, "no mesh is selected")

sphere = new_mesh(bpy.ops.mesh.primitive_uv_sphere_add, "Sphere")
bpy.ops.object.shade_smooth()
bpy.ops.tspace.check()
check(not [line for line in sphere["tspace"] if line.startswith("error")], "a sphere of Blender has no errors")
check(selected_faces(sphere) == red_faces(sphere), "what is selected is what is red")

torus = new_mesh(bpy.ops.mesh.primitive_torus_add, "Torus", major_segments=24, minor_segments=12)
bpy.ops.object.shade_smooth()
bpy.ops.tspace.check()
check(list(torus["tspace"]) == [] and selected_faces(torus) == [], f"a torus has no findings: {list(torus['tspace'])}")
bpy.ops.tspace.compare(method="mikktspace")
check(torus["tspace_angle"] < 0.1, f"MikkTSpace is Blender's, within {torus['tspace_angle']:.4f} degrees")
bpy.ops.tspace.compare(method="lengyel")
check(torus["tspace_angle"] > 0.1, f"another method is another one, by {torus['tspace_angle']:.2f} degrees")

# Faces 10 to 59 without UV area.
for face in range(10, 60):
    for loop in torus.data.polygons[face].loop_indices:
        torus.data.uv_layers.active.data[loop].uv = (0.5, 0.5)
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.tspace.check()
check(bpy.context.mode == "EDIT_MESH", "the mode stays")
bpy.ops.object.mode_set(mode="OBJECT")
check(set(range(10, 60)) <= set(selected_faces(torus)), "faces without UV area are selected")
check(selected_faces(torus) == red_faces(torus), "and red")
check(len(torus["tspace_remedies"]) == len(torus["tspace"]) > 0 and all(torus["tspace_remedies"]), "each finding has a remedy")
check("uvsDegenerate" in bpy.data.texts["tspace check"].as_string(), "the text has the findings")

circle = new_mesh(bpy.ops.mesh.primitive_circle_add, "Circle", vertices=8, fill_type="NGON", calc_uvs=True)
bpy.ops.tspace.check()
check(selected_faces(circle) == [0] and "more than 4 corners" in circle["tspace"][0], "n-gons are found")
fails(bpy.ops.tspace.compare, "triangulate them first")

low = new_mesh(bpy.ops.mesh.primitive_plane_add, "Low", size=2)
high = new_mesh(bpy.ops.mesh.primitive_grid_add, "High", size=2, x_subdivisions=96, y_subdivisions=96)
for vertex in high.data.vertices:
    vertex.co.z = 0.02 * math.sin(9 * vertex.co.x) * math.cos(7 * vertex.co.y)
bpy.ops.object.shade_smooth()
use(low)
fails(lambda: bpy.ops.tspace.bake(size=64), "select the high poly")
use(low, high)
bpy.ops.tspace.bake(size=128)
baked = bpy.context.scene.tspace.image
check(tuple(baked.size) == (128, 128) and baked.colorspace_settings.name == "Non-Color", "a map is baked")
check(0 < baked["tspace_mean_degrees"] < 0.5, f"its error is {baked['tspace_mean_degrees']:.3f} degrees in the mean")
texels = numbers(baked)[:, :3] * 2 - 1
check(texels[:, 2].min() > 0.8 and numpy.ptp(texels[:, 0]) > 0.1, "it has the relief")
# At the middle of the image the high poly's slope along x is known.
slope = 0.02 * 9 * math.cos(9 * (65 / 64 - 1 - 1 / 128)) * math.cos(7 * (65 / 64 - 1 - 1 / 128))
middle = texels.reshape(128, 128, 3)[64, 64]
check(abs(-middle[0] / middle[2] - slope) < 0.02, "x leans against the slope along u")

bpy.ops.tspace.flip_green()
flipped = bpy.context.scene.tspace.image
check(numpy.abs(numbers(flipped)[:, 1] - (1 - numbers(baked)[:, 1])).max() < 1e-4, "green is inverted")
check(numpy.abs(numbers(flipped)[:, 0] - numbers(baked)[:, 0]).max() < 1e-4, "red stays")
bpy.context.scene.tspace.image = baked
use(low)
bpy.ops.tspace.convert_map(convention="directx")
converted = bpy.context.scene.tspace.image
check(numpy.abs(numbers(converted)[:, 1] - (1 - numbers(baked)[:, 1])).max() < 2e-3, "for DirectX green is turned")

# A map whose green points down is found on a material.
material = bpy.data.materials.new("Bumps")
material.use_nodes = True
nodes, links = material.node_tree.nodes, material.node_tree.links
texture, bumps = nodes.new("ShaderNodeTexImage"), nodes.new("ShaderNodeNormalMap")
texture.image = flipped
links.new(texture.outputs["Color"], bumps.inputs["Color"])
low.data.materials.append(material)
bpy.ops.tspace.check()
check(any("green" in line for line in low["tspace"]), "green that points down is found in the map of a material")
texture.image = baked
bpy.ops.tspace.check()
check(not any("green" in line for line in low["tspace"]), "and not where it points up")

where = pathlib.Path(add_on.part(module, "tool").path())
check(add_on.folder(module) in where.parents, "the add-on brings its program")
preferences = bpy.context.preferences.addons[module].preferences
preferences.program = "/no/such/program"
fails(bpy.ops.tspace.check, "/no/such/program")
preferences.program = ""
bpy.ops.preferences.addon_disable(module=module)
check(not hasattr(bpy.types.Scene, "tspace"), "nothing stays when it is switched off")
print(f"all is well in Blender {bpy.app.version_string}, module {module}")
