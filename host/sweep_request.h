/* What a sweep is asked for: lists on the command line, and what they are by default. */
#ifndef SWEEP_REQUEST_H
#define SWEEP_REQUEST_H

#include "sweep_chains.h"

#include <stdint.h>

enum { SWEEP_MOST_SIZES = 16 };

typedef struct sweep_request {
    const sweep_chain *chains[SWEEP_CHAINS]; /* in the order of sweep_chains */
    int depths[2];
    long maps[SWEEP_MOST_SIZES], budgets[SWEEP_MOST_SIZES]; /* texels a side, bytes; ascending */
    int chain_count, depth_count, map_count, budget_count;
    long image[2];       /* 0: each scene's own */
    char image_text[16]; /* as --size takes it; empty: each scene's own */
    long workers;
} sweep_request;

/* Values of the command line, 0: not given. */
typedef struct sweep_request_values {
    const char *methods, *maps, *budgets, *depths, *size, *workers;
} sweep_request_values;

/* 0, or -1 and the problem. */
int sweep_request_read(sweep_request *request, const sweep_request_values *values, problem *why);

#endif
