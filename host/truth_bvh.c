#include "truth_bvh.h"

#include "memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BINS = 16, LEAF = 4, BALANCED_FROM = 48 };

/* ---- building -------------------------------------------------------------------------------------------------- */

typedef struct box {
    int32_t least[3], most[3];
} box;

typedef struct item { /* what the build knows of a triangle */
    box bounds;
    int64_t centre[3]; /* twice */
    uint32_t triangle;
} item;

typedef struct builder {
    bvh *tree;
    item *items;
} builder;

static const box empty_box = {{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}};

static void include(box *b, const box *other)
{
    for (int k = 0; k < 3; k++) {
        b->least[k] = other->least[k] < b->least[k] ? other->least[k] : b->least[k];
        b->most[k] = other->most[k] > b->most[k] ? other->most[k] : b->most[k];
    }
}

/* Half the surface, for comparisons only. */
static double area(const box *b)
{
    double size[3];
    if (b->least[0] > b->most[0])
        return 0;
    for (int k = 0; k < 3; k++)
        size[k] = (double)b->most[k] - b->least[k];
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
}

typedef struct split {
    int axis;
    int bin; /* the first of the right side */
    double cost;
} split;

typedef struct binning {
    int axis;
    int64_t least, size; /* of the centres, size > 0 */
} binning;

static int bin_of(const binning *b, const item *i)
{
    return (int)((i->centre[b->axis] - b->least) * (BINS - 1) / b->size);
}

static split best_along(const binning *b, const item *items, uint32_t count)
{
    split best = {.axis = -1, .cost = HUGE_VAL};
    box bounds[BINS], left = empty_box, right = empty_box;
    uint32_t counts[BINS] = {0}, passed = 0;
    double right_cost[BINS];
    for (int i = 0; i < BINS; i++)
        bounds[i] = empty_box;
    for (uint32_t i = 0; i < count; i++) {
        int bin = bin_of(b, &items[i]);
        counts[bin]++;
        include(&bounds[bin], &items[i].bounds);
    }
    for (int i = BINS - 1; i > 0; i--) {
        passed += counts[i];
        include(&right, &bounds[i]);
        right_cost[i] = area(&right) * passed;
    }
    passed = 0;
    for (int i = 1; i < BINS; i++) {
        passed += counts[i - 1];
        include(&left, &bounds[i - 1]);
        double cost = area(&left) * passed + right_cost[i];
        if (passed && passed < count && cost < best.cost)
            best = (split){b->axis, i, cost};
    }
    return best;
}

static binning binning_along(int axis, const item *items, uint32_t count)
{
    int64_t least = INT64_MAX, most = INT64_MIN;
    for (uint32_t i = 0; i < count; i++) {
        least = items[i].centre[axis] < least ? items[i].centre[axis] : least;
        most = items[i].centre[axis] > most ? items[i].centre[axis] : most;
    }
    return (binning){axis, least, most - least};
}

/* How many go left; items are sorted accordingly. Halves by count where nothing better is to be had, so that the tree's
 * depth has a bound. */
static uint32_t divide(item *items, uint32_t count, int depth)
{
    split best = {.axis = -1, .cost = HUGE_VAL};
    binning used = {0};
    for (int axis = 0; axis < 3 && depth < BALANCED_FROM; axis++) {
        binning b = binning_along(axis, items, count);
        split s = {.cost = HUGE_VAL};
        if (b.size > 0)
            s = best_along(&b, items, count);
        if (s.cost < best.cost) {
            best = s;
            used = b;
        }
    }
    if (best.axis < 0)
        return count / 2;
    uint32_t left = 0;
    for (uint32_t i = 0; i < count; i++)
        if (bin_of(&used, &items[i]) < best.bin) {
            item swapped = items[left];
            items[left++] = items[i];
            items[i] = swapped;
        }
    return left;
}

static void set_child(bvh_node *node, int side, const box *b, uint32_t child, uint32_t count)
{
    for (int k = 0; k < 3; k++) {
        node->box[side][0][k] = (float)b->least[k];
        node->box[side][1][k] = (float)b->most[k];
    }
    node->child[side] = child;
    node->count[side] = count;
}

/* The node of items first to first + count; there are more than LEAF. Depth is at most 48 + 32. */
static uint32_t build_node(builder *b, uint32_t first, uint32_t count, int depth)
{
    uint32_t number = b->tree->node_count++;
    uint32_t left = divide(b->items + first, count, depth);
    uint32_t firsts[2] = {first, first + left}, counts[2] = {left, count - left};
    for (int side = 0; side < 2; side++) {
        box bounds = empty_box;
        for (uint32_t i = 0; i < counts[side]; i++)
            include(&bounds, &b->items[firsts[side] + i].bounds);
        if (counts[side] <= LEAF)
            set_child(&b->tree->nodes[number], side, &bounds, firsts[side], counts[side]);
        else
            set_child(&b->tree->nodes[number], side, &bounds, build_node(b, firsts[side], counts[side], depth + 1), 0);
    }
    return number;
}

static void make_items(item *items, const truth_triangle *triangles, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        items[i].bounds = empty_box;
        items[i].triangle = i;
        for (int c = 0; c < 3; c++) {
            box corner;
            memcpy(corner.least, triangles[i].corner[c], sizeof corner.least);
            memcpy(corner.most, triangles[i].corner[c], sizeof corner.most);
            include(&items[i].bounds, &corner);
        }
        for (int k = 0; k < 3; k++)
            items[i].centre[k] = (int64_t)items[i].bounds.least[k] + items[i].bounds.most[k];
    }
}

void bvh_build(bvh *tree, truth_triangle *triangles, uint32_t count)
{
    *tree = (bvh){.triangle_count = count};
    if (count <= LEAF)
        return;
    item *items = memory_take(count, sizeof *items);
    truth_triangle *sorted = memory_take(count, sizeof *sorted);
    tree->nodes = memory_take(count, sizeof *tree->nodes);
    make_items(items, triangles, count);
    build_node(&(builder){tree, items}, 0, count, 0);
    for (uint32_t i = 0; i < count; i++)
        sorted[i] = triangles[items[i].triangle];
    memcpy(triangles, sorted, count * sizeof *triangles);
    free(sorted);
    free(items);
}

void bvh_free(bvh *tree)
{
    free(tree->nodes);
    memset(tree, 0, sizeof *tree);
}

/* ---- walking --------------------------------------------------------------------------------------------------- */

/* The true line is origin + s direction with both wrong by their errors: where it is inside a box, the line in double
 * precision is inside the box widened by origin_error + s direction_error. |s direction| does not exceed
 * reach + |origin| there, so that s direction_error is bounded as well. Another 1/16 unit pays for the roundings of the
 * slabs: s is wrong by 4 u of itself, a distance of at most 4 u (reach + |origin|), a millionth of a unit. */
static double widening(const truth_line *line)
{
    double largest = 0, origin = 0;
    for (int k = 0; k < 3; k++) {
        largest = fmax(largest, fabs(line->direction[k]));
        origin = fmax(origin, fabs(line->origin[k]));
    }
    double reach = line->view->reach + origin;
    return 0.0625 + 0x1p-48 * reach + 1.01 * (line->origin_error + 1.01 * reach / largest * line->direction_error);
}

void bvh_start(bvh_walk *walk, const bvh *tree, const truth_line *line, double least, double most)
{
    double wider = widening(line);
    walk->tree = tree;
    walk->least = least;
    walk->most = most;
    for (int k = 0; k < 3; k++) {
        /* A line along a plane: any direction within the error serves, also one that can be divided by. */
        double direction = fabs(line->direction[k]) < 0x1p-200 ? 0x1p-200 : line->direction[k];
        walk->inverse[k] = 1 / direction;
        walk->negative[k] = direction < 0;
        walk->near_edge[k] = line->origin[k] + (direction < 0 ? -wider : wider);
        walk->far_edge[k] = line->origin[k] - (direction < 0 ? -wider : wider);
    }
    walk->depth = 1;
    walk->stack[0].entry = least;
    walk->stack[0].child = 0;
    walk->stack[0].count = tree->nodes ? 0 : tree->triangle_count;
    if (!tree->triangle_count)
        walk->depth = 0;
}

/* Where the line enters a child's box, or HUGE_VAL if it does not. */
static double entry_of(const bvh_walk *walk, const float corners[2][3])
{
    double entry = walk->least, leaving = walk->most;
    for (int k = 0; k < 3; k++) {
        double in = (corners[walk->negative[k]][k] - walk->near_edge[k]) * walk->inverse[k];
        double out = (corners[!walk->negative[k]][k] - walk->far_edge[k]) * walk->inverse[k];
        entry = in > entry ? in : entry;
        leaving = out < leaving ? out : leaving;
    }
    return entry <= leaving ? entry : HUGE_VAL;
}

static void push(bvh_walk *walk, const bvh_node *node, int side, double entry)
{
    walk->stack[walk->depth].entry = entry;
    walk->stack[walk->depth].child = node->child[side];
    walk->stack[walk->depth].count = node->count[side];
    walk->depth++;
}

int bvh_next(bvh_walk *walk, uint32_t *first, uint32_t *count)
{
    while (walk->depth) {
        walk->depth--;
        uint32_t child = walk->stack[walk->depth].child;
        if (walk->stack[walk->depth].entry > walk->most)
            continue;
        *count = walk->stack[walk->depth].count;
        *first = child;
        if (*count)
            return 1;
        const bvh_node *node = &walk->tree->nodes[child];
        double entry[2];
        for (int side = 0; side < 2; side++)
            entry[side] = entry_of(walk, (const float(*)[3])node->box[side]);
        int farther = entry[1] > entry[0];
        if (entry[farther] < HUGE_VAL)
            push(walk, node, farther, entry[farther]);
        if (entry[!farther] < HUGE_VAL)
            push(walk, node, !farther, entry[!farther]);
    }
    return 0;
}
