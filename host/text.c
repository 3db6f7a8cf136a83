#include "text.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

text text_of(const char *file, const char *bytes, size_t size, int continued)
{
    text t = {.file = file, .at = bytes, .end = bytes + size, .line = 1, .continued = continued, .started = 0};
    if (size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0) /* a byte order mark that some exporters write */
        t.at += 3;
    return t;
}

static int is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/* Length of a backslash that joins two lines, with blanks and the line feed behind it; 0 if there is none at `at`. */
static size_t joint_length(const text *t, const char *at)
{
    if (!t->continued || *at != '\\')
        return 0;
    const char *c = at + 1;
    while (c < t->end && is_blank(*c))
        c++;
    return c < t->end && *c == '\n' ? (size_t)(c - at) + 1 : 0;
}

static void skip_blanks(text *t)
{
    while (t->at < t->end) {
        size_t joint = joint_length(t, t->at);
        if (joint) {
            t->at += joint;
            t->line++;
        } else if (is_blank(*t->at)) {
            t->at++;
        } else {
            return;
        }
    }
}

static void skip_statement(text *t)
{
    word w;
    while (text_next_word(t, &w)) {
    }
    while (t->at < t->end && *t->at != '\n')
        t->at++;
    if (t->at < t->end) {
        t->at++;
        t->line++;
    }
}

int text_next_statement(text *t)
{
    if (t->started)
        skip_statement(t);
    t->started = 1;
    while (t->at < t->end) {
        skip_blanks(t);
        if (t->at < t->end && *t->at != '\n' && *t->at != '#')
            return 1;
        skip_statement(t);
    }
    return 0;
}

int text_next_word(text *t, word *w)
{
    skip_blanks(t);
    const char *start = t->at;
    while (t->at < t->end && !is_blank(*t->at) && *t->at != '\n' && *t->at != '#' && !joint_length(t, t->at))
        t->at++;
    w->start = start;
    w->length = (size_t)(t->at - start);
    return w->length > 0;
}

int text_peek_word(const text *t, word *w)
{
    text copy = *t;
    return text_next_word(&copy, w);
}

int word_is(word w, const char *string)
{
    return strlen(string) == w.length && memcmp(w.start, string, w.length) == 0;
}

int word_number(word w, double *number)
{
    for (size_t i = 0; i < w.length; i++)
        if (!memchr("0123456789+-.eE", w.start[i], 15))
            return -1;
    char *end;
    *number = strtod(w.start, &end);
    return end == w.start + w.length && w.length && isfinite(*number) ? 0 : -1;
}

int word_integer(word w, long *number)
{
    for (size_t i = 0; i < w.length; i++)
        if (!memchr("0123456789+-", w.start[i], 12))
            return -1;
    char *end;
    errno = 0;
    *number = strtol(w.start, &end, 10);
    return end == w.start + w.length && w.length && !errno ? 0 : -1;
}

word_text word_shown(word w)
{
    word_text shown;
    size_t length = w.length < 60 ? w.length : 60;
    for (size_t i = 0; i < length; i++) {
        unsigned char c = (unsigned char)w.start[i];
        shown.text[i] = c < 32 || c == 127 ? '?' : (char)c;
    }
    memcpy(shown.text + length, length < w.length ? "..." : "", length < w.length ? 4 : 1);
    return shown;
}
