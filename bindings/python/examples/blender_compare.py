# SPDX-License-Identifier: MIT
"""Blender: compares tangents of the active mesh with those of calc_tangents, and shows the angle as a color.

    blender FILE.blend --python blender_compare.py
    blender --background --python blender_compare.py -- --torus --packages FOLDER

--torus adds a torus and uses it; --packages specifies the folder where tspace is installed, if Blender's Python does
not find it. The color attribute "tspace angle" is white where both agree, and red from 1 degree on.
"""

import argparse
import sys

import bpy
import numpy


def gathered(items, name, components, kind=numpy.float32):
    """Returns a property of all items of a Blender collection, as an array."""
    values = numpy.empty(len(items) * components, kind)
    items.foreach_get(name, values)
    return values.reshape(-1, components) if components > 1 else values


def tangents_of(mesh, tspace):
    """Returns tangents per loop for the original polygons, shape (loops, 4), like Blender's own."""
    mesh.calc_normals_split()
    return tspace.tangents(
        gathered(mesh.vertices, "co", 3),
        gathered(mesh.loops, "normal", 3),
        gathered(mesh.uv_layers.active.data, "uv", 2),
        gathered(mesh.loops, "vertex_index", 1, numpy.int32),
        face_sizes=gathered(mesh.polygons, "loop_total", 1, numpy.int32),
        normal_indices="corners",
        uv_indices="corners",
        convention="blender",
    )


def blender_tangents(mesh):
    mesh.calc_tangents(uvmap=mesh.uv_layers.active.name)  # fails for polygons with more than 4 corners
    signs = gathered(mesh.loops, "bitangent_sign", 1)
    return numpy.column_stack([gathered(mesh.loops, "tangent", 3), signs])


def show(mesh, angles):
    """Shows the angles as a color attribute per loop."""
    name = "tspace angle"
    if name in mesh.color_attributes:
        mesh.color_attributes.remove(mesh.color_attributes[name])
    attribute = mesh.color_attributes.new(name=name, type="FLOAT_COLOR", domain="CORNER")
    fade = 1 - numpy.clip(angles, 0, 1)
    colors = numpy.column_stack([numpy.ones_like(fade), fade, fade, numpy.ones_like(fade)])
    attribute.data.foreach_set("color", colors.astype(numpy.float32).ravel())
    mesh.color_attributes.active_color = attribute


def main():
    parser = argparse.ArgumentParser(prog="blender_compare.py")
    parser.add_argument("--torus", action="store_true")
    parser.add_argument("--packages")
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
    if options.packages:
        sys.path.insert(0, options.packages)
    import tspace

    if options.torus:
        bpy.ops.mesh.primitive_torus_add(major_segments=24, minor_segments=12)
        bpy.ops.object.shade_smooth()
    thing = bpy.context.active_object
    if thing is None or thing.type != "MESH" or not thing.data.uv_layers:
        raise SystemExit("the active object is no mesh with UVs")
    ours, theirs = tangents_of(thing.data, tspace), blender_tangents(thing.data)
    # The angle is computed from the chord, because the cosine of a small angle is rounded to 1.
    chord = numpy.linalg.norm(ours[:, :3].astype(float) - theirs[:, :3], axis=1)
    angles = numpy.degrees(2 * numpy.arcsin(numpy.clip(chord / 2, 0, 1)))
    signs = int((ours[:, 3] != theirs[:, 3]).sum())
    show(thing.data, angles)
    equal = int((ours == theirs).all(1).sum())
    print(f"{thing.name}: {len(ours)} corners, {equal} with equal bits, largest angle {angles.max():.6f} degrees")
    print(f"{signs} signs differ; colors are in {thing.data.color_attributes.active_color.name!r}")


if __name__ == "__main__":
    main()
