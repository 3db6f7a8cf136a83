#include "status.h"

const char *status_text(gn_status status)
{
    switch (status) {
    case GN_OK:
        return "done";
    case GN_STOPPED:
        return "stopped";
    case GN_BAD_ARGUMENT:
        return "an argument is none that it knows";
    case GN_OUT_OF_RANGE:
        return "a number is out of range";
    case GN_TOO_SMALL:
        return "the memory block is too small";
    case GN_MISALIGNED:
        return "the memory block is not aligned";
    case GN_BAD_MESH:
        return "a mesh refers to vertices or edges that do not exist";
    case GN_TOO_MANY:
        return "too many objects or triangles";
    case GN_UNSUPPORTED:
        return "settings that make no sense together";
    case GN_NOT_READY:
        return "called out of order";
    }
    return "an unknown status";
}
