// SPDX-License-Identifier: MIT
// Colors shared by the picture and its legends.

export type Rgb = readonly [number, number, number];

/** Color scale of errors, as in `tspace render`: degrees and the colors at them. Colors in between are interpolated. */
export const heatDegrees: readonly number[] = [0, 1, 5, 15, 45, 90, 180];
export const heat: readonly Rgb[] = [
  [41, 48, 89],
  [33, 120, 181],
  [51, 181, 122],
  [237, 224, 64],
  [245, 140, 31],
  [214, 38, 41],
  [242, 89, 230],
];

export const signPlus: Rgb = [66, 133, 210];
export const signMinus: Rgb = [240, 168, 56];
export const wrong: Rgb = [214, 32, 60];
export const noData: Rgb = [128, 128, 132];

export const css = ([r, g, b]: Rgb): string => `rgb(${r} ${g} ${b})`;
export const heatGradient = `linear-gradient(90deg, ${heat.map(css).join(", ")})`;

/** Returns a color for shaders that compute with display (sRGB-encoded) values. */
export const glsl = ([r, g, b]: Rgb): string => `vec3(${[r, g, b].map((x) => (x / 255).toFixed(4)).join(", ")})`;
