/* Line-based text as words: what the scene reader and the OBJ reader share.
 *
 * A statement is a line; words are separated by blanks and tabs; `#` ends a statement up to the end of the line; a
 * carriage return counts as a blank. With `continued`, a backslash at the end of a line joins the next one to the
 * statement.
 */
#ifndef TEXT_H
#define TEXT_H

#include "problem.h"

typedef struct word {
    const char *start; /* not zero-terminated, but followed by a byte that belongs to no number */
    size_t length;
} word;

typedef struct text {
    const char *file; /* its name, for messages */
    const char *at, *end;
    long line;     /* of `at`, from 1 */
    int continued; /* backslash joins lines */
    int started;
} text;

/* Words of `size` bytes that are followed by a zero byte. */
text text_of(const char *file, const char *bytes, size_t size, int continued);

/* Go to the next statement that holds a word: 1, or 0 at the end of the text. */
int text_next_statement(text *t);

/* The next word of the statement: 1, or 0 at its end. */
int text_next_word(text *t, word *w);

/* The next word without taking it. */
int text_peek_word(const text *t, word *w);

int word_is(word w, const char *string);

/* The word as a finite decimal number (no hexadecimal, no infinity): 0, or -1 if it is none. */
int word_number(word w, double *number);

/* The word as a whole number: 0, or -1 if it is none or does not fit. */
int word_integer(word w, long *number);

/* A copy of at most 60 characters for a message, what cannot be printed as '?'. */
typedef struct word_text {
    char text[64];
} word_text;
word_text word_shown(word w);

#endif
