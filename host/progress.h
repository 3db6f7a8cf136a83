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
void progress_end(progress *p);

#endif
