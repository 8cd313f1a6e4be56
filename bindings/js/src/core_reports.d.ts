// SPDX-License-Identifier: MIT
// Reports of calls.

// Everything below is written by scripts/api.

/** Counts of triangles, groups and defects of the input. Invalid geometry never makes a call fail. */
export interface TangentReport {
  /**
   * `mikktspace`: the input would drive the reference into quadratic time, so one of its steps was skipped. This is
   * either the sort (with `reference`; the corrected pairing was used for the last bucket; only crafted inputs cause
   * this), or the angular test (a group of more than 4096 faces whose tangents spread too far was not split).
   */
  referenceOrderAbandoned: number;
  /** Processed triangles, after triangulation of quads and n-gons. */
  triangleCount: number;
  /** Triangles with two corners at the same position. */
  degenerateTriangleCount: number;
  /** Triangles without UV area: they use the frames of their neighbors. */
  degenerateUvCount: number;
  /** Triangles that show the image mirrored, in the chosen convention. */
  mirroredCount: number;
  /** Faces for which nothing was computed. */
  skippedFaceCount: number;
  /** Groups: sets of corners that share one tangent. */
  groupCount: number;
  /** Outputs without a tangent from any face: default of the method. */
  defaultCornerCount: number;
  /** Outputs whose tangent has a NaN or infinity. */
  notFiniteCount: number;
  /** Given options that the method or weighting does not use. */
  ignoredOptions?: string[];
}

/** Counts of faces and defects of the input. Invalid geometry never makes the call fail. */
export interface NormalReport {
  /** Faces with at least 3 corners. */
  faceCount: number;
  /** Faces without a normal (zero area or not finite). */
  degenerateFaceCount: number;
  /** Corners whose mean vanished and was replaced (see generateNormals). */
  fallbackCornerCount: number;
  /**
   * Noise that `denoise` removed: standard deviation of positions along the normal, in mean edge lengths. 0: denoising
   * was off or found no noise, and changed no bit.
   */
  noise: number;
  /**
   * Crease angle that was used: as given, or as derived from the mesh (for noisy positions, an angle between smoothed
   * faces). `flat`: 0.
   */
  creaseAngle: number;
  /** Given options that the method or weighting does not use. */
  ignoredOptions?: string[];
}

/** Result of measurePositionNoise. Lengths are relative to `mean_edge`. */
export interface PositionNoise {
  /**
   * Standard deviation of positions from a smooth surface through their neighbors, along the normal. Includes detail
   * of the size of a triangle. 0: fewer than 200 vertices have enough neighbors for a measurement.
   */
  sigma: number;
  /**
   * How abruptly normals change along edges, from 0 to 1: the median over the sampled edges of x^2 / (x^2 + y^2),
   * where x is the part of the change that uniform bending cannot explain (0 on a circle), and y the part that it
   * explains. Noise: 0.3 to 0.8. CAD models, bevels and decimated meshes: less, for the same sigma.
   */
  kinkShare: number;
  /**
   * Part of `sigma` that is noise, which `denoise` removes automatically. 0: positions are not noisy, or most edges
   * are flatter than noise would leave them.
   */
  noise: number;
  /** Mean length of the sampled edges, in mesh units, without the length that noise of `sigma` adds to them. */
  meanEdge: number;
}

/** Corners repaired, by cause (the first that applies, in this order) and by fix. */
export interface SanitizeReport {
  /** NaN or infinity in the tangent. */
  notFiniteCount: number;
  /** Length 0 (or too small to normalize). */
  zeroCount: number;
  /** Length off by more than 5e-4 (the glTF validator's tolerance). */
  notUnitCount: number;
  /** Within 1 degree of +N or -N: no frame can be built. */
  parallelCount: number;
  /** Sign not exactly +1 or -1. */
  badSignCount: number;
  /** Sign changed because the signs of the face's corners differed. */
  mixedSignCount: number;
  /** Valid tangents changed by orthogonalize_all. */
  orthogonalizedCount: number;
  /** Fix: its own direction, made unit and orthogonal to N. */
  normalizedCount: number;
  /** Fix: direction of a valid corner of the same face or position. */
  fromNeighborCount: number;
  /** Fix: basis from N (Duff et al. 2017). */
  fromBasisCount: number;
  /** Corners whose N is zero or not finite: only a unit tangent is guaranteed. */
  badNormalCount: number;
  /** Returns the number of corners that were written: the sum of the causes. */
  mendedCount: number;
  /** Exactly (1, 0, 0), and not perpendicular to N. */
  placeholderCount: number;
}

/**
 * Results of mendWinding. A *component* is a set of faces connected by pairs of faces at edges. A pair is in
 * *conflict* if both faces traverse their shared edge in the same direction.
 */
export interface WindingReport {
  /** Faces with at least 3 corners. */
  faceCount: number;
  /** Faces to flip. */
  turnedCount: number;
  conflictCountBefore: number;
  /** Conflicts left after flipping. */
  conflictCountAfter: number;
  componentCount: number;
  /** Components in which more than half of the faces are flipped. */
  turnedComponentCount: number;
  /** Normals of the mesh. */
  byNormalsCount: number;
  /** Closed: the volume must be positive. */
  byVolumeCount: number;
  /** Closed, inside another component: keeps the winding of most of its area; if that is undecided, it is a cavity. */
  byNestingCount: number;
  /** Open, but with an inside: decided by the generalized winding number at its own faces. */
  byWindingNumberCount: number;
  /** Open, without an inside: keeps the winding of most of its area. */
  byMajorityCount: number;
  /** Fewer than 4 faces, such as leaves and cards: never flipped, because nothing shows their outside. */
  smallCount: number;
  /**
   * Flipping single faces would not reduce the number of conflicts, as on a Moebius band. No face is flipped, or all
   * faces if the component is open and its winding number shows that it is inside out.
   */
  oneSidedCount: number;
}

/** Frames repaired before packing. Each is counted once, by the first cause that applies, in this order. */
export interface PackReport {
  /** N zero or not finite: replaced by (0, 0, 1). */
  badNormalCount: number;
  /** NaN or infinity in the tangent: replaced by a basis from N. */
  notFiniteCount: number;
  /** Tangent of length 0 (or too small to normalize): replaced by a basis from N. */
  zeroCount: number;
  /** Tangent within 1 degree of +N or -N: replaced by a basis from N. */
  parallelCount: number;
  /** Length of N or T off by more than 5e-4: normalized. */
  notUnitCount: number;
  /** Cosine between N and T beyond 5e-4: T made orthogonal to N. */
  notOrthogonalCount: number;
  /** Sign not exactly +1 or -1: below 0 becomes -1, other values +1. */
  badSignCount: number;
  /** Returns the number of repaired frames: the sum of the causes. */
  mendedCount: number;
}
