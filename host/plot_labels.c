#include "plot_labels.h"

#include "memory.h"

#include <math.h>
#include <stdlib.h>

/* Directions by choice: down and to the left of a front nothing is drawn. Sines and cosines of multiples of 22.5
 * degrees. */
static const double directions[][2] = {{-0.707, 0.707}, {-0.924, 0.383}, {-0.383, 0.924}, {0, 1},
                                       {-1, 0},         {0.383, 0.924},  {0.707, 0.707},  {0.924, 0.383},
                                       {1, 0},          {0.707, -0.707}, {0.924, -0.383}, {0.383, -0.924},
                                       {0, -1},         {-0.707, -0.707}};
enum { DIRECTIONS = sizeof directions / sizeof *directions };

/* From a point: to a label beside it, and beyond which a line joins both. */
#define NEAREST 8.0
#define JOINED 15.0
#define STEP 4.0
#define FARTHEST 160.0

/* Outside of a point's own obstacle, a square of 5 units each way, in every direction. */
#define LINE_FROM 7.2

void plot_labels_avoid(plot_labels *l, plot_box box, double weight)
{
    l->obstacles = memory_grow(l->obstacles, &l->capacity, l->count + 1, sizeof *l->obstacles);
    l->obstacles[l->count++] = (plot_obstacle){box, weight};
}

static int boxes_meet(const plot_box *a, const plot_box *b)
{
    return a->left < b->right && b->left < a->right && a->top < b->bottom && b->top < a->bottom;
}

/* Does the segment meet the box? Its part inside of one pair of sides after the other (Liang and Barsky). */
static int segment_meets(const plot_label *s, const plot_box *box)
{
    double dx = s->to_x - s->from_x, dy = s->to_y - s->from_y, from = 0, to = 1;
    const double step[4] = {-dx, dx, -dy, dy};
    const double room[4] = {s->from_x - box->left, box->right - s->from_x, s->from_y - box->top,
                            box->bottom - s->from_y};
    for (int i = 0; i < 4; i++) {
        if (step[i] == 0 && room[i] < 0)
            return 0;
        if (step[i] < 0)
            from = fmax(from, room[i] / step[i]);
        else if (step[i] > 0)
            to = fmin(to, room[i] / step[i]);
    }
    return from < to;
}

static plot_label candidate(double x, double y, double width, double height, const double direction[2], double distance)
{
    plot_label c = {.found = 1, .joined = distance > JOINED};
    double at_x = x + direction[0] * distance, at_y = y + direction[1] * distance;
    c.anchor = direction[0] < -0.3 ? 1 : direction[0] > 0.3 ? -1 : 0;
    double left = at_x - width * (c.anchor + 1) / 2;
    c.box = (plot_box){left, at_y - height / 2, left + width, at_y + height / 2};
    c.from_x = x + direction[0] * LINE_FROM;
    c.from_y = y + direction[1] * LINE_FROM;
    c.to_x = at_x;
    c.to_y = c.anchor ? at_y : direction[1] > 0 ? c.box.top : c.box.bottom;
    return c;
}

static int is_inside(const plot_box *box, const plot_box *frame)
{
    return box->left >= frame->left && box->right <= frame->right && box->top >= frame->top &&
           box->bottom <= frame->bottom;
}

/* What is bad about it: the distance, and what it and its line cover. */
static double badness(const plot_labels *l, const plot_label *c, double distance)
{
    double sum = distance;
    for (size_t i = 0; i < l->count; i++) {
        const plot_obstacle *o = &l->obstacles[i];
        if (boxes_meet(&c->box, &o->box))
            sum += o->weight;
        else if (c->joined && o->weight >= PLOT_HEAVY && segment_meets(c, &o->box))
            sum += PLOT_CROSSED;
    }
    return sum;
}

/* The line as a row of small boxes. */
static void avoid_line(plot_labels *l, const plot_label *label)
{
    double dx = label->to_x - label->from_x, dy = label->to_y - label->from_y;
    int count = (int)(sqrt(dx * dx + dy * dy) / 3) + 1;
    for (int i = 0; i <= count; i++) {
        double x = label->from_x + dx * i / count, y = label->from_y + dy * i / count;
        plot_labels_avoid(l, (plot_box){x - 1, y - 1, x + 1, y + 1}, PLOT_HEAVY);
    }
}

plot_label plot_labels_place(plot_labels *l, double x, double y, double width, double height, double most)
{
    plot_label best = {.found = 0};
    double least = most;
    for (double distance = NEAREST; distance <= FARTHEST; distance += STEP)
        for (int i = 0; i < DIRECTIONS; i++) {
            plot_label c = candidate(x, y, width, height, directions[i], distance);
            if (!is_inside(&c.box, &l->frame))
                continue;
            double bad = badness(l, &c, 0.7 * distance + i);
            if (bad < least) {
                least = bad;
                best = c;
            }
        }
    if (best.found)
        plot_labels_avoid(l, best.box, PLOT_HEAVY);
    if (best.found && best.joined)
        avoid_line(l, &best);
    return best;
}

void plot_labels_free(plot_labels *l)
{
    free(l->obstacles);
    l->obstacles = 0;
    l->count = l->capacity = 0;
}
