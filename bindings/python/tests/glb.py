# SPDX-License-Identifier: MIT
"""Small GLB files, created in memory."""

import json
import struct

import numpy


def make_glb(shape, tangents=None, uri=None):
    """Returns a GLB with one mesh whose material has a normal map. With `uri`: returns a glTF, and the bytes of its
    buffer."""
    arrays = [
        ("POSITION", "VEC3", shape.positions),
        ("NORMAL", "VEC3", shape.normals),
        ("TEXCOORD_0", "VEC2", shape.uvs),
        ("TANGENT", "VEC4", tangents),
        (None, "SCALAR", shape.indices.astype(numpy.uint32)),
    ]
    accessors, views, attributes, data = [], [], {}, b""
    for name, kind, array in arrays:
        if array is None:
            continue
        accessor = {
            "bufferView": len(views),
            "componentType": 5126 if name else 5125,
            "count": len(array),
            "type": kind,
        }
        if name == "POSITION":
            accessor.update(min=array.min(0).tolist(), max=array.max(0).tolist())
        if name:
            attributes[name] = len(accessors)
        accessors.append(accessor)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": array.nbytes})
        data += array.tobytes()
    pixel = (
        "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGNoaPgPAAMEAYA"
        "cyl3MAAAAAElFTkSuQmCC"
    )
    gltf = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": len(accessors) - 1, "material": 0}]}],
        "materials": [{"normalTexture": {"index": 0}}],
        "textures": [{"source": 0}],
        "images": [{"uri": pixel}],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(data), **({"uri": uri} if uri else {})}],
    }
    text = json.dumps(gltf).encode()
    if uri:
        return text, data
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    head = struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + len(data))
    return head + struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data


def read_glb(data):
    """Returns the JSON of a GLB, and a function that returns the numbers of an accessor."""
    length = struct.unpack_from("<I", data, 12)[0]
    gltf = json.loads(data[20 : 20 + length])
    binary = data[28 + length :]

    def read(index):
        accessor = gltf["accessors"][index]
        view = gltf["bufferViews"][accessor["bufferView"]]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        kind = {5126: numpy.float32, 5125: numpy.uint32, 5123: numpy.uint16}[accessor["componentType"]]
        assert "byteStride" not in view or view["byteStride"] == width * numpy.dtype(kind).itemsize
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        return numpy.frombuffer(binary, kind, accessor["count"] * width, start).reshape(-1, width)

    return gltf, read
