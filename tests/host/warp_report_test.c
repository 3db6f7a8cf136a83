/* What is said of a fit and a warp, against figures worked out by hand. */
#include "core/tap.h"
#include "warp_report.h"

#include <math.h>

enum { UNIT = 1 << 30 };

static int is(double got, double expected)
{
    int good = fabs(got - expected) <= 1e-6 * fabs(expected);
    if (!good)
        note("got %.9g, expected %.9g", got, expected);
    return good;
}

static void the_rectangle(void)
{
    const gn_light box = {.kind = GN_DIRECTIONAL, .box_width = 1000, .box_height = 500}, spot = {.kind = GN_SPOT};
    /* cosine 1/2, sine of 60 degrees */
    const gn_rectangle r = {UNIT / 2, 929887697, {0, 0}, {UNIT / 2, UNIT / 4}};
    const gn_rectangle back = {UNIT / 2, -929887697, {0, 0}, {UNIT / 2, UNIT / 4}};
    uint32_t place[1][2] = {{5, 7}};
    warp_report of_box = warp_report_make(&r, &box, place, 1, 1), of_spot = warp_report_make(&back, &spot, place, 1, 1);
    ok(is(of_box.share, 0.25), "the_share_of_a_box_is_of_its_area"); /* 1/2 x 1/4 of 1 x 1/2 */
    ok(is(of_spot.share, 0.125), "the_share_of_a_frustum_is_of_a_square");
    ok(is(of_box.angle, 60) && is(of_spot.angle, -60), "the_angle_is_in_degrees_and_has_a_sign");
    ok(is(of_box.columns[0], 1) && is(of_box.columns[1], 1) && is(of_box.rows[0], 1) && is(of_box.rows[1], 1),
       "one_texel_is_as_large_as_it_is");
}

static void magnifications(void)
{
    const gn_light spot = {.kind = GN_SPOT};
    const gn_rectangle r = {UNIT, 0, {0, 0}, {UNIT / 2, UNIT / 2}};
    /* columns at 1/8, 2/8 and 7/8, a third would lie between two neighbours; rows at 1/4 and 3/4 as in a uniform map */
    uint32_t places[6][2];
    for (uint32_t i = 0; i < 6; i++) {
        static const uint32_t eighths[3] = {1, 2, 7};
        places[i][0] = eighths[i % 3] << 29;
        places[i][1] = i / 3 ? 3u << 30 : 1u << 30;
    }
    warp_report report = warp_report_make(&r, &spot, places, 3, 2);
    ok(is(report.columns[0], 8.0 / 15) && is(report.columns[1], 8.0 / 3),
       "columns_are_magnified_as_they_lie_closer_than_thirds");
    ok(is(report.rows[0], 1) && is(report.rows[1], 1), "rows_of_one_height_are_not_magnified");
    places[5][1] = 0xa0000000u; /* the last of the second row moves up to 5/8: 3/8 from the one above */
    report = warp_report_make(&r, &spot, places, 3, 2);
    ok(is(report.rows[0], 1) && is(report.rows[1], 4.0 / 3), "each_column_has_rows_of_its_own");
}

int main(void)
{
    the_rectangle();
    magnifications();
    return tap_done();
}
