/* SPDX-License-Identifier: MIT */
/* Version of these headers; equals the version of project() in CMakeLists.txt. */
#ifndef TSPACE_VERSION_H
#define TSPACE_VERSION_H

#define TSPACE_VERSION_MAJOR 0
#define TSPACE_VERSION_MINOR 1
#define TSPACE_VERSION_PATCH 0
/* A single number that increases with every version. */
#define TSPACE_VERSION_NUMBER (TSPACE_VERSION_MAJOR * 10000 + TSPACE_VERSION_MINOR * 100 + TSPACE_VERSION_PATCH)
#define TSPACE_VERSION_STRING "0.1.0"

#endif
