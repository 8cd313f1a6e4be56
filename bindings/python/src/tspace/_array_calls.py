# SPDX-License-Identifier: MIT
"""The functions of arrays whose results depend on `full`. Type checkers read _array_calls.pyi, and editors take the
docstrings from here."""

from ._normals import normals
from ._pack import pack_frames
from ._sanitize import sanitize
from ._tangents import tangents
