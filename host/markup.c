#include "markup.h"

#include "utf8.h"

#include <string.h>

void markup_text(FILE *stream, const char *text)
{
    const uint8_t *at = (const uint8_t *)text;
    while (*at) {
        int size = utf8_size(at);
        if (!size || *at < 0x20 || *at == 0x7f)
            fputs("\xef\xbf\xbd", stream);
        else if (strchr("&<>\"'", *at))
            fprintf(stream, "&#%d;", *at);
        else
            fwrite(at, 1, (size_t)size, stream);
        at += size ? size : 1;
    }
}

size_t markup_length(const char *text)
{
    size_t length = 0;
    for (const uint8_t *at = (const uint8_t *)text; *at; length++) {
        int size = utf8_size(at);
        at += size ? size : 1;
    }
    return length;
}

void markup_base64(FILE *stream, const uint8_t *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        size_t left = size - i;
        uint32_t group = (uint32_t)bytes[i] << 16 | (left > 1 ? (uint32_t)bytes[i + 1] << 8 : 0) |
                         (left > 2 ? (uint32_t)bytes[i + 2] : 0);
        putc(digits[group >> 18], stream);
        putc(digits[group >> 12 & 63], stream);
        putc(left > 1 ? digits[group >> 6 & 63] : '=', stream);
        putc(left > 2 ? digits[group & 63] : '=', stream);
    }
}
