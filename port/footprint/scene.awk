# Writes the scene that the memory figures are stated for: 1,000 triangles in closed meshes, a torus of 26 x 19 quads
# over a slab.
#
#     awk -v folder=FOLDER -f scene.awk
BEGIN {
    turn = 8 * atan2(1, 1)
    around = 26
    across = 19
    torus = folder "/torus.obj"
    for (i = 0; i < around; i++) {
        for (j = 0; j < across; j++) {
            radius = 2 + 0.8 * cos(turn * j / across)
            printf "v %.6f %.6f %.6f\n", radius * cos(turn * i / around), 1.5 + 0.8 * sin(turn * j / across),
                radius * sin(turn * i / around) > torus
        }
    }
    for (i = 0; i < around; i++) {
        for (j = 0; j < across; j++) {
            next_i = (i + 1) % around * across + 1
            next_j = (j + 1) % across
            this_i = i * across + 1
            printf "f %d %d %d %d\n", this_i + j, this_i + next_j, next_i + next_j, next_i + j > torus
        }
    }

    slab = folder "/slab.obj"
    for (i = 0; i < 8; i++)
        printf "v %d %.1f %d\n", (i % 2 ? 4 : -4), (int(i / 2) % 2 ? 0 : -0.2), (i < 4 ? -4 : 4) > slab
    print "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6" > slab

    scene = folder "/footprint.scene"
    print "image 320 240" > scene
    print "map 128" > scene
    print "camera perspective eye 6 6 7 target 0 0.8 0 up 0 1 0 fovy 38 near 1 far 30" > scene
    print "light directional direction -0.4 -1 -0.3" > scene
    print "ambient 0.2" > scene
    print "mesh slab.obj surface closed color .5 .6 .5" > scene
    print "mesh torus.obj surface closed color .9 .8 .7" > scene
}
