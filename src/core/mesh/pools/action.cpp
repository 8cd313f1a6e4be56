// SPDX-License-Identifier: MIT
// Names of what can be done to a primitive, and of the faces that it can be done on.
#include "tspace/asset.h"

namespace tspace {

const char* actionName(PrimitiveAction action) {
    switch (action) {
        case PrimitiveAction::generated:
            return "generated";
        case PrimitiveAction::replaced:
            return "replaced";
        case PrimitiveAction::unchanged:
            return "unchanged";
        case PrimitiveAction::kept:
            return "kept";
        case PrimitiveAction::notNeeded:
            return "notNeeded";
        case PrimitiveAction::notTriangles:
            return "notTriangles";
        case PrimitiveAction::impossible:
            return "impossible";
        case PrimitiveAction::removed:
            return "removed";
    }
    return "unknown";
}

const char* facesName(Faces faces) {
    switch (faces) {
        case Faces::triangles:
            return "triangles";
        case Faces::quads:
            return "quads";
        case Faces::automatic:
            return "auto";
    }
    return "unknown";
}

}  // namespace tspace
