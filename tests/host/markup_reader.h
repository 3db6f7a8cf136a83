/* For tests of what the simulator writes as HTML and SVG: find parts, read attributes and texts, and say whether the
 * whole is in order. A reader of its own: nothing of it is from host/. */
#ifndef MARKUP_READER_H
#define MARKUP_READER_H

#include "core/tap.h"

#include <ctype.h>
#include <string.h>

typedef struct part {
    const char *start, *end;
} part;

/* The first one after `from` in `in`: from `open` (a tag's beginning, as "<tr") to the end of `close` behind it. start
 * 0: none. */
static TAP_UNUSED part part_next(part in, const char *from, const char *open, const char *close)
{
    part found = {0, 0};
    const char *start = strstr(from, open);
    const char *end = start && start < in.end ? strstr(start, close) : 0;
    if (end && end < in.end)
        found = (part){start, end + strlen(close)};
    return found;
}

/* The text with tags left out, entities of numbers and hard blanks as characters; of at most size - 1 bytes. */
static TAP_UNUSED void part_text(part p, char *text, size_t size)
{
    size_t length = 0;
    for (const char *at = p.start; at < p.end && length + 1 < size;) {
        if (*at == '<') {
            at = strchr(at, '>') + 1;
        } else if (at[0] == '&' && at[1] == '#') {
            text[length++] = (char)strtol(at + 2, 0, 10);
            at = strchr(at, ';') + 1;
        } else if (at[0] == '\xc2' && at[1] == '\xa0') {
            text[length++] = ' ';
            at += 2;
        } else {
            text[length++] = *at++;
        }
    }
    text[length] = 0;
}

/* The number in the attribute of the part's first tag; -1: there is none. name: as " x=\"". */
static TAP_UNUSED double part_number(part p, const char *name)
{
    const char *end = strchr(p.start, '>'), *at = strstr(p.start, name);
    return at && at < end ? strtod(at + strlen(name), 0) : -1;
}

static TAP_UNUSED int part_has(part p, const char *text)
{
    const char *at = strstr(p.start, text);
    return at && at < p.end;
}

static TAP_UNUSED size_t part_count(part p, const char *text)
{
    size_t count = 0;
    for (const char *at = strstr(p.start, text); at && at < p.end; at = strstr(at + 1, text))
        count++;
    return count;
}

/* Is every element closed in its order, are attributes quoted, and does a text hold no bare & or >? */
static TAP_UNUSED int markup_is_balanced(part p)
{
    static const char *const empty[] = {"meta", "link", "img", "input", "wbr"};
    char open[64][16];
    int depth = 0;
    for (const char *at = p.start; at < p.end;) {
        if (*at == '&' && at[1] != '#')
            return note("a bare & in: %.40s", at), 0;
        if (*at == '>')
            return note("a bare > in: %.40s", at - 20), 0;
        if (*at++ != '<')
            continue;
        if (*at == '!') {
            at = strchr(at, '>') + 1;
            continue;
        }
        int closes = *at == '/', quoted = 0;
        char name[16] = "";
        at += closes;
        for (size_t i = 0; i < 15 && isalnum((unsigned char)*at); i++)
            name[i] = *at++;
        for (; *at != '>' || quoted; at++) {
            if (*at == '=' && !quoted && at[1] != '"')
                return note("an attribute without quotes in: %.40s", at - 10), 0;
            quoted ^= *at == '"';
            if (*at == '<' || at >= p.end)
                return note("a tag is not closed: <%s", name), 0;
        }
        int is_empty = at[-1] == '/';
        for (int i = 0; i < 5; i++)
            is_empty |= strcmp(name, empty[i]) == 0;
        at++;
        if (closes && (!depth || strcmp(open[--depth], name) != 0))
            return note("</%s> closes <%s>", name, open[depth]), 0;
        if (!closes && !is_empty && depth < 64)
            strcpy(open[depth++], name);
        if (!closes && (strcmp(name, "script") == 0 || strcmp(name, "style") == 0))
            while (at < p.end && strncmp(at, "</s", 3) != 0)
                at++;
    }
    if (depth)
        note("<%s> is not closed", open[depth - 1]);
    return depth == 0;
}

#endif
