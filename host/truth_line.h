/* Lines through the quantised scene, points where they meet it, and the signs that decide a pixel.
 *
 * Every question is the sign of a determinant of integers. It is first asked in double precision with a bound for the
 * error; where the value is smaller than its bound, in integers of as many bits as it takes (truth_wide.h). Both are
 * the same function: the answer is exact, and does not depend on compiler, fused multiply-adds or processor.
 */
#ifndef TRUTH_LINE_H
#define TRUTH_LINE_H

#include "gnomon.h"
#include "truth_wide.h"

/* A number in double precision, and how wrong it may be. */
typedef struct approximate {
    double value, error;
} approximate;

typedef struct truth_triangle {
    int32_t corner[3][3]; /* world units, |.| <= GN_WORLD_MAX */
    float extent;         /* the largest component of an edge, rounded up */
    uint32_t number;      /* counted over all objects in order */
} truth_triangle;

typedef enum truth_light_kind { TRUTH_DIRECTIONAL, TRUTH_SPOT, TRUTH_POINT } truth_light_kind;

/* normal . (X - position) >= offset: inside. |normal| < 2^61, |offset| <= 2^58. */
typedef struct truth_plane {
    int64_t normal[3], offset;
} truth_plane;

/* What all lines of an image share. */
typedef struct truth_view {
    gn_camera camera;
    gn_light light;
    truth_light_kind light_kind;
    int32_t width, height;
    double reach;   /* the largest coordinate of a corner, at least 1 */
    int exact_only; /* 1: never trust double precision (for tests) */
} truth_view;

/* Points (origin + s direction) / divisor; divisor > 0. */
typedef struct exact_line {
    wide origin[3], divisor, direction[3];
} exact_line;

/* Points origin + s direction. Eye rays: s grows away from the camera. Lines to a light: in the direction of light;
 * directional: s = 0 is the point, else s = 0 is the light and s = 1 the point. */
typedef struct truth_line {
    const truth_view *view;
    double origin[3], direction[3];
    double origin_error, direction_error; /* of each component */
    double edge_error;                    /* of an edge function, over the extent of its triangle */
    int32_t x, y;                         /* eye rays: 1/256 pixels */
    struct truth_point *point;            /* lines to a light: from where; else 0 */
    int has_exact;
    exact_line exact;
    unsigned exact_decisions; /* how often exact arithmetic was called for */
} truth_line;

/* Where a line passes a triangle's plane. */
typedef struct truth_hit {
    const truth_triangle *triangle;
    int side;    /* sign of normal . direction: never 0 */
    int touches; /* 1: on an edge or a corner */
    approximate s;
} truth_hit;

/* The point that an eye ray hits. */
typedef struct truth_point {
    double at[3], error; /* error: of each component */
    truth_line *eye;
    truth_hit hit;
    int has_exact;
    wide numerator[3], denominator; /* denominator > 0 */
} truth_point;

/* The eye ray through a point of the image, in 1/256 pixels from the upper left corner. */
void truth_eye_line(truth_line *line, const truth_view *view, int32_t x, int32_t y);

/* The point of a hit; eye must outlive it. */
void truth_hit_point(truth_point *point, truth_line *eye, const truth_hit *hit);

/* The line from the light to the point, which must outlive it. */
void truth_light_line(truth_line *line, truth_point *point);

typedef enum truth_meeting {
    TRUTH_MISSES,
    TRUTH_MEETS,   /* inside: all signs equal */
    TRUTH_TOUCHES, /* an edge or a corner: one or two signs are 0, the others equal */
    TRUTH_WITHIN   /* the line lies in the triangle's plane: all signs are 0 */
} truth_meeting;

/* How a line meets a triangle. signs: of its edge functions (from corner i to i + 1); complete unless it misses. */
truth_meeting truth_line_meets(truth_line *line, const truth_triangle *triangle, int signs[3]);

/* A tie of a line to the light, settled: the sign of an edge function that is 0 after the point has moved by (e, e^2,
 * e^3), e > 0 smaller than any number. Both triangles of a shared edge then agree on which side the line passes, so
 * that nothing slips through a closed surface. 0: the edge is parallel to the line. */
int truth_moved_edge_sign(const truth_line *line, const truth_triangle *triangle, int edge);

/* A line that meets or touches a triangle: where. */
truth_hit truth_make_hit(truth_line *line, const truth_triangle *triangle, const int signs[3]);

/* The sign of s of a - s of b. */
int truth_compare_hits(truth_line *line, const truth_hit *a, const truth_hit *b);

/* The sign of axis . (hit - from) / 2^30 - depth. from: the camera's eye or the light's position. */
int truth_compare_depth(truth_line *line, const truth_hit *hit, const int32_t axis[3], const int32_t from[3],
                        int32_t depth);

/* The sign of normal . (position - corner) of a triangle's plane. */
int truth_side_of_place(const truth_triangle *triangle, const int32_t position[3]);

/* The sign of normal . direction. */
int truth_side_of_direction(const truth_triangle *triangle, const int32_t direction[3]);

/* The sign of normal . (point - corner). */
int truth_side_of_point(truth_point *point, const truth_triangle *triangle);

/* The sign of plane.normal . (point - from) - plane.offset. */
int truth_side_of_plane(truth_point *point, const truth_plane *plane, const int32_t from[3]);

/* The axis (0, 1, 2) along which the point is farthest from a place; the lowest of equal ones. *negative: 1 if it lies
 * towards negative coordinates. */
int truth_farthest_axis(truth_point *point, const int32_t from[3], int *negative);

/* A line to the light within the plane of a triangle: 1 if it touches the triangle and some of the triangle lies
 * between light and point. Errs towards 1 where the triangle reaches past one of them. */
int truth_passes_within(truth_line *line, const truth_triangle *triangle);

/* Twice the area times the unit normal, exactly: 0 0 0 where the area is 0. Each below 2^52. */
void truth_normal(const truth_triangle *triangle, int64_t normal[3]);

#endif
