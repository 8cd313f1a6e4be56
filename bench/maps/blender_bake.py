# SPDX-License-Identifier: MIT
"""Bakes a normal map with Blender (Cycles, selected to active) and prints the time of the bake without import and export.

blender -b --factory-startup --python blender_bake.py -- LOW.obj HIGH.obj CAGE.obj|- OUT.png SIZE BITS REACH
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
    # Blender's OBJ importer drops some normals. In the files of this benchmark, vertex i has normal i.
    made.data.polygons.foreach_set("use_smooth", [True] * len(made.data.polygons))
    made.data.use_auto_smooth = True
    with open(path, encoding="ascii") as file:
        normals = [tuple(map(float, line.split()[1:])) for line in file if line.startswith("vn ")]
    made.data.normals_split_custom_set_from_vertices(normals)
    return made


def main():
    low_path, high_path, cage_path, out, size, bits, reach = sys.argv[sys.argv.index("--") + 1 :]
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    low, high = load(low_path), load(high_path)
    cage = None if cage_path == "-" else load(cage_path)

    blender_cycles.set_up(1)
    image = bpy.data.images.new("normal", int(size), int(size), alpha=False, float_buffer=bits == "16")
    image.colorspace_settings.name = "Non-Color"
    material = bpy.data.materials.new("baked")
    blender_cycles.target(material, image)
    low.data.materials.clear()
    low.data.materials.append(material)

    blender_cycles.select(low, high)
    options = {"use_selected_to_active": True, "margin": 16, "normal_space": "TANGENT"}
    if cage is None:
        options.update(cage_extrusion=float(reach), max_ray_distance=2 * float(reach))
    else:
        options.update(use_cage=True, cage_object=cage.name)
    wall, cpu = time.monotonic(), sum(os.times()[:2])
    bpy.ops.object.bake(type="NORMAL", **options)
    wall, cpu = time.monotonic() - wall, sum(os.times()[:2]) - cpu
    if bits == "16":
        blender_cycles.save_numbers(image, out)
    else:
        image.filepath_raw = out
        image.file_format = "PNG"
        image.save()
    print(f"BAKED {wall:.3f} {cpu:.3f}", flush=True)


main()
