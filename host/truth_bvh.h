/* A bounding volume hierarchy over triangles, and lines walking through it.
 *
 * Binary, built with the surface area heuristic over 16 bins an axis (Wald 2007), a node of 64 bytes holds the boxes of
 * both children. Boxes are exact: corners are integers that a float holds. A walk widens them by what it does not know
 * about its line, so that it visits every leaf that the true line passes, and now and then one more: the hierarchy
 * never decides anything.
 */
#ifndef TRUTH_BVH_H
#define TRUTH_BVH_H

#include "truth_line.h"

typedef struct bvh_node {
    float box[2][2][3]; /* of each child: least and largest corner */
    uint32_t child[2];  /* a node, or the first triangle of a leaf */
    uint32_t count[2];  /* triangles of the leaf; 0: child is a node */
} bvh_node;

typedef struct bvh {
    bvh_node *nodes; /* 0: all in one leaf */
    uint32_t node_count;
    uint32_t triangle_count;
} bvh;

/* Sort triangles into leaves. bvh_free() it. */
void bvh_build(bvh *tree, truth_triangle *triangles, uint32_t count);
void bvh_free(bvh *tree);

enum { BVH_DEEPEST = 96 };

typedef struct bvh_walk {
    const bvh *tree;
    double inverse[3], near_edge[3], far_edge[3]; /* 1 / direction; the origin, moved to widen boxes */
    int negative[3];                              /* the direction's sign */
    double least, most;                           /* s of the part of the line that is asked for; most may be lowered */
    int depth;
    struct {
        double entry;
        uint32_t child, count;
    } stack[BVH_DEEPEST + 2];
} bvh_walk;

void bvh_start(bvh_walk *walk, const bvh *tree, const truth_line *line, double least, double most);

/* The next leaf: 1 and its triangles, or 0 at the end. */
int bvh_next(bvh_walk *walk, uint32_t *first, uint32_t *count);

#endif
