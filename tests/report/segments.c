/* How silhouette edges become points of a silhouette map: figures 3 and 4 of Sen, Cammarano & Hanrahan 2003, drawn by
 * the functions that the light pass walks with (gn_segment.h).
 *
 *     segments -o FOLDER
 *
 * Written into FOLDER:
 *
 *     generate.svg  A: a silhouette, and the quadrangles that the paper draws about its edges, yellow; B: texels whose
 *                   centres the quadrangles hold: orange, those that an edge passes, which are those that the walk
 *                   visits; grey, those that the paper's program throws away; C: the points that are stored, to 1/16,
 *                   joined to those of the neighbours
 *     cases.svg     A to D of figure 4: an edge in a cell, its diagonals, and the point O
 *
 * On standard output, of 100000 edges of random length up to 16 texels: cells visited, fragments of quadrangles, and
 * how many of these no edge passes. Exit status: 0 done, 1 a quadrangle misses a cell that is visited, 2 bad usage or
 * output. */
#include "file.h"
#include "gn_segment.h"
#include "options.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CELLS = 12, SCALE = 22, GAP = 16, CORNERS = 9, ONE = 256 };

static const option table[] = {{"-o", "FOLDER", "where the pictures go"}};

static const double outline[CORNERS][2] = {{1.3, 2.2},  {4.6, 1.1}, {7.4, 2.9},  {10.7, 2.4}, {9.3, 6.6},
                                           {10.2, 9.7}, {5.9, 8.3}, {3.2, 10.6}, {2.4, 6.1}};

/* ---- cells of an edge -------------------------------------------------------------------------------------------- */

/* A cell is what the silhouette map calls a texel. Coordinates in cells. */
typedef struct edge {
    double from[2], to[2];
    gn_segment segment;
} edge;

static gn_vertex vertex_at(const double p[2])
{
    /* vertices count from the corner of the first texel of depths, half a texel before the first cell */
    return (gn_vertex){(int32_t)lround(ONE * p[0]) + ONE / 2, (int32_t)lround(ONE * p[1]) + ONE / 2, 1u << 30};
}

static edge make_edge(const double from[2], const double to[2])
{
    edge e;
    gn_vertex a = vertex_at(from), b = vertex_at(to);
    for (int i = 0; i < 2; i++) {
        e.from[i] = round(ONE * from[i]) / ONE;
        e.to[i] = round(ONE * to[i]) / ONE;
    }
    gn_make_segment(&e.segment, &a, &b);
    return e;
}

static gn_cells make_cells(int32_t count)
{
    gn_cells cells = {{0, 0, count + 1, 0}, {0, 0, count + 1, 0}};
    return cells;
}

/* Mark the cells that the walk visits, count x count; returns how many. */
static int visit(const edge *e, int32_t count, uint8_t *visited)
{
    gn_cells cells = make_cells(count);
    int32_t row, last, sum = 0;
    gn_segment_rows(&e->segment, &cells.rows, &row, &last);
    for (; row <= last; row++) {
        int32_t column, last_column;
        gn_segment_columns(&e->segment, &cells, row, &column, &last_column);
        for (; column <= last_column; column++, sum++)
            visited[row * count + column] = 1;
    }
    return (int)sum;
}

static gn_segment_point point_in(const edge *e, int32_t count, int32_t column, int32_t row)
{
    gn_cells cells = make_cells(count);
    gn_cell cell = gn_cell_between(&cells, column, row);
    gn_segment_point p;
    gn_segment_in_cell(&e->segment, &cell, &p);
    return p;
}

/* Half the width of a quadrangle, and what it is longer at each end, that it holds the centre of every cell the edge
 * passes: half a cell's diagonal. */
static const double reach = 0.70711;

static int is_in_quadrangle(const edge *e, int32_t column, int32_t row)
{
    double dx = e->to[0] - e->from[0], dy = e->to[1] - e->from[1], length = hypot(dx, dy);
    double x = column + .5 - e->from[0], y = row + .5 - e->from[1];
    double along = (x * dx + y * dy) / length, beside = (x * dy - y * dx) / length;
    return fabs(beside) <= reach && along >= -reach && along <= length + reach;
}

/* ---- figure 3 ---------------------------------------------------------------------------------------------------- */

static double place(int panel, double v)
{
    return panel * (CELLS * SCALE + GAP) + 1 + v * SCALE;
}

static void begin(FILE *out, int width, int height)
{
    fprintf(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" height=\"%d\" "
            "font-family=\"sans-serif\" font-size=\"16\" font-weight=\"bold\"><rect width=\"%d\" height=\"%d\" "
            "fill=\"#fff\"/>\n",
            width, height, width, height, width, height);
}

static void draw_grid(FILE *out, int panel, int count, double scale)
{
    double left = place(panel, 0), size = count * scale;
    fprintf(out, "<path fill=\"none\" stroke=\"#9ab\" d=\"");
    for (int i = 0; i <= count; i++)
        fprintf(out, "M%.1f %.1fh%.1fM%.1f 1v%.1f", left, 1 + i * scale, size, left + i * scale, size);
    fprintf(out, "\"/>\n");
}

static void draw_square(FILE *out, int panel, int column, int row, const char *colour)
{
    fprintf(out, "<rect x=\"%.1f\" y=\"%.1f\" width=\"%d\" height=\"%d\" fill=\"%s\"/>\n", place(panel, column),
            place(0, row), SCALE, SCALE, colour);
}

static void draw_line(FILE *out, int panel, const double a[2], const double b[2], const char *colour, double width)
{
    fprintf(out, "<path stroke=\"%s\" stroke-width=\"%.1f\" d=\"M%.1f %.1fL%.1f %.1f\"/>\n", colour, width,
            place(panel, a[0]), place(0, a[1]), place(panel, b[0]), place(0, b[1]));
}

static void draw_quadrangle(FILE *out, const edge *e)
{
    double dx = e->to[0] - e->from[0], dy = e->to[1] - e->from[1], length = hypot(dx, dy) / reach;
    dx /= length;
    dy /= length;
    double x0 = e->from[0] - dx, y0 = e->from[1] - dy, x1 = e->to[0] + dx, y1 = e->to[1] + dy;
    fprintf(out, "<path fill=\"#ffd840\" fill-opacity=\".55\" d=\"M%.1f %.1fL%.1f %.1fL%.1f %.1fL%.1f %.1fZ\"/>\n",
            place(0, x0 - dy), place(0, y0 + dx), place(0, x1 - dy), place(0, y1 + dx), place(0, x1 + dy),
            place(0, y1 - dx), place(0, x0 + dy), place(0, y0 - dx));
}

/* A cell's point to 1/16, as the map stores it: of two edges the smaller byte. */
static void keep_point(uint8_t *points, const edge *e, int column, int row)
{
    gn_segment_point p = point_in(e, CELLS, column, row);
    int x = (p.x + 8) >> 4, y = (p.y + 8) >> 4;
    uint8_t point = (uint8_t)((y > 15 ? 15 : y) << 4 | (x > 15 ? 15 : x)), *kept = &points[row * CELLS + column];
    *kept = point < *kept ? point : *kept;
}

static void draw_points(FILE *out, const uint8_t *visited, const uint8_t *points)
{
    for (int pass = 0; pass < 2; pass++)
        for (int at = 0; at < CELLS * CELLS; at++) {
            double p[2] = {at % CELLS + (points[at] & 15) / 16., at / CELLS + (points[at] >> 4) / 16.};
            for (int step = 1; step <= CELLS && !pass; step += CELLS - 1) {
                int next = at + step;
                double q[2];
                if (next >= CELLS * CELLS || (step == 1 && next % CELLS == 0) || !visited[at] || !visited[next])
                    continue;
                q[0] = next % CELLS + (points[next] & 15) / 16.;
                q[1] = next / CELLS + (points[next] >> 4) / 16.;
                draw_line(out, 2, p, q, "#888", 1.2);
            }
            if (pass && visited[at])
                fprintf(out, "<circle fill=\"#d00000\" cx=\"%.1f\" cy=\"%.1f\" r=\"3.4\"/>\n", place(2, p[0]),
                        place(0, p[1]));
        }
}

static void draw_generation(FILE *out)
{
    edge edges[CORNERS];
    uint8_t visited[CELLS * CELLS] = {0}, points[CELLS * CELLS];
    memset(points, 255, sizeof points);
    begin(out, 3 * CELLS * SCALE + 2 * GAP + 2, CELLS * SCALE + 2);
    for (int i = 0; i < CORNERS; i++) {
        uint8_t own[CELLS * CELLS] = {0};
        edges[i] = make_edge(outline[i], outline[(i + 1) % CORNERS]);
        visit(&edges[i], CELLS, own);
        draw_quadrangle(out, &edges[i]);
        for (int at = 0; at < CELLS * CELLS; at++)
            if (own[at]) {
                visited[at] = 1;
                keep_point(points, &edges[i], at % CELLS, at / CELLS);
            }
    }
    for (int at = 0; at < CELLS * CELLS; at++)
        for (int i = 0; i < CORNERS; i++)
            if (visited[at] || is_in_quadrangle(&edges[i], at % CELLS, at / CELLS)) {
                draw_square(out, 1, at % CELLS, at / CELLS, visited[at] ? "#ffb050" : "#ccc");
                break;
            }
    for (int panel = 0; panel < 3; panel++) {
        draw_grid(out, panel, CELLS, SCALE);
        for (int i = 0; i < CORNERS && panel < 2; i++)
            draw_line(out, panel, edges[i].from, edges[i].to, "#000", 2);
        fprintf(out, "<text x=\"%.0f\" y=\"%d\">%c</text>\n", place(panel, .2), CELLS * SCALE - 5, 'A' + panel);
    }
    draw_points(out, visited, points);
    fprintf(out, "</svg>\n");
}

/* ---- figure 4 ---------------------------------------------------------------------------------------------------- */

/* One cell, the middle of 3 x 3, eight times as large. */
static void draw_case(FILE *out, int number, const double from[2], const double to[2])
{
    enum { SIDE = 130, MARGIN = 35 };
    edge e = make_edge(from, to);
    uint8_t visited[9] = {0};
    double left = number * (SIDE + 2 * MARGIN) + MARGIN, top = MARGIN;
    visit(&e, 3, visited);
    fprintf(
        out,
        "<path fill=\"none\" stroke=\"#9ab\" d=\"M%.0f %.0fh%dv%dh-%dZ\"/><path stroke=\"#bbb\" stroke-dasharray=\"4 "
        "3\" d=\"M%.0f %.0fl%d %dM%.0f %.0fl-%d %d\"/>\n",
        left, top, SIDE, SIDE, SIDE, left, top, SIDE, SIDE, left + SIDE, top, SIDE, SIDE);
    fprintf(out, "<path stroke=\"#000\" stroke-width=\"2\" d=\"M%.1f %.1fL%.1f %.1f\"/>\n",
            left + (e.from[0] - 1) * SIDE, top + (e.from[1] - 1) * SIDE, left + (e.to[0] - 1) * SIDE,
            top + (e.to[1] - 1) * SIDE);
    fprintf(out, "<text x=\"%.0f\" y=\"%.0f\">%c</text>\n", left - 24, top + SIDE + 24, 'A' + number);
    printf("figure 4, %c: ", 'A' + number);
    if (!visited[4]) {
        printf("not visited; %s its quadrangle\n", is_in_quadrangle(&e, 1, 1) ? "in" : "not in");
        return;
    }
    gn_segment_point p = point_in(&e, 3, 1, 1);
    printf("point at %d/256, %d/256\n", (int)p.x, (int)p.y);
    fprintf(out, "<circle fill=\"none\" stroke=\"#d00000\" stroke-width=\"2.5\" cx=\"%.1f\" cy=\"%.1f\" r=\"7\"/>\n",
            left + p.x * SIDE / 256., top + p.y * SIDE / 256.);
}

static void draw_cases(FILE *out)
{
    static const double ends[4][2][2] = {
        {{1.65, 1.35}, {.8, 2.1}}, {{.8, 1.375}, {1.625, .8}}, {{.8, 1.3}, {2.2, 1.8}}, {{1.35, .7}, {2.25, 1.1}}};
    begin(out, 800, 200);
    for (int i = 0; i < 4; i++)
        draw_case(out, i, ends[i][0], ends[i][1]);
    fprintf(out, "</svg>\n");
}

/* ---- counts ------------------------------------------------------------------------------------------------------ */

/* 0 to 1, the same numbers in every run (Marsaglia's xorshift). */
static double random_share(uint32_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state / 4294967296.0;
}

/* Returns how many cells that the walk visits no quadrangle holds. */
static unsigned long count_fragments(void)
{
    enum { SIDE = 40, EDGES = 100000 };
    unsigned long visits = 0, fragments = 0, thrown = 0, missed = 0;
    uint32_t state = 2463534242u;
    for (int i = 0; i < EDGES; i++) {
        uint8_t visited[SIDE * SIDE] = {0};
        double length = 16 * random_share(&state) + .1, angle = 6.28318531 * random_share(&state);
        double from[2] = {19 + random_share(&state), 19 + random_share(&state)};
        double to[2] = {from[0] + length * cos(angle), from[1] + length * sin(angle)};
        edge e = make_edge(from, to);
        visits += (unsigned long)visit(&e, SIDE, visited);
        for (int at = 0; at < SIDE * SIDE; at++) {
            int held = is_in_quadrangle(&e, at % SIDE, at / SIDE);
            fragments += (unsigned long)held;
            thrown += held && !visited[at];
            missed += !held && visited[at];
        }
    }
    printf(
        "figure 3, 100000 random edges: cells visited %lu; fragments of quadrangles %lu, thrown away %.1f %%; visited "
        "but in no quadrangle %lu\n",
        visits, fragments, 100.0 * (double)thrown / (double)fragments, missed);
    return missed;
}

/* ---- the program ------------------------------------------------------------------------------------------------- */

static int write_picture(const char *folder, const char *name, void (*draw)(FILE *out), problem *why)
{
    char path[1024];
    file_output output;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    if (file_output_open(&output, path, why))
        return -1;
    draw(output.stream);
    return file_output_finish(&output, why);
}

int main(int argc, char **argv)
{
    const char *values[1];
    command_line line;
    problem why;
    int result = options_parse(table, 1, argc - 1, argv + 1, values, &line, &why);
    if (!result && (line.place_count || !values[0]))
        result = problem_of_usage(&why, "expected segments -o FOLDER");
    if (result || write_picture(values[0], "generate.svg", draw_generation, &why) ||
        write_picture(values[0], "cases.svg", draw_cases, &why)) {
        fprintf(stderr, "%s\n", why.text);
        return 2;
    }
    return count_fragments() != 0;
}
