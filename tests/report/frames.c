/* How steady masks are over a sequence of frames (tests/report/stability_frames.sh).
 *
 *     frames TRUTH MASK COUNT
 *
 * Reads TRUTH.K.pgm and MASK.K.pgm, K from 0 to COUNT - 1, 8-bit grey: 0 shadowed to 254 lit, 255 no surface. Of two
 * neighbouring frames those pixels count that see a surface in both truths and both masks, and whose truth does not
 * change; of these flicker those whose answer does. One line on standard output: flicker in per cent, mean and of the
 * worst pair; error in per cent of the surface, mean and of the worst frame. Exit status: 0 done, 2 bad input. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct picture {
    int width, height;
    unsigned char *grey;
} picture;

static picture read_picture(const char *prefix, int number)
{
    char name[4096];
    picture p = {0, 0, 0};
    if (snprintf(name, sizeof name, "%s.%d.pgm", prefix, number) >= (int)sizeof name)
        exit(2);
    FILE *file = fopen(name, "rb");
    if (!file || fscanf(file, "P5 %d %d 255", &p.width, &p.height) != 2 || fgetc(file) == EOF || p.width < 1 ||
        p.height < 1 || p.width > 4096 || p.height > 4096) {
        fprintf(stderr, "%s: not an 8-bit grey picture\n", name);
        exit(2);
    }
    size_t pixels = (size_t)p.width * (size_t)p.height;
    p.grey = malloc(pixels);
    if (!p.grey || fread(p.grey, 1, pixels, file) != pixels) {
        fprintf(stderr, "%s: shorter than its size\n", name);
        exit(2);
    }
    fclose(file);
    return p;
}

static int is_lit(unsigned char grey)
{
    return grey >= 127;
}

typedef struct share {
    double sum, worst;
    int count;
} share;

static void add(share *s, size_t part, size_t whole)
{
    double percent = whole ? 100.0 * (double)part / (double)whole : 0;
    s->sum += percent;
    s->worst = percent > s->worst ? percent : s->worst;
    s->count++;
}

static share errors, flicker;

static void compare(const picture truth[2], const picture mask[2], int first)
{
    size_t pixels = (size_t)truth[1].width * (size_t)truth[1].height, seen = 0, wrong = 0, steady = 0, changed = 0;
    for (size_t i = 0; i < pixels; i++) {
        unsigned char t = truth[1].grey[i], m = mask[1].grey[i];
        if (t == 255 || m == 255)
            continue;
        seen++;
        wrong += is_lit(t) != is_lit(m);
        if (first || truth[0].grey[i] == 255 || mask[0].grey[i] == 255 || is_lit(truth[0].grey[i]) != is_lit(t))
            continue;
        steady++;
        changed += is_lit(mask[0].grey[i]) != is_lit(m);
    }
    add(&errors, wrong, seen);
    if (!first)
        add(&flicker, changed, steady);
}

int main(int argc, char **argv)
{
    picture truth[2] = {{0, 0, 0}}, mask[2] = {{0, 0, 0}};
    int count = argc == 4 ? atoi(argv[3]) : 0;
    if (count < 2) {
        fprintf(stderr, "usage: frames TRUTH MASK COUNT\n");
        return 2;
    }
    for (int i = 0; i < count; i++) {
        if (i) {
            if (i > 1) {
                free(truth[0].grey);
                free(mask[0].grey);
            }
            truth[0] = truth[1];
            mask[0] = mask[1];
        }
        truth[1] = read_picture(argv[1], i);
        mask[1] = read_picture(argv[2], i);
        if (truth[1].width != mask[1].width || truth[1].height != mask[1].height) {
            fprintf(stderr, "%s, %s: %d: sizes differ\n", argv[1], argv[2], i);
            return 2;
        }
        compare(truth, mask, i == 0);
    }
    printf("%.4f %.4f %.4f %.4f\n", flicker.sum / flicker.count, flicker.worst, errors.sum / errors.count,
           errors.worst);
    return 0;
}
