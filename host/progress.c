#include "progress.h"

#include "frame.h"

#include <stdio.h>
#include <unistd.h>

progress progress_start(const char *what)
{
    double now = frame_clock();
    return (progress){.what = what, .start = now, .shown = now + 0.4};
}

void progress_show(progress *p, unsigned done, unsigned total)
{
    double now = frame_clock();
    if (now < p->shown + 0.1 || !isatty(STDERR_FILENO))
        return;
    p->shown = now;
    p->visible = 1;
    fprintf(stderr, "\r%s: %u of %u, %.0f s\033[K", p->what, done, total, now - p->start);
}

void progress_end(progress *p)
{
    if (p->visible)
        fputs("\r\033[K", stderr);
}
