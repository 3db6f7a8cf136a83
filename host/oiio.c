#include "oiio.h"

#include <dlfcn.h>
#include <pthread.h>

static const oiio_door *door;

/* The program's run path is its own folder (Makefile). It stays loaded: the library has threads. */
static void load(void)
{
    void *file = dlopen(OIIO_FILE, RTLD_LAZY | RTLD_LOCAL);
    door = file ? dlsym(file, "gnomon_oiio") : 0;
}

const oiio_door *oiio_open(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, load);
    return door;
}
