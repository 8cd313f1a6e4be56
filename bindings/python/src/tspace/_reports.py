# SPDX-License-Identifier: MIT
"""Reports of functions, as named tuples."""

from typing import Any, NamedTuple, Type, TypeVar

T = TypeVar("T")


class TangentReport(NamedTuple):
    """Report of the tangent computation. Invalid geometry is counted, and never an error."""

    #: the last step of the reference was skipped, because it would have taken quadratic time
    reference_order_abandoned: bool
    triangle_count: int  #: triangles after triangulation of quads and n-gons
    degenerate_triangle_count: int  #: two corners at the same position
    degenerate_uv_count: int  #: triangles without UV area; they use the frame of their neighbors
    mirrored_count: int  #: triangles whose texture is mirrored, according to the convention
    skipped_face_count: int  #: faces for which nothing was computed
    group_count: int  #: sets of corners that share one tangent
    default_corner_count: int  #: outputs to which no face contributes; they hold the method's default
    not_finite_count: int  #: outputs whose tangent contains NaN or infinity


class NormalReport(NamedTuple):
    """Report of the normal computation."""

    face_count: int  #: faces with at least 3 corners
    degenerate_face_count: int  #: faces without a normal (zero area, or not finite)
    fallback_corner_count: int  #: corners whose weighted mean is zero and that got a fallback
    noise: float  #: position noise that `denoise` removed: standard deviation in mean edge lengths; 0: none
    crease_angle_deg: float  #: crease angle used: the given one, or the one that "auto" determined


class PositionNoise(NamedTuple):
    """Measured noise of positions. Lengths are relative to `mean_edge`."""

    sigma: float  #: distance of positions from a smooth surface through their neighbors: standard deviation
    kink_share: float  #: median part of the normal difference along an edge that no smooth surface has, 0 to 1
    noise: float  #: the part of `sigma` that is noise; 0: not noisy
    mean_edge: float  #: mean length of sampled edges, in the unit of positions


class WindingReport(NamedTuple):
    """Report of the winding repair. A component consists of faces connected by edges."""

    face_count: int  #: faces with at least 3 corners
    turned_count: int  #: flipped faces
    conflict_count_before: int  #: pairs of faces that traverse their common edge in the same direction
    conflict_count_after: int
    component_count: int
    turned_component_count: int  #: components with more than half of their faces flipped
    by_normals_count: int  #: components oriented by the normals of the mesh
    by_volume_count: int  #: closed components, oriented by their signed volume
    by_nesting_count: int  #: closed components inside another component
    by_winding_number_count: int  #: open components that enclose a volume
    by_majority_count: int  #: components oriented by the majority of their area
    small_count: int  #: components with fewer than 4 faces: not changed
    one_sided_count: int  #: one-sided components, such as a Moebius strip: not changed


class SanitizeReport(NamedTuple):
    """Repaired corners, by cause (the first that applies) and by kind of repair."""

    not_finite_count: int  #: tangent contains NaN or infinity
    zero_count: int  #: tangent has length 0
    not_unit_count: int  #: length off by more than 5e-4
    parallel_count: int  #: within 1 degree of +N or -N
    bad_sign_count: int  #: sign not exactly +1 or -1
    mixed_sign_count: int  #: sign changed because the corners of the face have different signs
    orthogonalized_count: int  #: valid tangents changed by orthogonalize_all
    normalized_count: int  #: repair: original direction, normalized and made orthogonal to N
    from_neighbor_count: int  #: repair: direction of a valid corner of the same face or position
    from_basis_count: int  #: repair: tangent computed from N only
    bad_normal_count: int  #: corners whose N is zero or not finite
    mended_count: int  #: all repaired corners
    placeholder_count: int  #: cause: exactly (1, 0, 0), and not perpendicular to N


class PackReport(NamedTuple):
    """Frames repaired before packing, each counted once."""

    bad_normal_count: int  #: N is zero or not finite: replaced by (0, 0, 1)
    not_finite_count: int  #: tangent contains NaN or infinity: replaced by a tangent computed from N
    zero_count: int  #: tangent has length 0: replaced by a tangent computed from N
    parallel_count: int  #: tangent within 1 degree of +N or -N: replaced by a tangent computed from N
    not_unit_count: int  #: length of N or T off by more than 5e-4: normalized
    not_orthogonal_count: int  #: T was made orthogonal to N
    bad_sign_count: int  #: sign not exactly +1 or -1
    mended_count: int  #: sum of the counts above


def report(kind: Type[T], struct: Any) -> T:
    """Returns the named tuple for a C API struct with the same fields."""
    values = (getattr(struct, field) for field in kind._fields)  # type: ignore[attr-defined]
    kinds = kind.__annotations__.values()
    return kind(*(bool(value) if kind is bool else value for kind, value in zip(kinds, values)))
