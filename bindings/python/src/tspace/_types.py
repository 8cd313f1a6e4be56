# SPDX-License-Identifier: MIT
"""Types for type checkers: option names and arrays."""

from typing import TYPE_CHECKING, Any, Sequence, Union

import numpy

try:
    from typing import Literal, Protocol
except ImportError:  # pragma: no cover
    from typing_extensions import Literal, Protocol  # type: ignore

from ._names import (  # noqa: F401: for the modules that declare functions
    FrameFormatName,
    FrameShapeName,
    MethodName,
    NgonsName,
    NormalWeightingName,
    OutputDomainName,
    PairingName,
    PresetName,
)

Threads = Union[int, Literal["all"]]
DegreesOrAuto = Union[float, Literal["auto"]]


class HasArray(Protocol):
    """Types that numpy can convert to an array, such as arrays of other libraries."""

    def __array__(self, *arguments: Any, **options: Any) -> Any:
        """Array interface of numpy."""


# Type checkers report arguments that are not arrays of numbers, such as text.
if TYPE_CHECKING:
    from numpy.typing import NDArray

    FloatArray = NDArray[numpy.float32]
    IndexArray = NDArray[numpy.uint32]
    ByteArray = NDArray[numpy.uint8]
    BoolArray = NDArray[numpy.bool_]
    Rows = Union["NDArray[Any]", HasArray, memoryview, Sequence[Sequence[float]], Sequence["NDArray[Any]"]]
    Numbers = Union["NDArray[Any]", HasArray, memoryview, range, Sequence[int], Sequence[Sequence[int]]]
else:
    FloatArray = IndexArray = ByteArray = BoolArray = numpy.ndarray
    Rows = Numbers = Any
FaceSizes = Union[None, int, Numbers]
AttributeIndices = Union[None, Literal["corners"], Numbers]
