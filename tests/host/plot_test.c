/* Plots: the front is what its definition says, points lie where logarithms put them, names do not cover each other. */
#include "file.h"
#include "markup_reader.h"
#include "plot.h"
#include "sandbox.h"

#include <math.h>

enum { MOST = 300 };

static plot_point points[MOST];
static char names[MOST][32];
static file_content written;

/* Write it, and give the whole of what was written. */
static part draw(const plot *p)
{
    problem why;
    FILE *stream = fopen(sandbox_path("in-plot.svg"), "wb");
    plot_write(stream, p);
    fclose(stream);
    free(written.bytes);
    if (file_read(&written, sandbox_path("in-plot.svg"), &why))
        note("%s", why.text);
    return (part){(char *)written.bytes, (char *)written.bytes + written.size};
}

static double random_between(uint64_t *state, double low, double high)
{
    return low * pow(high / low, (double)(tap_random(state) >> 11) / 9007199254740992.0);
}

/* Few values, so that many are equal. */
static size_t random_points(uint64_t *state, size_t count)
{
    static const char *const chains[] = {"constant", "mixed+virtual", "silhouette msf+rectilinear", "crossing"};
    for (size_t i = 0; i < count; i++) {
        snprintf(names[i], sizeof names[i], "%s", chains[tap_random(state) % 4]);
        points[i] = (plot_point){.x = floor(random_between(state, 60, 3000)),
                                 .y = floor(random_between(state, 1, 400)) / 40,
                                 .shape = (plot_shape)(tap_random(state) % PLOT_SHAPES),
                                 .name = names[i]};
        if (tap_random(state) % 64 == 0)
            points[i].y = 0;
        if (tap_random(state) % 16 == 0)
            points[i].x = NAN;
    }
    return count;
}

static int beats(const plot_point *a, const plot_point *b)
{
    return a->x <= b->x && a->y <= b->y && (a->x < b->x || a->y < b->y);
}

/* By the definition, every pair. */
static int should_be_on_front(size_t i, size_t count)
{
    if (isnan(points[i].x))
        return 0;
    for (size_t k = 0; k < count; k++)
        if (beats(&points[k], &points[i]) || (k < i && points[k].x == points[i].x && points[k].y == points[i].y))
            return 0;
    return 1;
}

static void fronts(void)
{
    uint64_t state = 1;
    size_t front[MOST], wrong = 0, on_fronts = 0;
    for (int round = 0; round < 200; round++) {
        size_t count = random_points(&state, (size_t)(tap_random(&state) % 60));
        size_t found = plot_front(front, points, count);
        uint8_t on_front[MOST] = {0};
        for (size_t i = 0; i < found; i++) {
            on_front[front[i]] = 1;
            wrong += i && points[front[i]].x <= points[front[i - 1]].x;
        }
        for (size_t i = 0; i < count; i++)
            wrong += on_front[i] != should_be_on_front(i, count);
        on_fronts += found;
    }
    ok(wrong == 0 && on_fronts > 400, "a_front_is_what_no_point_beats_from_left_to_right");
    points[0] = (plot_point){.x = 1, .y = -1};
    points[1] = (plot_point){.x = 0, .y = 1};
    points[2] = (plot_point){.x = 1, .y = NAN};
    ok(plot_front(front, points, 3) == 0, "what_cannot_be_drawn_is_on_no_front");
}

static void numbers(void)
{
    static const struct {
        double number;
        const char *text;
    } cases[] = {{0, "0"},
                 {1, "1"},
                 {0.5, "0.5"},
                 {0.501, "0.501"},
                 {12.34, "12.3"},
                 {99.96, "100"},
                 {123.4, "123"},
                 {65535, "65535"},
                 {0.00012345, "0.000123"},
                 {0.09996, "0.1"},
                 {0.999, "0.999"},
                 {0.9996, "1"},
                 {9.996, "10"},
                 {9.99, "9.99"},
                 {100, "100"},
                 {-2.5, "-2.5"},
                 {1000000, "1000000"},
                 {0.02, "0.02"},
                 {10.04, "10"},
                 {0.0999, "0.0999"}},
      bytes[] = {{512, "512"}, {1024, "1 KiB"}, {32768, "32 KiB"}, {1536 * 1024.0, "1.5 MiB"}, {1000, "1000"}};
    int wrong = 0;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        if (strcmp(plot_number(cases[i].number).text, cases[i].text) != 0) {
            note("%.9g is %s, expected %s", cases[i].number, plot_number(cases[i].number).text, cases[i].text);
            wrong++;
        }
    wrong += *plot_number(NAN).text || *plot_number(INFINITY).text;
    ok(wrong == 0, "numbers_have_three_digits_and_no_exponent");
    for (size_t i = 0; i < sizeof bytes / sizeof *bytes; i++)
        if (strcmp(plot_bytes(bytes[i].number).text, bytes[i].text) != 0) {
            note("%.9g bytes are %s, expected %s", bytes[i].number, plot_bytes(bytes[i].number).text, bytes[i].text);
            wrong++;
        }
    ok(wrong == 0, "bytes_have_binary_units");
}

/* The i-th point of the front. */
static part front_use(part all, int i)
{
    part g = part_next(all, all.start, "<g class=\"p\"", "</g>"), use = {0, g.start};
    do
        use = part_next(g, use.end, "<use", "</use>");
    while (i-- && use.start);
    return use;
}

/* Of the text that reads so: its place on the axis; -1: there is none. */
static double tick_place(part all, const char *text, const char *coordinate)
{
    char between[64], got[64];
    for (part t = part_next(all, all.start, "<text", "</text>"); t.start;
         t = part_next(all, t.end, "<text", "</text>")) {
        part_text(t, got, sizeof got);
        if (strcmp(got, text) == 0 && !part_has((part){t.start, strchr(t.start, '>')}, "class"))
            return part_number(t, coordinate);
    }
    snprintf(between, sizeof between, "no tick reads %s", text);
    note("%s", between);
    return -1;
}

static int is_near(double a, double b)
{
    return a >= 0 && b >= 0 && fabs(a - b) <= 0.15; /* each is rounded to a tenth */
}

/* Three points a decade apart each way, and one without error. */
static void places(void)
{
    for (int i = 0; i < 4; i++)
        points[i] = (plot_point){.x = pow(10, i + 1), .y = i < 3 ? pow(10, 1 - i) : 0, .name = "n"};
    plot p = {.title = "t", .x_name = "x", .y_name = "y", .points = points, .point_count = 4};
    part all = draw(&p);
    double x[4], y[4];
    for (int i = 0; i < 4; i++) {
        part use = front_use(all, i);
        x[i] = use.start ? part_number(use, " x=\"") : -1;
        y[i] = use.start ? part_number(use, " y=\"") : -1;
    }
    ok(x[0] > 0 && is_near(x[1] - x[0], x[2] - x[1]) && is_near(x[2] - x[1], x[3] - x[2]) && x[3] - x[0] > 200,
       "decades_are_equally_far_apart_from_left_to_right");
    ok(y[0] > 0 && is_near(y[1] - y[0], y[2] - y[1]) && y[1] - y[0] > 60, "and_from_below");
    ok(y[3] > y[2] + 25 && is_near(tick_place(all, "0", " y=\"") - 4, y[3]), "no_error_lies_on_a_floor_that_reads_0");
    ok(is_near(tick_place(all, "100", " x=\""), x[1]) && is_near(tick_place(all, "1000", " x=\""), x[2]) &&
           is_near(tick_place(all, "1", " y=\"") - 4, y[1]) && is_near(tick_place(all, "0.1", " y=\"") - 4, y[2]),
       "ticks_are_where_their_numbers_are");
    ok(markup_is_balanced(all), "the_drawing_is_well_formed");
    p.point_count = 3;
    ok(!strstr(draw(&p).start, ">0</text>"), "without_such_a_point_there_is_no_floor");
    p.x_axis = PLOT_BYTES;
    for (int i = 0; i < 3; i++)
        points[i].x = 1024 << 3 * i;
    all = draw(&p);
    double from = part_number(front_use(all, 0), " x=\""), to = part_number(front_use(all, 2), " x=\"");
    ok(is_near(tick_place(all, "1 KiB", " x=\""), from) &&
           is_near(tick_place(all, "16 KiB", " x=\""), from + (to - from) * 4 / 6),
       "ticks_of_bytes_are_powers_of_two");
    p.point_count = 0;
    ok(markup_is_balanced(draw(&p)), "a_plot_of_nothing_is_well_formed");
}

typedef struct box {
    double left, top, right, bottom;
} box;

/* Letters of 5.8 units, and 9 high above the line: what the usual faces have at least. */
static box label_box(part t, const char *text)
{
    double x = part_number(t, " x=\""), y = part_number(t, " y=\""), width = 5.8 * (double)strlen(text);
    if (part_has(t, "\"end\""))
        x -= width;
    else if (part_has(t, "\"middle\""))
        x -= width / 2;
    return (box){x, y - 9, x + width, y};
}

static int meet(const box *a, const box *b)
{
    return a->left < b->right && b->left < a->right && a->top < b->bottom && b->top < a->bottom;
}

/* Labels of a plot that cover each other, a point of the front, or the border; *numbered: how many points have one. */
static int count_covered(part all, size_t *numbered)
{
    static box boxes[2 * MOST];
    size_t count = 0, labels;
    int covered = 0;
    for (part t = part_next(all, all.start, "<text class=\"n\"", "</text>"); t.start;
         t = part_next(all, t.end, "<text class=\"n\"", "</text>")) {
        char text[64];
        part_text(t, text, sizeof text);
        boxes[count++] = label_box(t, text);
    }
    labels = *numbered = count;
    for (int i = 0; front_use(all, i).start; i++) {
        double x = part_number(front_use(all, i), " x=\""), y = part_number(front_use(all, i), " y=\"");
        boxes[count++] = (box){x - 4, y - 4, x + 4, y + 4};
    }
    const char *view = strstr(all.start, "viewBox=\"0 0 ");
    double width = strtod(view + 13, 0), height = strtod(strchr(view + 13, ' '), 0);
    for (size_t i = 0; i < labels; i++) {
        covered += boxes[i].left < 0 || boxes[i].top < 0 || boxes[i].right > width || boxes[i].bottom > height;
        for (size_t k = i + 1; k < count; k++)
            if (meet(&boxes[i], &boxes[k]) && ++covered)
                note("%.1f %.1f to %.1f %.1f covers %.1f %.1f to %.1f %.1f", boxes[i].left, boxes[i].top,
                     boxes[i].right, boxes[i].bottom, boxes[k].left, boxes[k].top, boxes[k].right, boxes[k].bottom);
    }
    return covered;
}

/* Those that are a tenth lower than the one before, by going down the front. */
static size_t count_named(size_t count)
{
    size_t front[MOST], found = plot_front(front, points, count), named = 0;
    double before = INFINITY;
    for (size_t i = 0; i < found; i++)
        if (points[front[i]].y <= before * 9 / 10) {
            before = points[front[i]].y;
            named++;
        }
    return named;
}

static void labels(void)
{
    uint64_t state = 2;
    size_t numbered, all_numbered = 0, all_named = 0;
    int covered = 0;
    for (int round = 0; round < 40; round++) {
        size_t count = random_points(&state, 20 + tap_random(&state) % 200);
        for (size_t i = 0; i < count; i++) /* fronts as sweeps have them: of some 10 points */
            points[i].y *= 300 / points[i].x;
        plot p = {.title = "t", .x_name = "x", .y_name = "y", .points = points, .point_count = count};
        part all = draw(&p);
        covered += count_covered(all, &numbered);
        all_numbered += numbered;
        all_named += count_named(count);
    }
    note("%zu of %zu points have their number", all_numbered, all_named);
    ok(covered == 0 && all_named > 200, "names_cover_neither_each_other_nor_points_of_the_front_nor_the_border");
    ok(all_numbered == all_named, "every_point_that_is_a_tenth_lower_than_the_one_before_has_its_number");
}

/* What names and lines hold cannot end the drawing. */
static void escapes(void)
{
    const size_t line[] = {0, 1};
    const plot_line lines[] = {{"<l>", line, 2}};
    const double marks[] = {32768};
    points[0] = (plot_point){.x = 1000, .y = 2, .name = "<b>&\"'", .note = "</title>", .filled = 1};
    points[1] = (plot_point){.x = 4000, .y = 3, .name = "beaten", .shape = PLOT_STAR};
    plot p = {.title = "</svg>",
              .x_name = "<x>",
              .y_name = "&y",
              .x_axis = PLOT_BYTES,
              .points = points,
              .point_count = 2,
              .lines = lines,
              .line_count = 1,
              .marks = marks,
              .mark_count = 1,
              .level = 0,
              .level_name = "<level>"};
    part all = draw(&p);
    ok(markup_is_balanced(all) && part_count(all, "<svg") == 1 && part_count(all, "</svg>") == 1 &&
           !part_has(all, "<b>") && !part_has(all, "<level>") && !part_has(all, "<x>"),
       "names_are_text_whatever_they_hold");
    ok(part_has(all, "1</tspan> &#60;b&#62;&#38;&#34;&#39;</text>"), "the_front_has_its_names");
    ok(part_count(all, "stroke-dasharray") == 1 && part_count(all, "class=\"m\"") == 1 && part_has(all, ">32 KiB<"),
       "lines_have_dashes_and_marks_their_bytes");
    ok(!part_has(all, "beaten"), "what_is_beaten_is_not_named");
}

int main(void)
{
    sandbox_open();
    fronts();
    numbers();
    places();
    labels();
    escapes();
    ok(sandbox_leftovers() == 0, "no_file_is_left_behind");
    free(written.bytes);
    sandbox_close();
    return tap_done();
}
