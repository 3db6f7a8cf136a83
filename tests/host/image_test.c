/* Image files: bytes as the formats demand, and broken ones refused with their place. */
#include "image.h"
#include "sandbox.h"

static int file_is(const char *name, const void *bytes, size_t size)
{
    char got[200];
    FILE *file = fopen(sandbox_path(name), "rb");
    size_t length = file ? fread(got, 1, sizeof got, file) : 0;
    if (file)
        fclose(file);
    return length == size && memcmp(got, bytes, size) == 0;
}

static void written_bytes(void)
{
    problem why;
    uint8_t grey[6] = {0, 1, 2, 253, 254, 255}, colour[6] = {10, 20, 30, 40, 50, 60};
    uint16_t deep[2] = {0x1234, 0xff01};
    float floats[2] = {1.0f, -2.0f}; /* one column, two rows */
    image g = {3, 2, 1, IMAGE_U8, grey}, c = {2, 1, 3, IMAGE_U8, colour}, d = {2, 1, 1, IMAGE_U16, deep};
    image f = {1, 2, 1, IMAGE_F32, floats};
    ok(image_write(&g, sandbox_path("g.pgm"), &why) == 0 && file_is("g.pgm", "P5\n3 2\n255\n\0\1\2\375\376\377", 17),
       "a_pgm_of_8_bits_has_its_bytes");
    ok(image_write(&c, sandbox_path("c.PPM"), &why) == 0 && file_is("c.PPM", "P6\n2 1\n255\n\12\24\36\50\62\74", 17),
       "a_ppm_has_its_bytes");
    ok(image_write(&d, sandbox_path("d.pgm"), &why) == 0 && file_is("d.pgm", "P5\n2 1\n65535\n\x12\x34\xff\x01", 17),
       "a_pgm_of_16_bits_has_the_high_byte_first");
    const union {
        uint16_t number;
        uint8_t bytes[2];
    } order = {1};
    ok(image_write(&f, sandbox_path("f.pfm"), &why) == 0 &&
           file_is("f.pfm",
                   order.bytes[0] ? "Pf\n1 2\n-1.0\n\0\0\0\xc0\0\0\x80\x3f" : "Pf\n1 2\n1.0\n\xc0\0\0\0\x3f\x80\0\0",
                   order.bytes[0] ? 20 : 19),
       "a_pfm_starts_with_its_bottom_row");
}

static void read_back(void)
{
    problem why;
    image im;
    ok(image_read(&im, sandbox_path("d.pgm"), &why) == 0 && im.width == 2 && im.height == 1 && im.channels == 1 &&
           im.sample == IMAGE_U16 && ((uint16_t *)im.samples)[0] == 0x1234 && ((uint16_t *)im.samples)[1] == 0xff01,
       "16_bits_come_back");
    image_free(&im);
    ok(image_read(&im, sandbox_path("c.PPM"), &why) == 0 && im.channels == 3 && ((uint8_t *)im.samples)[5] == 60,
       "colours_come_back");
    image_free(&im);
    static const char commented[] = "P5 # one\n#two\n2\t#three\n1\r\n255 \0\377";
    ok(image_parse_netpbm(&im, "f", (const uint8_t *)commented, sizeof commented - 1, &why) == 0 && im.width == 2 &&
           im.height == 1 && ((uint8_t *)im.samples)[1] == 255,
       "comments_and_any_blank_may_stand_in_the_header");
    image_free(&im);
    sandbox_write("in-grey.ppm", "P6 2 1 255 \7\7\7\376\376\376", 17);
    ok(image_read_mask(&im, sandbox_path("in-grey.ppm"), &why) == 0 && im.channels == 1 &&
           ((uint8_t *)im.samples)[1] == 254,
       "a_grey_ppm_serves_as_a_mask");
    image_free(&im);
}

static void refused_writes(void)
{
    problem why;
    ok(image_can_write("a.ppm", 1, IMAGE_U8, &why) && strstr(why.text, "expected .pgm"), "grey_is_refused_as_ppm");
    ok(image_can_write("a.pgm", 3, IMAGE_U8, &why) && strstr(why.text, "expected .ppm"), "colour_is_refused_as_pgm");
    ok(image_can_write("a.pfm", 1, IMAGE_U16, &why) && strstr(why.text, "expected .pgm"),
       "integers_are_refused_as_pfm");
    ok(image_can_write("a.pgm", 1, IMAGE_F32, &why) && strstr(why.text, "expected .pfm"), "floats_are_refused_as_pgm");
    ok(image_can_write("a.nonsense", 3, IMAGE_U8, &why) && strstr(why.text, "expected"),
       "an_unknown_extension_is_refused");
    /* No test has the bridge to OpenImageIO in its folder. With it: tests/host/command_line_test.sh. */
    ok(image_can_write("a.png", 3, IMAGE_U8, &why) && strstr(why.text, "install libopenimageio-dev and rebuild"),
       "png_without_openimageio_says_what_to_install");
}

#define BYTES(string) string, sizeof string - 1

static const struct {
    const char *promise, *bytes;
    size_t size;
    const char *where, *what;
} broken[] = {
    {"an_empty_file", BYTES(""), ": byte 0", "no binary PGM"},
    {"one_letter", BYTES("P"), ": byte 0", "no binary PGM"},
    {"text", BYTES("hello"), ": byte 0", "no binary PGM"},
    {"a_plain_pgm", BYTES("P2\n1 1\n255\n7\n"), ": byte 0", "no binary PGM"},
    {"a_plain_ppm", BYTES("P3\n1 1\n255\n7 7 7\n"), ": byte 0", "no binary PGM"},
    {"a_bitmap", BYTES("P4\n1 1\n\0"), ": byte 0", "no binary PGM"},
    {"a_pam", BYTES("P7\nWIDTH 1\n"), ": byte 0", "no binary PGM"},
    {"a_number_stuck_to_the_magic", BYTES("P51 1 255 \7"), ": byte 2", "no blank after P5"},
    {"nothing_after_the_magic", BYTES("P5"), ": byte 2", "no blank after P5"},
    {"no_width", BYTES("P5\n"), ": byte 3", "ends before its width"},
    {"no_height", BYTES("P5\n3"), ": byte 4", "ends before its height"},
    {"no_largest_sample", BYTES("P5\n3 2\n"), ": byte 7", "ends before its largest sample"},
    {"no_samples", BYTES("P5\n3 2\n255"), ": byte 10", "no blank after the header"},
    {"a_comment_without_end", BYTES("P5\n3 2 # wide"), ": byte 13", "ends before its largest sample"},
    {"a_word_for_the_width", BYTES("P5\nthree 2\n255\n"), ": byte 3", "no number where the width"},
    {"a_word_for_the_height", BYTES("P5\n3 two\n255\n"), ": byte 5", "no number where the height"},
    {"a_negative_width", BYTES("P5\n-3 2\n255\n"), ": byte 3", "no number where the width"},
    {"a_sign_before_the_height", BYTES("P5\n3 +2\n255\n"), ": byte 5", "no number where the height"},
    {"a_fraction_for_the_width", BYTES("P5\n3.5 2\n255\n"), ": byte 4", "no number where the height"},
    {"a_width_of_zero", BYTES("P5\n0 2\n255\n"), ": byte 3", "width is out of range"},
    {"a_height_of_zero", BYTES("P5\n3 0\n255\n"), ": byte 5", "height is out of range"},
    {"a_width_of_4097", BYTES("P5\n4097 2\n255\n"), ": byte 3", "width is out of range"},
    {"a_height_beyond_32_bits", BYTES("P5\n3 4294967298\n255\n"), ": byte 5", "height is out of range"},
    {"a_width_beyond_64_bits", BYTES("P5\n99999999999999999999999 2\n255\n"), ": byte 3", "width is out of range"},
    {"a_largest_sample_of_zero", BYTES("P5\n1 1\n0\n\0"), ": byte 7", "largest sample is out of range"},
    {"a_largest_sample_of_65536", BYTES("P5\n1 1\n65536\n\0\0"), ": byte 7", "largest sample is out of range"},
    {"a_largest_sample_of_100", BYTES("P5\n1 1\n100\n\7"), ": byte 10", "expected 255 or 65535"},
    {"a_letter_after_the_header", BYTES("P5\n1 1\n255x\7"), ": byte 10", "no blank after the header"},
    {"a_sample_too_few", BYTES("P5\n3 2\n255\n12345"), ": byte 16", "5 bytes of samples; expected 6"},
    {"a_sample_too_many", BYTES("P5\n3 2\n255\n1234567"), ": byte 18", "7 bytes of samples; expected 6"},
    {"half_a_sample", BYTES("P5\n1 1\n65535\n1"), ": byte 14", "1 bytes of samples; expected 2"},
    {"a_colour_too_few", BYTES("P6\n1 1\n255\n12"), ": byte 13", "2 bytes of samples; expected 3"},
    {"a_mask_of_16_bits", BYTES("P5\n1 1\n65535\n12"), "", "more than 8 bits"},
    {"a_coloured_mask", BYTES("P6\n2 1\n255\n777778"), "", "coloured at pixel 1, 0"},
};

static void broken_files(void)
{
    sandbox_write("in-truth.pgm", "P5\n2 1\n255\n\0\376", 13);
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++) {
        sandbox_write("in.pgm", broken[i].bytes, broken[i].size);
        const char *arguments[] = {sandbox_path("in.pgm"),
                                   sandbox_path("in-truth.pgm"),
                                   "--difference",
                                   sandbox_path("out.ppm"),
                                   "--json",
                                   sandbox_path("out.json"),
                                   0};
        int status = sandbox_run(command_compare, arguments);
        ok(sandbox_refused(status, "in.pgm", broken[i].where, broken[i].what), "%s_is_refused_with_its_place",
           broken[i].promise);
    }
}

int main(void)
{
    sandbox_open();
    broken_files();
    written_bytes();
    read_back();
    refused_writes();
    sandbox_close();
    return tap_done();
}
