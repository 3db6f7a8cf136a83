/* Point lights against the exact truth, and pixels beside the edges of their cube against all others: near and far
 * cubes, a light in a plane and at a vertex, cameras anywhere; an empty room about the light, which is all lit. */
#include "core/point_scene.h"
#include "truth.h"

enum { SCENES = TAP_SLOWER > 1 ? 2 : 6 };
enum { TEXELS = 2, CLOSE = 128 }; /* beside an edge: so many texels; the map of pictures that are compared with truth */

typedef struct method {
    const char *name;
    uint8_t surface;
    const gn_receiver *receiver;
    const gn_reconstruction *reconstruction;
} method;

static const method methods[] = {
    {"constant", GN_CONSTANT, 0, 0},
    {"constant, virtual", GN_CONSTANT, &gn_virtual, 0},
    {"mixed, virtual", GN_MIXED, &gn_virtual, 0},
    {"dual, virtual-always", GN_DUAL, &gn_virtual_always, 0},
    {"mixed, bilinear", GN_MIXED, &gn_virtual, &gn_bilinear},
    {"mixed, jitter", GN_MIXED, &gn_virtual, &gn_jitter_4x4},
    {"mixed, box 3", GN_MIXED, &gn_virtual, &gn_box_3x3},
    {"mixed, box 7", GN_MIXED, &gn_virtual, &gn_box_7x7},
    {"mixed, silhouettes", GN_MIXED, &gn_virtual, &gn_silhouettes},
    {"mixed, smooth silhouettes", GN_MIXED, &gn_virtual, &gn_silhouettes_smooth},
    {"mixed, crossings", GN_MIXED, &gn_virtual, &gn_crossings},
};
enum { METHODS = sizeof methods / sizeof *methods };

/* What a pixel sees: the triangle and its point as seen from the light. 0: nothing. */
static int see(const stage *s, const gn_camera *camera, int x, int y, real v[3], int *at_edge)
{
    real half = ldexpl(camera->tan_half, -24), d[3], least = 0;
    real right = (2 * x + 1 - WIDTH) * half / HEIGHT, up = (HEIGHT - 2 * y - 1) * half / HEIGHT;
    for (int i = 0; i < 3; i++)
        d[i] = ldexpl(camera->forward[i] + right * camera->right[i] + up * camera->up[i], -30);
    for (uint32_t o = 0; o < s->scene.object_count; o++)
        for (uint32_t t = 0; t < s->objects[o].mesh->triangle_count; t++) {
            int32_t world[3][3];
            real inside = 0;
            (void)gn_triangle_world(&s->objects[o], t, world);
            real w = meet(world, camera->eye, d, &inside);
            if (inside >= 0 && w >= camera->near_depth && (least == 0 || w < least)) {
                least = w;
                *at_edge = inside < 0.02L;
            }
        }
    for (int i = 0; i < 3; i++)
        v[i] = camera->eye[i] + least * d[i] - s->light.position[i];
    return least > 0;
}

/* 1: within TEXELS texels of an edge of the cube, 0: farther; 2: sees nothing. */
static void find_edges(const stage *s, const gn_camera *camera, int map, uint8_t *beside)
{
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            real v[3], ratio[2], margin;
            int at_edge = 0, seen = see(s, camera, x, y, v, &at_edge);
            (void)face_of(v, ratio, &margin);
            real m = fmaxl(fmaxl(fabsl(v[0]), fabsl(v[1])), fabsl(v[2]));
            beside[y * WIDTH + x] = (uint8_t)(!seen ? 2 : margin / m * map / 2 < TEXELS);
        }
}

static int find_truth(truth *t, const stage *s, const gn_camera *camera)
{
    packed_scene packed;
    problem why;
    memset(&packed, 0, sizeof packed);
    packed.scene = s->scene;
    packed.objects = (gn_object *)(uintptr_t)s->scene.objects;
    packed.camera = *camera;
    packed.light = s->light;
    if (truth_make(t, &packed, WIDTH, HEIGHT, 1, 0, &why) == 0)
        return 1;
    note("%s", why.text);
    return 0;
}

typedef struct sums {
    real error[2];
    uint64_t pixels[2], lit, shadowed;
} sums;

static void add_errors(sums *e, const frame *f, const truth *t, const uint8_t *beside)
{
    for (size_t i = 0; i < mask_bytes(f); i++) {
        if (t->mask[i] == 255 || f->mask[i] == 255 || beside[i] > 1)
            continue;
        e->error[beside[i]] += abs(f->mask[i] - t->mask[i]) / 254.0L;
        e->pixels[beside[i]]++;
        e->lit += t->mask[i] == 254;
        e->shadowed += t->mask[i] == 0;
    }
}

static gn_settings settings_of(const stage *s, const method *m)
{
    gn_settings settings = s->settings;
    settings.map_width = settings.map_height = CLOSE;
    settings.surface = m->surface;
    settings.receiver = m->receiver;
    settings.reconstruction = m->reconstruction;
    return settings;
}

static void edges_of_the_cube_are_as_good_as_faces(void)
{
    sums all[METHODS];
    memset(all, 0, sizeof all);
    unsigned bad = 0;
    for (int scene = 0; scene < SCENES; scene++) {
        stage s;
        set_stage(&s);
        for (int which = 0; which < 5; which++) {
            gn_camera camera;
            truth t;
            uint8_t beside[WIDTH * HEIGHT];
            set_camera(&camera, which);
            if (camera.projection == GN_ORTHOGRAPHIC || !find_truth(&t, &s, &camera))
                continue;
            find_edges(&s, &camera, CLOSE, beside);
            for (int i = 0; i < METHODS; i++) {
                frame f;
                gn_settings settings = settings_of(&s, &methods[i]);
                if (render(&f, &s, &settings, &camera) == GN_OK)
                    add_errors(&all[i], &f, &t, beside);
                else
                    bad++;
                bad += !frame_end(&f);
            }
            truth_free(&t);
        }
        free_stage(&s);
    }
    ok(bad == 0, "all_pictures_are_made");
    for (int i = 0; i < METHODS; i++) {
        sums *e = &all[i];
        real beside = 100 * e->error[1] / e->pixels[1], elsewhere = 100 * e->error[0] / e->pixels[0];
        note("%s: %.3Lf %% of %llu pixels beside the edges are wrong, %.3Lf %% of %llu elsewhere", methods[i].name,
             beside, (unsigned long long)e->pixels[1], elsewhere, (unsigned long long)e->pixels[0]);
        ok(e->pixels[1] > 1000 && e->lit > 1000 && e->shadowed > 1000 && beside <= elsewhere,
           "%s: beside_the_edges_of_the_cube_no_more_is_wrong_than_elsewhere", methods[i].name);
    }
}

/* The room alone, whose walls run across the cube's edges: nothing in it casts a shadow that is seen. */
static void an_empty_room_is_all_lit(void)
{
    unsigned wrong = 0, pixels = 0, bad = 0, shadowed = 0, faces = 0;
    stage s;
    set_stage(&s);
    s.scene.objects = &s.objects[2];
    s.scene.object_count = 1;
    for (int which = 0; which < 5; which++) {
        gn_camera camera;
        truth t;
        set_camera(&camera, which);
        /* the orthographic camera sees the room from outside */
        if (camera.projection == GN_ORTHOGRAPHIC || !find_truth(&t, &s, &camera))
            continue;
        shadowed += (unsigned)t.shadowed;
        for (int i = 0; i < METHODS; i++) {
            frame f;
            unsigned before = wrong;
            gn_settings settings = settings_of(&s, &methods[i]);
            if (settings.reconstruction == &gn_box_7x7)
                settings.bias.value = 6 << 16; /* a wide filter reads the next wall at a corner of the room */
            bad += render(&f, &s, &settings, &camera) != GN_OK;
            for (size_t k = 0; k < mask_bytes(&f); k++) {
                pixels += t.mask[k] == 254;
                wrong += f.mask[k] != t.mask[k];
            }
            if (wrong != before)
                note("%s, camera %d: %u pixels are not lit", methods[i].name, which, wrong - before);
            bad += !frame_end(&f);
        }
        faces += (unsigned)t.lit;
        truth_free(&t);
    }
    ok(bad == 0 && shadowed == 0 && faces > 10000, "the_truth_of_an_empty_room_is_all_lit");
    ok(pixels > 10000 && wrong == 0, "no_method_shadows_a_pixel_of_it");
    free_stage(&s);
}

typedef struct place {
    const char *name;
    int32_t offset[3]; /* of the light from the corner of a box */
    int32_t near_depth, far_depth;
    int enclosed; /* 1: lights nothing */
} place;

/* A light at a corner of a solid, in the plane of its side, behind it; cubes that cut what is there. */
static void lights_stand_anywhere(void)
{
    static const place places[] = {
        {"at_the_corner_of_a_box", {0, 0, 0}, REACH / 500, 4 * REACH, 0},
        {"in_the_plane_of_its_side", {-5000, 0, -3000}, REACH / 500, 4 * REACH, 0},
        {"on_its_edge", {5000, 0, 0}, REACH / 500, 4 * REACH, 0},
        {"within_it", {5000, 5000, 5000}, REACH / 500, 4 * REACH, 1},
        {"with_a_near_cube_that_cuts_casters", {-9000, -9000, -9000}, REACH / 4, 4 * REACH, 0},
        {"with_a_far_cube_within_the_room", {-9000, -9000, -9000}, REACH / 500, REACH * 3 / 4, 0},
    };
    enum { PLACES = sizeof places / sizeof *places, CORNER = 8 * 5 /* the least one of the sixth box */ };
    static const method exact = {"", GN_CONSTANT, &gn_virtual,
                                 &gn_crossings}; /* second depth is not for lights in solids */
    for (int i = 0; i < PLACES; i++) {
        stage s;
        sums e;
        unsigned bad = 0;
        set_stage(&s);
        memset(&e, 0, sizeof e);
        for (int k = 0; k < 3; k++)
            s.light.position[k] = s.boxes.vertices[CORNER][k] + places[i].offset[k];
        s.light.near_depth = places[i].near_depth;
        s.light.far_depth = places[i].far_depth;
        for (int which = 0; which < 5; which++) {
            frame f;
            gn_camera camera;
            truth t;
            static const uint8_t none[WIDTH * HEIGHT];
            gn_settings settings = settings_of(&s, &exact);
            settings.map_width = settings.map_height = 4 * CLOSE;
            settings.bias.value = 0; /* a texel's width at the near cube is many times that far away */
            settings.faces = which % 2 ? &gn_one_face : &gn_six_faces;
            set_camera(&camera, which);
            bad += !find_truth(&t, &s, &camera) || render(&f, &s, &settings, &camera) != GN_OK;
            add_errors(&e, &f, &t, none);
            bad += !frame_end(&f);
            truth_free(&t);
        }
        real wrong = 100 * e.error[0] / e.pixels[0];
        note("%s: %.3Lf %% wrong of %llu lit, %llu shadowed", places[i].name, wrong, (unsigned long long)e.lit,
             (unsigned long long)e.shadowed);
        ok(bad == 0 && (e.lit > 100) == !places[i].enclosed && e.shadowed > 1000 && wrong < 1, "a_light_%s_is_right",
           places[i].name);
        free_stage(&s);
    }
}

int main(void)
{
    edges_of_the_cube_are_as_good_as_faces();
    an_empty_room_is_all_lit();
    lights_stand_anywhere();
    return tap_done();
}
