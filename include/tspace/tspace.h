/* SPDX-License-Identifier: MIT */
/* The C API of the core library: everything that the C++ headers offer, for C11 and for bindings. Comments are those of
 * the C++ headers, with names of C; what holds in C alone is said behind "In C:".
 *
 * Words: a *face* is a triangle, quad or n-gon; a *corner* is one (face, local vertex) pair, numbered face
 * after face; a *vertex* is one entry of the vertex arrays. A *sign* is +1 or -1: B = sign * cross(N, T).
 *
 * Rules that hold for every function:
 * - A function that can fail returns TSPACE_OK or an error code. Its last parameter `error` may be null;
 *   otherwise it is written in either case (code TSPACE_OK and an empty message after success).
 * - Structs that start with `struct_size` are prepared with TSPACE_INIT, which sets the size and every default; what
 *   has no other default is zero. Fields are only ever added at the end, and the size says which a program knows: one
 *   that was compiled with any older header works with a newer library, and gets the defaults of newer fields. A size
 *   that this version does not know is TSPACE_ERROR_INVALID_OPTION.
 * - Languages without the macro prepare options by tspace_init..., and fill all other sized structs with zeros and the
 *   size. Options of zeros are other ones than the defaults: they are refused where they look forgotten, which is said
 *   at each of these functions.
 * - Structs without `struct_size` that a program fills never change. tspace_Convention stands in the middle of others:
 *   what a later version adds to it is a field at the end of each struct that holds one.
 * - Arguments come in one order: inputs, options, outputs that the caller owns, execution, then what C++ returns (a
 *   result or a report), and the error. Execution may be null: the default, which is the calling thread.
 * - Options and reports may be null: default options, no report wanted. (Tangents need options: a convention has no
 *   default.) A report is written only on success. Other pointers are not null, where nothing else is said: a function
 *   that can fail then fails with TSPACE_ERROR_NULL_DATA.
 * - Arrays are the caller's. Inputs are read during the call only. Outputs must not overlap inputs or each
 *   other. An array is empty when its count is 0; it may then be null.
 * - Every function may be called from any thread at the same time as any other, as long as nobody writes what
 *   another one uses. There is no global state. Results have the same bits for any thread count.
 * - Nothing is printed, nothing aborts, and no C++ exception comes out.
 */
#ifndef TSPACE_TSPACE_H
#define TSPACE_TSPACE_H

#include "tspace/tspace_tangents.h"

#include "tspace/tspace_frame.h"
#include "tspace/tspace_indexed_frames.h"
#include "tspace/tspace_normals.h"
#include "tspace/tspace_pack.h"
#include "tspace/tspace_winding.h"

#endif
