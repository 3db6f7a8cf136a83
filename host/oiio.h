/* The only door to OpenImageIO (compiled where GNOMON_OIIO is 1). Rows from the top, packed, native byte order. */
#ifndef OIIO_H
#define OIIO_H

#include "image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Does the library write files with the extension of this name? */
int oiio_can_write(const char *path);

/* 0, or -1 and the library's message. */
int oiio_write(const image *im, const char *path, char *message, size_t message_size);

/* Size, channels and sample kind first (samples stays 0), then the samples into a block of the caller. The name of the
 * file is the same for both. 0, or -1 and the library's message. */
int oiio_read_size(image *im, const char *path, char *message, size_t message_size);
int oiio_read_samples(image *im, const char *path, char *message, size_t message_size);

#ifdef __cplusplus
}
#endif
#endif
