# SPDX-License-Identifier: MIT
"""Conversion of Blender's meshes and images to arrays, GLB files and PNG files."""

import base64
import json
import struct
import zlib

import bpy
import numpy

from .tool import Failed

_FLOATS, _INDICES = 5126, 5125


def gathered(items, name, components, kind=numpy.float32):
    """Returns a property of all items of a Blender collection as an array."""
    values = numpy.empty(len(items) * components, kind)
    items.foreach_get(name, values)
    return values.reshape(-1, components) if components > 1 else values


class Arrays:
    """A mesh with one vertex per loop, so that vertex numbers in reports identify faces."""

    def __init__(self, mesh, with_tangents):
        if not mesh.uv_layers.active:
            raise Failed(f'"{mesh.name}" has no UV map')
        if not mesh.polygons:
            raise Failed(f'"{mesh.name}" has no faces')
        if hasattr(mesh, "calc_normals_split"):  # until 4.0
            mesh.calc_normals_split()
        sizes = gathered(mesh.polygons, "loop_total", 1, numpy.int32)
        self.has_ngons = bool((sizes > 4).any())
        self.face_of_loop = numpy.repeat(numpy.arange(len(sizes)), sizes)
        vertices = gathered(mesh.loops, "vertex_index", 1, numpy.int32)
        self.positions = gathered(mesh.vertices, "co", 3)[vertices]
        self.normals = gathered(mesh.loops, "normal", 3)
        self.uvs = gathered(mesh.uv_layers.active.data, "uv", 2).copy()
        self.face_normals = gathered(mesh.polygons, "normal", 3)
        mesh.calc_loop_triangles()
        self.triangles = gathered(mesh.loop_triangles, "loops", 3, numpy.int32)
        self.material_of_triangle = gathered(mesh.loop_triangles, "material_index", 1, numpy.int32)
        self.tangents = None
        if with_tangents and not self.has_ngons:  # Blender refuses faces of more than 4 corners
            mesh.calc_tangents(uvmap=mesh.uv_layers.active.name)
            signs = gathered(mesh.loops, "bitangent_sign", 1)
            self.tangents = numpy.column_stack([gathered(mesh.loops, "tangent", 3), signs]).astype(numpy.float32)
            mesh.free_tangents()

    def faces_of_loops(self, loops):
        return self.face_of_loop[numpy.asarray(loops, int)]

    def faces_without_uv_area(self):
        a, b, c = (self.uvs[self.triangles[:, i]].astype(float) for i in range(3))
        area = numpy.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
        size = numpy.maximum((b - a) ** 2, (c - a) ** 2).sum(1)
        return numpy.unique(self.face_of_loop[self.triangles[area <= 1e-9 * size, 0]])

    def faces_with_normals_against_winding(self):
        towards = (self.normals * self.face_normals[self.face_of_loop]).sum(1)
        return numpy.unique(self.face_of_loop[towards < 0])


def normal_image(material):
    """Returns the image that is connected to a Normal Map node of a material, or None."""
    if material is None or not material.use_nodes:
        return None
    for node in material.node_tree.nodes:
        if node.type == "NORMAL_MAP" and node.inputs["Color"].is_linked:
            source = node.inputs["Color"].links[0].from_node
            if source.type == "TEX_IMAGE" and source.image:
                return source.image
    return None


def write_glb(path, name, arrays, materials, image_uris):
    """Returns a GLB with one primitive per material. image_uris: path of each material's normal map, or None."""
    views, accessors, data = [], [], bytearray()

    def accessor(array, kind, component):
        array = numpy.ascontiguousarray(array)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": array.nbytes})
        entry = {"bufferView": len(views) - 1, "componentType": component, "count": len(array), "type": kind}
        if kind == "VEC3":
            entry.update(min=array.min(0).tolist(), max=array.max(0).tolist())
        data.extend(array.tobytes())
        accessors.append(entry)
        return len(accessors) - 1

    flipped = arrays.uvs * numpy.float32([1, -1]) + numpy.float32([0, 1])  # glTF's v runs down
    attributes = {
        "POSITION": accessor(arrays.positions, "VEC3", _FLOATS),
        "NORMAL": accessor(arrays.normals, "VEC3", _FLOATS),
        "TEXCOORD_0": accessor(flipped.astype(numpy.float32), "VEC2", _FLOATS),
    }
    if arrays.tangents is not None:
        attributes["TANGENT"] = accessor(arrays.tangents, "VEC4", _FLOATS)
    primitives, gltf_materials, textures, images = [], [], [], []
    for number in numpy.unique(arrays.material_of_triangle):
        chosen = arrays.triangles[arrays.material_of_triangle == number].astype(numpy.uint32).ravel()
        material = materials[number] if number < len(materials) else None
        uri = image_uris[number] if number < len(image_uris) else None
        images.append({"uri": uri or _FLAT})
        textures.append({"source": len(images) - 1})
        gltf_materials.append({"name": material.name if material else "", "normalTexture": {"index": len(textures) - 1}})
        entry = {"attributes": attributes, "indices": accessor(chosen, "SCALAR", _INDICES), "material": len(gltf_materials) - 1}
        primitives.append(entry)
    document = {
        "asset": {"version": "2.0", "generator": "tspace for Blender"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": name}],
        "meshes": [{"name": name, "primitives": primitives}],
        "materials": gltf_materials,
        "textures": textures,
        "images": images,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(data)}],
    }
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    data.extend(b"\0" * (-len(data) % 4))
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data)


def _png(width, height, bits, rows):
    """Returns a PNG with three channels. Each row of `rows` begins with its filter type, 0."""

    def chunk(kind, content):
        checked = kind + content
        return struct.pack(">I", len(content)) + checked + struct.pack(">I", zlib.crc32(checked))

    head = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, bits, 2, 0, 0, 0))
    return b"\x89PNG\r\n\x1a\n" + head + chunk(b"IDAT", zlib.compress(rows, 6)) + chunk(b"IEND", b"")


# A flat normal map of one texel. Tangents are then also checked for materials without a normal map.
_FLAT = "data:image/png;base64," + base64.b64encode(_png(1, 1, 8, bytes([0, 128, 128, 255]))).decode()


def write_png(path, image):
    """Writes the stored values of an image as a 16-bit PNG, without color space conversion."""
    width, height = image.size
    if not width or not height:
        raise Failed(f'"{image.name}" has no pixels')
    pixels = numpy.empty(width * height * image.channels, numpy.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(height, width, image.channels)[::-1]
    if image.channels < 3:
        pixels = numpy.repeat(pixels[:, :, :1], 3, axis=2)
    numbers = numpy.rint(numpy.clip(numpy.nan_to_num(pixels[:, :, :3]), 0, 1) * 65535).astype(">u2")
    rows = numpy.concatenate([numpy.zeros((height, 1), numpy.uint8), numbers.reshape(height, -1).view(numpy.uint8)], axis=1)

    with open(path, "wb") as file:
        file.write(_png(width, height, 16, rows.tobytes()))


def load_map(path, name):
    """Loads a PNG as a packed image datablock with this name and the color space Non-Color."""
    loaded = bpy.data.images.load(path, check_existing=False)
    loaded.colorspace_settings.name = "Non-Color"
    loaded.pack()
    loaded.name = name
    return loaded


class Standing:
    """Context manager for a temporary copy of the evaluated mesh of an object, with modifiers applied; removed on exit."""

    def __init__(self, thing, context):
        evaluated = thing.evaluated_get(context.evaluated_depsgraph_get())
        self.mesh = bpy.data.meshes.new_from_object(evaluated)
        self.mesh.transform(thing.matrix_world)
        if thing.matrix_world.determinant() < 0:
            self.mesh.flip_normals()

    def __enter__(self):
        return self.mesh

    def __exit__(self, *_):
        bpy.data.meshes.remove(self.mesh)
