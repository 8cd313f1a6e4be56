# SPDX-License-Identifier: MIT
"""Reports of functions, as named tuples."""

from typing import NamedTuple

# Everything below is written by scripts/api.


class TangentReport(NamedTuple):
    """Counts of triangles, groups and defects of the input. Invalid geometry never makes a call fail."""

    #: `mikktspace`: the input would drive the reference into quadratic time, so one of its steps was skipped. This
    #: is either the sort (with `reference`; the corrected pairing was used for the last bucket; only crafted inputs
    #: cause this), or the angular test (a group of more than 4096 faces whose tangents spread too far was not
    #: split).
    reference_order_abandoned: bool
    #: Processed triangles, after triangulation of quads and n-gons.
    triangle_count: int
    #: Triangles with two corners at the same position.
    degenerate_triangle_count: int
    #: Triangles without UV area: they use the frames of their neighbors.
    degenerate_uv_count: int
    #: Triangles that show the image mirrored, in the chosen convention.
    mirrored_count: int
    #: Faces for which nothing was computed.
    skipped_face_count: int
    #: Groups: sets of corners that share one tangent.
    group_count: int
    #: Outputs without a tangent from any face: default of the method.
    default_corner_count: int
    #: Outputs whose tangent has a NaN or infinity.
    not_finite_count: int


class NormalReport(NamedTuple):
    """Counts of faces and defects of the input. Invalid geometry never makes the call fail."""

    #: Faces with at least 3 corners.
    face_count: int
    #: Faces without a normal (zero area or not finite).
    degenerate_face_count: int
    #: Corners whose mean vanished and was replaced (see generateNormals).
    fallback_corner_count: int
    #: Noise that `denoise` removed: standard deviation of positions along the normal, in mean edge lengths. 0:
    #: denoising was off or found no noise, and changed no bit.
    noise: float
    #: Crease angle that was used: as given, or as derived from the mesh (for noisy positions, an angle between
    #: smoothed faces). `flat`: 0.
    crease_angle_deg: float


class PositionNoise(NamedTuple):
    """Result of measurePositionNoise. Lengths are relative to `mean_edge`."""

    #: Standard deviation of positions from a smooth surface through their neighbors, along the normal. Includes
    #: detail of the size of a triangle. 0: fewer than 200 vertices have enough neighbors for a measurement.
    sigma: float
    #: How abruptly normals change along edges, from 0 to 1: the median over the sampled edges of x^2 / (x^2 + y^2),
    #: where x is the part of the change that uniform bending cannot explain (0 on a circle), and y the part that it
    #: explains. Noise: 0.3 to 0.8. CAD models, bevels and decimated meshes: less, for the same sigma.
    kink_share: float
    #: Part of `sigma` that is noise, which `denoise` removes automatically. 0: positions are not noisy, or most
    #: edges are flatter than noise would leave them.
    noise: float
    #: Mean length of the sampled edges, in mesh units, without the length that noise of `sigma` adds to them.
    mean_edge: float


class SanitizeReport(NamedTuple):
    """Corners repaired, by cause (the first that applies, in this order) and by fix."""

    #: NaN or infinity in the tangent.
    not_finite_count: int
    #: Length 0 (or too small to normalize).
    zero_count: int
    #: Length off by more than 5e-4 (the glTF validator's tolerance).
    not_unit_count: int
    #: Within 1 degree of +N or -N: no frame can be built.
    parallel_count: int
    #: Sign not exactly +1 or -1.
    bad_sign_count: int
    #: Sign changed because the signs of the face's corners differed.
    mixed_sign_count: int
    #: Valid tangents changed by orthogonalize_all.
    orthogonalized_count: int
    #: Fix: its own direction, made unit and orthogonal to N.
    normalized_count: int
    #: Fix: direction of a valid corner of the same face or position.
    from_neighbor_count: int
    #: Fix: basis from N (Duff et al. 2017).
    from_basis_count: int
    #: Corners whose N is zero or not finite: only a unit tangent is guaranteed.
    bad_normal_count: int
    #: Returns the number of corners that were written: the sum of the causes.
    mended_count: int
    #: Exactly (1, 0, 0), and not perpendicular to N.
    placeholder_count: int


class WindingReport(NamedTuple):
    """Results of mendWinding. A *component* is a set of faces connected by pairs of faces at edges. A pair is in *conflict* if both faces traverse their shared edge in the same direction."""

    #: Faces with at least 3 corners.
    face_count: int
    #: Faces to flip.
    turned_count: int
    conflict_count_before: int
    #: Conflicts left after flipping.
    conflict_count_after: int
    component_count: int
    #: Components in which more than half of the faces are flipped.
    turned_component_count: int
    #: Normals of the mesh.
    by_normals_count: int
    #: Closed: the volume must be positive.
    by_volume_count: int
    #: Closed, inside another component: keeps the winding of most of its area; if that is undecided, it is a cavity.
    by_nesting_count: int
    #: Open, but with an inside: decided by the generalized winding number at its own faces.
    by_winding_number_count: int
    #: Open, without an inside: keeps the winding of most of its area.
    by_majority_count: int
    #: Fewer than 4 faces, such as leaves and cards: never flipped, because nothing shows their outside.
    small_count: int
    #: Flipping single faces would not reduce the number of conflicts, as on a Moebius band. No face is flipped, or
    #: all faces if the component is open and its winding number shows that it is inside out.
    one_sided_count: int


class PackReport(NamedTuple):
    """Frames repaired before packing. Each is counted once, by the first cause that applies, in this order."""

    #: N zero or not finite: replaced by (0, 0, 1).
    bad_normal_count: int
    #: NaN or infinity in the tangent: replaced by a basis from N.
    not_finite_count: int
    #: Tangent of length 0 (or too small to normalize): replaced by a basis from N.
    zero_count: int
    #: Tangent within 1 degree of +N or -N: replaced by a basis from N.
    parallel_count: int
    #: Length of N or T off by more than 5e-4: normalized.
    not_unit_count: int
    #: Cosine between N and T beyond 5e-4: T made orthogonal to N.
    not_orthogonal_count: int
    #: Sign not exactly +1 or -1: below 0 becomes -1, other values +1.
    bad_sign_count: int
    #: Returns the number of repaired frames: the sum of the causes.
    mended_count: int
