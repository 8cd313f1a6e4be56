# SPDX-License-Identifier: MIT
"""Compares renderings of a low poly with its normal map to renderings of the high poly, pixel by pixel, from seven cameras.

Needs numpy and PIL.

python3 eye_errors.py TSPACE LOW SEEN: prints the mean angle in degrees between `render --show mapped` of the low poly and
`render --show normals` of the high poly, over pixels that show both. The surfaces differ in depth (parallax), so no result is
zero. The pictures of the high poly are kept next to it, as SEEN.N.png.
"""
import os
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image

VIEWS = ((35, 20), (-40, 25), (140, 30), (-145, 15), (60, 55), (-20, -35), (160, -25))  # yaw, pitch
PIXELS = 512


def normals(tspace, model, show, view, out):
    """Returns the vectors of a picture and a mask of the pixels that show the model: those whose color encodes a unit vector.

    Renders the picture only if it does not exist.
    """
    if not os.path.exists(out):
        command = [tspace, "render", "-q", model, "-o", out, "--show", show, "--view", f"{view[0]},{view[1]}"]
        subprocess.run(command + ["--size", str(PIXELS), "--samples", "1", "--no-legend", "--no-sync"], check=True)
    vectors = np.asarray(Image.open(out).convert("RGB")).astype(float) / 127.5 - 1
    lengths = np.linalg.norm(vectors, axis=2)
    shows = np.abs(lengths - 1) < 0.03
    return vectors / np.maximum(lengths, 1e-9)[:, :, None], shows


def main():
    tspace, low, seen = sys.argv[1:]
    total, count = 0.0, 0
    with tempfile.TemporaryDirectory() as folder:
        for i, view in enumerate(VIEWS):
            mapped, is_low = normals(tspace, low, "mapped", view, os.path.join(folder, f"{i}.png"))
            truth, is_high = normals(tspace, seen, "normals", view, f"{seen}.{i}.png")
            both = is_low & is_high
            cosines = np.clip((mapped[both] * truth[both]).sum(axis=1), -1, 1)
            total += np.degrees(np.arccos(cosines)).sum()
            count += both.sum()
    print(f"{total / max(count, 1):.3f}")


main()
