# SPDX-License-Identifier: MIT
"""A vase with numpy only: indexed frames, how the split changed vertices, and the normal of a texel of a normal map."""

import numpy
import tspace


def vase(rows, columns):
    """Returns a surface of revolution as quads. The texture is mirrored on the second half, so the seam needs two
    tangents."""
    v, u = numpy.mgrid[0 : rows + 1, 0:columns] / [[[rows]], [[columns]]]
    radius = 1 + 0.4 * numpy.sin(2 * numpy.pi * v)
    positions = numpy.stack([radius * numpy.cos(2 * numpy.pi * u), radius * numpy.sin(2 * numpy.pi * u), 3 * v], -1)
    uvs = numpy.stack([1 - abs(2 * u - 1), v], -1)
    corner = numpy.arange(rows)[:, None] * columns + numpy.arange(columns)
    right = numpy.arange(rows)[:, None] * columns + (numpy.arange(columns) + 1) % columns
    quads = numpy.stack([corner, right, right + columns, corner + columns], -1)
    return positions.reshape(-1, 3), uvs.reshape(-1, 2), quads.reshape(-1, 4)


def main():
    positions, uvs, quads = vase(24, 32)
    mesh = tspace.make_indexed_frames(positions, None, uvs, quads, convention="opengl", method="best")
    print(f"{len(positions)} vertices became {len(mesh.source_vertices)}: the rest copies those at the seam")

    # All other vertex attributes are gathered in the same way.
    new_positions, new_uvs = positions[mesh.source_vertices], uvs[mesh.source_vertices]
    assert len(new_positions) == len(new_uvs) == len(mesh.normals) == len(mesh.tangents)

    # Like in a shader: a texel (red, green, blue) is a linear combination of T, B and N.
    tangent, sign = mesh.tangents[:, :3], mesh.tangents[:, 3:]
    bitangent = sign * numpy.cross(mesh.normals, tangent)
    red, green, blue = 2 * numpy.array([0.6, 0.5, 0.95]) - 1
    bumped = red * tangent + green * bitangent + blue * mesh.normals
    bumped /= numpy.linalg.norm(bumped, axis=1, keepdims=True)
    lean = numpy.degrees(numpy.arccos((bumped * mesh.normals).sum(1)))
    print(f"normals of the map lean by {lean.min():.2f} to {lean.max():.2f} degrees")
    print(f"mirrored faces: {mesh.report.tangents.mirrored_count} of {mesh.report.tangents.triangle_count} triangles")


if __name__ == "__main__":
    main()
