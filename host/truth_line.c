/* Bits of the exact numbers. Corners are below 2^24, edges b below 2^25, normals N below 2^51 (checked: 2^51 + 1 at
 * most), eyes and lights below 2^27, axes below 2^31, images up to 4096 x 4096, tangents up to 2^30, x and y of a line
 * from the centre of the image below 2^19 (1/256 pixels). A line is (O + s D) / q:
 *
 *                      O               q           D
 *     perspective eye  2^27            1           2^81     128 H 2^24 forward + tan x right + tan y up
 *     orthographic eye 2^78            2^49        2^31     q eye + half_height (x right + y up), forward
 *     directional      2^158           2^134       2^31     the point's numerator and denominator, forward
 *     spot, point      2^27            1           2^162    light, point - light times the denominator
 *
 *     edge function    e = D . ((q V - O) x b)               3 x 2 x 2^81+28+25, 2^31+78+25, 2^31+159+25, 2^162+28+25
 *                                                            < 2^218
 *     hit              s = n / d, n = N . (q V - O), d = N . D
 *                      perspective n < 2^81, d < 2^134; orthographic n < 2^131, d < 2^84
 *     point            (d O + n D) / (q d): a point of the triangle: numerator < 2^158 (its summands < 2^163)
 *     order of hits    n d'                                  < 2^216
 *     depth of a hit   (axis . (O - q E)) d + n (axis . D) against depth 2^30 q d; light: n < 2^81, axis . D < 2^195
 *                                                            < 2^277
 *     frustum planes   normal (point - light)                3 x 2^61+162 < 2^225
 *     within a plane   (N x D) . (q V - O), D . (point - V)  < 2^245, < 2^323
 *
 * Errors of the doubles. u = 2^-53. Fused multiply-adds leave out a rounding that the bounds count, and so only help;
 * underflow is far below every bound. Normals are exact (integers below 2^53). An edge function with
 * a = V - origin, |a| <= R, |b| <= B, is d . (a x b): a is wrong by origin_error + u R, a component of the product by
 * 2 B (origin_error + 4 u R), and with 4 roundings of the sum
 *
 *     |error| <= 2 B (|d|_1 (origin_error + 8 u R) + 3 R direction_error)
 *
 * where one of the two errors is always 0, so that they have no product; we take 16 for 8, for what is of second
 * order. All other questions carry their errors along (struct approximate); an operation adds 2 u of its result, half
 * of it for the rounding of the errors themselves, and a sign is believed from 1.001 errors on.
 */
#include "truth_line.h"

#include <math.h>
#include <string.h>

#define UNIT 1.1102230246251565e-16 /* 2^-53: half the distance between doubles at 1 */

/* ---- doubles that know their error ----------------------------------------------------------------------------- */

static approximate exactly(double value)
{
    return (approximate){value, 0};
}

static approximate add(approximate a, approximate b)
{
    double value = a.value + b.value;
    return (approximate){value, a.error + b.error + 2 * UNIT * fabs(value)};
}

static approximate subtract(approximate a, approximate b)
{
    return add(a, (approximate){-b.value, b.error});
}

static approximate multiply(approximate a, approximate b)
{
    double value = a.value * b.value;
    return (approximate){value, fabs(a.value) * b.error + fabs(b.value) * a.error + a.error * b.error +
                                    4 * UNIT * fabs(value)};
}

/* Where b may be 0 the result may be anything. */
static approximate divide(approximate a, approximate b)
{
    double least = fabs(b.value) - 1.001 * b.error;
    if (!(least > 0))
        return (approximate){0, HUGE_VAL};
    double value = a.value / b.value;
    return (approximate){value, (a.error + fabs(value) * b.error) / least * 1.001 + 4 * UNIT * fabs(value)};
}

static approximate dot(const approximate a[3], const approximate b[3])
{
    return add(add(multiply(a[0], b[0]), multiply(a[1], b[1])), multiply(a[2], b[2]));
}

/* 0: cannot say. */
static int believed_sign(const truth_view *view, approximate a)
{
    if (view->exact_only || !(fabs(a.value) > 1.001 * a.error))
        return 0;
    return a.value < 0 ? -1 : 1;
}

/* ---- vectors --------------------------------------------------------------------------------------------------- */

void truth_normal(const truth_triangle *triangle, int64_t normal[3])
{
    int64_t a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = (int64_t)triangle->corner[1][k] - triangle->corner[0][k];
        b[k] = (int64_t)triangle->corner[2][k] - triangle->corner[0][k];
    }
    for (int k = 0; k < 3; k++)
        normal[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static void approximate_normal(const truth_triangle *triangle, approximate normal[3])
{
    int64_t exact[3];
    truth_normal(triangle, exact);
    for (int k = 0; k < 3; k++)
        normal[k] = exactly((double)exact[k]);
}

static void wide_normal(const truth_triangle *triangle, wide normal[3])
{
    int64_t exact[3];
    truth_normal(triangle, exact);
    for (int k = 0; k < 3; k++)
        normal[k] = wide_of(exact[k]);
}

static void wide_vector(wide out[3], const int32_t v[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = wide_of(v[k]);
}

static void wide_cross(wide out[3], const wide a[3], const wide b[3])
{
    for (int k = 0; k < 3; k++)
        out[k] =
            wide_subtract(wide_multiply(a[(k + 1) % 3], b[(k + 2) % 3]), wide_multiply(a[(k + 2) % 3], b[(k + 1) % 3]));
}

/* divisor place - origin */
static void wide_from(wide out[3], const int32_t place[3], const wide origin[3], wide divisor)
{
    for (int k = 0; k < 3; k++)
        out[k] = wide_subtract(wide_multiply(divisor, wide_of(place[k])), origin[k]);
}

static double largest_of(const double v[3])
{
    return fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
}

/* ---- lines: double precision ----------------------------------------------------------------------------------- */

static void finish_line(truth_line *line)
{
    double reach = line->view->reach + largest_of(line->origin);
    double length = fabs(line->direction[0]) + fabs(line->direction[1]) + fabs(line->direction[2]);
    line->edge_error = 2.02 * (length * (line->origin_error + 16 * UNIT * reach) + 3 * reach * line->direction_error);
    line->has_exact = 0;
    line->exact_decisions = 0;
}

/* x right + y up, each component wrong by at most 8 u (|x| + |y| + the largest of start) once start is added: x and y
 * have one rounding each, the products one, the sums two. */
static double place_in_image(double out[3], const double start[3], const gn_camera *camera, double x, double y)
{
    for (int k = 0; k < 3; k++)
        out[k] = start[k] + (x * ldexp(camera->right[k], -30) + y * ldexp(camera->up[k], -30));
    return 8 * UNIT * (fabs(x) + fabs(y) + largest_of(start));
}

void truth_eye_line(truth_line *line, const truth_view *view, int32_t x, int32_t y)
{
    const gn_camera *camera = &view->camera;
    /* Whole numbers: exact, up to the division. */
    double right = (double)x - 128.0 * view->width, up = 128.0 * view->height - (double)y,
           height = 128.0 * view->height;
    double eye[3], forward[3];
    line->view = view;
    line->x = x;
    line->y = y;
    line->point = 0;
    for (int k = 0; k < 3; k++) {
        eye[k] = camera->eye[k];
        forward[k] = camera->forward[k] * (1 / 1073741824.0);
    }
    if (camera->projection == GN_PERSPECTIVE) {
        double tangent = camera->tan_half * (1 / 16777216.0);
        memcpy(line->origin, eye, sizeof eye);
        line->origin_error = 0;
        line->direction_error =
            place_in_image(line->direction, forward, camera, right * tangent / height, up * tangent / height);
    } else {
        memcpy(line->direction, forward, sizeof forward);
        line->direction_error = 0;
        line->origin_error = place_in_image(line->origin, eye, camera, right * camera->half_height / height,
                                            up * camera->half_height / height);
    }
    finish_line(line);
}

void truth_light_line(truth_line *line, truth_point *point)
{
    const truth_view *view = point->eye->view;
    const gn_light *light = &view->light;
    line->view = view;
    line->point = point;
    line->x = point->eye->x;
    line->y = point->eye->y;
    line->origin_error = line->direction_error = 0;
    for (int k = 0; k < 3; k++)
        if (view->light_kind == TRUTH_DIRECTIONAL) {
            line->origin[k] = point->at[k];
            line->direction[k] = light->forward[k] * (1 / 1073741824.0);
            line->origin_error = point->error;
        } else {
            line->origin[k] = light->position[k];
            line->direction[k] = point->at[k] - light->position[k];
            line->direction_error = fmax(line->direction_error, point->error + 2 * UNIT * fabs(line->direction[k]));
        }
    finish_line(line);
}

/* ---- lines: exact ---------------------------------------------------------------------------------------------- */

static void exact_eye_line(truth_line *line)
{
    const truth_view *view = line->view;
    const gn_camera *camera = &view->camera;
    exact_line *exact = &line->exact;
    int perspective = camera->projection == GN_PERSPECTIVE;
    int64_t scale = perspective ? (int64_t)camera->tan_half : camera->half_height;
    wide right = wide_of(((int64_t)line->x - 128 * (int64_t)view->width) * scale);
    wide up = wide_of((128 * (int64_t)view->height - line->y) * scale);
    wide height = wide_of(128 * (int64_t)view->height * (perspective ? 1 << 24 : 1 << 30));
    exact->divisor = perspective ? wide_of(1) : height;
    for (int k = 0; k < 3; k++) {
        wide forward = wide_of(camera->forward[k]), eye = wide_of(camera->eye[k]);
        wide offset =
            wide_add(wide_multiply(right, wide_of(camera->right[k])), wide_multiply(up, wide_of(camera->up[k])));
        exact->origin[k] = perspective ? eye : wide_add(wide_multiply(height, eye), offset);
        exact->direction[k] = perspective ? wide_add(wide_multiply(height, forward), offset) : forward;
    }
}

static void exact_point(truth_point *point);

static void exact_light_line(truth_line *line)
{
    const gn_light *light = &line->view->light;
    truth_point *point = line->point;
    exact_line *exact = &line->exact;
    exact_point(point);
    int directional = line->view->light_kind == TRUTH_DIRECTIONAL;
    exact->divisor = directional ? point->denominator : wide_of(1);
    for (int k = 0; k < 3; k++) {
        wide from_light =
            wide_subtract(point->numerator[k], wide_multiply(wide_of(light->position[k]), point->denominator));
        exact->origin[k] = directional ? point->numerator[k] : wide_of(light->position[k]);
        exact->direction[k] = directional ? wide_of(light->forward[k]) : from_light;
    }
}

static const exact_line *exactly_line(truth_line *line)
{
    line->exact_decisions++;
    if (!line->has_exact) {
        if (line->point)
            exact_light_line(line);
        else
            exact_eye_line(line);
        line->has_exact = 1;
    }
    return &line->exact;
}

/* ---- edges ----------------------------------------------------------------------------------------------------- */

static int exact_edge_sign(const exact_line *line, const int32_t from[3], const int32_t to[3])
{
    wide a[3], b[3], cross[3];
    wide_from(a, from, line->origin, line->divisor);
    for (int k = 0; k < 3; k++)
        b[k] = wide_of((int64_t)to[k] - from[k]);
    wide_cross(cross, b, line->direction); /* d . (a x b) = a . (b x d) */
    return wide_dot(a, cross).sign;
}

/* d . ((from - origin) x (to - from)) */
static double edge_function(const truth_line *line, const int32_t from[3], const int32_t to[3])
{
    double a0 = from[0] - line->origin[0], a1 = from[1] - line->origin[1], a2 = from[2] - line->origin[2];
    double b0 = (double)(to[0] - from[0]), b1 = (double)(to[1] - from[1]), b2 = (double)(to[2] - from[2]);
    return line->direction[0] * (a1 * b2 - a2 * b1) + line->direction[1] * (a2 * b0 - a0 * b2) +
           line->direction[2] * (a0 * b1 - a1 * b0);
}

static truth_meeting meeting_of(const int signs[3])
{
    int least = signs[0], most = signs[0];
    for (int i = 1; i < 3; i++) {
        least = signs[i] < least ? signs[i] : least;
        most = signs[i] > most ? signs[i] : most;
    }
    if (least < 0 && most > 0)
        return TRUTH_MISSES;
    if (least == 0 && most == 0)
        return TRUTH_WITHIN;
    return least == most ? TRUTH_MEETS : TRUTH_TOUCHES;
}

truth_meeting truth_line_meets(truth_line *line, const truth_triangle *triangle, int signs[3])
{
    const int32_t(*v)[3] = triangle->corner;
    double e[3], error = line->view->exact_only ? HUGE_VAL : line->edge_error * (double)triangle->extent;
    for (int i = 0; i < 3; i++)
        e[i] = edge_function(line, v[i], v[(i + 1) % 3]);
    int above = (e[0] > error) + (e[1] > error) + (e[2] > error);
    int below = (e[0] < -error) + (e[1] < -error) + (e[2] < -error);
    if (above && below)
        return TRUTH_MISSES;
    for (int i = 0; i < 3; i++)
        signs[i] = e[i] > error ? 1 : e[i] < -error ? -1 : exact_edge_sign(exactly_line(line), v[i], v[(i + 1) % 3]);
    return meeting_of(signs);
}

int truth_moved_edge_sign(const truth_line *line, const truth_triangle *triangle, int edge)
{
    const gn_light *light = &line->view->light;
    const int32_t *from = triangle->corner[edge], *to = triangle->corner[(edge + 1) % 3];
    int directional = line->view->light_kind == TRUTH_DIRECTIONAL;
    int64_t a[3], b[3];
    /* The derivative of d . (a x b) by the point: a moves against it, or d with it. */
    for (int k = 0; k < 3; k++) {
        b[k] = (int64_t)to[k] - from[k];
        a[k] = directional ? light->forward[k] : (int64_t)from[k] - light->position[k];
    }
    for (int k = 0; k < 3; k++) {
        int64_t slope = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
        if (slope)
            return slope < 0 ? -1 : 1;
    }
    return 0;
}

/* ---- hits ------------------------------------------------------------------------------------------------------ */

truth_hit truth_make_hit(truth_line *line, const truth_triangle *triangle, const int signs[3])
{
    approximate normal[3], from[3], direction[3];
    truth_hit hit = {.triangle = triangle, .touches = !signs[0] || !signs[1] || !signs[2]};
    for (int i = 0; i < 3; i++)
        hit.side = signs[i] ? signs[i] : hit.side;
    approximate_normal(triangle, normal);
    for (int k = 0; k < 3; k++) {
        from[k] = subtract(exactly(triangle->corner[0][k]), (approximate){line->origin[k], line->origin_error});
        direction[k] = (approximate){line->direction[k], line->direction_error};
    }
    hit.s = divide(dot(normal, from), dot(normal, direction));
    return hit;
}

/* s = numerator / denominator, denominator > 0; the line's divisor left out. */
static void exact_hit(truth_line *line, const truth_triangle *triangle, wide *numerator, wide *denominator)
{
    const exact_line *exact = exactly_line(line);
    wide normal[3], from[3];
    wide_normal(triangle, normal);
    wide_from(from, triangle->corner[0], exact->origin, exact->divisor);
    *numerator = wide_dot(normal, from);
    *denominator = wide_dot(normal, exact->direction);
    if (denominator->sign < 0) {
        *numerator = wide_negate(*numerator);
        *denominator = wide_negate(*denominator);
    }
}

int truth_compare_hits(truth_line *line, const truth_hit *a, const truth_hit *b)
{
    wide a_numerator, a_denominator, b_numerator, b_denominator;
    int sign = believed_sign(line->view, subtract(a->s, b->s));
    if (sign)
        return sign;
    exact_hit(line, a->triangle, &a_numerator, &a_denominator);
    exact_hit(line, b->triangle, &b_numerator, &b_denominator);
    return wide_compare(wide_multiply(a_numerator, b_denominator), wide_multiply(b_numerator, a_denominator));
}

static int exact_compare_depth(truth_line *line, const truth_hit *hit, const int32_t axis[3], const int32_t from[3],
                               int32_t depth)
{
    const exact_line *exact = exactly_line(line);
    wide numerator, denominator, axes[3], start[3];
    exact_hit(line, hit->triangle, &numerator, &denominator);
    wide_vector(axes, axis);
    wide_from(start, from, exact->origin, exact->divisor); /* its negative */
    wide left = wide_subtract(wide_multiply(numerator, wide_dot(axes, exact->direction)),
                              wide_multiply(wide_dot(axes, start), denominator));
    wide right = wide_multiply(wide_of((int64_t)depth * (1 << 30)), wide_multiply(exact->divisor, denominator));
    return wide_compare(left, right);
}

int truth_compare_depth(truth_line *line, const truth_hit *hit, const int32_t axis[3], const int32_t from[3],
                        int32_t depth)
{
    approximate axes[3], start[3], direction[3];
    for (int k = 0; k < 3; k++) {
        axes[k] = exactly(axis[k]);
        start[k] = subtract((approximate){line->origin[k], line->origin_error}, exactly(from[k]));
        direction[k] = (approximate){line->direction[k], line->direction_error};
    }
    approximate w = add(dot(axes, start), multiply(hit->s, dot(axes, direction)));
    int sign = believed_sign(line->view, subtract(w, exactly((double)depth * 1073741824.0)));
    return sign ? sign : exact_compare_depth(line, hit, axis, from, depth);
}

/* ---- sides of a place ------------------------------------------------------------------------------------------ */

/* normal . v, |v| < 2^31: doubles where they suffice. */
static int sign_along_normal(const truth_triangle *triangle, const int64_t v[3])
{
    int64_t normal[3];
    double sum = 0, magnitude = 0;
    truth_normal(triangle, normal);
    for (int k = 0; k < 3; k++) {
        double product = (double)normal[k] * (double)v[k];
        sum += product;
        magnitude += fabs(product);
    }
    if (fabs(sum) > 8 * UNIT * magnitude)
        return sum < 0 ? -1 : 1;
    wide total = wide_of(0);
    for (int k = 0; k < 3; k++)
        total = wide_add(total, wide_multiply(wide_of(normal[k]), wide_of(v[k])));
    return total.sign;
}

int truth_side_of_place(const truth_triangle *triangle, const int32_t position[3])
{
    int64_t v[3];
    for (int k = 0; k < 3; k++)
        v[k] = (int64_t)position[k] - triangle->corner[0][k];
    return sign_along_normal(triangle, v);
}

int truth_side_of_direction(const truth_triangle *triangle, const int32_t direction[3])
{
    int64_t v[3] = {direction[0], direction[1], direction[2]};
    return sign_along_normal(triangle, v);
}

/* ---- points ---------------------------------------------------------------------------------------------------- */

static void exact_point(truth_point *point)
{
    wide s, denominator;
    if (point->has_exact)
        return;
    point->has_exact = 1;
    exact_hit(point->eye, point->hit.triangle, &s, &denominator);
    const exact_line *line = &point->eye->exact;
    for (int k = 0; k < 3; k++)
        point->numerator[k] =
            wide_add(wide_multiply(line->origin[k], denominator), wide_multiply(line->direction[k], s));
    point->denominator = wide_multiply(line->divisor, denominator);
}

/* Grazing eye rays: their points are badly known along the ray, so that too much would be left to exact arithmetic. */
static void sharpen(truth_point *point)
{
    exact_point(point);
    double denominator = wide_to_double(point->denominator), largest = 0;
    for (int k = 0; k < 3; k++) {
        point->at[k] = wide_to_double(point->numerator[k]) / denominator;
        largest = fmax(largest, fabs(point->at[k]));
    }
    point->error = 64 * UNIT * largest;
}

void truth_hit_point(truth_point *point, truth_line *eye, const truth_hit *hit)
{
    static const double sharp_enough = 0x1p-12; /* world units: 2^-36 of the scene */
    point->eye = eye;
    point->hit = *hit;
    point->has_exact = 0;
    point->error = 0;
    for (int k = 0; k < 3; k++) {
        approximate direction = {eye->direction[k], eye->direction_error};
        approximate at = add((approximate){eye->origin[k], eye->origin_error}, multiply(hit->s, direction));
        point->at[k] = at.value;
        point->error = fmax(point->error, 1.001 * at.error);
    }
    if (!(point->error < sharp_enough))
        sharpen(point);
}

static void approximate_offset(const truth_point *point, const int32_t from[3], approximate out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = subtract((approximate){point->at[k], point->error}, exactly(from[k]));
}

/* (point - from) denominator */
static void wide_offset(truth_point *point, const int32_t from[3], wide out[3])
{
    point->eye->exact_decisions++;
    exact_point(point);
    for (int k = 0; k < 3; k++)
        out[k] = wide_subtract(point->numerator[k], wide_multiply(wide_of(from[k]), point->denominator));
}

int truth_side_of_point(truth_point *point, const truth_triangle *triangle)
{
    approximate normal[3], offset[3];
    approximate_normal(triangle, normal);
    approximate_offset(point, triangle->corner[0], offset);
    int sign = believed_sign(point->eye->view, dot(normal, offset));
    if (sign)
        return sign;
    wide wide_normals[3], wide_offsets[3];
    wide_normal(triangle, wide_normals);
    wide_offset(point, triangle->corner[0], wide_offsets);
    return wide_dot(wide_normals, wide_offsets).sign;
}

int truth_side_of_plane(truth_point *point, const truth_plane *plane, const int32_t from[3])
{
    approximate normal[3], offset[3];
    for (int k = 0; k < 3; k++) /* up to 61 bits: rounded */
        normal[k] = multiply(exactly((double)plane->normal[k]), exactly(1));
    approximate_offset(point, from, offset);
    int sign = believed_sign(point->eye->view, subtract(dot(normal, offset), exactly((double)plane->offset)));
    if (sign)
        return sign;
    wide normals[3], offsets[3];
    for (int k = 0; k < 3; k++)
        normals[k] = wide_of(plane->normal[k]);
    wide_offset(point, from, offsets);
    return wide_compare(wide_dot(normals, offsets), wide_multiply(wide_of(plane->offset), point->denominator));
}

int truth_farthest_axis(truth_point *point, const int32_t from[3], int *negative)
{
    approximate offset[3], distance[3];
    wide offsets[3];
    int farthest = 0, has_wide = 0;
    approximate_offset(point, from, offset);
    for (int k = 0; k < 3; k++)
        distance[k] = (approximate){fabs(offset[k].value), offset[k].error};
    for (int k = 1; k < 3; k++) {
        int sign = believed_sign(point->eye->view, subtract(distance[k], distance[farthest]));
        if (!sign && !has_wide) {
            wide_offset(point, from, offsets);
            has_wide = 1;
        }
        if (!sign) {
            wide a = offsets[k], b = offsets[farthest];
            a.sign *= a.sign;
            b.sign *= b.sign;
            sign = wide_compare(a, b);
        }
        if (sign > 0)
            farthest = k;
    }
    int sign = believed_sign(point->eye->view, offset[farthest]);
    if (!sign) {
        wide_offset(point, from, offsets);
        sign = offsets[farthest].sign;
    }
    *negative = sign < 0;
    return farthest;
}

/* ---- lines within a plane -------------------------------------------------------------------------------------- */

int truth_passes_within(truth_line *line, const truth_triangle *triangle)
{
    const exact_line *exact = exactly_line(line);
    wide normal[3], across[3], from_origin[3], to_point[3];
    int left = 0, right = 0, past_light = 0, before_point = 0;
    wide_normal(triangle, normal);
    wide_cross(across, normal, exact->direction);
    for (int i = 0; i < 3; i++) {
        wide_from(from_origin, triangle->corner[i], exact->origin, exact->divisor);
        wide_offset(line->point, triangle->corner[i], to_point);
        int side = wide_dot(across, from_origin).sign;
        left |= side <= 0;
        right |= side >= 0;
        past_light |= wide_dot(exact->direction, from_origin).sign > 0;
        before_point |= wide_dot(exact->direction, to_point).sign >= 0;
    }
    if (line->view->light_kind == TRUTH_DIRECTIONAL)
        past_light = 1; /* it is infinitely far away */
    return left && right && past_light && before_point;
}
