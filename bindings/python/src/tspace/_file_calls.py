# SPDX-License-Identifier: MIT
"""The functions of files. Type checkers read _file_calls.pyi, which lists the options; at run time an unknown option raises
an error that lists the valid ones. Editors take the docstrings from here."""

from ._files import (
    bake_file,
    check,
    compress_map_bytes,
    compress_map_file,
    diff,
    finish_file,
    flip_green_bytes,
    flip_green_file,
    generate_bytes,
    generate_file,
    convert_map_file,
    height_to_normal_file,
    identify,
    inspect,
)
