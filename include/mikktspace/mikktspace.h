/* SPDX-License-Identifier: MIT */
/* Drop-in replacement header for programs that include "mikktspace/mikktspace.h", or <mikktspace.h> with this folder on
 * their include path. */
#include "../tspace/compat/mikktspace.h"
