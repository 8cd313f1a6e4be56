# SPDX-License-Identifier: MIT
"""The panel in the sidebar and the preferences of the add-on."""

import textwrap

import bpy

from .operators import TEXT


class TspacePreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: bpy.props.StringProperty(name="Program", description="Path of the program tspace, if it is not found automatically", subtype="FILE_PATH")

    def draw(self, _context):
        self.layout.prop(self, "program")


class TspaceSettings(bpy.types.PropertyGroup):
    image: bpy.props.PointerProperty(name="Map", type=bpy.types.Image, description="The normal map for Convert and Flip Green; by default the last one baked")


class TSPACE_PT_panel(bpy.types.Panel):
    bl_label = "tspace"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "tspace"

    def draw(self, context):
        layout = self.layout
        column = layout.column(align=True)
        column.operator("tspace.check", icon="CHECKMARK")
        column.operator("tspace.compare", icon="ORIENTATION_NORMAL")
        column.operator("tspace.bake", icon="RENDER_STILL")
        layout.prop(context.scene.tspace, "image")
        column = layout.column(align=True)
        column.operator("tspace.convert_map")
        column.operator("tspace.flip_green")
        thing = context.active_object
        found = thing.get("tspace") if thing else None
        if found is None:
            return
        box = layout.box()
        box.label(text={0: "Nothing was found", 1: "1 finding"}.get(len(found), f"{len(found)} findings"), icon="INFO")
        for sentence, remedy in list(zip(found, thing["tspace_remedies"]))[:5]:
            for line in textwrap.wrap(sentence, 40) + textwrap.wrap(f"fix: {remedy}", 40):
                box.label(text=line)
        if len(found):
            box.label(text=f'all: text "{TEXT}"')


CLASSES = (TspacePreferences, TspaceSettings, TSPACE_PT_panel)
