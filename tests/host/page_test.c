/* The page about a sweep: well-formed, of itself alone, every row in it, fronts and sentences as worked out here by
 * definition from the rows.
 */
#include "file.h"
#include "markup.h"
#include "markup_reader.h"
#include "page.h"
#include "page_crop.h"
#include "page_picture.h"
#include "plot.h"
#include "sandbox.h"

#include <math.h>

enum { MOST_ROWS = 400, WIDTH = 96, HEIGHT = 64 };

static sweep_row rows[MOST_ROWS];
static file_content written;
static int masks_asked;

static const char hostile[] = "</table><script>alert(\"1\")</script>&'\xff";

/* ---- input ------------------------------------------------------------------------------------------------------ */

static sweep_row *add_row(size_t *count, const char *scene, const char *chain, double depth_bits, double map,
                          double budget)
{
    sweep_row *row = &rows[(*count)++];
    *row = sweep_row_empty();
    snprintf(row->scene, sizeof row->scene, "%s", scene);
    snprintf(row->chain, sizeof row->chain, "%s", chain);
    snprintf(row->options, sizeof row->options, "--method %s", chain);
    row->depth_bits = depth_bits;
    row->map = map;
    row->budget = budget;
    return row;
}

/* Few values of each number, so that some are equal. */
static void fill(sweep_row *row, uint64_t *state)
{
    row->resident_bytes = row->map * row->map * row->depth_bits / 8 * (double)(4 + tap_random(state) % 3) / 4;
    row->peak_bytes = row->resident_bytes + 5000;
    row->error = tap_random(state) % 32 ? (double)(60 + tap_random(state) % 60) / row->map : 0;
    if (row->map == 0)
        row->error = 0.25;
    row->false_shadow = row->error / 2;
    row->false_light = row->error / 2;
    row->m4_pixel = 50 + (double)(tap_random(state) % 40);
    row->host_ratio = 1 + (double)(tap_random(state) % 20) / 8;
}

static size_t make_rows(void)
{
    static const char *const scenes[] = {hostile, "second"};
    static const char *const chains[] = {"constant", "mixed+virtual", "silhouette/msf", "<chain>"};
    static const struct {
        double map, budget;
    } maps[] = {{64, 0}, {128, 0}, {256, 0}, {120, 32768}, {250, 131072}, {500, 524288}};
    uint64_t state = 7;
    size_t count = 0;
    for (int depth = 16; depth <= 32; depth *= 2)
        for (int s = 0; s < 2; s++)
            for (int c = 0; c < 4; c++)
                for (int m = 0; m < 6; m++)
                    fill(add_row(&count, scenes[s], chains[c], depth, maps[m].map, maps[m].budget), &state);
    fill(add_row(&count, hostile, "volumes", 16, 0, 0), &state);
    rows[count - 1].resident_bytes = 100; /* also then it is no map */
    return count;
}

static uint8_t *all_lit(void *context, const page_scene *scene, const sweep_row *row, problem *why)
{
    uint8_t *mask = malloc((size_t)scene->truth->width * scene->truth->height);
    masks_asked++;
    if (!mask || strcmp(row->chain, context) == 0) {
        free(mask);
        problem_in(why, row->chain, "cannot be drawn; expected luck");
        return 0;
    }
    memset(mask, 254, (size_t)scene->truth->width * scene->truth->height);
    return mask;
}

/* A square of shadow in the light. */
static image make_truth(void)
{
    image truth = image_make(WIDTH, HEIGHT, 1, IMAGE_U8);
    memset(truth.samples, 254, WIDTH * HEIGHT);
    for (int y = 40; y < 50; y++)
        memset((uint8_t *)truth.samples + y * WIDTH + 70, 0, 10);
    return truth;
}

/* The page of all rows, or of the first scenes alone. */
static part write_page(const page_input *input, const char *name)
{
    problem why;
    free(written.bytes);
    written.bytes = 0;
    if (page_write(sandbox_path(name), input, &why) || file_read(&written, sandbox_path(name), &why)) {
        note("%s", why.text);
        return (part){"", ""};
    }
    return (part){(char *)written.bytes, (char *)written.bytes + written.size};
}

/* ---- the whole -------------------------------------------------------------------------------------------------- */

/* What a browser would ask for: after src=, href=, url( and @import nothing but data: and #. */
static int asks_for_nothing(part all)
{
    static const char *const doors[] = {"src=\"", "href=\"", "url(", "@import", "srcset=", "action=\""};
    for (size_t i = 0; i < sizeof doors / sizeof *doors; i++)
        for (const char *at = strstr(all.start, doors[i]); at; at = strstr(at + 1, doors[i])) {
            const char *target = at + strlen(doors[i]);
            if (i > 1 || (*target != '#' && strncmp(target, "data:", 5) != 0))
                return note("it asks for %.40s", at), 0;
        }
    return !strstr(all.start, "http:") && !strstr(all.start, "https:") && !strstr(all.start, "fetch(");
}

static void whole(part all)
{
    ok(strncmp(all.start, "<!DOCTYPE html>\n", 16) == 0 && markup_is_balanced(all), "the_page_is_well_formed");
    ok(asks_for_nothing(all), "it_asks_for_nothing");
    ok(part_count(all, "<script>") == 1 && !part_has(all, "alert(\"1\")") && !part_has(all, "<chain>"),
       "names_are_text_whatever_they_hold");
    ok(part_has(all, "&#60;/table&#62;&#60;script&#62;alert(&#34;1&#34;)&#60;/script&#62;&#38;&#39;\xef\xbf\xbd"),
       "and_are_there");
    ok(part_has(all, "gnomon &#60;sweep&#62; &#38; more"), "the_command_is_there");
    ok(part_has(all, "id=\"all\"") && part_has(all, "id=\"scene1\"") && part_has(all, "id=\"scene2\"") &&
           part_count(all, "<svg class=\"plot\"") == 4 && part_count(all, "<img class=\"picture\"") == 1,
       "every_scene_has_two_plots_and_its_picture");
    /* 4 chains each and volumes, of 16 bits and the middle budget */
    ok(part_count(all, "mask and difference") == 5 && masks_asked == 5, "every_chain_has_its_worst_place");
    ok(part_count(all, "here 100 of 3072, at 16, 2<") == 5, "the_first_one_where_all_that_is_wrong_is_in");
}

/* ---- the table -------------------------------------------------------------------------------------------------- */

static part scene_section(part all, int number)
{
    char open[32];
    snprintf(open, sizeof open, "<section id=\"scene%d\"", number);
    return part_next(all, all.start, open, "</section>");
}

static part table_of(part section)
{
    return part_next(section, section.start, "<table class=\"sort", "</table>");
}

/* Cell number `column` of the row, as text. */
static void cell_text(part row, int column, char *text, size_t size)
{
    const char *at = row.start + 1;
    for (int i = 0; i <= column && at; i++) {
        const char *th = strstr(at, "<th"), *td = strstr(at, "<td");
        at = th && (!td || th < td) ? th + 1 : td ? td + 1 : 0;
    }
    text[0] = 0;
    if (at && at < row.end)
        part_text((part){at - 1, strstr(at, "</t")}, text, size);
}

static int column_of(part table, const char *name)
{
    char text[64];
    part head = part_next(table, table.start, "<thead", "</thead>");
    for (int i = 0; i < 64; i++) {
        cell_text(head, i + 0, text, sizeof text);
        if (strcmp(text, name) == 0)
            return i;
    }
    note("there is no column %s", name);
    return 0;
}

static double cell_number(part row, int column)
{
    char text[64], *end;
    cell_text(row, column, text, sizeof text);
    double number = strtod(text, &end);
    return end == text ? NAN : number;
}

/* Shown with three digits. */
static int shows(double shown, double number)
{
    return fabs(shown - number) <= 0.005 * fabs(number) + 1e-12;
}

/* Which row it is: by chain, depth and map, which are a row's name within a scene; -1: none. */
static int row_shown(part tr, part table, const char *scene, size_t count)
{
    char chain[64];
    cell_text(tr, 0, chain, sizeof chain);
    double depth = cell_number(tr, column_of(table, "depth bits")), map = cell_number(tr, column_of(table, "map"));
    for (size_t i = 0; i < count; i++)
        if (strcmp(rows[i].scene, scene) == 0 && strcmp(rows[i].chain, chain) == 0 && rows[i].depth_bits == depth &&
            rows[i].map == map)
            return (int)i;
    return -1;
}

static double paid(const sweep_row *row, int of_bytes)
{
    return of_bytes ? row->resident_bytes : row->m4_pixel;
}

static int takes_part(const sweep_row *a, size_t count, int of_bytes)
{
    if (of_bytes && a->map == 0)
        return 0;
    for (size_t i = 0; i < count && a->depth_bits == 32; i++) {
        const sweep_row *b = &rows[i];
        if (strcmp(a->scene, b->scene) == 0 && b->depth_bits == 16 && (b->map > 0 || !of_bytes) &&
            paid(b, of_bytes) <= paid(a, of_bytes) * 11 / 10 && a->error > b->error * 9 / 10)
            return 0;
    }
    return 1;
}

/* By the definition, every pair: is it on the front of bytes (of rows with a map), or of cost? Of 32 bits those take
 * part that are a tenth better than all of 16 bits that cost up to a tenth more. */
static int should_be_on_front(size_t row, size_t count, int of_bytes)
{
    const sweep_row *a = &rows[row];
    if (!takes_part(a, count, of_bytes))
        return 0;
    for (size_t i = 0; i < count; i++) {
        const sweep_row *b = &rows[i];
        double x = paid(a, of_bytes), other = paid(b, of_bytes);
        if (strcmp(a->scene, b->scene) != 0 || i == row || !takes_part(b, count, of_bytes))
            continue;
        if (other <= x && b->error <= a->error && (other < x || b->error < a->error || i < row))
            return 0;
    }
    return 1;
}

static void table(part all, int number, const char *scene, size_t count)
{
    part t = table_of(scene_section(all, number)), tr = part_next(t, strstr(t.start, "<tbody"), "<tr", "</tr>");
    int seen[MOST_ROWS] = {0}, wrong = 0, shown = 0, expected = 0, fronts = 0;
    double before = -1;
    for (; tr.start; tr = part_next(t, tr.end, "<tr", "</tr>"), shown++) {
        int i = row_shown(tr, t, scene, count);
        if (i < 0 || seen[i]++) {
            wrong++;
            continue;
        }
        char front[16];
        cell_text(tr, column_of(t, "front"), front, sizeof front);
        int of_bytes = should_be_on_front((size_t)i, count, 1), of_cost = should_be_on_front((size_t)i, count, 0);
        wrong += !shows(cell_number(tr, column_of(t, "error")), rows[i].error);
        wrong += !shows(cell_number(tr, column_of(t, "m4 pixel")), rows[i].m4_pixel);
        wrong += rows[i].resident_bytes != cell_number(tr, column_of(t, "resident bytes"));
        wrong += rows[i].error < before;
        wrong += (strchr(front, 'B') != 0) != of_bytes || (strchr(front, 'C') != 0) != of_cost;
        wrong += part_has(tr, "<tr class=\"f\"") != (of_bytes || of_cost);
        fronts += of_bytes + of_cost;
        before = rows[i].error;
    }
    for (size_t i = 0; i < count; i++)
        expected += strcmp(rows[i].scene, scene) == 0;
    note("%d rows, %d on fronts, %d wrong", shown, fronts, wrong);
    ok(shown == expected && wrong == 0 && fronts > 4, "the_table_of_scene_%d_has_every_row_once_and_marks_the_fronts",
       number);
}

/* Points of both plots: all of 16 bits, of 32 bits those on the front. */
static void points(part all, size_t count)
{
    part section = scene_section(all, 1);
    size_t expected = 0;
    for (size_t i = 0; i < count; i++)
        for (int of_bytes = 0; of_bytes < 2; of_bytes++)
            expected += strcmp(rows[i].scene, hostile) == 0 && (rows[i].map > 0 || !of_bytes) &&
                        (rows[i].depth_bits == 16 || should_be_on_front(i, count, of_bytes));
    note("%zu points", expected);
    ok(part_count(section, "<use ") == expected && expected > 49 && expected < 96,
       "greater_depths_are_drawn_where_they_are_on_the_front");
    size_t listed = 0;
    for (part t = part_next(section, section.start, "<table class=\"front\"", "</table>"); t.start;
         t = part_next(section, t.end, "<table class=\"front\"", "</table>"))
        listed += part_count(t, "<tr><td>");
    ok(listed == part_count(section, "<tspan class=\"d\">") && listed > 4, "what_has_a_number_is_in_the_list_below_it");
}

static void heads(part all)
{
    part t = table_of(scene_section(all, 1)), head = part_next(t, t.start, "<thead", "</thead>");
    part body = {strstr(t.start, "<tbody"), t.end};
    size_t columns = part_count(head, "<th "), lines = part_count(body, "<tr");
    ok(columns == part_count(head, "data-kind=") && part_count(head, "data-kind=\"text\"") == 2 &&
           part_has(head, "data-kind=\"text\"><button type=\"button\">chain<") &&
           part_has(head, "data-kind=\"text\"><button type=\"button\">front<") &&
           part_has(head, "data-kind=\"number\" aria-sort=\"ascending\"><button type=\"button\">error<"),
       "columns_say_how_they_are_sorted");
    ok(part_count(body, "<td") == lines * (columns - 1) && part_count(body, "<th") == lines,
       "rows_have_a_cell_in_every_column");
    /* nothing of these was measured */
    ok(!part_has(head, "overdraw") && !part_has(head, "multiplies") && part_has(head, "host ratio"),
       "columns_without_anything_are_left_out");
}

/* ---- sentences -------------------------------------------------------------------------------------------------- */

static void sentence(part section, int number, char *text, size_t size)
{
    part list = part_next(section, section.start, "<ul class=\"advice\"", "</ul>"), item = {0, list.start};
    for (int i = 0; i <= number && item.end; i++)
        item = part_next(list, item.end, "<li>", "</li>");
    text[0] = 0;
    if (item.start)
        part_text(item, text, size);
}

static int reads(part section, int number, const char *expected)
{
    char text[512];
    sentence(section, number, text, sizeof text);
    int good = strcmp(text, expected) == 0;
    if (!good)
        note("got \"%s\", expected \"%s\"", text, expected);
    return good;
}

static sweep_row *hall(size_t *count, const char *chain, double map, double budget, double bytes, double error,
                       double cost)
{
    sweep_row *row = add_row(count, "hall", chain, 16, map, budget);
    row->resident_bytes = bytes;
    row->error = error;
    row->m4_pixel = cost;
    return row;
}

/* The hall beside a scene with instructions, and one of which nothing is known to err. */
static void beside_others(page_input *input, size_t count)
{
    const page_scene *alone = input->scenes;
    const page_scene scenes[] = {*alone, {"field", 0, 0}, {"sky", 0, 0}};
    for (size_t i = 1; i < 3; i++) {
        rows[count + i - 1] = rows[0];
        snprintf(rows[count + i - 1].scene, sizeof rows->scene, "%s", scenes[i].name);
    }
    rows[count].m4_pixel = 50;
    rows[count + 1].error = NAN;
    input->scenes = scenes;
    input->scene_count = 3;
    input->row_count = count + 2;
    part all = write_page(input, "in-hall.html");
    ok(reads(scene_section(all, 1), 0,
             "For 32 KiB take best (map 181 × 181, 16 bits): 0.5 % wrong at 1.25 times constant. To compare: constant "
             "(map 181 × 181, 16 bits), 3.5 % wrong.") &&
           reads(scene_section(all, 2), 0,
                 "For 32 KiB take best (map 181 × 181, 16 bits): 0.5 % wrong at 50 instructions a pixel."),
       "each_scene_has_its_own_cost");
    ok(reads(part_next(all, all.start, "<section id=\"all\"", "</section>"), 0,
             "For 32 KiB: best, 16 bits: 0.5 % wrong in the mean"),
       "means_are_over_scenes_that_can_err");
    input->scenes = alone;
    input->scene_count = 1;
    input->row_count = count;
}

/* Each figure stands in the sentences that it should stand in, and in no other. */
static void sentences(void)
{
    size_t count = 0;
    const page_scene scene = {"hall", 0, 0};
    hall(&count, "best", 181, 32768, 32768, 0.5, 61);
    hall(&count, "beyond", 181, 0, 32769, 0.1, 61);
    hall(&count, "equal", 181, 32768, 32768, 0.5, 62); /* as good, and dearer */
    hall(&count, "cheap", 128, 0, 16384, 0.67, 48);    /* 0.5 / 4 * 5 + 0.05 = 0.675; 61 * 0.8 = 48.8 */
    hall(&count, "cheaper", 64, 0, 4096, 0.68, 40);    /* errs too much */
    hall(&count, "avoid", 181, 32768, 32700, 9, 61);
    hall(&count, "worse", 181, 32768, 32700, 10, 60); /* cheap, as it should be */
    hall(&count, "bad", 128, 0, 16384, 12, 90);       /* not the largest map for its bytes */
    hall(&count, "large", 400, 524288, 400000, 0, 30);
    hall(&count, "constant", 181, 32768, 32768, 3.5, 20);
    hall(&count, "constant", 128, 0, 16384, 3.6, 20); /* not the largest map */
    hall(&count, "volumes", 0, 0, 0, 0.02, 900)->peak_bytes = 65536;
    page_input input = {.scenes = &scene, .scene_count = 1, .rows = rows, .row_count = count};
    part section = scene_section(write_page(&input, "in-hall.html"), 1);
    ok(reads(
           section, 0,
           "For 32 KiB take best (map 181 × 181, 16 bits): 0.5 % wrong at 61 instructions a pixel. Nearly as good for "
           "less: cheap (map 128 × 128, 16 bits), 0.67 % wrong at 48 instructions a pixel. Avoid avoid (map 181 × 181, "
           "16 bits): no cheaper, and 9 % wrong at 61 instructions a pixel. To compare: constant (map 181 × 181, 16 "
           "bits), "
           "3.5 % wrong at 20 instructions a pixel."),
       "a_sentence_says_what_to_take_and_what_to_avoid");
    ok(reads(section, 1, "For 512 KiB take large (map 400 × 400, 16 bits): no pixel wrong at 30 instructions a pixel."),
       "and_no_more_than_there_is_to_say");
    ok(reads(section, 2, "Without a map: volumes, 0.02 % wrong at 900 instructions a pixel, 64 KiB of memory in all."),
       "what_needs_no_map_stands_apart");
    for (size_t i = 0; i < count; i++)
        rows[i].m4_pixel = NAN;
    section = scene_section(write_page(&input, "in-hall.html"), 1);
    ok(reads(section, 0,
             "For 32 KiB take best (map 181 × 181, 16 bits): 0.5 % wrong. To compare: constant (map 181 × 181, 16 "
             "bits), 3.5 % wrong.") &&
           part_count(section, "<svg class=\"plot\"") == 1,
       "without_a_cost_there_is_none_in_words_and_plots");
    rows[0].host_ratio = 1.25;
    section = scene_section(write_page(&input, "in-hall.html"), 1);
    ok(reads(section, 0,
             "For 32 KiB take best (map 181 × 181, 16 bits): 0.5 % wrong at 1.25 times constant. To compare: constant "
             "(map 181 × 181, 16 bits), 3.5 % wrong.") &&
           part_count(section, "<svg class=\"plot\"") == 2,
       "without_instructions_the_time_of_this_machine_is_the_cost");
    beside_others(&input, count);
    for (size_t i = 0; i < count; i++)
        rows[i].budget = 0;
    section = scene_section(write_page(&input, "in-hall.html"), 1);
    ok(reads(section, 0, "Take large (map 400 × 400, 16 bits): no pixel wrong."),
       "without_budgets_all_maps_are_of_one");
    rows[0].error = NAN;
    part all = write_page(&input, "in-hall.html");
    ok(markup_is_balanced(all) && !part_has(all, "nan") && !part_has(all, "inf"), "what_is_not_known_is_not_shown");
    input.row_count = 0;
    ok(markup_is_balanced(write_page(&input, "in-hall.html")), "a_scene_without_rows_has_a_page");
}

/* Against all rows of both scenes: no row within the bytes errs less than the one that is named. */
static void named_is_best(part all, int number, const char *scene, size_t count)
{
    static const double budgets[] = {32768, 131072, 524288};
    static const char *const names[] = {"32 KiB", "128 KiB", "512 KiB"};
    int wrong = 0;
    for (int b = 0; b < 3; b++) {
        char text[512], expected[512];
        int found = 0;
        double least = INFINITY;
        for (size_t i = 0; i < count; i++)
            if (strcmp(rows[i].scene, scene) == 0 && rows[i].map > 0 && rows[i].resident_bytes <= budgets[b])
                least = fmin(least, rows[i].error);
        sentence(scene_section(all, number), b, text, sizeof text);
        for (size_t i = 0; i < count; i++) {
            if (strcmp(rows[i].scene, scene) != 0 || rows[i].map == 0 || rows[i].resident_bytes > budgets[b] ||
                rows[i].error != least)
                continue;
            snprintf(expected, sizeof expected, "For %s take %s (map %.0f × %.0f, %.0f bits): ", names[b],
                     rows[i].chain, rows[i].map, rows[i].map, rows[i].depth_bits);
            found |= strncmp(text, expected, strlen(expected)) == 0;
        }
        if (!found)
            note("%s: the least error is %.9g; %s", names[b], least, text);
        wrong += !found;
    }
    ok(wrong == 0, "the_row_that_is_named_for_a_budget_of_scene_%d_errs_least", number);
}

static double mean_error(size_t count, const char *chain, double depth, double budget)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        if (strcmp(rows[i].chain, chain) == 0 && rows[i].depth_bits == depth && rows[i].budget == budget)
            sum += rows[i].error;
    return sum / 2;
}

static void means(part all, size_t count)
{
    part section = part_next(all, all.start, "<section id=\"all\"", "</section>"), t = table_of(section);
    part tr = part_next(t, strstr(t.start, "<tbody"), "<tr", "</tr>");
    int shown = 0, wrong = 0;
    double before = -1;
    for (; tr.start; tr = part_next(t, tr.end, "<tr", "</tr>"), shown++) {
        char chain[64];
        cell_text(tr, 0, chain, sizeof chain);
        double depth = cell_number(tr, 1), middle = mean_error(count, chain, depth, 131072);
        wrong += !shows(cell_number(tr, 2), mean_error(count, chain, depth, 32768));
        wrong += !shows(cell_number(tr, 3), middle);
        wrong += !shows(cell_number(tr, 4), mean_error(count, chain, depth, 524288));
        wrong += middle < before;
        before = middle;
    }
    ok(shown == 8 && wrong == 0, "means_over_all_scenes_are_what_they_are_called");
}

/* ---- worst places and pictures ---------------------------------------------------------------------------------- */

static void crops(void)
{
    static uint8_t mask[WIDTH * HEIGHT];
    image truth = image_make(WIDTH, HEIGHT, 1, IMAGE_U8);
    uint8_t *t = truth.samples;
    uint64_t state = 4;
    static const uint8_t values[] = {0, 126, 127, 254, 255};
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        t[i] = values[tap_random(&state) % 5];
        mask[i] = values[tap_random(&state) % 5];
    }
    uint32_t most = 0, x = 0, y = 0;
    for (uint32_t top = 0; top + PAGE_CROP_HEIGHT <= HEIGHT; top++)
        for (uint32_t left = 0; left + PAGE_CROP_WIDTH <= WIDTH; left++) {
            uint32_t wrong = 0;
            for (uint32_t i = 0; i < PAGE_CROP_WIDTH * PAGE_CROP_HEIGHT; i++) {
                size_t at = (top + i / PAGE_CROP_WIDTH) * WIDTH + left + i % PAGE_CROP_WIDTH;
                wrong += mask[at] != 255 && t[at] != 255 && (mask[at] > 126) != (t[at] > 126);
            }
            if (wrong > most) {
                most = wrong;
                x = left;
                y = top;
            }
        }
    page_crop c = page_crop_make(mask, &truth);
    ok(c.wrong == most && c.x == x && c.y == y && most > 500, "the_worst_place_has_the_most_wrong_pixels");
    image_free(&c.picture);
    image_free(&truth);
    truth = image_make(2, 1, 1, IMAGE_U8);
    static const uint8_t small[2] = {254, 255};
    c = page_crop_make(small, &truth); /* truly in shadow, and lit here; no surface here */
    static const uint8_t expected[18] = {255, 255, 255, 20, 20, 20,  255, 255, 255,
                                         255, 255, 255, 40, 80, 255, 220, 40,  220};
    ok(c.width == 2 && c.height == 1 && c.wrong == 1 && c.picture.width == 6 && c.picture.height == 1 &&
           memcmp(c.picture.samples, expected, 18) == 0,
       "it_shows_the_mask_and_the_difference");
    image_free(&c.picture);
    image_free(&truth);
}

/* Two pixels above one another: red, then blue; worked out from the format's description. */
static void bitmaps(void)
{
    uint8_t samples[6] = {200, 0, 0, 0, 0, 100};
    const image im = {1, 2, 3, IMAGE_U8, samples};
    size_t size;
    uint8_t *bmp = page_picture_bmp(&im, &size);
    static const uint8_t head[30] = {'B', 'M', 0x3e, 4, 0, 0, 0, 0, 0, 0, 0x36, 4, 0, 0, 40,
                                     0,   0,   0,    1, 0, 0, 0, 2, 0, 0, 0,    1, 0, 8, 0};
    static const uint8_t colours[8] = {0, 0, 200, 0, 100, 0, 0, 0}, pixels[8] = {1, 0, 0, 0, 0, 0, 0, 0};
    ok(size == 54 + 1024 + 8 && memcmp(bmp, head, sizeof head) == 0 && memcmp(bmp + 54, colours, 8) == 0 &&
           memcmp(bmp + 54 + 1024, pixels, 8) == 0,
       "a_bitmap_of_few_colours_has_a_palette_and_its_lowest_row_first");
    free(bmp);
    static uint8_t many[3 * 257];
    for (int i = 0; i < 257; i++)
        many[3 * i] = (uint8_t)i, many[3 * i + 1] = (uint8_t)(i >> 8), many[3 * i + 2] = 7;
    const image wide = {257, 1, 3, IMAGE_U8, many};
    bmp = page_picture_bmp(&wide, &size);
    ok(size == 54 + 772 && bmp[28] == 24 && bmp[10] == 54 && bmp[54] == 7 && bmp[56] == 0 && bmp[54 + 768] == 7 &&
           bmp[54 + 769] == 1,
       "one_of_many_colours_has_three_bytes_a_pixel");
    free(bmp);
    uint8_t four[12] = {0, 0, 0, 10, 20, 30, 2, 4, 6, 2, 1, 3};
    const image square = {2, 2, 3, IMAGE_U8, four};
    image one = page_picture_shrink(&square, 1);
    static const uint8_t mean[3] = {4, 6, 10}; /* of 3.5, 6.25, 9.75 */
    ok(one.width == 1 && one.height == 1 && memcmp(one.samples, mean, 3) == 0, "a_picture_shrinks_to_means");
    image_free(&one);
}

/* ---- texts ------------------------------------------------------------------------------------------------------ */

static int text_is(void (*write)(FILE *), const char *expected)
{
    char got[128] = "";
    FILE *stream = fopen(sandbox_path("in-text"), "w+b");
    write(stream);
    rewind(stream);
    size_t size = fread(got, 1, sizeof got - 1, stream);
    fclose(stream);
    got[size] = 0;
    if (strcmp(got, expected) != 0)
        note("got %s, expected %s", got, expected);
    return strcmp(got, expected) == 0;
}

/* RFC 4648, section 10. */
static void write_vectors(FILE *s)
{
    static const char foobar[] = "foobar";
    for (size_t i = 0; i <= 6; i++, putc(' ', s))
        markup_base64(s, (const uint8_t *)foobar, i);
    markup_base64(s, (const uint8_t *)"\xff\xef\xbe", 3);
}

static void write_marks(FILE *s)
{
    markup_text(s, "a<b>&\"'\n");
}

static void write_strange(FILE *s)
{
    /* two, three and four bytes; then one longer than need be, a surrogate, too large, cut */
    markup_text(s, "\xc3\x97\xe2\x82\xac\xf0\x9f\x98\x80|\xc0\x80|\xed\xa0\x80|\xf4\x90\x80\x80|\xe2\x82");
}

#define NONE "\xef\xbf\xbd"

static void texts(void)
{
    ok(text_is(write_vectors, " Zg== Zm8= Zm9v Zm9vYg== Zm9vYmE= Zm9vYmFy /+++"), "base_64_is_that_of_its_rfc");
    ok(text_is(write_marks, "a&#60;b&#62;&#38;&#34;&#39;" NONE), "markup_in_texts_is_text");
    ok(text_is(write_strange, "\xc3\x97\xe2\x82\xac\xf0\x9f\x98\x80|" NONE NONE "|" NONE NONE NONE
                              "|" NONE NONE NONE NONE "|" NONE NONE),
       "what_is_no_utf_8_is_replaced");
    ok(markup_length("\xc3\x97"
                     "a\xe2\x82\xac\xff") == 4,
       "letters_are_counted_not_bytes");
}

/* ---- all -------------------------------------------------------------------------------------------------------- */

static void refused(page_input *input)
{
    problem why;
    file_content before = written;
    written = (file_content){0, 0};
    input->context = (void *)(uintptr_t) "silhouette/msf";
    ok(page_write(sandbox_path("in-page.html"), input, &why) == -1 && strstr(why.text, "expected luck"),
       "a_mask_that_cannot_be_made_ends_it");
    file_read(&written, sandbox_path("in-page.html"), &why);
    ok(written.size == before.size && memcmp(written.bytes, before.bytes, before.size) == 0 && sandbox_leftovers() == 0,
       "and_the_older_page_stays");
    ok(page_write(sandbox_path("nowhere/page.html"), input, &why) == -1 && strstr(why.text, "expected a place"),
       "a_folder_that_is_not_there_is_refused");
    free(before.bytes);
}

int main(void)
{
    sandbox_open();
    size_t count = make_rows();
    image truth = make_truth(), picture = image_make(WIDTH, HEIGHT, 3, IMAGE_U8);
    const page_scene scenes[] = {{hostile, &picture, &truth}, {"second", 0, 0}};
    page_input input = {.command = "gnomon <sweep> & more",
                        .scenes = scenes,
                        .scene_count = 2,
                        .rows = rows,
                        .row_count = count,
                        .mask = all_lit,
                        .context = (void *)(uintptr_t) "none"};
    part all = write_page(&input, "in-page.html");
    whole(all);
    table(all, 1, hostile, count);
    table(all, 2, "second", count);
    heads(all);
    points(all, count);
    named_is_best(all, 1, hostile, count);
    named_is_best(all, 2, "second", count);
    means(all, count);
    file_content first = written;
    written = (file_content){0, 0};
    write_page(&input, "in-page.html");
    ok(written.size == first.size && memcmp(written.bytes, first.bytes, first.size) == 0,
       "the_same_rows_give_the_same_bytes");
    free(first.bytes);
    refused(&input);
    sentences();
    crops();
    bitmaps();
    texts();
    ok(sandbox_leftovers() == 0, "no_file_is_left_behind");
    free(written.bytes);
    image_free(&truth);
    image_free(&picture);
    sandbox_close();
    return tap_done();
}
