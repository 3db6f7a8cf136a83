/* No triangle shadows itself. First the reason (invariant 5): a triangle is drawn alone, and at every texel that it
 * covers the receiver's plane is the stored depth, bit for bit. Then what follows for lone planes with first depth and
 * lone convex solids with second depth, under a thousand lights and with no bias at all: no pixel that is turned to the
 * light is shadowed, or its shadow has a reason that is worked out here. Cases: 2600000 triangles, a million of which
 * cover texels, or GNOMON_CASES; a light for every 2600 of them. */
#include "gn_cascade.h"
#include "points.h"
#include "scenes.h"

#include <math.h>

__extension__ typedef __int128 exact;

#define EMPTY ((gn_depth)0xffffffffu)

static double fraction_between(double low, double high)
{
    return low + (high - low) * (double)(tap_random(&random_state) >> 11) / 9007199254740992.0;
}

/* 2^low to 2^high, all magnitudes alike. */
static double magnitude_between(double low, double high)
{
    return exp2(fraction_between(low, high));
}

/* On which side of a triangle's plane the light is: the sign of a product that has 80 bits. */
static int side_of(int32_t (*corner)[3], const int32_t direction[3])
{
    exact sum = 0;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        sum += direction[i] * ((exact)(corner[1][j] - corner[0][j]) * (corner[2][k] - corner[0][k]) -
                               (exact)(corner[1][k] - corner[0][k]) * (corner[2][j] - corner[0][j]));
    }
    return sum < 0 ? -1 : sum > 0;
}

/* ---- invariant 5: one triangle alone --------------------------------------------------------------------------- */

/* A context whose scene is one triangle, which moves from pass to pass. */
typedef struct alone {
    int32_t vertices[3][3];
    uint16_t indices[3];
    gn_mesh mesh;
    gn_model mirror;
    gn_object object;
    gn_scene scene;
    gn_settings settings;
    gn_plan plan;
    gn_context *context;
    void *block;
    gn_receiver_plane planes[GN_COLOUR_CACHE]; /* maps of one texel have no receiver, and so no place for them */
} alone;

/* About 4096 texels a region, so that every size of map costs the same. */
static gn_status start_alone(alone *a, uint16_t width, uint16_t height)
{
    static const gn_mesh one = {0, 0, 3, 1, 2, 0, 0, 0};
    gn_settings s = gn_default_settings(1, 1, 1);
    memset(a, 0, sizeof *a);
    for (int i = 0; i < 3; i++)
        a->indices[i] = (uint16_t)i;
    a->mesh = one;
    a->mesh.vertices = (const int32_t(*)[3])a->vertices;
    a->mesh.indices = a->indices;
    gn_model_identity(&a->mirror);
    a->mirror.m[0][0] = -a->mirror.m[0][0];
    a->object.mesh = &a->mesh;
    a->scene.objects = &a->object;
    a->scene.object_count = 1;
    s.map_width = width;
    s.map_height = height;
    s.map_rows = (uint16_t)(width > 4096 ? 1 : 4096 / width);
    s.surface = GN_CONSTANT;
    s.cull = (uint8_t)between(GN_CULL_NONE, GN_CULL_FRONT);
    a->settings = s;
    gn_status status = gn_make_plan(&a->plan, &a->scene, &s);
    if (status != GN_OK)
        return status;
    a->block = grown(0, a->plan.bytes);
    return gn_init(&a->context, &a->scene, &s, a->block, a->plan.bytes);
}

static gn_status random_light(gn_light *light)
{
    int32_t direction[3], position[3];
    for (int i = 0; i < 3; i++) {
        direction[i] = between(-1000, 1000);
        position[i] = between(-(1 << 22), 1 << 22);
    }
    memset(light, 0, sizeof *light);
    if (between(0, 1)) {
        int32_t target[3] = {position[0] + direction[0], position[1] + direction[1], position[2] + direction[2]};
        double near_depth = magnitude_between(11, 20), far_depth = near_depth + magnitude_between(-5, 8) * near_depth;
        return gn_spot_light(light, position, target, 0, GN_DEGREES(between(5, 150)), (int32_t)near_depth,
                             (int32_t)far_depth);
    }
    gn_status status = gn_directional_light(light, direction, 0);
    light->box_u = position[0];
    light->box_v = position[1];
    light->box_z = position[2];
    light->box_width = (int32_t)magnitude_between(12, 23);
    light->box_height = (int32_t)(light->box_width * magnitude_between(-1, 1));
    light->box_depth = (int32_t)magnitude_between(10, 23);
    return status;
}

/* The world's point at a place of the map (0 to 1 across and up) and a share of the depth range. 0: beyond the world.
 */
static int place_in_world(int32_t world[3], const gn_light *light, const double place[3])
{
    double along[3];
    if (light->kind == GN_SPOT) {
        /* even in post-projective depth within the range, in distance beyond it */
        double near_depth = light->near_depth, far_depth = light->far_depth, tangent = light->tan_half / 16777216.0;
        double w = place[2] >= 0 && place[2] <= 1 ? 1 / (1 / near_depth + place[2] * (1 / far_depth - 1 / near_depth))
                                                  : near_depth + place[2] * (far_depth - near_depth);
        along[0] = (2 * place[0] - 1) * tangent * w;
        along[1] = (2 * place[1] - 1) * tangent * w;
        along[2] = w;
    } else {
        along[0] = light->box_u + place[0] * light->box_width;
        along[1] = light->box_v + place[1] * light->box_height;
        along[2] = light->box_z + place[2] * light->box_depth;
    }
    for (int i = 0; i < 3; i++) {
        double p = (along[0] * light->right[i] + along[1] * light->up[i] + along[2] * light->forward[i]) / (1 << 30);
        p += light->kind == GN_SPOT ? light->position[i] : 0;
        if (!(fabs(p) < GN_WORLD_MAX))
            return 0;
        world[i] = (int32_t)floor(p + 0.5);
    }
    return 1;
}

typedef enum attitude { ANY, LEVEL, STEEP, HUGE_ONE, ATTITUDES } attitude;

/* A triangle about a place within the map; *row: the place's. */
static int random_triangle(alone *a, const gn_light *light, int32_t *row)
{
    attitude how = (attitude)between(0, ATTITUDES - 1);
    double centre[3] = {fraction_between(0, 1), fraction_between(0, 1), fraction_between(0, 1)}, corner[3][3];
    int32_t larger = a->settings.map_width > a->settings.map_height ? a->settings.map_width : a->settings.map_height;
    double size = how == HUGE_ONE ? magnitude_between(0, 5) : magnitude_between(2, 5) / larger;
    double depth = how == LEVEL ? 0 : how == HUGE_ONE ? magnitude_between(-8, 2) : magnitude_between(-16, 0);
    *row = (int32_t)((1 - centre[1]) * a->settings.map_height);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            double reach = k < 2 ? size : depth;
            corner[i][k] = centre[k] + fraction_between(-reach, reach);
            if (k == 2 && how != HUGE_ONE)
                corner[i][k] = fmin(fmax(corner[i][k], 0), 1);
        }
    if (how == STEEP) { /* the last corner almost in the light's plane through the others */
        double t = fraction_between(0, 1), aside = magnitude_between(-9, -1) / larger;
        for (int k = 0; k < 2; k++)
            corner[2][k] = corner[0][k] + t * (corner[1][k] - corner[0][k]) + fraction_between(-aside, aside);
    }
    for (int i = 0; i < 3; i++) {
        if (!place_in_world(a->vertices[i], light, corner[i]))
            return 0;
        if (a->object.model)
            a->vertices[i][0] = -a->vertices[i][0];
    }
    return 1;
}

typedef struct lone_count {
    unsigned failures;
    uint64_t triangles, covering, texels;
    uint64_t spots, clipped, steep, level, mirrored, saturated, in_plane, farthest;
} lone_count;

static int32_t least_of_three(int32_t a, int32_t b, int32_t c)
{
    return a < b ? (a < c ? a : c) : b < c ? b : c;
}

/* The light looks at the triangle: whatever it faces, the camera is on the same side. */
static void look_along(gn_camera *camera, const gn_light *light)
{
    camera->projection = light->kind == GN_SPOT ? GN_PERSPECTIVE : GN_ORTHOGRAPHIC;
    for (int i = 0; i < 3; i++) {
        camera->eye[i] = light->position[i];
        camera->forward[i] = light->forward[i];
    }
}

static void note_lone(const alone *a, const gn_light *light, uint64_t n)
{
    note("triangle %llu%s, %s light, map %dx%d", (unsigned long long)n, a->object.model ? ", mirrored" : "",
         light->kind == GN_SPOT ? "spot" : "directional", (int)a->settings.map_width, (int)a->settings.map_height);
    for (int i = 0; i < 3; i++)
        note("    corner %ld %ld %ld", (long)a->vertices[i][0], (long)a->vertices[i][1], (long)a->vertices[i][2]);
}

/* Draw it alone and compare a region's texels with its plane. */
static void compare_lone(alone *a, const gn_light *light, uint64_t n, lone_count *count)
{
    gn_context *context = a->context;
    int32_t row, width = a->settings.map_width;
    uint32_t first, rows, stride;
    a->object.model = between(0, 3) ? 0 : &a->mirror;
    a->mesh.closed = (uint8_t)(between(0, 3) == 0);
    if (!random_triangle(a, light, &row))
        return;
    uint32_t region = (uint32_t)row / a->plan.map_rows;
    region = region < a->plan.light_regions ? region : a->plan.light_regions - 1;
    gn_status status = gn_light_begin(context, light);
    if (status == GN_OK)
        status = gn_light_layers(context, region, 0);
    const gn_depth *z = gn_layer(context, 0, region, 0, &first, &rows, &stride);
    if (status != GN_OK || !z) {
        if (count->failures++ < 5)
            note("triangle %llu: status %d", (unsigned long long)n, (int)status);
        return;
    }
    look_along(&context->camera, light);
    context->workers[0].planes = a->planes;
    a->planes[0].triangle = GN_NO_TRIANGLE;
    const gn_receiver_plane *plane = gn_find_plane(context, &context->workers[0], 0, 0);
    int clips = context->objects[0].clips;
    const gn_vertex *v = context->vertices;
    int32_t left = 0, right = width;
    if (!clips) { /* columns that it can reach; whoever covers others fails elsewhere */
        left = least_of_three(v[0].x, v[1].x, v[2].x) / 256 - 1;
        right = -least_of_three(-v[0].x, -v[1].x, -v[2].x) / 256 + 2;
        left = left < 0 ? 0 : left;
        right = right > width ? width : right;
    }
    int32_t world[3][3], to_light[3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            world[i][k] = a->object.model && k == 0 ? -a->vertices[i][k] : a->vertices[i][k];
    for (int k = 0; k < 3; k++)
        to_light[k] = light->kind == GN_SPOT ? light->position[k] - world[0][k] : -light->forward[k];
    int in_plane = side_of(world, to_light) == 0;
    uint64_t texels = 0;
    for (uint32_t r = 0; r < rows; r++) {
        for (int32_t column = left; column < right && !in_plane; column++) {
            gn_depth got = z[r * stride + (uint32_t)column];
            if (got == EMPTY)
                continue;
            int64_t depth = gn_wide_depth(&plane->plane, column, (int32_t)(first + r));
            uint32_t held = depth < 0 ? 0 : depth > 0xffffffff ? 0xffffffffu : (uint32_t)depth;
            texels++;
            count->saturated += depth != (int64_t)held;
            if ((!plane->exists || got != (gn_depth)(held >> (32 - GN_DEPTH_BITS))) && count->failures++ < 5) {
                note_lone(a, light, n);
                note("    texel (%d, %u): stored %lu, the receiver's plane has %lld%s", (int)column,
                     (unsigned)(first + r), (unsigned long)got, (long long)depth,
                     plane->exists ? "" : " and is not there");
            }
        }
    }
    if (plane->faces_light == in_plane && count->failures++ < 5) {
        note_lone(a, light, n);
        note("    the light is %s its plane, but faces_light is %d", in_plane ? "in" : "beside",
             (int)plane->faces_light);
    }
    int64_t dx = plane->plane.dx < 0 ? -plane->plane.dx : plane->plane.dx;
    int64_t dy = plane->plane.dy < 0 ? -plane->plane.dy : plane->plane.dy;
    count->triangles++;
    count->in_plane += in_plane;
    count->texels += texels;
    if (texels) {
        count->covering++;
        count->spots += light->kind == GN_SPOT;
        count->clipped += clips != 0;
        count->mirrored += a->object.model != 0;
        count->steep += dx >> 30 || dy >> 30;
        count->level += dx == 0 && dy == 0;
    }
}

static uint16_t random_side(void)
{
    return (uint16_t)(between(0, 3) ? between(1, 70) : between(0, 1) ? between(1, 4096) : 1 << between(0, 12));
}

static void planes_equal_stored_depths(uint64_t cases)
{
    static alone a;
    static lone_count count;
    uint64_t maps = 0;
    for (uint64_t n = 0; count.triangles < cases && n < 4 * cases && count.failures < 5; maps++) {
        gn_light light;
        if (start_alone(&a, random_side(), random_side()) != GN_OK) {
            count.failures++;
            break;
        }
        for (int i = 0; i < 400; i++, n++) {
            if (i % 20 == 0)
                while (random_light(&light) != GN_OK)
                    continue;
            compare_lone(&a, &light, n, &count);
        }
        free(a.block);
    }
    ok(!count.failures, "a triangle's plane is what the light pass stored for it: %llu triangles, %llu texels",
       (unsigned long long)count.triangles, (unsigned long long)count.texels);
    ok(count.covering > cases / 4 && count.texels > 10 * cases && count.spots > cases / 10 &&
           count.clipped > cases / 40 && count.steep > cases / 200 && count.mirrored > cases / 20 &&
           count.level > cases / 400,
       "%llu covered texels: %llu under spot lights, %llu clipped, %llu steep, %llu level, %llu mirrored",
       (unsigned long long)count.covering, (unsigned long long)count.spots, (unsigned long long)count.clipped,
       (unsigned long long)count.steep, (unsigned long long)count.level, (unsigned long long)count.mirrored);
    note("%llu maps; %llu texels beyond the range; %llu triangles with the light in their plane",
         (unsigned long long)maps, (unsigned long long)count.saturated, (unsigned long long)count.in_plane);
}

/* ---- lone planes and lone solids ------------------------------------------------------------------------------- */

static void random_vector(int32_t v[3], double least, double most)
{
    double direction[3], length = 0, wanted = magnitude_between(least, most);
    do {
        length = 0;
        for (int i = 0; i < 3; i++) {
            direction[i] = fraction_between(-1, 1);
            length += direction[i] * direction[i];
        }
    } while (length > 1 || length < 0.01);
    for (int i = 0; i < 3; i++)
        v[i] = (int32_t)(direction[i] * wanted / sqrt(length));
}

/* origin + a x + b y: exactly in one plane whatever a and b. */
static uint32_t add_combined(shape *s, const int32_t origin[3], const int32_t x[3], const int32_t y[3], int32_t a,
                             int32_t b)
{
    return add_vertex(s, origin[0] + a * x[0] + b * y[0], origin[1] + a * x[1] + b * y[1],
                      origin[2] + a * x[2] + b * y[2]);
}

/* Two directions of similar lengths under a fair angle. */
static void random_axes(int32_t x[3], int32_t y[3], double length)
{
    double cross;
    do {
        random_vector(x, length - 1, length);
        random_vector(y, length - 1, length);
        double dot = 0, xx = 0, yy = 0;
        for (int i = 0; i < 3; i++) {
            dot += (double)x[i] * y[i];
            xx += (double)x[i] * x[i];
            yy += (double)y[i] * y[i];
        }
        cross = 1 - dot * dot / (xx * yy);
    } while (cross < 0.1);
}

static void make_quad(shape *s)
{
    int32_t x[3], y[3], origin[3] = {0, 0, 0};
    random_axes(x, y, 21);
    uint32_t a = add_combined(s, origin, x, y, -1, -1);
    add_combined(s, origin, x, y, 1, -1);
    add_combined(s, origin, x, y, 1, 1);
    add_combined(s, origin, x, y, -1, 1);
    add_triangle(s, a, a + 1, a + 2);
    add_triangle(s, a, a + 2, a + 3);
}

static void make_one_triangle(shape *s)
{
    int32_t corner[3];
    for (int i = 0; i < 3; i++) {
        random_vector(corner, 20, 22);
        add_vertex(s, corner[0], corner[1], corner[2]);
    }
    add_triangle(s, 0, 1, 2);
}

/* Twelve corners on a circle of 1000: still strictly convex when rounded. */
static const int16_t circle[12][2] = {{1000, 0},  {866, 500},   {500, 866},   {0, 1000},  {-500, 866}, {-866, 500},
                                      {-1000, 0}, {-866, -500}, {-500, -866}, {0, -1000}, {500, -866}, {866, -500}};

static void make_fan(shape *s)
{
    int32_t x[3], y[3], origin[3] = {0, 0, 0};
    random_axes(x, y, 11);
    uint32_t centre = add_combined(s, origin, x, y, between(-300, 300), between(-300, 300));
    for (int i = 0; i < 12; i++)
        add_combined(s, origin, x, y, circle[i][0], circle[i][1]);
    for (uint32_t i = 0; i < 12; i++)
        add_triangle(s, centre, centre + 1 + i, centre + 1 + (i + 1) % 12);
}

/* A plane of 8 x 8 cells. */
static void make_grid(shape *s)
{
    enum { CELLS = 8 };
    int32_t x[3], y[3], origin[3] = {0, 0, 0};
    random_axes(x, y, 19);
    for (int32_t b = 0; b <= CELLS; b++)
        for (int32_t a = 0; a <= CELLS; a++)
            add_combined(s, origin, x, y, a - CELLS / 2, b - CELLS / 2);
    for (uint32_t b = 0; b < CELLS; b++)
        for (uint32_t a = 0; a < CELLS; a++) {
            uint32_t i = b * (CELLS + 1) + a;
            add_triangle(s, i, i + 1, i + CELLS + 2);
            add_triangle(s, i, i + CELLS + 2, i + CELLS + 1);
        }
}

/* Turn the triangles of a convex solid about the origin outwards. */
static void turn_outwards(shape *s)
{
    for (uint32_t t = 0; t < s->mesh.triangle_count; t++) {
        uint32_t *index = s->indices + 3 * t;
        int32_t corner[3][3];
        for (int i = 0; i < 3; i++)
            memcpy(corner[i], s->vertices[index[i]], sizeof corner[i]);
        if (side_of(corner, corner[0]) < 0) {
            uint32_t first = index[1];
            index[1] = index[2];
            index[2] = first;
        }
    }
}

/* A block of three directions, the third divided by thin: all faces exactly plane. */
static void add_block(shape *s, int32_t thin)
{
    static const uint8_t face[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    int32_t x[3], y[3], z[3];
    double volume, lengths;
    do {
        random_axes(x, y, 21);
        random_vector(z, 20, 21);
        volume = 0;
        lengths = 1;
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3, k = (i + 2) % 3;
            volume += z[i] * ((double)x[j] * y[k] - (double)x[k] * y[j]);
        }
        lengths = 1;
        for (int i = 0; i < 3; i++) {
            const int32_t *v = i == 0 ? x : i == 1 ? y : z;
            lengths *= sqrt((double)v[0] * v[0] + (double)v[1] * v[1] + (double)v[2] * v[2]);
        }
    } while (fabs(volume) < 0.2 * lengths);
    for (int i = 0; i < 8; i++) {
        int32_t p[3];
        for (int k = 0; k < 3; k++)
            p[k] = (i & 1 ? x[k] : -x[k]) + (i & 2 ? y[k] : -y[k]) + (i & 4 ? z[k] / thin : -z[k] / thin);
        add_vertex(s, p[0], p[1], p[2]);
    }
    for (uint32_t i = 0; i < 6; i++) {
        add_triangle(s, face[i][0], face[i][1], face[i][2]);
        add_triangle(s, face[i][0], face[i][2], face[i][3]);
    }
    turn_outwards(s);
}

static void make_block(shape *s)
{
    add_block(s, 1);
}

static void make_slab(shape *s)
{
    add_block(s, (int32_t)magnitude_between(5, 12));
}

static void make_tetrahedron(shape *s)
{
    static const int8_t corner[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    int32_t x[3], y[3], z[3];
    random_axes(x, y, 21);
    for (int i = 0; i < 3; i++)
        z[i] =
            (int32_t)(((double)x[(i + 1) % 3] * y[(i + 2) % 3] - (double)x[(i + 2) % 3] * y[(i + 1) % 3]) / (1 << 21));
    for (int i = 0; i < 4; i++)
        add_vertex(s, corner[i][0] * x[0] + corner[i][1] * y[0] + corner[i][2] * z[0],
                   corner[i][0] * x[1] + corner[i][1] * y[1] + corner[i][2] * z[1],
                   corner[i][0] * x[2] + corner[i][1] * y[2] + corner[i][2] * z[2]);
    for (uint32_t i = 0; i < 4; i++)
        add_triangle(s, i, (i + 1) % 4, (i + 2) % 4);
    turn_outwards(s);
}

/* Twelve sides between two lids. */
static void make_prism(shape *s)
{
    int32_t x[3], y[3], z[3], low[3], high[3];
    random_axes(x, y, 11);
    for (int i = 0; i < 3; i++) {
        z[i] =
            (int32_t)(((double)x[(i + 1) % 3] * y[(i + 2) % 3] - (double)x[(i + 2) % 3] * y[(i + 1) % 3]) / (1 << 2));
        low[i] = -z[i];
        high[i] = z[i];
    }
    for (int i = 0; i < 24; i++)
        add_combined(s, i < 12 ? low : high, x, y, circle[i % 12][0], circle[i % 12][1]);
    for (uint32_t i = 0; i < 12; i++) {
        uint32_t j = (i + 1) % 12;
        add_triangle(s, i, j, 12 + j);
        add_triangle(s, i, 12 + j, 12 + i);
        if (i > 0 && i < 11) {
            add_triangle(s, 0, i, i + 1);
            add_triangle(s, 12, 12 + i, 13 + i);
        }
    }
    turn_outwards(s);
}

/* An icosahedron's faces in 16 parts each, all corners on a sphere. */
static void add_part(shape *s, const double a[3], const double b[3], const double c[3], int depth)
{
    const double *corner[3] = {a, b, c};
    double middle[3][3];
    if (depth == 0) {
        uint32_t index[3];
        for (int i = 0; i < 3; i++) {
            int32_t p[3];
            for (int k = 0; k < 3; k++)
                p[k] = (int32_t)floor(corner[i][k] * 2000000 + 0.5);
            index[i] = add_vertex(s, p[0], p[1], p[2]);
        }
        add_triangle(s, index[0], index[1], index[2]);
        return;
    }
    for (int i = 0; i < 3; i++) {
        double length = 0;
        for (int k = 0; k < 3; k++) {
            middle[i][k] = corner[i][k] + corner[(i + 1) % 3][k];
            length += middle[i][k] * middle[i][k];
        }
        for (int k = 0; k < 3; k++)
            middle[i][k] /= sqrt(length);
    }
    for (int i = 0; i < 3; i++)
        add_part(s, corner[i], middle[i], middle[(i + 2) % 3], depth - 1);
    add_part(s, middle[0], middle[1], middle[2], depth - 1);
}

static void make_ball(shape *s)
{
    static const uint8_t face[20][3] = {{0, 1, 4},  {0, 4, 9},  {9, 4, 5},  {4, 8, 5},  {4, 1, 8},
                                        {8, 1, 10}, {8, 10, 3}, {5, 8, 3},  {5, 3, 2},  {2, 3, 7},
                                        {7, 3, 10}, {7, 10, 6}, {7, 6, 11}, {11, 6, 0}, {0, 6, 1},
                                        {6, 10, 1}, {9, 11, 0}, {9, 2, 11}, {9, 5, 2},  {7, 11, 2}};
    const double x = 0.525731112119133606, z = 0.850650808352039932;
    const double corner[12][3] = {{-x, 0, z}, {x, 0, z},   {-x, 0, -z}, {x, 0, -z}, {0, z, x},  {0, z, -x},
                                  {0, -z, x}, {0, -z, -x}, {z, x, 0},   {-z, x, 0}, {z, -x, 0}, {-z, -x, 0}};
    for (int i = 0; i < 20; i++)
        add_part(s, corner[face[i][0]], corner[face[i][1]], corner[face[i][2]], 2);
    turn_outwards(s);
}

typedef struct kind {
    const char *name;
    void (*make)(shape *s);
    int closed;
} kind;

/* Open ones first. */
static const kind kinds[] = {
    {"triangle", make_one_triangle, 0},
    {"quad", make_quad, 0},
    {"fan", make_fan, 0},
    {"grid", make_grid, 0},
    {"block", make_block, 1},
    {"thin slab", make_slab, 1},
    {"tetrahedron", make_tetrahedron, 1},
    {"prism", make_prism, 1},
    {"faceted ball", make_ball, 1},
};
enum { KINDS = sizeof kinds / sizeof kinds[0], OPEN_KINDS = 4 };

/* Distance of the farthest corner from the origin. */
static double reach_of(const gn_mesh *mesh)
{
    double farthest = 0;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const int32_t *v = mesh->vertices[i];
        farthest = fmax(farthest, (double)v[0] * v[0] + (double)v[1] * v[1] + (double)v[2] * v[2]);
    }
    return sqrt(farthest);
}

/* A light that shape and all its parts are well inside of; a camera anywhere about it. */
static gn_status random_views(gn_light *light, gn_camera *camera, const gn_scene *scene, int spot)
{
    static const int32_t up[3] = {0, 1, 0}, origin[3] = {0, 0, 0};
    int32_t direction[3], eye[3], at[3], position[3];
    random_vector(direction, 20, 20);
    random_vector(eye, 23, 24);
    random_vector(at, 18, 20);
    memset(light, 0, sizeof *light);
    memset(camera, 0, sizeof *camera);
    gn_status status = gn_look_at(camera, eye, at, up);
    if (status == GN_OK)
        status = between(0, 3) ? gn_perspective(camera, GN_DEGREES(between(15, 40)), 1 << 20, 1 << 25)
                               : gn_orthographic(camera, 3 << 20, 0, 1 << 25);
    if (status != GN_OK)
        return status;
    if (spot) {
        double reach = 1.02 * reach_of(scene->objects->mesh), away = reach * magnitude_between(1, 3);
        double half = asin(reach / away) * 180 / 3.14159265358979;
        for (int i = 0; i < 3; i++)
            position[i] = (int32_t)(-direction[i] * (away / (1 << 20)));
        return gn_spot_light(light, position, origin, 0, GN_DEGREES((int)(2 * half) + 2),
                             (int32_t)((away - reach) * magnitude_between(-4, 0)),
                             (int32_t)((away + reach) * magnitude_between(0, 2)));
    }
    status = gn_directional_light(light, direction, 0);
    return status == GN_OK ? gn_fit_light(light, scene) : status;
}

/* Of pixels that are turned to the light. */
typedef struct self_shadow {
    uint64_t turned, shadowed, away;
    uint64_t unexplained;
} self_shadow;

/* Is the triangle turned to camera and light alike, decided by the test itself? A solid's from outside: along its
 * outline the camera may see a pixel of a face's inner side, which the solid itself shadows. */
static int is_turned(const gn_mesh *mesh, uint32_t triangle, const gn_light *light, const gn_camera *camera)
{
    int32_t corner[3][3], to_light[3], to_camera[3];
    uint32_t index[3];
    gn_triangle_indices(mesh, triangle, index);
    for (int i = 0; i < 3; i++)
        memcpy(corner[i], mesh->vertices[index[i]], sizeof corner[i]);
    for (int i = 0; i < 3; i++) {
        to_light[i] = light->kind == GN_SPOT ? light->position[i] - corner[0][i] : -light->forward[i];
        to_camera[i] = camera->projection == GN_PERSPECTIVE ? camera->eye[i] - corner[0][i] : -camera->forward[i];
    }
    int side = side_of(corner, to_light);
    return (mesh->closed ? side > 0 : side != 0) && side == side_of(corner, to_camera);
}

/* What a plane rises within half a texel, however steep. */
static double rise_of(const gn_wide_plane *p)
{
    return (fabs((double)p->dx) + fabs((double)p->dy)) / 2;
}

/* A triangle as the light sees it. */
typedef struct projected {
    gn_vertex v[3];
    gn_wide_plane plane;
    int exists;
} projected;

static projected project(const gn_context *context, const gn_mesh *mesh, uint32_t triangle)
{
    projected p;
    gn_depth_plane narrow;
    uint32_t index[3];
    memset(&p, 0, sizeof p);
    gn_triangle_indices(mesh, triangle, index);
    for (int i = 0; i < 3; i++) {
        gn_place place;
        (void)gn_view_place(&context->light_view, mesh->vertices[index[i]], &place);
        gn_view_project(&context->light_view, &place, &p.v[i]);
    }
    int64_t area = gn_area(&p.v[0], &p.v[1], &p.v[2]);
    if (area < 0) {
        gn_vertex v = p.v[1];
        p.v[1] = p.v[2];
        p.v[2] = v;
    }
    p.exists = area != 0;
    if (area && gn_make_depth_plane(&narrow, &p.v[0], &p.v[1], &p.v[2], area))
        gn_make_steep_plane(&p.plane, &p.v[0], &p.v[1], &p.v[2], area);
    else if (area)
        gn_make_steep_plane(&p.plane, &p.v[0], &p.v[1], &p.v[2], area); /* the same, but for wrapping */
    return p;
}

/* Is the texel's centre inside, or on the border? */
static int covers(const projected *p, int64_t column, int64_t row)
{
    for (int i = 0; i < 3; i++) {
        const gn_vertex *a = &p->v[i], *b = &p->v[(i + 1) % 3];
        if ((b->x - a->x) * (256 * row + 128 - a->y) - (b->y - a->y) * (256 * column + 128 - a->x) < 0)
            return 0;
    }
    return 1;
}

/* The steepest of the triangles over a texel's centre; corners are snapped, so what they stored there errs by up to
 * 1/256 of what they rise within half a texel. */
static double steepest_over(const gn_context *context, const gn_mesh *mesh, int64_t column, int64_t row)
{
    double steepest = 0;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        projected p = project(context, mesh, i);
        if (p.exists && covers(&p, column, row))
            steepest = fmax(steepest, p.plane.dx == 0 && p.plane.dy == 0 ? HUGE_VAL : rise_of(&p.plane));
    }
    return steepest;
}

/* Why a pixel is shadowed. Corners are snapped to 1/256 texel, so a face stores depths that err by h/256, h being what
 * it rises within half a texel; and where the solid ends, a centre may be covered that lies up to 1/512 texel outside,
 * where two faces part by up to 1/256 of both their h. A receiver knows the h of its own face alone: it can be shadowed
 * by one that is steeper. And by the vote of the four texels where its own point errs by more than GN_POINT_ERROR: a
 * steep plane turns an error of place into one of depth. */
static int has_a_reason(gn_context *context, const gn_mesh *mesh, uint32_t triangle, const point *p, int by_vote)
{
    const gn_receiver_plane *plane = gn_find_plane(context, &context->workers[0], triangle, 0);
    int64_t one = (int64_t)1 << p->bits, column = p->u / one, row = p->v / one;
    double unit = GN_DEPTH_BITS == 16 ? 65536 : 1, h = rise_of(&plane->plane), steepest;
    if (!plane->exists)
        return 1; /* edge-on */
    int64_t nearer = gn_wide_depth(&plane->plane, (int32_t)column, (int32_t)row) - plane->slack;
    double held = nearer < 0 ? 0 : fmin((double)nearer, 4294967295.0), z = floor(held / unit);
    if (z > texel_at(context, (uint32_t)column, (uint32_t)row)) {
        steepest = steepest_over(context, mesh, column, row);
        return held - unit - texel_at(context, (uint32_t)column, (uint32_t)row) * unit <= (steepest + h) / 128;
    }
    /* the plane at the point, whose place is from the first texel's border */
    double at = (double)plane->plane.base + ((double)p->u / (double)one - 0.5) * (double)plane->plane.dx +
                ((double)p->v / (double)one - 0.5) * (double)plane->plane.dy;
    steepest = 0;
    for (int i = 0; i < 4; i++)
        steepest = fmax(steepest,
                        steepest_over(context, mesh, (p->u - one / 2) / one + i % 2, (p->v - one / 2) / one + i / 2));
    return by_vote && p->z - at >= GN_POINT_ERROR - unit - (steepest + h) / 128;
}

typedef struct choice {
    uint8_t surface, layers, cull;
    const gn_receiver *receiver;
} choice;

enum { WIDTH = 48, HEIGHT = 36 };

/* Render the lone shape and count the pixels that shadow themselves. */
static int count_self_shadow(self_shadow *count, const gn_scene *scene, const gn_light *light, const gn_camera *camera,
                             int size, choice what)
{
    static uint32_t q[WIDTH * HEIGHT], triangle[WIDTH * HEIGHT];
    const gn_mesh *mesh = scene->objects->mesh;
    gn_window window = {0, 0, WIDTH, HEIGHT};
    gn_pixels region;
    frame f;
    gn_settings s = gn_default_settings(WIDTH, HEIGHT, (uint16_t)size);
    s.format = GN_NO_COLOUR;
    s.mask = 1;
    s.region_height = HEIGHT;
    s.surface = what.surface;
    s.layers = what.layers;
    s.cull = what.cull;
    s.receiver = what.receiver;
    gn_status status = frame_start(&f, scene, &s);
    if (status == GN_OK)
        status = gn_light_pass(f.context, light);
    if (status == GN_OK)
        status = gn_camera_begin(f.context, camera);
    if (status == GN_OK) {
        gn_rasterise_region(f.context, &f.context->workers[0], &window);
        memcpy(q, f.context->workers[0].q, sizeof q);
        memcpy(triangle, f.context->workers[0].triangle, sizeof triangle);
        status = gn_camera_region(f.context, 0, 0, 0, f.mask, &region);
    }
    for (int32_t i = 0; status == GN_OK && i < WIDTH * HEIGHT; i++) {
        if (triangle[i] == GN_NO_TRIANGLE)
            continue;
        if (!is_turned(mesh, triangle[i], light, camera)) {
            count->away++;
            continue;
        }
        count->turned++;
        if (f.mask[i] == 254)
            continue;
        count->shadowed++;
        if (what.receiver) {
            point p = find_point(f.context, i % WIDTH, i / WIDTH, q[i]);
            count->unexplained += !has_a_reason(f.context, mesh, triangle[i], &p, what.receiver == &gn_virtual);
        }
    }
    return frame_end(&f) && status == GN_OK;
}

typedef enum measured {
    PLANE_ALWAYS,
    PLANE_VOTED,
    SECOND_ALWAYS,
    SECOND_VOTED,
    FIRST_ALWAYS,
    FIRST_VOTED,
    PLANE_POINT,
    MEASURED
} measured;

static const char *const measured_names[MEASURED] = {"planes, first depth, virtual samples everywhere",
                                                     "planes, first depth, three-way rule",
                                                     "solids, second depth, virtual samples everywhere",
                                                     "solids, second depth, three-way rule",
                                                     "solids, first depth, virtual samples everywhere",
                                                     "solids, first depth, three-way rule",
                                                     "planes, first depth, the point's depth"};

static const choice choices[MEASURED] = {
    {GN_CONSTANT, GN_LAYERS_FIRST, GN_CULL_NONE, &gn_virtual_always},
    {GN_CONSTANT, GN_LAYERS_FIRST, GN_CULL_NONE, &gn_virtual},
    {GN_SECOND, GN_LAYERS_TWO, GN_CULL_NONE, &gn_virtual_always},
    {GN_SECOND, GN_LAYERS_TWO, GN_CULL_NONE, &gn_virtual},
    {GN_CONSTANT, GN_LAYERS_FIRST, GN_CULL_NONE, &gn_virtual_always},
    {GN_CONSTANT, GN_LAYERS_FIRST, GN_CULL_NONE, &gn_virtual},
    {GN_CONSTANT, GN_LAYERS_FIRST, GN_CULL_NONE, 0},
};

static int measure(self_shadow counts[MEASURED], const kind *what, int spot, int front_culled, int with_point)
{
    shape s = shape_new(what->closed);
    gn_object object = {&s.mesh, 0, {200, 200, 200}};
    gn_scene scene = {&object, 1, {0, 0, 0}, 0};
    gn_light light;
    gn_camera camera;
    what->make(&s);
    int good = random_views(&light, &camera, &scene, spot) == GN_OK;
    int size = 32 << (between(0, 15) ? between(0, 3) : between(4, 5));
    size -= between(0, 1) ? between(0, size / 4) : 0;
    for (int m = 0; good && m < MEASURED; m++) {
        choice how = choices[m];
        if (m == PLANE_POINT ? !with_point || what->closed : what->closed == (m <= PLANE_VOTED))
            continue;
        if (how.surface == GN_SECOND && front_culled) {
            how.layers = GN_LAYERS_FIRST;
            how.cull = GN_CULL_FRONT;
        }
        good = count_self_shadow(&counts[m], &scene, &light, &camera, size, how);
    }
    shape_free(&s);
    return good;
}

static void lone_shapes_shadow_themselves_no_more_than_is_explained(uint64_t lights)
{
    static self_shadow counts[2][MEASURED];
    uint64_t failures = 0;
    for (uint64_t n = 0; n < lights; n++)
        for (int spot = 0; spot < 2; spot++) {
            failures += !measure(counts[spot], &kinds[n % OPEN_KINDS], spot, 0, n % 16 < 4);
            failures +=
                !measure(counts[spot], &kinds[OPEN_KINDS + n % (KINDS - OPEN_KINDS)], spot, (int)(n / 5 % 2), 0);
        }
    ok(!failures, "%llu views of lone shapes", (unsigned long long)(4 * lights));
    for (int spot = 0; spot < 2; spot++) {
        const char *light = spot ? "spot" : "directional";
        const self_shadow *c = counts[spot];
        /* exactly: neighbours in one plane differ by their snapping, and the slack of gn_receiver_plane.c holds that */
        ok(c[PLANE_ALWAYS].shadowed == 0 && c[PLANE_ALWAYS].turned > 20 * lights && c[PLANE_ALWAYS].away > 20 * lights,
           "%s light: no lone plane shadows itself: %llu of %llu pixels", light,
           (unsigned long long)c[PLANE_ALWAYS].shadowed, (unsigned long long)c[PLANE_ALWAYS].turned);
        /* but for a steeper face that hides one (has_a_reason): measured, a pixel in a million */
        ok(c[SECOND_ALWAYS].unexplained == 0 && c[SECOND_ALWAYS].shadowed <= 1 + c[SECOND_ALWAYS].turned / 1000000 &&
               c[SECOND_ALWAYS].turned > 50 * lights && c[SECOND_ALWAYS].away > 50 * lights,
           "%s light: a lone convex solid with second depth is shadowed by a steeper face's snapping at most: %llu of "
           "%llu pixels",
           light, (unsigned long long)c[SECOND_ALWAYS].shadowed, (unsigned long long)c[SECOND_ALWAYS].turned);
        /* the vote is by a point that errs: measured, up to 0.1 in a thousand, held to 0.25 */
        ok(!c[PLANE_VOTED].unexplained && !c[SECOND_VOTED].unexplained && !c[FIRST_ALWAYS].unexplained &&
               !c[FIRST_VOTED].unexplained && c[PLANE_VOTED].shadowed <= 1 + c[PLANE_VOTED].turned / 4000 &&
               c[SECOND_VOTED].shadowed <= 1 + c[SECOND_VOTED].turned / 100000,
           "%s light: what shadows itself by the vote or with first depth has a reason, and by the vote is below 250 "
           "in a million",
           light);
        /* else all of this would show nothing */
        ok(c[PLANE_POINT].shadowed * 10 > c[PLANE_POINT].turned * 3 && c[PLANE_POINT].turned > lights,
           "%s light: without virtual samples %llu of %llu pixels do", light,
           (unsigned long long)c[PLANE_POINT].shadowed, (unsigned long long)c[PLANE_POINT].turned);
        for (int m = 0; m < MEASURED; m++)
            note("%s light: %s: %llu of %llu, %.1f in a million, %llu without a reason", light, measured_names[m],
                 (unsigned long long)c[m].shadowed, (unsigned long long)c[m].turned,
                 c[m].turned ? 1e6 * (double)c[m].shadowed / (double)c[m].turned : 0,
                 (unsigned long long)c[m].unexplained);
    }
}

/* Wang & Molnar's figure 10 compares virtual samples with <. The samples of a lone plane are the stored depths
 * themselves, so that every one of its pixels over a texel that it covers would be shadowed. */
static void samples_of_lone_planes_are_what_is_stored_so_less_would_shadow_them(uint64_t lights)
{
    uint64_t covered = 0, by_less = 0, by_less_or_equal = 0, failures = 0;
    for (uint64_t n = 0; n < lights; n++) {
        shape s = shape_new(0);
        gn_object object = {&s.mesh, 0, {200, 200, 200}};
        gn_scene scene = {&object, 1, {0, 0, 0}, 0};
        gn_light light;
        gn_camera camera;
        gn_window window = {0, 0, WIDTH, HEIGHT};
        frame f;
        make_one_triangle(&s);
        gn_settings settings = gn_default_settings(WIDTH, HEIGHT, 64);
        settings.surface = GN_CONSTANT;
        settings.receiver = &gn_virtual;
        settings.region_height = HEIGHT;
        gn_status status = random_views(&light, &camera, &scene, (int)(n & 1));
        if (status == GN_OK)
            status = frame_start(&f, &scene, &settings);
        if (status == GN_OK)
            status = gn_light_pass(f.context, &light);
        if (status == GN_OK)
            status = gn_camera_begin(f.context, &camera);
        if (status != GN_OK) {
            failures++;
            shape_free(&s);
            continue;
        }
        gn_context *context = f.context;
        gn_worker *worker = &context->workers[0];
        gn_rasterise_region(context, worker, &window);
        projected p = project(context, &s.mesh, 0);
        for (int32_t i = 0; i < WIDTH * HEIGHT && is_turned(&s.mesh, 0, &light, &camera); i++) {
            if (worker->triangle[i] == GN_NO_TRIANGLE)
                continue;
            point at = find_point(context, i % WIDTH, i / WIDTH, worker->q[i]);
            int32_t column = (int32_t)(at.u >> at.bits), row = (int32_t)(at.v >> at.bits);
            if (at.where != ON_MAP || column > 63 || row > 63 || !covers(&p, column, row))
                continue;
            uint32_t z = gn_saturate(gn_wide_depth(&gn_find_plane(context, worker, 0, 0)->plane, column, row));
            gn_depth sample = (gn_depth)(z >> (32 - GN_DEPTH_BITS)),
                     stored = texel_at(context, (uint32_t)column, (uint32_t)row);
            if (stored == EMPTY)
                continue; /* a centre on the border that the fill rule gives to the other side */
            covered++;
            by_less += sample < stored;
            by_less_or_equal += sample <= stored;
        }
        failures += !frame_end(&f);
        shape_free(&s);
    }
    ok(!failures && covered > 10 * lights && by_less == 0 && by_less_or_equal == covered,
       "with < none of %llu pixels of lone planes would be lit (%llu are), with <= all (%llu)",
       (unsigned long long)covered, (unsigned long long)by_less, (unsigned long long)by_less_or_equal);
}

/* ---- slack ----------------------------------------------------------------------------------------------------- */

/* What gn_receiver_plane.c derives, in doubles: 2^15 + h/128 + h min(1, (E1 + E2) / A), a hundredth more at most for
 * its integers. */
static void slack_is_what_snapping_asks_for(uint64_t cases)
{
    static alone a;
    uint64_t checked = 0, slivers = 0, large = 0, sheer = 0, wrong = 0;
    gn_light light;
    gn_status status = start_alone(&a, 200, 150);
    if (status != GN_OK)
        note("status %d", (int)status);
    for (uint64_t n = 0; status == GN_OK && n < cases && wrong < 5; n++) {
        int32_t row;
        if (n % 20 == 0)
            while (random_light(&light) != GN_OK)
                continue;
        if (!random_triangle(&a, &light, &row) || gn_light_begin(a.context, &light) != GN_OK ||
            a.context->objects[0].clips)
            continue;
        look_along(&a.context->camera, &light);
        a.context->workers[0].planes = a.planes;
        a.planes[0].triangle = GN_NO_TRIANGLE;
        const gn_receiver_plane *plane = gn_find_plane(a.context, &a.context->workers[0], 0, 0);
        const gn_vertex *v = a.context->vertices;
        double area = fabs((double)gn_area(&v[0], &v[1], &v[2])), h = rise_of(&plane->plane), least = HUGE_VAL, sum = 0;
        if (!plane->exists)
            continue; /* edge-on */
        /* the whole range in 1/256 texel is flat: then every depth is its neighbour's */
        double dz1 = (double)v[1].depth - v[0].depth, dz2 = (double)v[2].depth - v[0].depth;
        double nx = dz1 * (v[2].y - v[0].y) - dz2 * (v[1].y - v[0].y),
               ny = dz2 * (v[1].x - v[0].x) - dz1 * (v[2].x - v[0].x);
        double steepest = 512 * fmax(fabs(nx), fabs(ny)) / area;
        if (steepest >= 549755813888.0) { /* 2^39, flat from there or from 2^40 on */
            sheer += h == 0;
            if (h == 0 && plane->slack < INT64_C(1) << 32 && wrong++ < 5)
                note("triangle %llu: slack %lld of a flat plane, expected 2^32", (unsigned long long)n,
                     (long long)plane->slack);
            continue;
        }
        for (int i = 0; i < 3; i++) {
            const gn_vertex *from = &v[i], *to = &v[(i + 1) % 3];
            double side = abs(to->x - from->x) + abs(to->y - from->y);
            least = fmin(least, side);
            sum += side;
        }
        double slenderness = fmin(1, (sum - least) / area), exact_slack = 32768 + h / 128 + h * slenderness;
        checked++;
        slivers += slenderness > 0.25;
        large += slenderness < 0.01;
        if (((double)plane->slack < exact_slack - 512 || (double)plane->slack > exact_slack + h / 256 + 512) &&
            wrong++ < 5)
            note("triangle %llu: slack %lld, expected %.1f to %.1f", (unsigned long long)n, (long long)plane->slack,
                 exact_slack, exact_slack + h / 256);
    }
    free(a.block);
    ok(!wrong && checked > cases / 4 && slivers > cases / 50 && large > cases / 50 && sheer > cases / 2000,
       "the slack of %llu planes, %llu of them of slivers and %llu of large triangles, is what snapping asks for; "
       "%llu that are flat have all",
       (unsigned long long)checked, (unsigned long long)slivers, (unsigned long long)large, (unsigned long long)sheer);
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 2600000);
    planes_equal_stored_depths(cases);
    slack_is_what_snapping_asks_for(cases / 30);
    samples_of_lone_planes_are_what_is_stored_so_less_would_shadow_them(cases / 26000);
    lone_shapes_shadow_themselves_no_more_than_is_explained(cases / 2600);
    return tap_done();
}
