/* The only door to OpenImageIO. The library brings some 250 others, which take a third of a second to load; so
 * host/oiio.cpp is a file of its own beside the simulator, loaded when the first picture asks for it.
 *
 * Rows from the top, packed, native byte order. */
#ifndef OIIO_H
#define OIIO_H

#include "image.h"

#ifdef __cplusplus
extern "C" {
#endif

#define OIIO_FILE "gnomon-oiio.so"

typedef struct oiio_door {
    /* Does the library write files with the extension of this name? */
    int (*can_write)(const char *path);

    /* 0, or -1 and the library's message. */
    int (*write)(const image *im, const char *path, char *message, size_t message_size);

    /* Size, channels and sample kind first (samples stays 0), then the samples into a block of the caller. The name of
     * the file is the same for both. 0, or -1 and the library's message. */
    int (*read_size)(image *im, const char *path, char *message, size_t message_size);
    int (*read_samples)(image *im, const char *path, char *message, size_t message_size);
} oiio_door;

/* 0 where there is no OIIO_FILE in the program's folder, or no OpenImageIO for it. */
const oiio_door *oiio_open(void);

/* What OIIO_FILE gives away. */
extern const oiio_door gnomon_oiio;

#ifdef __cplusplus
}
#endif
#endif
