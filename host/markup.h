/* Texts and bytes inside of HTML and SVG. */
#ifndef MARKUP_H
#define MARKUP_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Any bytes as text, also between quotes: markup's own characters as entities; what is no UTF-8, and control
 * characters, as U+FFFD. */
void markup_text(FILE *stream, const char *text);

/* How many characters the text has, as markup_text shows it. */
size_t markup_length(const char *text);

/* Base 64 (RFC 4648, section 4), padded, without line feeds. */
void markup_base64(FILE *stream, const uint8_t *bytes, size_t size);

#endif
