// SPDX-License-Identifier: MIT
// Evaluates a picture of NormalTangentTest. The model is a grid of square cells, with three pairs per row. The left
// cell of a pair is a dome of triangles; the right one is a flat square with a normal map of such a dome, and the UVs
// are rotated by a different angle in each row. If the frames are right, both cells of a pair are lit on the same side.

/// The rendered part of the model's front: x and y from -half to half, in size by size pixels.
export const VIEW = { half: 1.25, size: 600 };

/// Light directions, in addition to the front. One light is insufficient: a frame with a wrong sign mirrors the dome
/// along its tangent, which does not change the lit side if the light has that direction.
export const LIGHTS = { right: [1, 0], top: [0, 1] };

const ROWS = [0.8, 0.4, 0, -0.4, -0.8];
const PAIRS = [-0.96, -0.16, 0.64];  // x of the domes of triangles; mapped cells are PAIR_DISTANCE to the right
const PAIR_DISTANCE = 0.32;
const DOME_RADIUS = 0.1;

export const MAPPED_CELLS = ROWS.length * PAIRS.length;

const MOST_DEGREES = 20; // maximum angle between the lit sides of the two cells of a pair
// minimum contrast of a mapped cell relative to its dome: an unused normal map has no contrast
const LEAST_CONTRAST = 0.5;
const LEAST_DOME_CONTRAST = 5; // minimum contrast of a dome, in steps of 1/255; it is about 19 here

/// Returns the direction of increasing brightness, scaled by its amount. Pixels are RGBA, starting with the bottom row.
function litSide(pixels, center_x, center_y) {
    const scale = VIEW.size / (2 * VIEW.half);
    const x0 = (center_x + VIEW.half) * scale, y0 = (center_y + VIEW.half) * scale, radius = DOME_RADIUS * scale;
    let x_sum = 0, y_sum = 0, count = 0;
    for (let row = Math.ceil(y0 - radius); row <= y0 + radius; ++row) {
        for (let column = Math.ceil(x0 - radius); column <= x0 + radius; ++column) {
            const x = column + 0.5 - x0, y = row + 0.5 - y0;
            if (x * x + y * y > radius * radius) continue;
            const at = 4 * (row * VIEW.size + column);
            const brightness = (pixels[at] + pixels[at + 1] + pixels[at + 2]) / 3;
            x_sum += brightness * x;
            y_sum += brightness * y;
            ++count;
        }
    }
    return [x_sum / count / radius, y_sum / count / radius];
}

const degreesBetween = ([ax, ay], [bx, by]) => Math.abs(Math.atan2(ax * by - ay * bx, ax * bx + ay * by)) * (180 / Math.PI);

/// Returns one entry per pair of cells and light: the deviation of the mapped cell from its dome.
export function comparePairs(pixels_of_lights) {
    const compared = [];
    for (const [row, y] of ROWS.entries()) {
        for (const [pair, x] of PAIRS.entries()) {
            for (const [side, light] of Object.entries(LIGHTS)) {
                const dome = litSide(pixels_of_lights[side], x, y);
                const mapped = litSide(pixels_of_lights[side], x + PAIR_DISTANCE, y);
                compared.push({
                    row, pair, side,
                    dome_degrees: degreesBetween(dome, light),
                    dome_contrast: Math.hypot(...dome),
                    degrees: degreesBetween(dome, mapped),
                    contrast: Math.hypot(...mapped) / Math.hypot(...dome),
                });
            }
        }
    }
    return compared;
}

/// Returns the entries whose dome of triangles is missing or is not lit from the direction of the light. If there are
/// any, the picture is invalid.
export const missingDomes = (compared) =>
    compared.filter((entry) => !(entry.dome_degrees <= MOST_DEGREES && entry.dome_contrast >= LEAST_DOME_CONTRAST));

/// Returns the entries whose mapped cell differs from its dome. NaN counts as wrong.
export const wrongOf = (compared) =>
    compared.filter((entry) => !(entry.degrees <= MOST_DEGREES && entry.contrast >= LEAST_CONTRAST));

/// Returns the distinct cells of the entries.
export const cellsOf = (compared) => new Set(compared.map(({ row, pair }) => `row ${row + 1}, pair ${pair + 1}`));
