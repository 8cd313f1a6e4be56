# SPDX-License-Identifier: MIT
"""What a map shows beside the high poly, as an eye sees both: seven cameras, pixel for pixel. Needs numpy and PIL.

python3 eye_errors.py TSPACE LOW SEEN: prints the mean angle in degrees between `render --show mapped` of the low poly and
`render --show normals` of the high poly, over pixels that show both. Parallax is in it, so none is zero. The pictures of the high
poly stay beside it, as SEEN.N.png.
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
    """Vectors, and which pixels show the model: a color that is a unit vector. A picture that is there is not drawn again."""
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
