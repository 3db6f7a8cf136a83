/* The twelve scenes. World units, y up; each stands on y = 0. Whole numbers and decimals are those of gen.py, and so is
 * the order of all parts, sums and random draws: the files depend on it byte for byte. */
#include "procedural.h"
#include "procedural_random.h"
#include "procedural_scene.h"

#include <errno.h>
#include <math.h>
#include <string.h>

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

enum { OPEN, CLOSED };

/* ---- camera, light, meshes ------------------------------------------------------------------------------------- */

static void camera(procedural_scene *s, part_point eye, part_point target, double fovy)
{
    s->camera = (procedural_camera){eye, target, fovy, 0.1, 500};
}

static void sun(procedural_scene *s, double x, double y, double z)
{
    s->light.is_spot = 0;
    s->light.direction = (part_point){x, y, z};
}

static void spot(procedural_scene *s, part_point position, part_point target, double fovy, double near_depth,
                 double far_depth)
{
    s->light = (procedural_light){1, {0, 0, 0}, position, target, fovy, near_depth, far_depth};
}

/* Begin the next mesh of the scene. */
static part_mesh *mesh(procedural_scene *s, const char *tag, int closed, const char *colour)
{
    procedural_piece *piece = &s->pieces[s->piece_count++];
    piece->tag = tag;
    piece->closed = closed;
    piece->colour = colour;
    return &piece->mesh;
}

/* Draw from Python's Random(seed), 0 <= seed < 2^32. */
static void seed(twister *random, uint32_t number)
{
    twister_seed(random, &number, 1);
}

/* ---- small scenes ---------------------------------------------------------------------------------------------- */

static void lshape(procedural_scene *s)
{
    static const part_corner outline[] = {{0, 0}, {3, 0}, {3, .6}, {.6, .6}, {.6, 3}, {0, 3}};
    camera(s, (part_point){6.3, 5.2, 6.9}, (part_point){1.2, .7, 1.3}, 34);
    sun(s, -.3, -1, .27);
    part_box(mesh(s, "plane", CLOSED, ".5 .7 .5"), -4, 6, -.3, 0, -4, 6);
    part_prism(mesh(s, "L", CLOSED, ".8 .8 .8"), outline, COUNT(outline), .25, 2.4);
}

static void torus2(procedural_scene *s)
{
    camera(s, (part_point){.5, 5.6, 6.2}, (part_point){0, .9, 0}, 36);
    sun(s, .45, -1, -.28);
    part_rectangle(mesh(s, "plane", OPEN, ".5 .7 .5"), (part_point){-6, 0, -6}, (part_point){12, 0, 0},
                   (part_point){0, 0, 12}, 1, 1);
    part_mesh *tori = mesh(s, "tori", CLOSED, ".8 .7 .5");
    part_translate(part_rotate_x(part_torus(tori, 1.1, .42, 48, 24), 25), -1.22, 1.7, 0);
    part_translate(part_rotate_x(part_torus(tori, 1.1, .42, 48, 24), -35), 1.22, 1.7, 0);
}

static void table(procedural_scene *s)
{
    camera(s, (part_point){3.6, 3.2, 4.4}, (part_point){0, .7, 0}, 36);
    spot(s, (part_point){2.5, 6.5, -2.2}, (part_point){0, .4, 0}, 62, 2, 14);
    part_box(mesh(s, "floor", CLOSED, ".6 .6 .6"), -4, 4, -.2, 0, -4, 4);
    part_mesh *m = mesh(s, "table", CLOSED, ".8 .6 .4");
    part_box(m, -1.6, 1.6, 1.5, 1.6, -1, 1);
    for (int i = 0; i < 4; i++) {
        double x = i & 2 ? 1.45 : -1.45, z = i & 1 ? .85 : -.85;
        part_box(m, x - .06, x + .06, 0, 1.5, z - .06, z + .06);
    }
}

static void pins(procedural_scene *s)
{
    static const part_ring pin[] = {{0, 0},     {.42, 0},    {.5, .25},   {.62, .7},   {.74, 1.2}, {.78, 1.6},
                                    {.73, 2.1}, {.6, 2.6},   {.44, 3.0},  {.32, 3.4},  {.28, 3.7}, {.31, 4.0},
                                    {.4, 4.4},  {.42, 4.65}, {.33, 4.95}, {.16, 5.08}, {0, 5.12}};
    camera(s, (part_point){2.6, 2.6, 5.6}, (part_point){-.1, .45, -.8}, 34);
    spot(s, (part_point){-3.4, 5.6, 2.6}, (part_point){0, .2, -1}, 58, 2, 13);
    part_box(mesh(s, "lane", CLOSED, ".7 .5 .3"), -3, 3, -.2, 0, -5, 4);
    part_mesh *m = mesh(s, "pins", CLOSED, ".9 .9 .9");
    for (int row = 0; row < 4; row++)
        for (int k = 0; k <= row; k++) /* -row is an int: row 0 stands at +0, not at -0 */
            part_translate(part_scale(part_lathe(m, pin, COUNT(pin), 15), .24), (k - row / 2.0) * 1.1, 0, -row * .95);
    part_translate(part_rotate_x(part_scale(part_lathe(m, pin, COUNT(pin), 15), .24), 78), -1.9, .19, 1.0);
    part_translate(part_sphere(m, .48, 24, 14), 1.3, .48, 1.6);
}

static void fence(procedural_scene *s)
{
    double sunset = part_radians(8);
    camera(s, (part_point){3.2, 3.0, 8.8}, (part_point){0, .1, 2.6}, 44);
    sun(s, .25 * cos(sunset), -sin(sunset), .968 * cos(sunset));
    part_box(mesh(s, "ground", CLOSED, ".5 .6 .4"), -9, 9, -.3, 0, -4, 9);
    part_mesh *m = mesh(s, "fence", CLOSED, ".9 .9 .9");
    for (int i = 0; i < 34; i++) {
        double x = -5 + .3 * i;
        const part_corner picket[] = {{x, .02}, {x + .2, .02}, {x + .2, 1.0}, {x + .1, 1.15}, {x, 1.0}};
        part_prism_along_z(m, picket, COUNT(picket), -.03, .03);
    }
    part_box(m, -5.1, 5.2, .25, .35, .03, .09);
    part_box(m, -5.1, 5.2, .75, .85, .03, .09);
    part_box(m, -5.15, -5.0, 0, 1.3, -.1, .1);
    part_box(m, 5.2, 5.35, 0, 1.3, -.1, .1);
}

/* ---- pipes: random walks along the axes ------------------------------------------------------------------------ */

#define PIPE_STEPS 9

/* One step of -3, -2, 2 or 3 along an axis other than the last; turned round, or left out, where it would leave the
 * room. Returns 1 if the point has moved. */
static int walk(twister *random, int p[3], int *last_axis)
{
    static const int steps[] = {-3, -2, 2, 3}, low[3] = {-4, 1, -4}, high[3] = {4, 7, 4};
    int axis = twister_below(random, *last_axis < 0 ? 3 : 2);
    if (*last_axis >= 0 && axis >= *last_axis)
        axis++;
    *last_axis = axis;
    int step = steps[twister_below(random, 4)];
    if (p[axis] + step < low[axis] || p[axis] + step > high[axis])
        step = -step;
    if (p[axis] + step < low[axis] || p[axis] + step > high[axis])
        return 0;
    p[axis] += step;
    return 1;
}

/* The corners of pipe k, which is shifted along the diagonal so that no two pipes share a plane. */
static part_path pipe_corners(twister *random, int k)
{
    part_path path = {.count = 0};
    double shift = .04 * k * (k % 2 ? 1 : -1) / 3;
    int p[3], last_axis = -1;
    p[0] = twister_between(random, -4, 4);
    p[1] = twister_between(random, 1, 7);
    p[2] = twister_between(random, -4, 4);
    path.points[path.count++] = (part_point){p[0] + shift, p[1] + shift, p[2] + shift};
    for (int i = 0; i < PIPE_STEPS; i++)
        if (walk(random, p, &last_axis))
            path.points[path.count++] = (part_point){p[0] + shift, p[1] + shift, p[2] + shift};
    return path;
}

static void pipes(procedural_scene *s)
{
    twister random;
    seed(&random, 3);
    camera(s, (part_point){9, 9, 11}, (part_point){0, 2.9, 0}, 42);
    sun(s, -.5, -1, -.35);
    part_box(mesh(s, "floor", CLOSED, ".6 .6 .6"), -7, 7, -.3, 0, -7, 7);
    part_mesh *m = mesh(s, "pipes", CLOSED, ".4 .6 .8");
    for (int k = 0; k < 26; k++) {
        part_path corners = pipe_corners(&random, k);
        if (corners.count <= 2)
            continue;
        part_path path = part_rounded(&corners, .35, 3);
        part_tube(m, &path, .16 + .05 * (k % 3), 10);
    }
}

/* ---- crowd ----------------------------------------------------------------------------------------------------- */

#define BODY_PARTS 8

/* Person k, who stands at (x, 0, z): trunk, head and twice leg, arm, foot, each turned a little about y. */
static void person(part_mesh *m, int k, double x, double z)
{
    static const part_ring trunk[] = {{0, .8}, {.16, .8}, {.2, 1.0}, {.17, 1.15}, {.23, 1.4}, {.2, 1.52}, {0, 1.58}};
    static const part_path leg = {{{0, 0, 0}, {0, -.42, 0}, {0, -.82, .03}}, 3};
    static const part_path arm = {{{0, 0, 0}, {0, -.3, .02}, {0, -.6, .1}}, 3};
    twister random;
    seed(&random, (uint32_t)k);
    part body[BODY_PARTS];
    int n = 0;
    double height = 1 + .12 * twister_unit(&random);
    body[n++] = part_lathe(m, trunk, COUNT(trunk), 12);
    body[n++] = part_translate(part_sphere(m, .13, 14, 9), 0, 1.72, 0);
    for (int side = -1; side <= 1; side += 2) {
        double swing = side * twister_uniform(&random, 5, 30);
        body[n++] = part_translate(part_rotate_x(part_tube(m, &leg, .075, 10), swing), side * .1, .83, 0);
        double lift = side * twister_uniform(&random, 8, 45);
        body[n++] = part_translate(part_rotate_x(part_rotate_z(part_tube(m, &arm, .055, 10), lift), -swing), side * .22,
                                   1.45, 0);
        body[n++] = part_translate(part_sphere(m, .06, 8, 6), side * .1, .07, .05);
    }
    for (int i = 0; i < n; i++) {
        double twist = twister_uniform(&random, -60, 60);
        part_translate(part_scale(part_rotate_y(body[i], twist), height), x, 0, z);
    }
}

static void crowd(procedural_scene *s)
{
    camera(s, (part_point){-6.5, 3.6, 4.8}, (part_point){1.2, 1.0, -4.2}, 48);
    sun(s, .3, -.14, -1);
    part_mesh *set = mesh(s, "set", CLOSED, ".7 .7 .7");
    part_box(set, -8, 8, -.2, 0, -7, 5);
    part_box(set, -8, 8, -.2, 5, -7.4, -7);
    part_mesh *people = mesh(s, "people", CLOSED, ".6 .5 .7");
    for (int k = 0; k < 24; k++) {
        int row = k / 8;
        person(people, k, (k % 8 - 3.5) * .85 + .2 * (row % 2), row * .95);
    }
}

/* ---- castle ---------------------------------------------------------------------------------------------------- */

/* A wall with merlons along the outer edge of its longer side. */
static void wall(part_mesh *m, double x0, double x1, double z0, double z1, double height)
{
    int along_x = x1 - x0 > z1 - z0;
    double length = along_x ? x1 - x0 : z1 - z0;
    int n = (int)(length / .7) > 2 ? (int)(length / .7) : 2;
    part_box(m, x0, x1, 0, height, z0, z1);
    for (int i = 0; i < n; i++) {
        double from = length * ((i + .1) / n), to = length * ((i + .6) / n);
        if (along_x)
            part_box(m, x0 + from, x0 + to, height, height + .35, z0, z0 + .14);
        else
            part_box(m, x0, x0 + .14, height, height + .35, z0 + from, z0 + to);
    }
}

static void towers(part_mesh *m)
{
    static const double places[][2] = {{-5, -5}, {5, -5}, {-5, 5}, {5, 5}, {-1.2, 4.8}, {1.2, 4.8}};
    for (int i = 0; i < COUNT(places); i++) {
        double x = places[i][0], z = places[i][1];
        int at_corner = fabs(x) > 2;
        part_translate(part_cylinder(m, at_corner ? .8 : .55, 0, 3.2, 12), x, 0, z);
        part_translate(part_cone(m, at_corner ? .95 : .7, 3.2, 4.6, 12), x, 0, z);
    }
}

static void keep(part_mesh *m)
{
    part_box(m, -1.5, 1.5, 0, 4, -2, 1);
    part_box(m, -.9, .9, 4, 5, -1.4, .4);
    for (int i = 0; i < 4; i++)
        for (int front = 0; front < 2; front++) {
            double x = -1.5 + .82 * i, z = front ? .86 : -2;
            part_box(m, x, x + .5, 4, 4.35, z, z + .14);
        }
}

static void castle(procedural_scene *s)
{
    camera(s, (part_point){9.5, 8.5, 12.5}, (part_point){0, 1.1, 0}, 40);
    sun(s, .5, -.75, .45);
    part_box(mesh(s, "ground", CLOSED, ".5 .6 .4"), -10, 10, -.3, 0, -10, 10);
    part_mesh *m = mesh(s, "castle", CLOSED, ".7 .65 .6");
    wall(m, -5, 5, -5, -4.6, 2);
    wall(m, -5, -1, 4.6, 5, 2);
    wall(m, 1, 5, 4.6, 5, 2);
    wall(m, -5, -4.6, -4.6, 4.6, 2);
    wall(m, 4.6, 5, -4.6, 4.6, 2);
    towers(m);
    keep(m);
    part_box(m, -1, 1, 1.5, 2, 4.5, 5.1); /* the gate's lintel */
    for (int i = 0; i < 2; i++) {
        double x = i ? 3.1 : -3.2;
        const part_corner barn[] = {{x - .9, -3.5}, {x + .9, -3.5}, {x + .9, -1}, {x - .9, -1}};
        part_prism(m, barn, COUNT(barn), 0, 1.1);
    }
    for (int k = 0; k < 6; k++)
        part_translate(part_rotate_y(part_box(m, -.25, .25, 0, .5, -.25, .25), 17 * k), -3 + 1.1 * k, 0,
                       2.7 + .3 * (k % 2));
}

/* ---- room: a conference room, light inside --------------------------------------------------------------------- */

static part_point room_curtain(double u, double v)
{
    return (part_point){3.6 + .12 * sin(14 * u), .1 + 2.6 * v, -1 + 3 * u};
}

/* Floor, four walls and a curtain; no ceiling. 8 wide, 3 high, 10 deep. */
static void room_shell(part_mesh *m)
{
    const part_point wide = {8, 0, 0}, high = {0, 3, 0}, deep = {0, 0, 10};
    const part_point left_back = {-4, 0, -5}, right_back = {4, 0, -5}, left_front = {-4, 0, 5};
    part_rectangle(m, left_back, wide, deep, 1, 1);
    part_rectangle(m, left_back, high, deep, 1, 1);
    part_rectangle(m, right_back, high, deep, 1, 1);
    part_rectangle(m, left_back, wide, high, 1, 1);
    part_rectangle(m, left_front, wide, high, 1, 1);
    part_sheet(m, room_curtain, 28, 4);
}

/* Seat, back, four legs and two posts. */
static void chair(part_mesh *m, double x, double z, double degrees)
{
    part q[8];
    int n = 0;
    q[n++] = part_box(m, -.22, .22, .42, .46, -.22, .22);
    q[n++] = part_box(m, -.22, .22, .5, .95, -.24, -.2);
    for (int sx = -1; sx <= 1; sx += 2)
        for (int sz = -1; sz <= 1; sz += 2)
            q[n++] = part_box(m, sx * .2 - .015, sx * .2 + .015, 0, .42, sz * .2 - .015, sz * .2 + .015);
    for (int sx = -1; sx <= 1; sx += 2)
        q[n++] = part_box(m, sx * .2 - .012, sx * .2 + .012, .42, .5, -.23, -.206);
    for (int i = 0; i < n; i++)
        part_translate(part_rotate_y(q[i], degrees), x, 0, z);
}

static void conference_table(part_mesh *m)
{
    part_box(m, -1, 1, .72, .78, -2.4, 2.4);
    for (int i = 0; i < 6; i++) {
        double x = i < 3 ? -.8 : .8, z = 2.1 * (i % 3 - 1);
        part_box(m, x - .05, x + .05, 0, .72, z - .05, z + .05);
    }
    for (int i = 0; i < 5; i++) {
        chair(m, -1.35, -2 + i, 90 + 7 * (i % 3));
        chair(m, 1.4, -2 + i, -90 - 9 * (i % 2));
    }
    chair(m, 0, -2.95, 4);
    chair(m, .1, 3.0, 176);
}

/* Cups and papers on the table, a cupboard, a sideboard with vases, a lamp. */
static void furnishings(part_mesh *m)
{
    static const part_ring cup[] = {{0, 0}, {.035, 0}, {.045, .1}, {0, .1}};
    static const part_ring vase[] = {{0, 0}, {.1, 0}, {.14, .25}, {.07, .35}, {0, .36}};
    static const part_ring lamp[] = {{0, 2.2}, {.3, 2.2}, {.12, 2.5}, {0, 2.5}};
    for (int i = 0; i < 6; i++)
        part_translate(part_lathe(m, cup, COUNT(cup), 12), -.5 + .2 * (i % 4), .78, -1.9 + .75 * i);
    for (int i = 0; i < 4; i++)
        part_translate(part_rotate_y(part_box(m, -.15, .15, .78, .80, -.1, .1), 15 * i), i % 2 ? -.45 : .45, 0,
                       -1.6 + i);
    part_box(m, 3.2, 3.9, 0, 1.9, -4.6, -3.2);
    part_box(m, -3.9, -3.3, 0, .8, -3, 3);
    for (int i = 0; i < 8; i++)
        part_translate(part_lathe(m, vase, COUNT(vase), 14), -3.6, .8, -2.6 + .75 * i);
    part_translate(part_lathe(m, lamp, COUNT(lamp), 16), .9, 0, .9);
    part_box(m, .88, .92, 2.5, 3, .88, .92);
}

static void room(procedural_scene *s)
{
    camera(s, (part_point){-3.3, 2.2, 4.6}, (part_point){.5, .6, -.6}, 58);
    spot(s, (part_point){-1.2, 2.85, .4}, (part_point){-.2, 0, .1}, 128, .25, 9);
    room_shell(mesh(s, "shell", OPEN, ".8 .8 .75"));
    part_mesh *things = mesh(s, "things", CLOSED, ".6 .5 .4");
    conference_table(things);
    furnishings(things);
}

/* ---- sheets: what has no inside -------------------------------------------------------------------------------- */

static part_point curtain(double u, double v)
{
    return (part_point){-3.4 + 3 * u, 3.1 * v + .02, -.5 + .25 * sin(22 * u) + .3 * u};
}

static part_point leaf(double u, double v)
{
    double across = v - .5;
    return (part_point){across * .55 * sin(PART_PI * (u * .98 + .01)), .18 * sin(PART_PI * u) + .25 * (across * across),
                        u};
}

static void foliage(part_mesh *m)
{
    twister random;
    seed(&random, 9);
    for (int k = 0; k < 60; k++) {
        part p = part_sheet(m, leaf, 6, 4);
        p = part_rotate_x(p, twister_uniform(&random, -50, 40));
        p = part_rotate_z(p, twister_uniform(&random, -40, 40));
        p = part_rotate_y(p, twister_uniform(&random, 0, 360));
        double x = 1.7 + twister_gauss(&random, 0, .7);
        double y = 2.1 + twister_gauss(&random, 0, .55);
        double z = twister_gauss(&random, 0, .7);
        part_translate(p, x, y, z);
    }
}

static void sheets(procedural_scene *s)
{
    camera(s, (part_point){4.6, 4.6, 7.2}, (part_point){-.3, 1.1, 0}, 40);
    sun(s, -.35, -1, .45);
    part_rectangle(mesh(s, "floor", OPEN, ".7 .7 .6"), (part_point){-6, 0, -6}, (part_point){12, 0, 0},
                   (part_point){0, 0, 12}, 4, 4);
    part_sheet(mesh(s, "curtain", OPEN, ".8 .4 .4"), curtain, 48, 6);
    foliage(mesh(s, "leaves", OPEN, ".3 .7 .3"));
    part_translate(part_cylinder(mesh(s, "stem", CLOSED, ".5 .4 .3"), .08, 0, 2.2, 10), 1.7, 0, 0);
}

/* ---- factory --------------------------------------------------------------------------------------------------- */

/* Floor, two walls, five portal frames with trusses. */
static void factory_hall(part_mesh *m)
{
    part_box(m, -10, 10, -.3, 0, -8, 8);
    part_box(m, -10, 10, 0, 6, -8.4, -8);
    part_box(m, -10.4, -10, 0, 6, -8.4, 8);
    for (int i = 0; i < 5; i++) {
        double x = -8 + 4 * i;
        part_box(m, x - .12, x + .12, 0, 5.5, -7.4 - .12, -7.4 + .12);
        part_box(m, x - .12, x + .12, 0, 5.5, 7.0 - .12, 7.0 + .12);
        part_box(m, x - .1, x + .1, 5.5, 5.7, -7.6, 7.2);
        part_box(m, x - .1, x + .1, 4.9, 5.0, -7.6, 7.2);
        for (int k = 0; k < 14; k++)
            part_translate(part_rotate_x(part_box(m, -.04, .04, -.42, .42, -.04, .04), k % 2 ? -45 : 45), x, 5.25,
                           -6.9 + 1.05 * k);
    }
}

/* A cylinder that lies along x. */
static void roll(part_mesh *m, double radius, double half_length, int sides, double x, double y, double z)
{
    part_translate(part_rotate_z(part_cylinder(m, radius, -half_length, half_length, sides), 90), x, y, z);
}

/* Overhead rolls on their shafts; a conveyor of rollers with boxes on it. */
static void factory_conveyor(part_mesh *m, twister *random)
{
    for (int i = 0; i < 8; i++)
        roll(m, .32, 1.1, 24, 5.5, 4.2, -5.5 + 1.3 * i);
    for (int i = 0; i < 8; i++)
        roll(m, .08, 1.6, 16, 5.5, 4.2, -5.5 + 1.3 * i);
    for (int i = 0; i < 30; i++)
        roll(m, .13, .8, 12, -3, .95, -6 + .4 * i);
    part_box(m, -3.9, -3.9 + .1, .8, 1.0, -6.3, 6.1);
    part_box(m, -2.2, -2.2 + .1, .8, 1.0, -6.3, 6.1);
    for (int i = 0; i < 7; i++)
        for (int right = 0; right < 2; right++) {
            double x = right ? -2.15 : -3.85, z = -6 + 2 * i;
            part_box(m, x - .05, x + .05, 0, .8, z - .05, z + .05);
        }
    for (int i = 0; i < 9; i++)
        part_translate(part_rotate_y(part_box(m, -.4, .4, 0, .6, -.35, .35), twister_uniform(random, -25, 25)), -3,
                       1.08, -5.5 + 1.3 * i);
}

/* Four tanks, and from each three pipes to the back wall. */
static void factory_tanks(part_mesh *m)
{
    static const part_ring tank[] = {{0, 0},     {1.1, 0},   {1.25, .4}, {1.25, 2.6},
                                     {1.0, 3.1}, {.4, 3.35}, {.3, 3.6},  {0, 3.6}};
    for (int k = 0; k < 4; k++)
        part_translate(part_lathe(m, tank, COUNT(tank), 20), 1.2 + .2 * k, 0, -5.6 + 3 * k);
    for (int k = 0; k < 12; k++) {
        double x0 = 1.2 + .15 * k, x1 = 4 - k * .35, y = 4.4 + .05 * k, z = -5.6 + (k % 4) * 3;
        const part_path corners = {{{x0, 3.4, z}, {x0, y, z}, {x1, y, z}, {x1, y, -7.2}, {x1, .4, -7.2}}, 5};
        part_path path = part_rounded(&corners, .3, 4);
        part_tube(m, &path, .1, 8);
    }
}

/* Five gear wheels on their blocks. */
static void factory_gears(part_mesh *m)
{
    part_corner outline[48];
    for (int i = 0; i < COUNT(outline); i++) {
        double radius = i % 2 ? .9 : .72, angle = 2 * PART_PI * i / COUNT(outline);
        outline[i] = (part_corner){radius * cos(angle), radius * sin(angle)};
    }
    for (int k = 0; k < 5; k++) {
        part wheel = part_wheel(m, outline, COUNT(outline), -.12, .12);
        part_translate(part_rotate_x(wheel, 90), 7.9, 1.3, -5.5 + 2.4 * k);
        part_box(m, 7.4, 8.4, 0, .5, -5.8 + 2.4 * k, -5.2 + 2.4 * k);
    }
}

/* Crates and balls on the floor, conduits along the back wall, a railing in front. */
static void factory_floor(part_mesh *m, twister *random)
{
    for (int k = 0; k < 26; k++) {
        double size = twister_uniform(random, .25, .6);
        double angle = twister_uniform(random, 0, 90);
        double x = twister_uniform(random, -9, -5);
        double z = twister_uniform(random, -6.5, 7);
        part_translate(part_rotate_y(part_box(m, -size, size, 0, 2 * size, -size, size), angle), x, 0, z);
    }
    for (int k = 0; k < 9; k++)
        part_translate(part_sphere(m, .35, 20, 12), 3.9 + .3 * (k % 3), .35 + (k / 3 == 2 ? .6 : 0), 1 + .8 * k * .8);
    for (int k = 0; k < 12; k++) {
        const part_path conduit = {{{-9.9 + .02 * k, 1 + .3 * k, -7.8}, {9, 1 + .3 * k, -7.8}}, 2};
        part_tube(m, &conduit, .06, 8);
    }
    for (int k = 0; k < 40; k++)
        part_box(m, -9.6 + .45 * k, -9.55 + .45 * k, 0, 1.0, 7.3, 7.35);
    part_box(m, -9.7, 8.3, 1.0, 1.06, 7.28, 7.36);
}

static void factory(procedural_scene *s)
{
    twister random;
    seed(&random, 5);
    camera(s, (part_point){12, 7.2, 13}, (part_point){-.6, 1.6, -1.2}, 44);
    sun(s, -.55, -1, -.42);
    part_mesh *m = mesh(s, "all", CLOSED, ".6 .6 .65");
    factory_hall(m);
    factory_conveyor(m, &random);
    factory_tanks(m);
    factory_gears(m);
    factory_floor(m, &random);
}

/* ---- colonnade ------------------------------------------------------------------------------------------------- */

static void colonnade(procedural_scene *s)
{
    static const part_ring column[] = {{0, 0},     {.42, 0},   {.42, .25}, {.3, .4},
                                       {.26, 2.6}, {.4, 2.85}, {.4, 3.0},  {0, 3.0}};
    camera(s, (part_point){.6, 1.8, 29}, (part_point){-.1, 1.2, 0}, 58);
    sun(s, .6, -1, -.25);
    part_mesh *m = mesh(s, "all", CLOSED, ".75 .7 .6");
    part_box(m, -6, 6, -.4, 0, -30, 30);
    for (int side = -1; side <= 1; side += 2) {
        double x = side * 3.2, x_wall = side * 5.8;
        for (int k = 0; k < 20; k++)
            part_translate(part_lathe(m, column, COUNT(column), 14), x, 0, -28.5 + 3 * k);
        part_box(m, x - .45, x + .45, 3.0, 3.6, -30, 30);
        part_box(m, x_wall - .2, x_wall + .2, 0, 4.2, -30, 30);
    }
    for (int k = 0; k < 20; k++) { /* beams, and the blocks that carry them */
        part_box(m, -6, 6, 4.2, 4.4, -30 + 3 * k, -29.6 + 3 * k);
        part_box(m, -3.3, -2.8, 3.6, 4.2, -28.7 + 3 * k, -28.3 + 3 * k);
        part_box(m, 2.8, 3.3, 3.6, 4.2, -28.7 + 3 * k, -28.3 + 3 * k);
    }
    for (int k = 0; k < 14; k++)
        part_translate(part_rotate_y(part_box(m, -.35, .35, 0, .7, -.35, .35), 23 * k), -1.8 + fmod(k * 1.37, 3.6), 0,
                       27 - 4 * k);
}

/* ---- the table of scenes --------------------------------------------------------------------------------------- */

#define SCENES(X)                                                                                                      \
    X(lshape) X(torus2) X(factory) X(table) X(pipes) X(pins) X(crowd) X(castle) X(room) X(sheets) X(fence) X(colonnade)

#define NAME(scene) #scene,
#define MAKER(scene) scene,

const char *const procedural_names[] = {SCENES(NAME)};
const int procedural_count = COUNT(procedural_names);
static void (*const makers[])(procedural_scene *) = {SCENES(MAKER)};

int procedural_index(const char *name)
{
    for (int i = 0; i < procedural_count; i++)
        if (strcmp(name, procedural_names[i]) == 0)
            return i;
    errno = EINVAL;
    return -1;
}

int procedural_build(procedural_scene *scene, int index)
{
    memset(scene, 0, sizeof *scene);
    scene->name = procedural_names[index];
    makers[index](scene);
    for (int i = 0; i < scene->piece_count; i++)
        if (scene->pieces[i].mesh.failed) {
            errno = ENOMEM;
            return -1;
        }
    return 0;
}

void procedural_free(procedural_scene *scene)
{
    for (int i = 0; i < scene->piece_count; i++)
        part_mesh_free(&scene->pieces[i].mesh);
    scene->piece_count = 0;
}
