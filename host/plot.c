#include "plot.h"

#include "markup.h"
#include "memory.h"
#include "plot_labels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Units of the drawing: a wide column shows one as about a pixel, a phone as three quarters of one. */
enum { WIDTH = 440, HEIGHT = 420, LEFT = 42, RIGHT = 432, TOP = 34, BOTTOM = 374, FLOOR_ROOM = 26 };
enum { LETTER_HEIGHT = 13, MARK = 5 };

/* Of a letter of 11.5 units, in the mean, in the widest of the usual sans-serif faces. */
#define LETTER_WIDTH 6.6

/* Okabe and Ito, "Color universal design", 2008. */
static const char *const colours[PLOT_SHAPES] = {"#000000", "#0072b2", "#009e73", "#56b4e9",
                                                 "#d55e00", "#cc79a7", "#e69f00"};

static const char *const outlines[PLOT_SHAPES] = {
    "M-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0z",
    "M-3.5 -3.5h7v7h-7z",
    "M0 -5L5 0L0 5L-5 0z",
    "M0 4.5L-4.5 -3.5h9z",
    "M0 -4.5L4.5 3.5h-9z",
    "M-4.6 0L-2.3 -4L2.3 -4L4.6 0L2.3 4L-2.3 4z",
    "M0 -5.5L1.4 -1.9L5.2 -1.7L2.2 0.7L3.2 4.4L0 2.3L-3.2 4.4L-2.2 0.7L-5.2 -1.7L-1.4 -1.9z",
};

static const char *const dashes[PLOT_LINES] = {"7 3", "2 3", "9 3 2 3", "4 2"};

/* ---- the front -------------------------------------------------------------------------------------------------- */

static int can_be_drawn(const plot_point *p)
{
    return isfinite(p->x) && isfinite(p->y) && p->x > 0 && p->y >= 0;
}

typedef struct place {
    double x, y;
    size_t index;
} place;

static int by_place(const void *a, const void *b)
{
    const place *p = a, *q = b;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    if (p->y != q->y)
        return p->y < q->y ? -1 : 1;
    return p->index < q->index ? -1 : 1;
}

size_t plot_front(size_t *front, const plot_point points[], size_t count)
{
    place *places = memory_take(count, sizeof *places);
    size_t drawn = 0, found = 0;
    double least = INFINITY;
    for (size_t i = 0; i < count; i++)
        if (can_be_drawn(&points[i]))
            places[drawn++] = (place){points[i].x, points[i].y, i};
    qsort(places, drawn, sizeof *places, by_place);
    for (size_t i = 0; i < drawn; i++)
        if (places[i].y < least) {
            least = places[i].y;
            front[found++] = places[i].index;
        }
    free(places);
    return found;
}

size_t plot_named(size_t *named, const size_t front[], size_t count, const plot_point points[])
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++)
        if (!found || points[front[i]].y <= 0.9 * points[named[found - 1]].y)
            named[found++] = front[i];
    return found;
}

/* ---- numbers ---------------------------------------------------------------------------------------------------- */

plot_text plot_number(double number)
{
    plot_text t = {""};
    double size = fabs(number);
    if (!isfinite(number))
        return t;
    int digits = size >= 99.95 || size == 0 ? 0 : size >= 9.995 ? 1 : size >= 0.9995 ? 2 : 2 - (int)floor(log10(size));
    if (digits > 2 && size * pow(10, digits) >= 999.5) /* it is rounded up to a digit more */
        digits--;
    snprintf(t.text, sizeof t.text, "%.*f", digits > 12 ? 12 : digits, number);
    for (char *end = t.text + strlen(t.text) - 1; digits && (*end == '0' || *end == '.'); end--) {
        digits = *end != '.';
        *end = 0;
    }
    return t;
}

plot_text plot_bytes(double bytes)
{
    static const char *const units[] = {"", " KiB", " MiB", " GiB"};
    int unit = 0;
    for (; unit < 3 && bytes >= 1024; unit++)
        bytes /= 1024;
    plot_text t, number = plot_number(bytes);
    snprintf(t.text, sizeof t.text, "%.30s%s", number.text, units[unit]);
    return t;
}

/* ---- axes ------------------------------------------------------------------------------------------------------- */

typedef struct axis {
    plot_axis kind;
    double low, high; /* logarithms to base 10 */
    double from, to;  /* where they lie */
} axis;

static double axis_place(const axis *a, double value)
{
    return a->from + (log10(value) - a->low) / (a->high - a->low) * (a->to - a->from);
}

static void axis_take(axis *a, double value)
{
    if (value > 0) {
        a->low = fmin(a->low, log10(value));
        a->high = fmax(a->high, log10(value));
    }
}

/* Room at both ends, and so long that two ticks lie within. */
static void axis_finish(axis *a)
{
    if (a->low > a->high)
        a->low = a->high = 0;
    double room = fmax(0.04 * (a->high - a->low), (0.8 - (a->high - a->low)) / 2);
    a->low -= room;
    a->high += room;
}

typedef struct drawing {
    const plot *plot;
    FILE *stream;
    axis x, y;
    int has_floor;
    size_t *front, *named;
    size_t front_count, named_count;
    uint8_t *is_named; /* a byte a point */
    plot_labels labels;
} drawing;

static double place_x(const drawing *d, double x)
{
    return axis_place(&d->x, x);
}

static double place_y(const drawing *d, double y)
{
    return y > 0 ? axis_place(&d->y, y) : BOTTOM;
}

static void make_axes(drawing *d)
{
    const plot *p = d->plot;
    d->x = (axis){p->x_axis, INFINITY, -INFINITY, LEFT, RIGHT};
    d->y = (axis){PLOT_DECIMAL, INFINITY, -INFINITY, BOTTOM, TOP};
    for (size_t i = 0; i < p->point_count; i++) {
        if (!can_be_drawn(&p->points[i]))
            continue;
        axis_take(&d->x, p->points[i].x);
        axis_take(&d->y, p->points[i].y);
        d->has_floor |= p->points[i].y == 0;
    }
    for (size_t i = 0; i < p->mark_count; i++)
        axis_take(&d->x, p->marks[i]);
    axis_finish(&d->x);
    axis_finish(&d->y);
    if (d->has_floor)
        d->y.from = BOTTOM - FLOOR_ROOM;
}

static double text_width(const char *text)
{
    return LETTER_WIDTH * (double)markup_length(text);
}

/* The middle of a text that ends inside of the drawing. */
static double inside(double middle, const char *text)
{
    return fmin(middle, WIDTH - 3 - text_width(text) / 2);
}

static void write_tick(drawing *d, const axis *a, double value, int named)
{
    double at = axis_place(a, value);
    if (a == &d->x)
        fprintf(d->stream, "<path class=\"%s\" d=\"M%.1f %dV%d\"/>", named ? "g" : "t", at, BOTTOM,
                named ? TOP : BOTTOM - 4);
    else
        fprintf(d->stream, "<path class=\"%s\" d=\"M%d %.1fH%d\"/>", named ? "g" : "t", LEFT, at,
                named ? RIGHT : LEFT + 4);
    if (!named)
        return;
    plot_text text = a->kind == PLOT_BYTES ? plot_bytes(value) : plot_number(value);
    if (a == &d->x)
        fprintf(d->stream, "<text x=\"%.1f\" y=\"%d\" text-anchor=\"middle\">%s</text>\n", inside(at, text.text),
                BOTTOM + 15, text.text);
    else
        fprintf(d->stream, "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">%s</text>\n", LEFT - 5, at + 4, text.text);
}

/* Powers of two, as far apart as their names need. */
static void write_byte_ticks(drawing *d, const axis *a, double apart)
{
    const double octave = log10(2);
    int step = 1;
    while (step * octave / (a->high - a->low) * fabs(a->to - a->from) < apart)
        step++;
    for (int i = (int)ceil(a->low / octave); i * octave <= a->high; i++)
        write_tick(d, a, ldexp(1, i), i % step == 0);
}

/* 1, 2, 5; or 1, 3; or 1 of every decade, or of every second one, ...; the others of 1 to 9 have ticks without names.
 */
static void write_decimal_ticks(drawing *d, const axis *a, double apart)
{
    static const double closest[] = {0.3010, 0.4771, 1}; /* of logarithms */
    static const char *const named[] = {"125", "13", "1"};
    double unit = fabs(a->to - a->from) / (a->high - a->low);
    int choice = 0, step = 1;
    while (choice < 2 && closest[choice] * unit < apart)
        choice++;
    while (choice == 2 && step * unit < apart)
        step++;
    for (int decade = (int)floor(a->low); decade <= (int)ceil(a->high); decade++)
        for (int digit = 1; digit <= 9; digit++) {
            double value = digit * pow(10, decade), at = log10(value);
            int has_name = strchr(named[choice], '0' + digit) && decade % step == 0;
            if (at >= a->low && at <= a->high && (has_name || step == 1))
                write_tick(d, a, value, has_name);
        }
}

static void write_axes(drawing *d)
{
    FILE *s = d->stream;
    if (d->x.kind == PLOT_BYTES)
        write_byte_ticks(d, &d->x, 62);
    else
        write_decimal_ticks(d, &d->x, 42);
    write_decimal_ticks(d, &d->y, 22);
    fprintf(s, "<path class=\"a\" d=\"M%d %dV%dH%d\"/>", LEFT, TOP, BOTTOM, RIGHT);
    if (d->has_floor) {
        fprintf(s, "<path class=\"b\" d=\"M%d %dH%d\"/>", LEFT, BOTTOM - FLOOR_ROOM / 2, RIGHT);
        fprintf(s, "<text x=\"%d\" y=\"%d\" text-anchor=\"end\">0</text>", LEFT - 5, BOTTOM + 4);
    }
    fprintf(s, "<text class=\"x\" x=\"%d\" y=\"%d\">", 2, 13);
    markup_text(s, d->plot->y_name);
    fprintf(s, "</text><text class=\"x\" x=\"%d\" y=\"%d\" text-anchor=\"end\">", RIGHT, HEIGHT - 10);
    markup_text(s, d->plot->x_name);
    fputs("</text>\n", s);
}

/* ---- what lies in it -------------------------------------------------------------------------------------------- */

/* Upright lines with their numbers above the plot. */
static void write_marks(drawing *d)
{
    double free_from = 0;
    for (size_t i = 0; i < d->plot->mark_count; i++) {
        double at = place_x(d, d->plot->marks[i]);
        plot_text text = d->x.kind == PLOT_BYTES ? plot_bytes(d->plot->marks[i]) : plot_number(d->plot->marks[i]);
        double half = text_width(text.text) / 2, middle = inside(at, text.text);
        fprintf(d->stream, "<path class=\"m\" d=\"M%.1f %dV%d\"/>", at, TOP - 4, BOTTOM);
        if (middle - half >= free_from) {
            fprintf(d->stream, "<text class=\"y\" x=\"%.1f\" y=\"%d\" text-anchor=\"middle\">%s</text>\n", middle,
                    TOP - 7, text.text);
            free_from = middle + half + 4;
        }
    }
}

static void write_level(drawing *d)
{
    if (!d->plot->level_name)
        return;
    double at = fmax(fmin(place_y(d, d->plot->level), BOTTOM), TOP), width = text_width(d->plot->level_name);
    /* to the left and below a front nothing else is drawn */
    fprintf(d->stream, "<path class=\"v\" d=\"M%d %.1fH%d\"/><text class=\"n\" x=\"%d\" y=\"%.1f\">", LEFT, at, RIGHT,
            LEFT + 6, at - 4);
    markup_text(d->stream, d->plot->level_name);
    fputs("</text>\n", d->stream);
    plot_labels_avoid(&d->labels, (plot_box){LEFT, at - 4 - LETTER_HEIGHT, LEFT + 8 + width, at}, PLOT_HEAVY);
}

static void write_lines(drawing *d)
{
    for (size_t i = 0; i < d->plot->line_count && i < PLOT_LINES; i++) {
        const plot_line *line = &d->plot->lines[i];
        size_t drawn = 0;
        for (size_t k = 0; k < line->count; k++) {
            const plot_point *p = &d->plot->points[line->points[k]];
            if (can_be_drawn(p))
                fprintf(d->stream, "%s%.1f %.1f", drawn++ ? "L" : "<path class=\"l\" d=\"M", place_x(d, p->x),
                        place_y(d, p->y));
        }
        if (drawn)
            fprintf(d->stream, "\" stroke-dasharray=\"%s\"/>\n", dashes[i]);
    }
}

static void write_point(drawing *d, const plot_point *p)
{
    fprintf(d->stream, "<use href=\"#s%d\" x=\"%.1f\" y=\"%.1f\" class=\"k%d%s\">", (int)p->shape, place_x(d, p->x),
            place_y(d, p->y), (int)p->shape, p->filled ? "f" : "");
    if (p->note) {
        fputs("<title>", d->stream);
        markup_text(d->stream, p->note);
        fputs("</title>", d->stream);
    }
    fputs("</use>\n", d->stream);
}

static plot_box around(double x, double y, double half)
{
    return (plot_box){x - half, y - half, x + half, y + half};
}

static void write_others(drawing *d)
{
    fputs("<g class=\"r\">\n", d->stream);
    for (size_t i = 0; i < d->plot->point_count; i++) {
        const plot_point *p = &d->plot->points[i];
        if (d->is_named[i] || !can_be_drawn(p))
            continue;
        write_point(d, p);
        plot_labels_avoid(&d->labels, around(place_x(d, p->x), place_y(d, p->y), MARK - 1), PLOT_LIGHT);
    }
    fputs("</g>\n", d->stream);
}

static void avoid_segment(drawing *d, double x0, double y0, double x1, double y1)
{
    plot_labels_avoid(&d->labels, (plot_box){fmin(x0, x1) - 1, fmin(y0, y1) - 1, fmax(x0, x1) + 1, fmax(y0, y1) + 1},
                      PLOT_HEAVY);
}

/* From above down to the first point, and from the last one to the right: beyond both nothing is better. */
static void write_stairs(drawing *d)
{
    double x = 0, y = TOP;
    for (size_t i = 0; i < d->front_count; i++) {
        const plot_point *p = &d->plot->points[d->front[i]];
        double next_x = place_x(d, p->x), next_y = place_y(d, p->y);
        if (i) {
            fprintf(d->stream, "H%.1f", next_x);
            avoid_segment(d, x, y, next_x, y);
        } else {
            fprintf(d->stream, "<path class=\"s\" d=\"M%.1f %d", next_x, TOP);
        }
        fprintf(d->stream, "V%.1f", next_y);
        avoid_segment(d, next_x, y, next_x, next_y);
        x = next_x;
        y = next_y;
    }
    if (d->front_count) {
        fprintf(d->stream, "H%d\"/>\n", RIGHT);
        avoid_segment(d, x, y, RIGHT, y);
    }
}

static void write_named(drawing *d)
{
    fputs("<g class=\"p\">\n", d->stream);
    for (size_t i = 0; i < d->named_count; i++) {
        const plot_point *p = &d->plot->points[d->named[i]];
        write_point(d, p);
        plot_labels_avoid(&d->labels, around(place_x(d, p->x), place_y(d, p->y), MARK), PLOT_HEAVY);
    }
    fputs("</g>\n", d->stream);
}

/* ---- names ------------------------------------------------------------------------------------------------------ */

static void write_label(drawing *d, const plot_label *l, size_t number, const char *name)
{
    double x = l->anchor < 0 ? l->box.left : l->anchor > 0 ? l->box.right : (l->box.left + l->box.right) / 2;
    if (l->joined)
        fprintf(d->stream, "<path class=\"j\" d=\"M%.1f %.1fL%.1f %.1f\"/>", l->from_x, l->from_y, l->to_x, l->to_y);
    fprintf(d->stream, "<text class=\"n\" x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\"><tspan class=\"d\">%zu</tspan>", x,
            l->box.bottom - 3,
            l->anchor < 0   ? "start"
            : l->anchor > 0 ? "end"
                            : "middle",
            number);
    if (name) {
        putc(' ', d->stream);
        markup_text(d->stream, name);
    }
    fputs("</text>\n", d->stream);
}

/* Try the number with the name, where one is wanted; then the number alone. */
static void label_point(drawing *d, size_t number, const char *name)
{
    const plot_point *p = &d->plot->points[d->named[number - 1]];
    double x = place_x(d, p->x), y = place_y(d, p->y), digits = LETTER_WIDTH * (number < 10 ? 1.1 : 2.2);
    plot_label l = {.found = 0};
    if (name)
        l = plot_labels_place(&d->labels, x, y, digits + 4 + text_width(name), LETTER_HEIGHT, PLOT_CROSSED);
    if (!l.found) {
        name = 0;
        l = plot_labels_place(&d->labels, x, y, digits, LETTER_HEIGHT, PLOT_HEAVY);
    }
    if (l.found)
        write_label(d, &l, number, name);
}

/* Points that follow each other under one name have it once. */
static const char *new_name(const drawing *d, size_t i)
{
    const plot_point *points = d->plot->points;
    const char *name = points[d->named[i]].name;
    return i && strcmp(name, points[d->named[i - 1]].name) == 0 ? 0 : name;
}

static void write_labels(drawing *d)
{
    for (size_t i = 0; i < d->named_count; i++)
        if (new_name(d, i))
            label_point(d, i + 1, new_name(d, i));
    for (size_t i = 0; i < d->named_count; i++)
        if (!new_name(d, i))
            label_point(d, i + 1, 0);
}

/* ---- the whole -------------------------------------------------------------------------------------------------- */

static void find_front(drawing *d)
{
    d->front = memory_take(d->plot->point_count, sizeof *d->front);
    d->named = memory_take(d->plot->point_count, sizeof *d->named);
    d->is_named = memory_take(d->plot->point_count, 1);
    d->front_count = plot_front(d->front, d->plot->points, d->plot->point_count);
    d->named_count = plot_named(d->named, d->front, d->front_count, d->plot->points);
    for (size_t i = 0; i < d->named_count; i++)
        d->is_named[d->named[i]] = 1;
}

void plot_write(FILE *stream, const plot *p)
{
    drawing d = {.plot = p, .stream = stream, .labels = {.frame = {LEFT + 3, TOP, WIDTH - 2, BOTTOM - 2}}};
    find_front(&d);
    make_axes(&d);
    fprintf(stream, "<svg class=\"plot\" viewBox=\"0 0 %d %d\" role=\"img\"><title>", WIDTH, HEIGHT);
    markup_text(stream, p->title);
    fputs("</title>\n", stream);
    write_axes(&d);
    write_marks(&d);
    write_level(&d);
    write_lines(&d);
    write_others(&d);
    write_stairs(&d);
    write_named(&d);
    write_labels(&d);
    fputs("</svg>\n", stream);
    plot_labels_free(&d.labels);
    free(d.front);
    free(d.named);
    free(d.is_named);
}

void plot_write_style(FILE *stream)
{
    fputs(".plot{width:100%;height:auto;display:block}\n"
          ".plot text{font:11.5px Helvetica,Arial,\"Liberation Sans\",sans-serif;fill:#222}\n"
          ".plot path{fill:none}\n"
          ".plot .g{stroke:#e4e4e4}.plot .t,.plot .a{stroke:#555}.plot .b{stroke:#999;stroke-dasharray:1 3}\n"
          ".plot .m{stroke:#666;stroke-dasharray:5 4;stroke-width:.8}.plot .v{stroke:#000;stroke-dasharray:10 3 2 3 2 "
          "3}\n"
          ".plot .l{stroke:#777;stroke-width:1.1}.plot .s{stroke:#000;stroke-width:1.6}.plot "
          ".j{stroke:#000;stroke-width:.6}\n"
          ".plot .y{font-size:11px}.plot .n{paint-order:stroke;stroke:#fff;stroke-width:3px;stroke-linejoin:round}\n"
          ".plot .d{font-weight:bold}.plot .x{font-weight:bold}\n"
          ".r use{stroke-width:.8;opacity:.75}.p use{stroke-width:1.9;stroke:#000}\n",
          stream);
    for (int i = 0; i < PLOT_SHAPES; i++)
        fprintf(stream, ".k%d,.k%df{stroke:%s;fill:#fff}.k%df{fill:%s;fill-opacity:.55}\n", i, i, colours[i], i,
                colours[i]);
}

void plot_write_shapes(FILE *stream)
{
    fputs("<svg width=\"0\" height=\"0\" style=\"position:absolute\" aria-hidden=\"true\"><defs>\n", stream);
    for (int i = 0; i < PLOT_SHAPES; i++)
        fprintf(stream, "<path id=\"s%d\" d=\"%s\"/>\n", i, outlines[i]);
    fputs("</defs></svg>\n", stream);
}

void plot_write_sample(FILE *stream, plot_shape shape, int filled)
{
    fprintf(stream,
            "<svg class=\"sample\" width=\"16\" height=\"14\" viewBox=\"-8 -7 16 14\" aria-hidden=\"true\">"
            "<use href=\"#s%d\" class=\"k%d%s\"/></svg>",
            (int)shape, (int)shape, filled ? "f" : "");
}

void plot_write_line_sample(FILE *stream, size_t line)
{
    fprintf(stream,
            "<svg class=\"sample plot\" width=\"36\" height=\"14\" viewBox=\"0 0 36 14\" aria-hidden=\"true\">"
            "<path class=\"l\" d=\"M0 7H36\" stroke-dasharray=\"%s\"/></svg>",
            dashes[line]);
}
