#include "warp_report.h"

#include <math.h>

/* The plane's area, in its longer side. */
static double plane_area(const gn_light *light)
{
    if (light->kind != GN_DIRECTIONAL)
        return 1;
    double width = light->box_width, height = light->box_height;
    return width < height ? width / height : height / width;
}

/* Take two neighbours into account; `count` texels share the side that they lie along. */
static void look_at(double magnification[2], const uint32_t a[2], const uint32_t b[2], uint32_t count)
{
    double across = (double)b[0] - a[0], down = (double)b[1] - a[1];
    double times = ldexp(1.0 / count, 32) / hypot(across, down);
    magnification[0] = fmin(magnification[0], times);
    magnification[1] = fmax(magnification[1], times);
}

warp_report warp_report_make(const gn_rectangle *rectangle, const gn_light *light, uint32_t (*places)[2],
                             uint32_t columns, uint32_t rows)
{
    double size[2] = {ldexp(rectangle->size[0], -30), ldexp(rectangle->size[1], -30)};
    double degrees = 180 / acos(-1);
    warp_report report = {
        .share = size[0] * size[1] / plane_area(light),
        .angle = degrees * atan2(rectangle->sine, rectangle->cosine),
        .columns = {columns > 1 ? HUGE_VAL : 1, columns > 1 ? 0 : 1},
        .rows = {rows > 1 ? HUGE_VAL : 1, rows > 1 ? 0 : 1},
    };
    for (uint32_t row = 0; row < rows; row++)
        for (uint32_t column = 0; column < columns; column++) {
            uint32_t(*here)[2] = places + (size_t)row * columns + column;
            if (column + 1 < columns)
                look_at(report.columns, here[0], here[1], columns);
            if (row + 1 < rows)
                look_at(report.rows, here[0], here[columns], rows);
        }
    return report;
}
