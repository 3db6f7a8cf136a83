/* From meshes to vertices on a view: model matrix, view, projection; and the fit of a directional light. */
#include "gn_context.h"

gn_status gn_world_position(const gn_object *object, uint32_t vertex, int32_t world[3])
{
    const int32_t *v = object->mesh->vertices[vertex];
    const gn_model *model = object->model;
    if (!model) {
        for (int i = 0; i < 3; i++)
            world[i] = v[i];
        return GN_OK;
    }
    gn_status status = GN_OK;
    int64_t half = model->shift ? (int64_t)1 << (model->shift - 1) : 0;
    for (int i = 0; i < 3; i++) {
        int64_t sum = gn_multiply(model->m[i][0], v[0]) + gn_multiply(model->m[i][1], v[1]) +
                      gn_multiply(model->m[i][2], v[2]) + half;
        sum = gn_floor_shift_64(sum, model->shift) + model->t[i];
        if (sum < -GN_WORLD_MAX || sum > GN_WORLD_MAX) {
            status = GN_OUT_OF_RANGE;
            sum = 0;
        }
        world[i] = (int32_t)sum;
    }
    return status;
}

int gn_mirrors(const gn_model *model)
{
    int64_t m[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            m[i][j] = gn_floor_shift(model->m[i][j], 11); /* 20 bits: the determinant fits 64 */
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) <
           0;
}

gn_status gn_transform_scene(gn_context *context, const gn_view *view, int32_t *largest_w, int *inside)
{
    int32_t right = 2 * view->half_width, bottom = 2 * view->half_height;
    *largest_w = 0;
    *inside = 1;
    for (uint32_t i = 0; i < context->scene->object_count; i++) {
        const gn_object *object = &context->scene->objects[i];
        gn_object_state *state = &context->objects[i];
        gn_vertex *vertex = context->vertices + state->first_vertex;
        state->mirrored = (uint8_t)(object->model && gn_mirrors(object->model));
        state->clips = 0;
        for (uint32_t v = 0; v < object->mesh->vertex_count; v++, vertex++) {
            int32_t world[3];
            gn_place place;
            gn_status status = gn_world_position(object, v, world);
            if (status == GN_OK)
                status = gn_view_place(view, world, &place);
            if (status != GN_OK)
                return status;
            gn_view_project(view, &place, vertex);
            if (place.c[2] > *largest_w)
                *largest_w = place.c[2];
            if (vertex->depth == 0)
                state->clips = 1;
            if (vertex->depth == 0 || vertex->x < 0 || vertex->y < 0 || vertex->x >= right || vertex->y >= bottom)
                *inside = 0;
        }
    }
    return GN_OK;
}

void gn_triangle_places(const gn_view *view, const gn_object *object, const uint32_t index[3], gn_place corner[3])
{
    for (int i = 0; i < 3; i++) {
        int32_t world[3];
        (void)gn_world_position(object, index[i], world);
        (void)gn_view_place(view, world, &corner[i]);
    }
}

gn_status gn_fit_light(gn_light *light, const gn_scene *scene)
{
    if (!light || !scene)
        return GN_BAD_ARGUMENT;
    const gn_q2_30 *axis[3] = {light->right, light->up, light->forward};
    int64_t low[3] = {INT64_MAX, INT64_MAX, INT64_MAX}, high[3] = {INT64_MIN, INT64_MIN, INT64_MIN};
    for (uint32_t i = 0; i < scene->object_count; i++) {
        const gn_object *object = &scene->objects[i];
        for (uint32_t v = 0; v < object->mesh->vertex_count; v++) {
            int32_t world[3];
            gn_status status = gn_world_position(object, v, world);
            if (status != GN_OK)
                return status;
            for (int a = 0; a < 3; a++) {
                int64_t d = gn_multiply(axis[a][0], world[0]) + gn_multiply(axis[a][1], world[1]) +
                            gn_multiply(axis[a][2], world[2]);
                low[a] = d < low[a] ? d : low[a];
                high[a] = d > high[a] ? d : high[a];
            }
        }
    }
    int32_t centre2[3], size[3]; /* twice the centre, and 1.02 x the extent, world units */
    for (int a = 0; a < 3; a++) {
        if (low[a] > high[a])
            low[a] = high[a] = 0;
        int64_t extent = gn_floor_shift_64(high[a] - low[a], 30) + 1;
        centre2[a] = (int32_t)gn_floor_shift_64(low[a] + high[a], 30);
        size[a] = (int32_t)((extent * 102 + 50) / 100);
        size[a] = size[a] < 64 ? 64 : size[a];
    }
    int32_t square = size[0] > size[1] ? size[0] : size[1];
    light->box_width = light->box_height = square;
    light->box_depth = size[2];
    light->box_u = gn_floor_shift(centre2[0] - square, 1);
    light->box_v = gn_floor_shift(centre2[1] - square, 1);
    light->box_z = gn_floor_shift(centre2[2] - size[2], 1);
    return GN_OK;
}
