/* Points over two logarithmic axes as SVG: what one pays to the right, what one errs upwards, and the Pareto front of
 * it as a staircase, its main points named.
 *
 * Readable in black and white: points differ in shape, lines in dashes; colours (those of Okabe and Ito, which differ
 * for every kind of eye) only repeat it. Names are put where they cover neither each other nor the front, some joined
 * to their point by a thin line; where there is no such place the point has its number alone. An error of 0 has no
 * place on a logarithmic axis: it lies on a marked floor below it.
 *
 * The drawing has no size of its own but a viewBox, and refers to nothing outside of the document: its shapes and
 * styles are in plot_write_style and plot_write_shapes, once a document.
 */
#ifndef PLOT_H
#define PLOT_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Each hollow, or filled. */
typedef enum plot_shape {
    PLOT_CIRCLE,
    PLOT_SQUARE,
    PLOT_DIAMOND,
    PLOT_TRIANGLE_DOWN,
    PLOT_TRIANGLE_UP,
    PLOT_HEXAGON,
    PLOT_STAR,
    PLOT_SHAPES
} plot_shape;

typedef struct plot_point {
    double x, y; /* x above 0, y 0 or more; others are not drawn and not on the front */
    plot_shape shape;
    int filled;
    const char *name; /* beside it, where it is named */
    const char *note; /* where a pointer rests on it */
} plot_point;

typedef struct plot_line {
    const char *name;
    const size_t *points; /* indices, from left to right */
    size_t count;
} plot_line;

typedef enum plot_axis { PLOT_DECIMAL, PLOT_BYTES } plot_axis;

enum { PLOT_LINES = 4 };

typedef struct plot {
    const char *title; /* for who hears the page */
    const char *x_name, *y_name;
    plot_axis x_axis;
    const plot_point *points;
    size_t point_count;
    const plot_line *lines; /* at most PLOT_LINES, each with dashes of its own */
    size_t line_count;
    const double *marks; /* upright lines, each with its number */
    size_t mark_count;
    double level;           /* a level line over the whole width; at the border where it is beyond the points */
    const char *level_name; /* 0: no such line */
} plot;

/* The points that no other one beats: none is at most as far to the right and at most as high, and less in one of both.
 * Of equal points the first one stays. front: room for count indices, from left to right. Returns how many. */
size_t plot_front(size_t *front, const plot_point points[], size_t count);

/* Of the front those that are named, as others say nearly the same: the first one, and then each that is at least a
 * tenth lower than the one named before. named: room for count indices. Returns how many. */
size_t plot_named(size_t *named, const size_t front[], size_t count, const plot_point points[]);

void plot_write(FILE *stream, const plot *p);

/* Inside of <style>. */
void plot_write_style(FILE *stream);

/* An <svg> without extent that holds the shapes; before the first plot. */
void plot_write_shapes(FILE *stream);

/* A shape, or a line's dashes, for a legend. */
void plot_write_sample(FILE *stream, plot_shape shape, int filled);
void plot_write_line_sample(FILE *stream, size_t line);

typedef struct plot_text {
    char text[64];
} plot_text;

/* Three significant digits or all before the point, no exponent, 0 as 0; nothing for what is no number. */
plot_text plot_number(double number);

/* The same with a binary multiple: 512, 32 KiB, 1.5 MiB. */
plot_text plot_bytes(double bytes);

#endif
