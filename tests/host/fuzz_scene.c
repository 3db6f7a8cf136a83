/* Any bytes as a scene file: no crash. */
#include "fuzz.h"
#include "scene_file.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    scene_file scene;
    problem why;
    char *text = calloc(size + 1, 1);
    memcpy(text, bytes, size);
    scene_file_parse(&scene, "fuzz", text, size, &why);
    scene_file_free(&scene);
    free(text);
    return 0;
}

#ifndef GNOMON_LIBFUZZER
int main(int argc, char **argv)
{
    static const char good[] = "# a\nimage 8 6\nmap 16 8\nambient .2\n"
                               "camera perspective eye 0 5 9 target 0 0 0 up 0 1 0 fovy 40 near 1 far 99\n"
                               "light spot position 0 9 0 target 0 0 0 up 1 0 0 fovy 60 near 2 far 20\n"
                               "mesh in.obj surface open color 1 1 1 scale 2 rotate 0 1 0 90 translate 1 2 3\n";
    fuzz_run("changed_scene_files_never_crash_the_reader", (const uint8_t *)good, sizeof good - 1,
             tap_cases(argc, argv, TAP_SLOWER * 20000));
    return tap_done();
}
#endif
