# SPDX-License-Identifier: MIT
"""Arrays for results. The memory of a large array is reused after its last use: getting fresh pages from the system
takes a fifth of the time of computing tangents."""

import math
from collections import deque
from typing import Deque, Tuple

import numpy

_LARGE_BYTES = 1 << 20  # the C library reuses smaller blocks itself
_spare: Deque[numpy.ndarray] = deque(maxlen=1)


class _Block:
    """Owns the memory of one result: arrays over it, and their views, keep it alive."""

    def __init__(self, memory: numpy.ndarray, shape: Tuple[int, ...]):
        self.memory = memory
        self.__array_interface__ = {
            "data": (memory.ctypes.data, False),
            "shape": shape,
            "typestr": numpy.dtype(numpy.float32).str,
            "version": 3,
        }

    # The default argument keeps the list alive during interpreter shutdown.
    def __del__(self, spare: Deque[numpy.ndarray] = _spare) -> None:
        spare.append(self.memory)


def new_array(shape: Tuple[int, ...]) -> numpy.ndarray:
    """Returns an uninitialized float32 array."""
    size = 4 * math.prod(shape)
    if size < _LARGE_BYTES:
        return numpy.empty(shape, numpy.float32)
    try:
        memory = _spare.pop()
    except IndexError:
        memory = None
    # A reused block is at most twice as large as needed, so that a small result does not occupy a large one's memory.
    if memory is None or not size <= memory.nbytes <= 2 * size:
        memory = numpy.empty(size, numpy.uint8)
    return numpy.asarray(_Block(memory, shape))
