#include "truth_trace.h"

/* Every s that a line can have. */
#define EVERYWHERE 1e300

/* A tie counts with the reason that is named first in truth_reason, so that it does not depend on the order in which
 * triangles are met. */
static void note_tie(truth_reason *reason, truth_reason found)
{
    if (found && (!*reason || found < *reason))
        *reason = found;
}

/* ---- what the eye sees ----------------------------------------------------------------------------------------- */

typedef struct sight {
    const truth_scene *scene;
    truth_line line;
    int found;
    truth_hit hit;
    truth_reason reason;
} sight;

static void replace_hit(sight *s, const truth_hit *hit, truth_reason reason)
{
    s->found = 1;
    s->hit = *hit;
    s->reason = hit->touches ? TRUTH_EYE_EDGE : reason;
}

/* Two triangles in the same place: the lower number is seen. */
static void share_hit(sight *s, const truth_hit *hit)
{
    note_tie(&s->reason, hit->touches ? TRUTH_EYE_EDGE : TRUTH_EYE_DEPTH);
    if (hit->triangle->number < s->hit.triangle->number)
        s->hit = *hit;
}

static void see(sight *s, const truth_triangle *triangle)
{
    int signs[3];
    const gn_camera *camera = &s->line.view->camera;
    truth_meeting meeting = truth_line_meets(&s->line, triangle, signs);
    if (meeting == TRUTH_MISSES || meeting == TRUTH_WITHIN || (s->found && triangle == s->hit.triangle))
        return;
    truth_hit hit = truth_make_hit(&s->line, triangle, signs);
    int order = s->found ? truth_compare_hits(&s->line, &hit, &s->hit) : -1;
    if (order > 0)
        return;
    int past_near = truth_compare_depth(&s->line, &hit, camera->forward, camera->eye, camera->near_depth);
    int past_far = truth_compare_depth(&s->line, &hit, camera->forward, camera->eye, camera->far_depth);
    if (past_near < 0 || past_far > 0)
        return;
    if (order < 0)
        replace_hit(s, &hit, past_near && past_far ? TRUTH_NO_TIE : TRUTH_EYE_PLANE);
    else
        share_hit(s, &hit);
}

static void look(sight *s, const truth_scene *scene, int32_t x, int32_t y, const truth_triangle *likely)
{
    bvh_walk walk;
    uint32_t first, count;
    s->scene = scene;
    s->found = 0;
    s->reason = TRUTH_NO_TIE;
    truth_eye_line(&s->line, &scene->view, x, y);
    if (likely)
        see(s, likely);
    double least = scene->view.camera.projection == GN_PERSPECTIVE ? 0 : -EVERYWHERE;
    bvh_start(&walk, &scene->tree, &s->line, least, EVERYWHERE);
    for (;;) {
        if (s->found)
            walk.most = s->hit.s.value + 1.001 * s->hit.s.error;
        if (!bvh_next(&walk, &first, &count))
            return;
        for (uint32_t i = 0; i < count; i++)
            see(s, &scene->triangles[first + i]);
    }
}

/* ---- what is in the way of light ------------------------------------------------------------------------------- */

typedef struct passage {
    const truth_scene *scene;
    truth_point *point;
    truth_line line;
    int32_t axis[3]; /* spot, point: w is along it */
    int blocked;     /* by a triangle that is no tie */
    int tie_blocks;  /* a tie that the rule settles so */
    truth_reason reason;
} passage;

/* An edge in the way: does the line pass inside after its point has been moved a little? */
static int moved_line_meets(const passage *p, const truth_triangle *triangle, const int signs[3])
{
    int sum = 0;
    for (int i = 0; i < 3; i++)
        sum += signs[i] ? signs[i] : truth_moved_edge_sign(&p->line, triangle, i);
    return sum == 3 || sum == -3;
}

/* Beyond the light's near plane? 0: on it, which counts as beyond. */
static int side_of_near(passage *p, const truth_hit *hit)
{
    const gn_light *light = &p->scene->view.light;
    if (p->scene->view.light_kind == TRUTH_DIRECTIONAL)
        return 1;
    return truth_compare_depth(&p->line, hit, p->axis, light->position, light->near_depth);
}

static void obstruct(passage *p, const truth_triangle *triangle)
{
    int signs[3];
    if (triangle == p->point->hit.triangle)
        return;
    truth_meeting meeting = truth_line_meets(&p->line, triangle, signs);
    if (meeting == TRUTH_MISSES)
        return;
    if (meeting == TRUTH_WITHIN) {
        if (truth_passes_within(&p->line, triangle))
            note_tie(&p->reason, TRUTH_SHADOW_WITHIN);
        return;
    }
    truth_hit hit = truth_make_hit(&p->line, triangle, signs);
    int before_point = hit.side * truth_side_of_point(p->point, triangle);
    if (before_point == 0)
        note_tie(&p->reason, TRUTH_SHADOW_TOUCH);
    int side = before_point > 0 ? side_of_near(p, &hit) : -1;
    if (side < 0)
        return;
    if (side > 0 && meeting == TRUTH_MEETS) {
        p->blocked = 1;
        return;
    }
    note_tie(&p->reason, meeting == TRUTH_TOUCHES ? TRUTH_SHADOW_EDGE : TRUTH_SHADOW_NEAR);
    p->tie_blocks |= meeting == TRUTH_MEETS || moved_line_meets(p, triangle, signs);
}

static void search_way(passage *p, truth_memory *memory)
{
    bvh_walk walk;
    uint32_t first, count;
    int directional = p->scene->view.light_kind == TRUTH_DIRECTIONAL;
    truth_light_line(&p->line, p->point);
    if (memory->blocker)
        obstruct(p, memory->blocker);
    bvh_start(&walk, &p->scene->tree, &p->line, directional ? -EVERYWHERE : 0, directional ? 0 : 1);
    while (!p->blocked && bvh_next(&walk, &first, &count))
        for (uint32_t i = 0; i < count && !p->blocked; i++) {
            obstruct(p, &p->scene->triangles[first + i]);
            if (p->blocked)
                memory->blocker = &p->scene->triangles[first + i];
        }
    memory->exact_decisions += p->line.exact_decisions;
}

/* The axis of the face of a point light's cube that the point is behind, as unit vector. */
static void choose_face(passage *p)
{
    int negative, axis = truth_farthest_axis(p->point, p->scene->view.light.position, &negative);
    for (int k = 0; k < 3; k++)
        p->axis[k] = k != axis ? 0 : negative ? -(1 << 30) : 1 << 30;
}

/* Is the point in the light's frustum? -1: outside, 0: on its boundary, which counts as inside. */
static int side_of_frustum(passage *p)
{
    const truth_scene *scene = p->scene;
    const gn_light *light = &scene->view.light;
    truth_plane planes[TRUTH_MOST_PLANES];
    int count = scene->plane_count, least = 1;
    for (int i = 0; i < count; i++)
        planes[i] = scene->planes[i];
    for (int k = 0; k < 3; k++)
        p->axis[k] = light->forward[k];
    if (scene->view.light_kind == TRUTH_POINT) {
        choose_face(p);
        count = 2;
        for (int k = 0; k < 3; k++) {
            planes[0].normal[k] = p->axis[k];
            planes[1].normal[k] = -(int64_t)p->axis[k];
        }
        planes[0].offset = (int64_t)light->near_depth * (1 << 30);
        planes[1].offset = (int64_t)light->far_depth * -(1 << 30);
    }
    for (int i = 0; i < count && least >= 0; i++) {
        int side = truth_side_of_plane(p->point, &planes[i], light->position);
        least = side < least ? side : least;
    }
    return least;
}

static void backwards(int32_t out[3], const int32_t v[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = -v[k];
}

/* 1: camera and light are on the same side of the triangle, -1: they are not, 0: the light is in its plane. */
static int facing(const truth_view *view, const truth_triangle *triangle)
{
    int32_t to_camera[3], to_light[3];
    backwards(to_camera, view->camera.forward);
    backwards(to_light, view->light.forward);
    int camera = view->camera.projection == GN_PERSPECTIVE ? truth_side_of_place(triangle, view->camera.eye)
                                                           : truth_side_of_direction(triangle, to_camera);
    int light = view->light_kind == TRUTH_DIRECTIONAL ? truth_side_of_direction(triangle, to_light)
                                                      : truth_side_of_place(triangle, view->light.position);
    return camera * light;
}

static int is_lit(const truth_scene *scene, truth_point *point, truth_reason *reason, truth_memory *memory)
{
    passage p = {.scene = scene, .point = point};
    int side = facing(&scene->view, point->hit.triangle);
    int frustum = side < 0 ? -1 : side_of_frustum(&p);
    if (side < 0 || frustum < 0)
        return 0;
    search_way(&p, memory);
    if (p.blocked)
        return 0;
    /* Only here do ties matter: with something in the way nothing else could make it light. */
    if (side == 0)
        note_tie(reason, TRUTH_LIGHT_SIDE);
    if (frustum == 0)
        note_tie(reason, TRUTH_LIGHT_FRUSTUM);
    note_tie(reason, p.reason);
    return side > 0 && !p.tie_blocks;
}

truth_answer truth_trace(const truth_scene *scene, int32_t x, int32_t y, truth_memory *memory)
{
    sight s;
    truth_point point;
    look(&s, scene, x, y, memory->surface);
    truth_answer answer = {TRUTH_NO_SURFACE, s.reason};
    memory->surface = 0;
    if (s.found) {
        memory->surface = s.hit.triangle;
        truth_hit_point(&point, &s.line, &s.hit);
        answer.mask = is_lit(scene, &point, &answer.reason, memory) ? TRUTH_LIT : TRUTH_SHADOWED;
    }
    memory->exact_decisions += s.line.exact_decisions;
    return answer;
}
