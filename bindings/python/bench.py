# SPDX-License-Identifier: MIT
"""Measures the overhead of the Python package over the C call: for a cube, and for a million triangles.

Run it where tspace is installed: build/python/venv/bin/python bindings/python/bench.py
"""

import argparse
import ctypes
import sys
import time
from pathlib import Path

import numpy
import tspace
from tspace import _abi
from tspace._mesh import Mesh
from tspace._tangents import tangent_options

sys.path.insert(0, str(Path(__file__).parent / "tests"))
from support import cube, torus  # noqa: E402

OPTIONS = ("mikktspace", "gltf", 180.0, "reference", "triangulate", "corner", "gram_schmidt", 1)


def c_call(shape):
    """Returns a function that makes only the C call, and the array that it writes."""
    mesh, options, error = Mesh(*shape, None), tangent_options(*OPTIONS), _abi.Error()
    out = numpy.zeros((mesh.corner_count, 4), numpy.float32)
    output = _abi.TangentOutput(ctypes.sizeof(_abi.TangentOutput), 0, _abi.Span(out.ctypes.data, mesh.corner_count, 16))
    arguments = [ctypes.byref(struct) for struct in (mesh.struct, options, output)]
    function, place = _abi.library.tspace_generateTangents, ctypes.byref(error)

    def call():
        assert function(*arguments, None, None, place) == 0
        return mesh  # lives as long as the function

    return call, out


def seconds(functions, rounds, calls):
    """Returns the least time of one call of each function. Calls alternate, so that all functions see the same machine
    load."""
    best = [float("inf")] * len(functions)
    for _ in range(rounds):
        for number, function in enumerate(functions):
            start = time.perf_counter()
            for _ in range(calls):
                function()
            best[number] = min(best[number], (time.perf_counter() - start) / calls)
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=15, help="the least time of so many rounds counts")
    rounds = parser.parse_args().rounds

    shape = cube()
    c, _ = c_call(shape)
    python, c = seconds([lambda: tspace.tangents(*shape, convention="gltf"), c], rounds, 2000)
    print(f"cube, 12 triangles: {python * 1e6:.1f} us; the C call alone {c * 1e6:.1f} us (target: at most 25 us)")

    shape = torus(500, 1000)
    c, out = c_call(shape)
    c()
    assert (tspace.tangents(*shape, convention="gltf") == out).all()
    reused, fresh, c = seconds(
        [
            lambda: tspace.tangents(*shape, convention="gltf", out=out),
            lambda: tspace.tangents(*shape, convention="gltf"),
            c,
        ],
        rounds,
        1,
    )
    print(
        f"torus, 1,000,000 triangles: the C call {c * 1e3:.1f} ms; Python with out= {reused * 1e3:.1f} ms "
        f"({(reused / c - 1) * 100:+.1f} %, target: at most +5 %), with a new array each time {fresh * 1e3:.1f} ms"
    )


if __name__ == "__main__":
    main()
