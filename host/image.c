#include "image.h"

#include "file.h"
#include "memory.h"
#include "oiio.h"

#include <stdlib.h>
#include <string.h>

enum { LARGEST_SIZE = 4096 };

#define NEEDS_OIIO                                                                                                     \
    "there is no " OIIO_FILE " with OpenImageIO beside this simulator; expected .ppm, .pgm or .pfm, or install "       \
    "libopenimageio-dev and rebuild"

image image_make(uint32_t width, uint32_t height, uint32_t channels, image_sample sample)
{
    image im = {width, height, channels, sample, 0};
    im.samples = memory_take(image_sample_count(&im), sample);
    return im;
}

void image_free(image *im)
{
    free(im->samples);
    im->samples = 0;
}

/* ---- writing --------------------------------------------------------------------------------------------------- */

int image_can_write(const char *path, uint32_t channels, image_sample sample, problem *why)
{
    int pgm = file_has_extension(path, ".pgm"), ppm = file_has_extension(path, ".ppm");
    if ((pgm && channels != 1) || (ppm && channels != 3))
        return problem_in(why, path, "holds %s here; expected %s", channels == 1 ? "grey" : "colour",
                          pgm ? ".ppm" : ".pgm");
    if ((pgm || ppm) && sample == IMAGE_F32)
        return problem_in(why, path, "cannot hold floats; expected .pfm");
    if (file_has_extension(path, ".pfm") && sample != IMAGE_F32)
        return problem_in(why, path, "holds floats only; expected %s", channels == 1 ? ".pgm" : ".ppm");
    if (pgm || ppm || file_has_extension(path, ".pfm"))
        return file_can_write(path, why);
    const oiio_door *oiio = oiio_open();
    if (!oiio)
        return problem_in(why, path, NEEDS_OIIO);
    if (!oiio->can_write(path))
        return problem_in(why, path,
                          "is no image format that can be written; expected .ppm, .pgm, .pfm, .png, .exr, .tif, ...");
    return file_can_write(path, why);
}

/* Netpbm wants the most significant byte first. */
static void write_netpbm(const image *im, FILE *stream)
{
    size_t row = (size_t)im->width * im->channels;
    fprintf(stream, "P%d\n%u %u\n%d\n", im->channels == 1 ? 5 : 6, im->width, im->height,
            im->sample == IMAGE_U8 ? 255 : 65535);
    if (im->sample == IMAGE_U8) {
        fwrite(im->samples, 1, row * im->height, stream);
        return;
    }
    const uint16_t *samples = im->samples;
    for (size_t i = 0; i < row * im->height; i++) {
        putc(samples[i] >> 8, stream);
        putc(samples[i] & 255, stream);
    }
}

/* Bottom row first; the sign of the scale tells the byte order: negative is little-endian. */
static void write_pfm(const image *im, FILE *stream)
{
    const union {
        uint16_t number;
        uint8_t bytes[2];
    } order = {1};
    size_t row = (size_t)im->width * im->channels;
    fprintf(stream, "%s\n%u %u\n%s\n", im->channels == 1 ? "Pf" : "PF", im->width, im->height,
            order.bytes[0] ? "-1.0" : "1.0");
    for (uint32_t y = im->height; y-- > 0;)
        fwrite((const float *)im->samples + y * row, sizeof(float), row, stream);
}

static int write_native(const image *im, const char *path, problem *why)
{
    file_output output;
    if (file_output_open(&output, path, why))
        return -1;
    if (im->sample == IMAGE_F32)
        write_pfm(im, output.stream);
    else
        write_netpbm(im, output.stream);
    return file_output_finish(&output, why);
}

int image_write(const image *im, const char *path, problem *why)
{
    if (image_can_write(path, im->channels, im->sample, why))
        return -1;
    if (file_has_extension(path, ".pgm") || file_has_extension(path, ".ppm") || file_has_extension(path, ".pfm"))
        return write_native(im, path, why);
    file_output output;
    char message[400];
    if (file_output_name(&output, path, why))
        return -1;
    if (oiio_open()->write(im, output.temporary, message, sizeof message)) {
        file_output_abandon(&output);
        return problem_in(why, path, "cannot be written: %s; expected a format that holds it", message);
    }
    return file_output_finish(&output, why);
}

/* ---- reading --------------------------------------------------------------------------------------------------- */

typedef struct header {
    const char *file;
    const uint8_t *bytes;
    size_t size, at;
    problem *why;
} header;

static int is_blank(uint8_t c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

/* A decimal number of the header, after blanks and comments. */
static int header_number(header *h, const char *what, long least, long most, uint32_t *number)
{
    while (h->at < h->size && (is_blank(h->bytes[h->at]) || h->bytes[h->at] == '#')) {
        int comment = h->bytes[h->at] == '#';
        while (comment && h->at < h->size && h->bytes[h->at] != '\n')
            h->at++;
        h->at += h->at < h->size;
    }
    size_t start = h->at;
    long value = 0;
    for (; h->at < h->size && h->bytes[h->at] >= '0' && h->bytes[h->at] <= '9'; h->at++)
        if (value <= most)
            value = 10 * value + (h->bytes[h->at] - '0');
    if (h->at == start && start == h->size)
        return problem_at_byte(h->why, h->file, start, "the file ends before its %s; expected %ld to %ld", what, least,
                               most);
    if (h->at == start)
        return problem_at_byte(h->why, h->file, start, "no number where the %s should be; expected %ld to %ld", what,
                               least, most);
    if (value < least || value > most)
        return problem_at_byte(h->why, h->file, start, "%s is out of range; expected %ld to %ld", what, least, most);
    *number = (uint32_t)value;
    return 0;
}

static int copy_samples(image *im, const header *h, uint32_t most)
{
    size_t count = image_sample_count(im), bytes = count * im->sample;
    if (h->size - h->at != bytes)
        return problem_at_byte(h->why, h->file, h->size, "the file holds %zu bytes of samples; expected %zu",
                               h->size - h->at, bytes);
    im->samples = memory_take(count, im->sample);
    const uint8_t *from = h->bytes + h->at;
    for (size_t i = 0; i < count; i++) {
        unsigned sample = im->sample == IMAGE_U8 ? from[i] : (unsigned)from[2 * i] << 8 | from[2 * i + 1];
        if (sample > most) {
            image_free(im);
            return problem_at_byte(h->why, h->file, h->at + i * im->sample,
                                   "sample %u is above the largest, %u; expected less", sample, most);
        }
        if (im->sample == IMAGE_U8)
            ((uint8_t *)im->samples)[i] = (uint8_t)sample;
        else
            ((uint16_t *)im->samples)[i] = (uint16_t)sample;
    }
    return 0;
}

int image_parse_netpbm(image *im, const char *file, const uint8_t *bytes, size_t size, problem *why)
{
    header h = {file, bytes, size, 2, why};
    uint32_t most;
    memset(im, 0, sizeof *im);
    if (size < 2 || bytes[0] != 'P' || (bytes[1] != '5' && bytes[1] != '6'))
        return problem_at_byte(why, file, 0, "is no binary PGM or PPM; expected it to start with P5 or P6");
    if (size < 3 || (!is_blank(bytes[2]) && bytes[2] != '#'))
        return problem_at_byte(why, file, 2, "no blank after P%c; expected one", bytes[1]);
    im->channels = bytes[1] == '5' ? 1 : 3;
    if (header_number(&h, "width", 1, LARGEST_SIZE, &im->width) ||
        header_number(&h, "height", 1, LARGEST_SIZE, &im->height) ||
        header_number(&h, "largest sample", 1, 65535, &most))
        return -1;
    if (most != 255 && most != 65535)
        return problem_at_byte(why, file, h.at, "the largest sample is %u; expected 255 or 65535", most);
    im->sample = most == 255 ? IMAGE_U8 : IMAGE_U16;
    if (h.at >= size || !is_blank(bytes[h.at]))
        return problem_at_byte(why, file, h.at, "no blank after the header; expected one, then the samples");
    h.at++;
    return copy_samples(im, &h, most);
}

static int read_with_library(image *im, const char *path, problem *why)
{
    const oiio_door *oiio = oiio_open();
    char message[400];
    if (!oiio)
        return problem_in(why, path, NEEDS_OIIO);
    if (oiio->read_size(im, path, message, sizeof message))
        return problem_in(why, path, "cannot be read: %s; expected an image", message);
    if (im->width < 1 || im->width > LARGEST_SIZE || im->height < 1 || im->height > LARGEST_SIZE)
        return problem_in(why, path, "is %u x %u pixels; expected 1 to %d each way", im->width, im->height,
                          LARGEST_SIZE);
    if (im->channels != 1 && im->channels != 3)
        return problem_in(why, path, "has %u channels; expected 1 or 3", im->channels);
    im->samples = memory_take(image_sample_count(im), im->sample);
    if (oiio->read_samples(im, path, message, sizeof message)) {
        image_free(im);
        return problem_in(why, path, "cannot be read: %s; expected an image", message);
    }
    return 0;
}

int image_read(image *im, const char *path, problem *why)
{
    file_content content;
    memset(im, 0, sizeof *im);
    if (file_read(&content, path, why))
        return -1;
    int known = !file_has_extension(path, ".pgm") && !file_has_extension(path, ".ppm") &&
                !(content.size >= 2 && content.bytes[0] == 'P' && content.bytes[1] >= '1' && content.bytes[1] <= '7');
    int result =
        known ? read_with_library(im, path, why) : image_parse_netpbm(im, path, content.bytes, content.size, why);
    free(content.bytes);
    return result;
}

int image_read_mask(image *im, const char *path, problem *why)
{
    if (image_read(im, path, why))
        return -1;
    if (im->sample != IMAGE_U8) {
        image_free(im);
        return problem_in(why, path, "has more than 8 bits a sample; expected a mask of 8 bits");
    }
    if (im->channels == 1)
        return 0;
    uint8_t *samples = im->samples;
    for (size_t i = 0; i < (size_t)im->width * im->height; i++) {
        const uint8_t *p = samples + 3 * i;
        if (p[0] != p[1] || p[1] != p[2]) {
            image_free(im);
            return problem_in(why, path, "is coloured at pixel %u, %u; expected a grey mask", (unsigned)(i % im->width),
                              (unsigned)(i / im->width));
        }
        samples[i] = p[0];
    }
    im->channels = 1;
    return 0;
}
