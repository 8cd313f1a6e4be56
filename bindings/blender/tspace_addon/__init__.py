# SPDX-License-Identifier: MIT
"""tspace in Blender: checks meshes and their normal maps, compares tangents, bakes, converts and flips maps.

It runs the program tspace from the folder bin next to this file, from the path in the preferences, or from PATH."""

bl_info = {
    "name": "tspace",
    "author": "The tspace authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > tspace",
    "description": "Checks tangents and normal maps, and bakes with the error in degrees",
    "category": "Mesh",
}

import bpy

from . import operators, panel

CLASSES = (*operators.CLASSES, *panel.CLASSES)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Scene.tspace = bpy.props.PointerProperty(type=panel.TspaceSettings)


def unregister():
    del bpy.types.Scene.tspace
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
