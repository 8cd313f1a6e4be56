# SPDX-License-Identifier: MIT
"""Runs in Blender's window: checks a faulty ring by the add-on, and takes a picture of the window. Arguments: ZIP PICTURE.

    xvfb-run -a blender --factory-startup --python window.py -- tspace_addon.zip window.png
"""

import os
import sys
import traceback

import bpy
import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import add_on  # noqa: E402

bpy.context.preferences.view.show_splash = False
archive, picture = sys.argv[sys.argv.index("--") + 1 :]


def area_of_view():
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    return window, area, next(region for region in area.regions if region.type == "WINDOW")


def check_a_ring():
    add_on.install(archive)
    window, area, region = area_of_view()
    with bpy.context.temp_override(window=window, area=area, region=region):
        for thing in list(bpy.data.objects):
            bpy.data.objects.remove(thing)
        bpy.ops.mesh.primitive_torus_add(major_segments=24, minor_segments=12)
        ring = bpy.context.active_object
        for face in range(10, 60):
            for loop in ring.data.polygons[face].loop_indices:
                ring.data.uv_layers.active.data[loop].uv = (0.5, 0.5)
        bpy.ops.tspace.check()
        if not len(ring["tspace"]):
            raise SystemExit("FAILED: the ring's fault was not found")
        space = area.spaces.active
        space.show_region_ui = True
        space.shading.color_type = "VERTEX"
        bpy.ops.view3d.view_all()
    # The add-on's page is chosen by hand; here its panel moves to the page that is open.
    panel = bpy.types.TSPACE_PT_panel
    bpy.utils.unregister_class(panel)
    panel.bl_category, panel.bl_order = "Item", -1
    bpy.utils.register_class(panel)
    return 1.0


def take_the_picture():
    window, area, region = area_of_view()
    with bpy.context.temp_override(window=window, area=area, region=region):
        bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=2)
        bpy.ops.screen.screenshot(filepath=picture)
    pixels = numpy.empty(len(drawn := bpy.data.images.load(picture).pixels), numpy.float32)
    drawn.foreach_get(pixels)
    red, green, blue, _ = pixels.reshape(-1, 4).T
    count = int(((red > 2 * green) & (red > 2 * blue) & (red > 0.3)).sum())
    if count < 1000:
        raise SystemExit(f"FAILED: {count} pixels of the window are red, which the wrong faces should be")
    print(f"ok: {count} pixels are red in {picture}")
    return None


steps = [check_a_ring, take_the_picture]


def run():
    try:
        again = steps.pop(0)()
    except (Exception, SystemExit):
        traceback.print_exc()
        sys.stderr.flush()
        os._exit(1)
    if again is None:
        sys.stdout.flush()
        os._exit(0)
    return again


bpy.app.timers.register(run, first_interval=1.0)
