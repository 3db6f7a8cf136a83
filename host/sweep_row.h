/* A row of `gnomon sweep`: one scene, one chain of choices, one depth, one map, and what it errs and costs.
 * docs/sweep.md defines each column.
 *
 * Numbers are doubles throughout, so that whoever plots them needs no cases; NAN is what is not known or not there
 * (empty in CSV, null in JSON). Counts stay below 2^53.
 */
#ifndef SWEEP_ROW_H
#define SWEEP_ROW_H

#include "problem.h"

#include <stddef.h>

typedef struct sweep_row {
    char scene[64];    /* the file's name without folder and extension, made unique */
    char chain[48];    /* of sweep_chains.h */
    char options[256]; /* of `gnomon render`: what makes this mask again */
    double depth_bits; /* 16 or 32 */
    double map;        /* texels a side; 0: shadow volumes, which have none */
    double budget;     /* bytes that this is the largest map for; 0: a size that was asked for */
    double bias;       /* texels; NAN where it is none, or in another unit */
    double false_shadow, false_light, error, edge_band, interior, mean_absolute_error;
    double resident_bytes, peak_bytes;
    double triangles, texels, pixels, tested, outside, agreed, virtual_pixels, fractional, silhouette;
    double p_percent, overdraw, bandwidth;
    double multiplies, divides, adds, loads, stores, others;
    double m4_view, m4_light, m4_camera, m4_pixel;
    double host_ratio; /* the only one that differs from run to run */
    char key[20];      /* hash of everything that the row hangs on */
} sweep_row;

/* Counts are whole. */
typedef enum sweep_kind { SWEEP_TEXT, SWEEP_COUNT, SWEEP_NUMBER } sweep_kind;

typedef struct sweep_column {
    const char *name;    /* in CSV and JSON */
    const char *unit;    /* "" where there is none */
    const char *meaning; /* half a line */
    sweep_kind kind;
    size_t offset, size; /* in sweep_row */
} sweep_column;

enum { SWEEP_COLUMNS = 39 };

extern const sweep_column sweep_columns[SWEEP_COLUMNS];

/* Texts empty, numbers NAN. */
sweep_row sweep_row_empty(void);

const char *sweep_row_text(const sweep_row *row, const sweep_column *column);
double sweep_row_number(const sweep_row *row, const sweep_column *column);

/* 0 where the column is a text and this one does not fit, or no number where it is one; row is as it was. */
int sweep_row_set(sweep_row *row, const sweep_column *column, const char *value);

/* The column of that name; 0: none. */
const sweep_column *sweep_column_find(const char *name, size_t length);

#endif
