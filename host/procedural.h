/* Twelve test scenes made from a few lines of geometry each, so that no mesh has to be kept or licensed.
 *
 * They imitate the figures of the shadow-map papers, and are not those papers' data: an L-shaped block, two
 * tori, a factory hall, a table, pipes, bowling pins, a crowd, a castle, a conference room, leaves and curtains, a
 * picket fence at low sun, a colonnade seen along its length. They were made public (CC0) as a Python program, gen.py;
 * this is that program in C, byte for byte: numbers are printed with %g and %.9g, random ones come from CPython's
 * generator.
 *
 * Byte identity asks for IEEE doubles evaluated as written: compile with -ffp-contract=off and without -ffast-math,
 * where FLT_EVAL_METHOD is 0 (x86 of 32 bits: -msse2 -mfpmath=sse), and stay in the "C" locale. sin, cos, log and sqrt
 * are libm's; nine printed digits hide most, but not all, of a last-bit difference (a sum that cancels prints its
 * rounding error). tests/host/procedural_test.sh knows the checksums.
 *
 * Not here: textures, normals, models with a transformation (each mesh stands in world units). */
#ifndef PROCEDURAL_H
#define PROCEDURAL_H

extern const char *const procedural_names[]; /* lshape, torus2, ... colonnade */
extern const int procedural_count;           /* twelve */

/* Write NAME.scene and the OBJ files that it names into folder, which must exist.
 * Each file is written under a temporary name and renamed when complete, the scene last: after a failure no file is
 * half written, and no new scene names a mesh that is missing. Up to 0.7 MB of files and 2 MB of heap, freed.
 * Returns 0, or -1 with errno set: EINVAL for a name that is not among the twelve, ENOMEM, or what the file system
 * says. */
int procedural_write(const char *name, const char *folder);

/* Write NAME_viewSEED.scene and the same OBJ files into folder: another camera around the scene's target (2 to 50
 * degrees above the horizon, 0.6 to 1.2 of the distance) and another light (20 to 70 degrees above the horizon), drawn
 * from the seed until the view shows both lit and shadowed surface. A millisecond to some seconds, by the scene's size.
 * Returns and errors as above, and EDOM: no such view was found. */
int procedural_write_view(const char *name, unsigned seed, const char *folder);

#endif
