# SPDX-License-Identifier: MIT
"""What functions met on their way, as named tuples."""

from typing import Any, NamedTuple, Type, TypeVar

T = TypeVar("T")


class TangentReport(NamedTuple):
    """What was met while tangents were computed. Broken input is counted and never an error."""

    reference_order_abandoned: bool  #: the reference would take quadratic time, so its last step was left out
    triangle_count: int  #: triangles computed with, after cutting quads and n-gons
    degenerate_triangle_count: int  #: two corners at the same position
    degenerate_uv_count: int  #: triangles without UV area: they take their neighbours' frame
    mirrored_count: int  #: triangles that show the image mirrored, in the convention
    skipped_face_count: int  #: faces for which nothing was computed
    group_count: int  #: sets of corners that share one tangent
    default_corner_count: int  #: outputs that no face gives a tangent: they hold the method's default
    not_finite_count: int  #: outputs whose tangent has a NaN or infinity


class NormalReport(NamedTuple):
    """What was met while normals were computed."""

    face_count: int  #: faces with at least 3 corners
    degenerate_face_count: int  #: faces without a normal (zero area or not finite)
    fallback_corner_count: int  #: corners whose mean vanished and that got a substitute
    noise: float  #: noise of positions that `denoise` removed: standard deviation in mean edge lengths; 0: none
    crease_angle_deg: float  #: the angle that edges were held against: as given, or what "auto" found


class PositionNoise(NamedTuple):
    """How noisy positions are. Lengths are parts of `mean_edge`."""

    sigma: float  #: how far positions lie from a smooth surface through their neighbours: standard deviation
    kink_share: float  #: of how normals differ along an edge, the part that no smooth surface has: the median, 0 to 1
    noise: float  #: what of `sigma` is noise; 0: they are not noisy
    mean_edge: float  #: of a sample, in the unit of positions


class WindingReport(NamedTuple):
    """What was found and done. A component is what hangs together over pairs of faces at edges."""

    face_count: int  #: faces with at least 3 corners
    turned_count: int  #: faces that were turned
    conflict_count_before: int  #: pairs of faces that run through their edge in the same direction
    conflict_count_after: int
    component_count: int
    turned_component_count: int  #: of which more than half of the faces were turned
    by_normals_count: int  #: components decided by normals of the mesh
    by_volume_count: int  #: closed: by the volume
    by_nesting_count: int  #: closed, and lying in another one
    by_winding_number_count: int  #: open, but with an inside
    by_majority_count: int  #: as most of the area was wound
    small_count: int  #: fewer than 4 faces: nothing was turned
    one_sided_count: int  #: as a Moebius band: nothing was turned


class SanitizeReport(NamedTuple):
    """Corners mended, by cause (the first that applies) and by cure."""

    not_finite_count: int  #: NaN or infinity in the tangent
    zero_count: int  #: length 0
    not_unit_count: int  #: length off by more than 5e-4
    parallel_count: int  #: within 1 degree of +N or -N
    bad_sign_count: int  #: sign not exactly +1 or -1
    mixed_sign_count: int  #: sign changed because the face's corners disagreed
    orthogonalized_count: int  #: sound ones changed by orthogonalize_all
    normalized_count: int  #: cure: own direction, made unit and orthogonal to N
    from_neighbor_count: int  #: cure: direction of a sound corner of the same face or position
    from_basis_count: int  #: cure: basis from N alone
    bad_normal_count: int  #: corners whose N is zero or not finite
    mended_count: int  #: all corners that were written
    placeholder_count: int  #: cause: exactly (1, 0, 0), and not in the plane across N


class PackReport(NamedTuple):
    """Frames mended before they were packed, each counted once."""

    bad_normal_count: int  #: N zero or not finite: (0, 0, 1) took its place
    not_finite_count: int  #: NaN or infinity in the tangent: a basis from N took its place
    zero_count: int  #: tangent of length 0: a basis from N
    parallel_count: int  #: tangent within 1 degree of +N or -N: a basis from N
    not_unit_count: int  #: length of N or T off by more than 5e-4: made unit
    not_orthogonal_count: int  #: T was made orthogonal to N
    bad_sign_count: int  #: sign not exactly +1 or -1
    mended_count: int  #: the sum of them


def report(kind: Type[T], struct: Any) -> T:
    """The named tuple of a struct of the C API that has the same fields."""
    values = (getattr(struct, field) for field in kind._fields)  # type: ignore[attr-defined]
    kinds = kind.__annotations__.values()
    return kind(*(bool(value) if kind is bool else value for kind, value in zip(kinds, values)))
