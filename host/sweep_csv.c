#include "sweep_csv.h"

#include "file.h"
#include "memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- writing --------------------------------------------------------------------------------------------------- */

static void write_text(FILE *stream, const char *text)
{
    if (!text[strcspn(text, ",\"\r\n")]) {
        fputs(text, stream);
        return;
    }
    putc('"', stream);
    for (const char *c = text; *c; c++) {
        if (*c == '"')
            putc('"', stream);
        putc(*c, stream);
    }
    putc('"', stream);
}

void sweep_csv_write_names(FILE *stream)
{
    for (int i = 0; i < SWEEP_COLUMNS; i++)
        fprintf(stream, "%s%c", sweep_columns[i].name, i + 1 < SWEEP_COLUMNS ? ',' : '\n');
}

void sweep_csv_write(FILE *stream, const sweep_row *row)
{
    for (int i = 0; i < SWEEP_COLUMNS; i++) {
        const sweep_column *c = &sweep_columns[i];
        if (c->kind == SWEEP_TEXT)
            write_text(stream, sweep_row_text(row, c));
        else if (!isnan(sweep_row_number(row, c)))
            fprintf(stream, c->kind == SWEEP_COUNT ? "%.0f" : "%.9g", sweep_row_number(row, c));
        putc(i + 1 < SWEEP_COLUMNS ? ',' : '\n', stream);
    }
}

void sweep_json_write(json *j, const sweep_row *row)
{
    for (int i = 0; i < SWEEP_COLUMNS; i++) {
        const sweep_column *c = &sweep_columns[i];
        if (c->kind == SWEEP_TEXT)
            json_string(j, c->name, sweep_row_text(row, c));
        else if (c->kind == SWEEP_COUNT && !isnan(sweep_row_number(row, c)))
            json_integer(j, c->name, (int64_t)sweep_row_number(row, c));
        else
            json_number(j, c->name, sweep_row_number(row, c));
    }
}

/* ---- reading --------------------------------------------------------------------------------------------------- */

enum { MOST_FIELDS = 256, LONGEST_FIELD = 1024 };

typedef struct reader {
    const char *file, *at, *end;
    long line;
    const sweep_column *columns[MOST_FIELDS]; /* 0: unknown */
    int column_count;
    char field[LONGEST_FIELD]; /* the latest */
} reader;

static int put(reader *r, size_t *length, char c, problem *why)
{
    if (*length + 1 == LONGEST_FIELD)
        return problem_at(why, r->file, r->line, "a field of more than %d characters; expected a row of gnomon sweep",
                          LONGEST_FIELD - 1);
    if (!c)
        return problem_at(why, r->file, r->line, "a zero byte; expected a row of gnomon sweep");
    r->field[(*length)++] = c;
    return 0;
}

/* One field up to its comma or line feed, which is not taken. A quote that is not closed ends with the file. */
static int read_field(reader *r, problem *why)
{
    size_t length = 0;
    int quoted = r->at < r->end && *r->at == '"';
    for (r->at += quoted; r->at < r->end; r->at++) {
        if (!quoted && (*r->at == ',' || *r->at == '\n'))
            break;
        if (quoted && *r->at == '"') {
            quoted = r->at + 1 < r->end && r->at[1] == '"';
            if (!quoted)
                continue;
            r->at++;
        }
        if (put(r, &length, *r->at, why))
            return -1;
    }
    if (length && r->field[length - 1] == '\r') /* as a spreadsheet writes lines */
        length--;
    r->field[length] = 0;
    return 0;
}

/* Past the comma or the line feed: 1 if another field of this line follows. */
static int step(reader *r)
{
    int more = r->at < r->end && *r->at == ',';
    r->at += r->at < r->end;
    return more;
}

static int read_names(reader *r, problem *why)
{
    int more = 1;
    while (more) {
        if (read_field(r, why))
            return -1;
        if (r->column_count == MOST_FIELDS)
            return problem_at(why, r->file, 1, "more than %d columns; expected those of gnomon sweep", MOST_FIELDS);
        r->columns[r->column_count++] = sweep_column_find(r->field, strlen(r->field));
        more = step(r);
    }
    if (r->columns[0] != &sweep_columns[0])
        return problem_at(why, r->file, 1, "starts with no column '%s'; expected what gnomon sweep wrote",
                          sweep_columns[0].name);
    return 0;
}

static int read_row(reader *r, sweep_row *row, problem *why)
{
    int more = 1, i = 0;
    *row = sweep_row_empty();
    for (; more && i < r->column_count; i++) {
        if (read_field(r, why))
            return -1;
        const sweep_column *c = r->columns[i];
        if (c && !sweep_row_set(row, c, r->field))
            return problem_at(why, r->file, r->line, "%s is '%.60s'; expected %s", c->name, r->field,
                              c->kind == SWEEP_TEXT ? "a shorter text" : "a number or nothing");
        more = step(r);
    }
    if (more || i < r->column_count)
        return problem_at(why, r->file, r->line, "%s %d fields; expected as many as there are names in line 1",
                          more ? "more than" : "only", i);
    return 0;
}

static int read_rows(reader *r, sweep_row **rows, size_t *count, problem *why)
{
    size_t capacity = 0;
    r->line = 1;
    if (r->at < r->end && read_names(r, why))
        return -1;
    for (r->line = 2; r->at < r->end; r->line++) {
        *rows = memory_grow(*rows, &capacity, *count + 1, sizeof **rows);
        if (read_row(r, &(*rows)[*count], why))
            return -1;
        ++*count;
    }
    return 0;
}

int sweep_csv_read(sweep_row **rows, size_t *count, const char *path, problem *why)
{
    file_content content;
    *rows = 0;
    *count = 0;
    if (file_read(&content, path, why))
        return -1;
    const char *bytes = (const char *)content.bytes;
    size_t size = content.size;
    while (size && bytes[size - 1] != '\n')
        size--;
    reader r = {.file = path, .at = bytes, .end = bytes + size};
    int result = read_rows(&r, rows, count, why);
    free(content.bytes);
    if (result) {
        free(*rows);
        *rows = 0;
        *count = 0;
    }
    return result;
}
