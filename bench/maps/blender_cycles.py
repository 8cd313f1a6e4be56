# SPDX-License-Identifier: MIT
"""Functions shared by the scripts that bake with Blender: Cycles on two threads, selected to active."""
import bpy


def set_up(samples):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    # If no denoiser is available, a bake that requests one remains empty.
    scene.cycles.use_denoising = False
    scene.cycles.use_adaptive_sampling = False
    scene.render.threads_mode = "FIXED"
    scene.render.threads = 2


def target(material, image):
    """Makes the image the bake target of all objects that have the material."""
    material.use_nodes = True
    nodes = material.node_tree.nodes
    node = nodes.new("ShaderNodeTexImage")
    node.image = image
    nodes.active = node


def select(low, high):
    bpy.ops.object.select_all(action="DESELECT")
    high.select_set(True)
    low.select_set(True)
    bpy.context.view_layer.objects.active = low


def save_numbers(image, path):
    """Saves an image as a 16-bit PNG. save_render applies the view transform; the transform Raw does not change values."""
    scene = bpy.context.scene
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.color_depth = "16"
    scene.view_settings.view_transform = "Raw"
    image.save_render(path, scene=scene)
