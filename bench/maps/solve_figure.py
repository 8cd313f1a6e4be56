# SPDX-License-Identifier: MIT
"""Draws the figure of docs/evidence/bake-theory.md as SVG.

It shows one row of texels that are exact at their centers or solved by least squares, and the errors between the centers.
"""
import math

TEXELS, FIRST, LAST = 24, 6, 18  # the row repeats; texels FIRST to LAST are drawn
GRID = 3  # samples per texel
WIDTH, HEIGHT, GAP = 760, 170, 40


def truth(x):
    """Returns the true angle of the normal in degrees at x (in texels): waves with a length of 6 texels."""
    return 25 * math.sin(2 * math.pi * x / 6)


def direction(x):
    angle = math.radians(truth(x))
    return math.sin(angle), math.cos(angle)


def filtered(texels, x):
    """Interpolates linearly between two texels as a renderer does; texel centers are at i + 1/2."""
    left = math.floor(x - 0.5)
    part = x - 0.5 - left
    a, b = texels[left % TEXELS], texels[(left + 1) % TEXELS]
    return tuple((1 - part) * a[k] + part * b[k] for k in range(2))


def error(texels, x):
    mixed = filtered(texels, x)
    return math.degrees(math.atan2(mixed[0], mixed[1])) - truth(x)


def solved(start):
    """Minimizes the squared deviation from the wanted directions, one texel at a time, until no texel changes."""
    along = 0.02
    texels = [list(texel) for texel in start]
    for _ in range(200):
        for i in range(TEXELS):
            xx = xy = yy = bx = by = 0.0
            for k in range(-GRID + 1, GRID):
                x = i + 0.5 + k / GRID
                own = 1 - abs(k) / GRID
                d = direction(x)
                other = filtered(texels, x)
                rest = tuple(other[c] - own * texels[i][c] for c in range(2))
                less = 1 - along
                m = (1 - less * d[0] * d[0], -less * d[0] * d[1], 1 - less * d[1] * d[1])
                want = tuple(0.98 * d[c] - rest[c] for c in range(2))
                xx += own * own * m[0]
                xy += own * own * m[1]
                yy += own * own * m[2]
                bx += own * (m[0] * want[0] + m[1] * want[1])
                by += own * (m[1] * want[0] + m[2] * want[1])
            determinant = xx * yy - xy * xy
            texels[i] = [(yy * bx - xy * by) / determinant, (xx * by - xy * bx) / determinant]
    return texels


def path(points):
    return "M" + " L".join(f"{x:.1f} {y:.1f}" for x, y in points)


def main():
    exact = [direction(i + 0.5) for i in range(TEXELS)]
    best = solved(exact)
    places = [FIRST + (LAST - FIRST) * i / 480 for i in range(481)]
    errors = [("exact at centers", "#c0392b", [error(exact, x) for x in places]),
              ("solved", "#1f6fb2", [error(best, x) for x in places])]
    most = max(abs(value) for _, _, values in errors for value in values)

    def at(x):
        return 60 + (x - FIRST) / (LAST - FIRST) * (WIDTH - 80)

    total = 2 * HEIGHT + GAP + 50
    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {total}" font-family="sans-serif" font-size="13">')
    print(f'<rect width="{WIDTH}" height="{total}" fill="white"/>')
    for x in range(FIRST, LAST + 1):
        print(f'<path d="M{at(x):.1f} 20 V{2 * HEIGHT + GAP + 20}" stroke="#ddd"/>')
    middle = 20 + HEIGHT / 2
    scale = HEIGHT / 2 / 30
    print(f'<path d="{path([(at(x), middle - scale * truth(x)) for x in places])}" fill="none" stroke="#444" stroke-width="2"/>')
    for name, color, texels in (("exact", "#c0392b", exact), ("solved", "#1f6fb2", best)):
        for i in range(FIRST, LAST):
            angle = math.degrees(math.atan2(*texels[i]))
            print(f'<circle cx="{at(i + 0.5):.1f}" cy="{middle - scale * angle:.1f}" r="4" fill="{color}"/>')
    print(f'<text x="6" y="{middle + 4:.0f}">angle</text>')
    middle = 20 + HEIGHT * 1.5 + GAP
    scale = HEIGHT / 2 / most
    print(f'<path d="M{at(FIRST):.1f} {middle} H{at(LAST):.1f}" stroke="#888"/>')
    for index, (name, color, values) in enumerate(errors):
        points = [(at(x), middle - scale * value) for x, value in zip(places, values)]
        print(f'<path d="{path(points)}" fill="none" stroke="{color}" stroke-width="2"/>')
        mean = sum(abs(value) for value in values) / len(values)
        print(f'<text x="{70 + 330 * index}" y="{total - 10}" fill="{color}">{name}: {mean:.2f} degrees in the mean, '
              f"{max(abs(value) for value in values):.2f} at most</text>")
    print(f'<text x="6" y="{middle + 4:.0f}">error</text>')
    print("</svg>")


main()
