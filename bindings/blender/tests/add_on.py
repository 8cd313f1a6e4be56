# SPDX-License-Identifier: MIT
"""Installs the add-on as users of this Blender do."""

import importlib
import pathlib
import sys

import bpy


def install(archive):
    """Installs as an extension from Blender 4.2 on, and as an add-on before. Returns the name of its module."""
    if bpy.app.version < (4, 2, 0):
        bpy.ops.preferences.addon_install(filepath=archive, overwrite=True)
        bpy.ops.preferences.addon_enable(module="tspace_addon")
        return "tspace_addon"
    bpy.ops.extensions.package_install_files(filepath=archive, repo="user_default", enable_on_install=True)
    return "bl_ext.user_default.tspace"


def part(module, name):
    return importlib.import_module(f"{module}.{name}")


def folder(module):
    return pathlib.Path(sys.modules[module].__file__).parent
