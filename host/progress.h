/* A line on standard error that says how far long work has come: on a terminal only, after half a second, ten times a
 * second at most. */
#ifndef PROGRESS_H
#define PROGRESS_H

typedef struct progress {
    const char *what;
    double start, shown;
    int visible;
} progress;

progress progress_start(const char *what);
void progress_show(progress *p, unsigned done, unsigned total);

/* The same, and how long the rest will take. share: of the work that is done, 0 to 1. */
void progress_show_left(progress *p, unsigned done, unsigned total, double share);
void progress_end(progress *p);

#endif
