# SPDX-License-Identifier: MIT
"""Bakes the other kinds of maps (occlusion, position, color) with Blender (Cycles, selected to active).

blender -b --factory-startup --python blender_layers.py -- LOW.obj HIGH.obj FOLDER SIZE REACH SAMPLES
writes FOLDER/blender_KIND.bin (rows from the top, three floats per texel) and prints the time of each bake without import.
"""
import os
import sys
import time

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import blender_cycles  # noqa: E402


def load(path):
    before = set(bpy.data.objects)
    bpy.ops.wm.obj_import(filepath=path, forward_axis="Y", up_axis="Z")
    (made,) = set(bpy.data.objects) - before
    return made


def main():
    low_path, high_path, folder, size, reach, samples = sys.argv[sys.argv.index("--") + 1 :]
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    low, high = load(low_path), load(high_path)
    scene = bpy.context.scene
    blender_cycles.set_up(1)
    scene.world.light_settings.distance = 100
    material = bpy.data.materials.new("baked")
    material.use_nodes = True
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    low.data.materials.clear()
    low.data.materials.append(material)
    blender_cycles.select(low, high)
    for kind, count in (("AO", int(samples)), ("POSITION", 1), ("DIFFUSE", 1), ("DIFFUSE", 16)):
        name = f"{kind}_{count}"
        image = bpy.data.images.new(name, int(size), int(size), alpha=False, float_buffer=True)
        image.colorspace_settings.name = "Non-Color"
        node.image = image
        material.node_tree.nodes.active = node
        scene.cycles.samples = count
        options = {"use_selected_to_active": True, "margin": 0, "cage_extrusion": float(reach), "max_ray_distance": 2 * float(reach)}
        if kind == "DIFFUSE":
            options["pass_filter"] = {"COLOR"}
        wall, cpu = time.monotonic(), sum(os.times()[:2])
        bpy.ops.object.bake(type=kind, **options)
        wall, cpu = time.monotonic() - wall, sum(os.times()[:2]) - cpu
        pixels = list(image.pixels)
        import array

        rows = array.array("f")
        for y in range(int(size) - 1, -1, -1):
            for x in range(int(size)):
                at = 4 * (y * int(size) + x)
                rows.extend(pixels[at : at + 3])
        with open(os.path.join(folder, f"blender_{name}.bin"), "wb") as file:
            rows.tofile(file)
        print(f"BAKED {name} {wall:.3f} {cpu:.3f}", flush=True)


main()
