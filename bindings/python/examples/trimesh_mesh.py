# SPDX-License-Identifier: MIT
"""trimesh: input vertices with UVs, output vertices with tangents, and a GLB that contains them."""

import numpy
import trimesh
import tspace


def with_frames(mesh, convention="opengl"):
    """Returns a trimesh.Trimesh with vertex_attributes["tangent"], from one with UVs. V points up in trimesh: "opengl".
    """
    uvs = mesh.visual.uv
    made = tspace.make_indexed_frames(mesh.vertices, mesh.vertex_normals, uvs, mesh.faces, convention=convention)
    result = trimesh.Trimesh(
        vertices=mesh.vertices[made.source_vertices],
        faces=made.indices.reshape(-1, 3),
        vertex_normals=made.normals,
        visual=trimesh.visual.TextureVisuals(uv=uvs[made.source_vertices], material=mesh.visual.material),
        process=False,  # would merge the split vertices again
    )
    result.vertex_attributes["tangent"] = made.tangents
    return result


def to_glb(mesh):
    """Returns a GLB with TANGENT. trimesh's exporter would name the attribute "_tangent", which no renderer reads."""
    plain = mesh.export(file_type="glb", include_normals=True)
    return tspace.generate_bytes(plain, all=True)  # all: also if the material has no normal map


def main():
    mesh = trimesh.creation.icosphere(subdivisions=2)
    around = numpy.arctan2(mesh.vertices[:, 1], mesh.vertices[:, 0]) / (2 * numpy.pi) + 0.5
    uvs = numpy.column_stack([around, mesh.vertices[:, 2] / 2 + 0.5])
    mesh.visual = trimesh.visual.TextureVisuals(uv=uvs)

    framed = with_frames(mesh)
    tangents = framed.vertex_attributes["tangent"]
    print(f"{len(mesh.vertices)} vertices became {len(framed.vertices)}, with tangents of shape {tangents.shape}")
    across = abs((tangents[:, :3] * framed.vertex_normals).sum(1)).max()
    print(f"T stands across N within {across:.1e}")
    assert across < 1e-5

    glb = to_glb(mesh)
    wrong = [finding.message for finding in tspace.check(glb).findings if finding.severity == "error"]
    assert not wrong, wrong
    print(f"a GLB of {len(glb)} bytes, whose tangents are those of {tspace.identify(glb).method}")


if __name__ == "__main__":
    main()
