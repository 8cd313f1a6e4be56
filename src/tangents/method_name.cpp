// SPDX-License-Identifier: MIT
// Names of methods, as the tool and the docs spell them.
#include "tspace/tangents.h"

namespace tspace {

const char* methodName(Method method) {
    switch (method) {
        case Method::mikktspace:
            return "mikktspace";
        case Method::lengyel:
            return "lengyel";
        case Method::uniform:
            return "uniform";
        case Method::angle:
            return "angle";
        case Method::area:
            return "area";
        case Method::flat:
            return "flat";
        case Method::basis:
            return "basis";
        case Method::fast:
            return "fast";
        case Method::best:
            return "best";
    }
    return "unknown";
}

}  // namespace tspace
