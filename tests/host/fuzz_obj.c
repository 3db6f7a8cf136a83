/* Any bytes as an OBJ file: no crash, and every triangle that comes out names vertices that exist. */
#include "closed_mesh.h"
#include "fuzz.h"
#include "obj.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    obj_mesh mesh;
    problem why;
    char *text = calloc(size + 1, 1);
    memcpy(text, bytes, size);
    if (obj_parse(&mesh, "fuzz", text, size, &why) == 0)
        check_closed_mesh(&mesh);
    for (size_t i = 0; i < 3 * mesh.triangle_count; i++)
        if (mesh.triangles[i / 3][i % 3] >= mesh.position_count)
            abort();
    obj_free(&mesh);
    free(text);
    return 0;
}

#ifndef GNOMON_LIBFUZZER
int main(int argc, char **argv)
{
    static const char good[] =
        "# a\nv 0 0 0\nv 1 0 .5\nv 0 1 0 1\nv 1e0 -1 2\nvt 0 0\nvn 0 0 1\nf 1 2 3\nf 1/1 2//1 3/1/1 \\\n-1\n";
    fuzz_run("changed_obj_files_never_crash_the_reader", (const uint8_t *)good, sizeof good - 1,
             tap_cases(argc, argv, TAP_SLOWER * 20000));
    return tap_done();
}
#endif
