/* Rows of a sweep as CSV (RFC 4180: commas, texts quoted where they must be), the first line their
 * names; and as JSON.
 */
#ifndef SWEEP_CSV_H
#define SWEEP_CSV_H

#include "json.h"
#include "sweep_row.h"

#include <stdio.h>

void sweep_csv_write_names(FILE *stream);
void sweep_csv_write(FILE *stream, const sweep_row *row);

/* Read rows of a file. Columns go by their names in the first line: unknown ones are skipped, missing ones empty. A
 * last line without its line feed, as an interrupted writer leaves it, is left out. free() *rows afterwards. 0, or -1
 * and the problem. */
int sweep_csv_read(sweep_row **rows, size_t *count, const char *path, problem *why);

/* The columns as members of the innermost object. */
void sweep_json_write(json *j, const sweep_row *row);

#endif
