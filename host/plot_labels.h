/* Places for the names of a plot's points, where they cover neither each other nor what is drawn. */
#ifndef PLOT_LABELS_H
#define PLOT_LABELS_H

#include <stddef.h>

/* In units of the drawing; y grows downwards. */
typedef struct plot_box {
    double left, top, right, bottom;
} plot_box;

/* What is there already. */
typedef struct plot_obstacle {
    plot_box box;
    double weight; /* of covering it */
} plot_obstacle;

typedef struct plot_labels {
    plot_box frame; /* in which labels stay */
    plot_obstacle *obstacles;
    size_t count, capacity;
} plot_labels;

typedef struct plot_label {
    plot_box box;
    double from_x, from_y, to_x, to_y; /* the line that joins it to its point */
    int anchor;                        /* of the text: -1 its left end, 0 its middle, 1 its right end */
    int found, joined;
} plot_label;

/* What is bad about a place: 0.7 a unit of distance, 1 a direction (down and to the left is the first of 14), and the
 * weights of what it covers; heavy is what is never covered, and costs less where only the line to the point crosses
 * it. */
#define PLOT_LIGHT 5.0
#define PLOT_HEAVY 1000.0
#define PLOT_CROSSED 100.0

void plot_labels_avoid(plot_labels *l, plot_box box, double weight);

/* The best place for a label of that size at the point (x, y); it is an obstacle from then on, and so is the line to
 * it. Where none is less bad than `most` (up to PLOT_HEAVY), found is 0. */
plot_label plot_labels_place(plot_labels *l, double x, double y, double width, double height, double most);

void plot_labels_free(plot_labels *l);

#endif
