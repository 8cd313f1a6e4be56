# SPDX-License-Identifier: MIT
"""Open3D stores UVs per corner, so the call takes an index list for positions and one row of UVs per corner."""

import numpy
import open3d
import tspace


def with_frames(mesh, convention="opengl"):
    """Returns an open3d.t.geometry.TriangleMesh with normals, UVs and tangents per vertex, from a legacy mesh with
    triangle_uvs."""
    positions = numpy.asarray(mesh.vertices)  # float64: tspace converts it
    triangles = numpy.asarray(mesh.triangles)  # int32, used without a copy
    uvs = numpy.asarray(mesh.triangle_uvs)
    normals = numpy.asarray(mesh.vertex_normals) if mesh.has_vertex_normals() else None
    made = tspace.make_indexed_frames(positions, normals, uvs, triangles, uv_indices="corners", convention=convention)

    result = open3d.t.geometry.TriangleMesh()
    result.vertex.positions = open3d.core.Tensor(positions[made.source_vertices].astype(numpy.float32))
    result.vertex.normals = open3d.core.Tensor(made.normals)
    result.vertex.texture_uvs = open3d.core.Tensor(uvs[made.source_corners].astype(numpy.float32))
    result.vertex.tangents = open3d.core.Tensor(made.tangents)
    result.triangle.indices = open3d.core.Tensor(made.indices.reshape(-1, 3).astype(numpy.int32))
    return result


def main():
    mesh = open3d.geometry.TriangleMesh.create_box(create_uv_map=True)
    framed = with_frames(mesh)
    tangents = framed.vertex.tangents.numpy()
    normals = framed.vertex.normals.numpy()
    across = abs((tangents[:, :3] * normals).sum(1)).max()
    print(
        f"{len(mesh.vertices)} vertices and {len(mesh.triangle_uvs)} UVs became {len(tangents)} vertices with tangents"
    )
    print(f"T stands across N within {across:.1e}")
    assert across < 1e-5


if __name__ == "__main__":
    main()
