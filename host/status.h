/* What a status of the core means, for a message. */
#ifndef STATUS_H
#define STATUS_H

#include "gnomon.h"

const char *status_text(gn_status status);

#endif
