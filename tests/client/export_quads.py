# SPDX-License-Identifier: MIT
"""Run by Blender: exports meshes of quads, and of triangles to compare, to the folder after "--". An exception ends Blender
with status 1 (--python-exit-code)."""
import math
import sys

import bpy

folder = sys.argv[sys.argv.index("--") + 1]


def normal_mapped():
    material = bpy.data.materials.new("mapped")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    image = bpy.data.images.new("normals", 4, 4)
    image.generated_color = (0.5, 0.5, 1, 1)
    image.colorspace_settings.name = "Non-Color"
    image.pack()
    texture, normal = nodes.new("ShaderNodeTexImage"), nodes.new("ShaderNodeNormalMap")
    texture.image = image
    links.new(texture.outputs["Color"], normal.inputs["Color"])
    links.new(normal.outputs["Normal"], nodes["Principled BSDF"].inputs["Normal"])
    return material


def export(name, add, modifier=None, levels=0, shape_key=False, tangents=True, fbx=False):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    add()
    thing = bpy.context.object
    if modifier:
        made = thing.modifiers.new("it", modifier)
        if levels:
            made.levels = levels
        bpy.ops.object.modifier_apply(modifier="it")
    bpy.ops.object.shade_smooth()
    thing.data.materials.append(normal_mapped())
    if shape_key:
        thing.shape_key_add(name="Basis")
        for point in thing.shape_key_add(name="bend").data:
            point.co.z += 0.3 * math.sin(3 * point.co.y)
    bpy.ops.export_scene.gltf(
        filepath=f"{folder}/{name}.glb", export_format="GLB", export_tangents=tangents, export_morph_normal=True
    )
    if fbx:
        bpy.ops.export_scene.fbx(filepath=f"{folder}/{name}.fbx", use_tspace=True)


mesh = bpy.ops.mesh
export("cube", mesh.primitive_cube_add, "SUBSURF", 3)
export("monkey", mesh.primitive_monkey_add, fbx=True)
export("monkey_subdivided", mesh.primitive_monkey_add, "SUBSURF", 2, fbx=True)
export("monkey_morph", mesh.primitive_monkey_add, shape_key=True)
export("monkey_bare", mesh.primitive_monkey_add, tangents=False)
export("monkey_triangulated", mesh.primitive_monkey_add, "TRIANGULATE", fbx=True)
export("triangulated_bare", mesh.primitive_monkey_add, "TRIANGULATE", tangents=False)
export("sphere", mesh.primitive_uv_sphere_add)
