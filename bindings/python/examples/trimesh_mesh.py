# SPDX-License-Identifier: MIT
"""trimesh: vertices with UVs in, vertices with tangents out, as a vertex attribute that its exporters write."""

import numpy
import trimesh
import tspace


def with_frames(mesh, convention="opengl"):
    """A trimesh.Trimesh whose vertex_attributes has "tangent", of one with UVs."""
    uvs = mesh.visual.uv
    made = tspace.make_indexed_frames(mesh.vertices, mesh.vertex_normals, uvs, mesh.faces, convention=convention)
    visual = trimesh.visual.TextureVisuals(uv=uvs[made.source_vertex], material=mesh.visual.material)
    result = trimesh.Trimesh(
        vertices=mesh.vertices[made.source_vertex],
        faces=made.indices.reshape(-1, 3),
        vertex_normals=made.normals,
        visual=visual,
        process=False,  # it would merge the vertices that were split
    )
    result.vertex_attributes["tangent"] = made.tangents
    return result


def main():
    mesh = trimesh.creation.icosphere(subdivisions=2)
    around = numpy.arctan2(mesh.vertices[:, 1], mesh.vertices[:, 0]) / (2 * numpy.pi) + 0.5
    uvs = numpy.column_stack([around, mesh.vertices[:, 2] / 2 + 0.5])
    mesh.visual = trimesh.visual.TextureVisuals(uv=uvs)
    framed = with_frames(mesh)
    tangents = framed.vertex_attributes["tangent"]
    print(f"{len(mesh.vertices)} vertices became {len(framed.vertices)}, with tangents of shape {tangents.shape}")


if __name__ == "__main__":
    main()
