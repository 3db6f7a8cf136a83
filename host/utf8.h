/* Text of other programs, which may be in UTF-8 and may be anything. */
#ifndef UTF8_H
#define UTF8_H

#include <stdint.h>

/* Bytes of the character in UTF-8 at text, 1 to 4; 0 where it is none: a byte that starts none, one that is cut, one
 * written longer than need be, a surrogate, or beyond U+10FFFF (RFC 3629, section 4). text ends with a zero byte. */
int utf8_size(const uint8_t *text);

#endif
