/* SPDX-License-Identifier: MIT */
/* The drop-in for programs that include "mikktspace/mikktspace.h", or <mikktspace.h> with this folder on their
 * include path. */
#include "../tspace/compat/mikktspace.h"
