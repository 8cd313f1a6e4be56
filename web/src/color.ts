// SPDX-License-Identifier: MIT
// Colours that the picture and its legends share. They differ in brightness too, so that no two of them need the eye for hue.

export type Rgb = readonly [number, number, number];

/** From no error to the end of the scale: dark violet over red to pale yellow, brighter all the way. */
export const heat: readonly Rgb[] = [
  [38, 24, 92],
  [116, 32, 128],
  [196, 56, 94],
  [244, 126, 48],
  [252, 230, 140],
];

export const signPlus: Rgb = [66, 133, 210];
export const signMinus: Rgb = [240, 168, 56];
export const wrong: Rgb = [214, 32, 60];
export const noData: Rgb = [128, 128, 132];

export const css = ([r, g, b]: Rgb): string => `rgb(${r} ${g} ${b})`;
export const heatGradient = `linear-gradient(90deg, ${heat.map(css).join(", ")})`;

/** For shaders, which work with the numbers as the screen shows them. */
export const glsl = ([r, g, b]: Rgb): string => `vec3(${[r, g, b].map((x) => (x / 255).toFixed(4)).join(", ")})`;
