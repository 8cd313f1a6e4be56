// SPDX-License-Identifier: MIT
// Vector functions for drawing, and for the formulas whose results the page shows next to those of the library.

export type Vec2 = readonly [number, number];
export type Vec3 = readonly [number, number, number];

export const add = (a: Vec3, b: Vec3): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (k: number, a: Vec3): Vec3 => [k * a[0], k * a[1], k * a[2]];
export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vec3, b: Vec3): Vec3 => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a: Vec3): number => Math.sqrt(dot(a, a));
export const unit = (a: Vec3): Vec3 => (length(a) > 0 ? scale(1 / length(a), a) : a);

/** Returns the angle in degrees, accurate for small angles too. */
export const angle = (a: Vec3, b: Vec3): number => (Math.atan2(length(cross(a, b)), dot(a, b)) * 180) / Math.PI;

/** Returns `v` minus its component along the unit vector `n`. */
export const across = (v: Vec3, n: Vec3): Vec3 => sub(v, scale(dot(v, n), n));

/** The three corners of a triangle: positions and UVs. */
export interface Triangle {
  positions: readonly [Vec3, Vec3, Vec3];
  uvs: readonly [Vec2, Vec2, Vec2];
}

/** Returns dP/du and dP/dv of a triangle by Lengyel's formula, and its terms. Both are zero if the UVs have no area. */
export function derivatives({ positions: [p0, p1, p2], uvs: [a, b, c] }: Triangle) {
  const e1 = sub(p1, p0), e2 = sub(p2, p0);
  const s1 = b[0] - a[0], t1 = b[1] - a[1], s2 = c[0] - a[0], t2 = c[1] - a[1];
  const determinant = s1 * t2 - s2 * t1;
  const inverse = Math.abs(determinant) < 1e-9 ? 0 : 1 / determinant;
  return {
    e1, e2, s1, t1, s2, t2, determinant,
    tangent: scale(inverse, sub(scale(t2, e1), scale(t1, e2))),
    bitangent: scale(inverse, sub(scale(s1, e2), scale(s2, e1))),
  };
}

/** Formats a number with two decimal places; the width does not depend on the sign. */
export const text = (value: number, digits = 2): string => {
  const rounded = Object.is(Math.round(value * 10 ** digits), -0) || Math.abs(value) < 0.5 * 10 ** -digits ? 0 : value;
  return rounded.toFixed(digits).replace("-", "\u2212");
};
export const tuple = (values: readonly number[], digits = 2): string => `(${values.map((v) => text(v, digits)).join(", ")})`;
