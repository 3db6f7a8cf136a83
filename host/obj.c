#include "obj.h"

#include "file.h"
#include "memory.h"
#include "text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ELEMENTS = 0x7fffffff };
static const double LARGEST_COORDINATE = 1e12;

typedef struct reader {
    obj_mesh *mesh;
    text text;
    problem *why;
    size_t position_capacity, triangle_capacity;
    long texture_count, normal_count;
} reader;

/* One number of a vertex: `index` from 0, of which `least` must be there. 1 if there is one more. */
static int read_number(reader *r, const char *what, int index, int least, double *number)
{
    word w;
    if (!text_next_word(&r->text, &w)) {
        if (index >= least)
            return 0;
        return problem_at(r->why, r->text.file, r->text.line, "%s has %d numbers; expected at least %d", what, index,
                          least);
    }
    if (word_number(w, number))
        return problem_at(r->why, r->text.file, r->text.line, "'%s' is not a number; expected a decimal number",
                          word_shown(w).text);
    return 1;
}

static int read_position(reader *r)
{
    obj_mesh *mesh = r->mesh;
    mesh->positions =
        memory_grow(mesh->positions, &r->position_capacity, mesh->position_count + 1, sizeof *mesh->positions);
    for (int i = 0;; i++) {
        double number;
        int more = read_number(r, "vertex", i, 3, &number);
        if (more < 0)
            return -1;
        if (!more)
            break;
        if (i == 7)
            return problem_at(r->why, r->text.file, r->text.line,
                              "vertex has more than 7 numbers; expected x y z [w] or x y z r g b");
        if (i < 3 && fabs(number) > LARGEST_COORDINATE)
            return problem_at(r->why, r->text.file, r->text.line, "coordinate %g is too large; expected at most 1e12",
                              number);
        if (i < 3)
            mesh->positions[mesh->position_count][i] = number;
    }
    if (++mesh->position_count > MOST_ELEMENTS)
        return problem_at(r->why, r->text.file, r->text.line, "too many vertices; expected at most 2147483647");
    return 0;
}

/* vt or vn: only counted, so that references to them can be checked. */
static int read_attribute(reader *r, const char *what, int least, long *count)
{
    double number;
    int more = 1;
    for (int i = 0; more > 0; i++)
        more = read_number(r, what, i, least, &number);
    ++*count;
    return more;
}

/* Whole number at *at up to a slash or the end; 0, or -1 if there is none. */
static int take_integer(const char **at, const char *end, long *number)
{
    const char *slash = memchr(*at, '/', (size_t)(end - *at));
    word part = {*at, (size_t)((slash ? slash : end) - *at)};
    *at += part.length;
    return word_integer(part, number);
}

/* A reference, from 1 or negative from the end, as an index from 0. */
static int resolve(reader *r, const char *what, long reference, long count, long *index)
{
    if (reference >= 1 && reference <= count)
        *index = reference - 1;
    else if (reference < 0 && reference >= -count)
        *index = count + reference;
    else if (!count)
        return problem_at(r->why, r->text.file, r->text.line,
                          "%s %ld does not exist; expected none, since no %s was defined so far", what, reference,
                          what);
    else
        return problem_at(r->why, r->text.file, r->text.line,
                          "%s %ld does not exist; expected 1 to %ld or -1 to -%ld, those defined so far", what,
                          reference, count, count);
    return 0;
}

static int bad_corner(reader *r, word w)
{
    return problem_at(r->why, r->text.file, r->text.line,
                      "'%s' is not a corner of a face; expected v, v/vt, v//vn or v/vt/vn", word_shown(w).text);
}

static int read_corner(reader *r, word w, uint32_t *vertex)
{
    const char *at = w.start, *end = w.start + w.length;
    long reference, index = 0, ignored;
    if (take_integer(&at, end, &reference))
        return bad_corner(r, w);
    if (resolve(r, "vertex", reference, (long)r->mesh->position_count, &index))
        return -1;
    *vertex = (uint32_t)index;
    if (at == end)
        return 0;
    at++;
    if (at == end)
        return bad_corner(r, w);
    if (*at != '/') {
        if (take_integer(&at, end, &reference))
            return bad_corner(r, w);
        if (resolve(r, "texture coordinate", reference, r->texture_count, &ignored))
            return -1;
        if (at == end)
            return 0;
    }
    at++;
    if (take_integer(&at, end, &reference) || at != end)
        return bad_corner(r, w);
    return resolve(r, "normal", reference, r->normal_count, &ignored);
}

static int read_face(reader *r)
{
    obj_mesh *mesh = r->mesh;
    uint32_t first = 0, previous = 0;
    size_t corners = 0;
    word w;
    for (; text_next_word(&r->text, &w); corners++) {
        uint32_t vertex = 0;
        if (read_corner(r, w, &vertex))
            return -1;
        if (corners == 0)
            first = vertex;
        if (corners >= 2) {
            mesh->triangles =
                memory_grow(mesh->triangles, &r->triangle_capacity, mesh->triangle_count + 1, sizeof *mesh->triangles);
            uint32_t *triangle = mesh->triangles[mesh->triangle_count++];
            triangle[0] = first;
            triangle[1] = previous;
            triangle[2] = vertex;
        }
        previous = vertex;
    }
    if (corners < 3)
        return problem_at(r->why, r->text.file, r->text.line, "face has %zu corners; expected at least 3", corners);
    if (mesh->triangle_count > MOST_ELEMENTS)
        return problem_at(r->why, r->text.file, r->text.line, "too many triangles; expected at most 2147483647");
    return 0;
}

int obj_parse(obj_mesh *mesh, const char *file, const char *bytes, size_t size, problem *why)
{
    memset(mesh, 0, sizeof *mesh);
    reader r = {.mesh = mesh, .text = text_of(file, bytes, size, 1), .why = why};
    const char *zero = memchr(bytes, 0, size);
    word w;
    int result = 0;
    if (zero)
        return problem_at_byte(why, file, (size_t)(zero - bytes), "a zero byte; expected text");
    while (!result && text_next_statement(&r.text)) {
        text_next_word(&r.text, &w);
        if (word_is(w, "v"))
            result = read_position(&r);
        else if (word_is(w, "vt"))
            result = read_attribute(&r, "texture coordinate", 1, &r.texture_count);
        else if (word_is(w, "vn"))
            result = read_attribute(&r, "normal", 3, &r.normal_count);
        else if (word_is(w, "f"))
            result = read_face(&r);
    }
    if (!result && !mesh->triangle_count)
        result = problem_at(why, file, r.text.line, "the file ends without a face; expected at least one 'f' line");
    return result;
}

int obj_read(obj_mesh *mesh, const char *path, problem *why)
{
    file_content content;
    memset(mesh, 0, sizeof *mesh);
    if (file_read(&content, path, why))
        return -1;
    int result = obj_parse(mesh, path, (const char *)content.bytes, content.size, why);
    free(content.bytes);
    return result;
}

void obj_free(obj_mesh *mesh)
{
    free(mesh->positions);
    free(mesh->triangles);
    memset(mesh, 0, sizeof *mesh);
}
