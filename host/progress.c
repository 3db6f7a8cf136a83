#include "progress.h"

#include "frame.h"

#include <stdio.h>
#include <unistd.h>

progress progress_start(const char *what)
{
    double now = frame_clock();
    return (progress){.what = what, .start = now, .shown = now + 0.4};
}

/* Is it time to show something? */
static int is_due(progress *p, double now)
{
    if (now < p->shown + 0.1 || !isatty(STDERR_FILENO))
        return 0;
    p->shown = now;
    p->visible = 1;
    return 1;
}

void progress_show(progress *p, unsigned done, unsigned total)
{
    double now = frame_clock();
    if (is_due(p, now))
        fprintf(stderr, "\r%s: %u of %u, %.0f s\033[K", p->what, done, total, now - p->start);
}

void progress_show_left(progress *p, unsigned done, unsigned total, double share)
{
    double now = frame_clock(), past = now - p->start;
    if (is_due(p, now) && share > 0)
        fprintf(stderr, "\r%s: %u of %u, %.0f s, about %.0f s left\033[K", p->what, done, total, past,
                past * (1 - share) / share);
}

void progress_end(progress *p)
{
    if (p->visible)
        fputs("\r\033[K", stderr);
}
