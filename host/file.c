#include "file.h"

#include "memory.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { LARGEST_FILE = 0x7fffffff };

static int read_stream(file_content *content, FILE *stream, const char *path, problem *why)
{
    size_t capacity = 0;
    for (;;) {
        content->bytes = memory_grow(content->bytes, &capacity, content->size + 65536, 1);
        size_t got = fread(content->bytes + content->size, 1, capacity - content->size - 1, stream);
        content->size += got;
        if (!got)
            break;
        if (content->size > LARGEST_FILE)
            return problem_in(why, path, "is larger than 2 GiB; expected a smaller file");
    }
    if (ferror(stream))
        return problem_in(why, path, "cannot be read: %s; expected a file that can be read", strerror(errno));
    content->bytes[content->size] = 0;
    return 0;
}

int file_read(file_content *content, const char *path, problem *why)
{
    struct stat status;
    content->bytes = 0;
    content->size = 0;
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return problem_in(why, path, "cannot be opened: %s; expected a file that can be read", strerror(errno));
    int result = fstat(fileno(stream), &status) == 0 && S_ISDIR(status.st_mode)
                     ? problem_in(why, path, "is a folder; expected a file")
                     : read_stream(content, stream, path, why);
    fclose(stream);
    if (result) {
        free(content->bytes);
        content->bytes = 0;
    }
    return result;
}

static void release(file_output *output)
{
    free(output->path);
    free(output->temporary);
    output->stream = 0;
    output->path = output->temporary = 0;
}

int file_can_write(const char *path, problem *why)
{
    file_output output;
    if (file_output_name(&output, path, why))
        return -1;
    char *slash = strrchr(output.temporary, '/');
    const char *place = strcmp(output.path, output.temporary) == 0 ? path : slash ? output.temporary : ".";
    if (slash && place == output.temporary)
        slash[1] = 0;
    int result =
        access(place, W_OK) == 0
            ? 0
            : problem_in(why, path, "cannot be written: %s; expected a place that can be written", strerror(errno));
    release(&output);
    return result;
}

static const char *last_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* Status of the folder that the path's last name is in. */
static int folder_status(const char *path, struct stat *status)
{
    size_t length = (size_t)(last_name(path) - path);
    char *folder = memory_take(length + 2, 1);
    memcpy(folder, length ? path : ".", length ? length : 1);
    int result = stat(folder, status);
    free(folder);
    return result;
}

static int is_one(const struct stat *a, const struct stat *b)
{
    return a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

/* One name in one folder, or one file under two names. */
static int is_same_file(const char *a, const char *b)
{
    struct stat status_a, status_b;
    int has_a = stat(a, &status_a) == 0, has_b = stat(b, &status_b) == 0;
    if (has_a && has_b)
        return S_ISREG(status_a.st_mode) && is_one(&status_a, &status_b);
    return !has_a && !has_b && strcmp(last_name(a), last_name(b)) == 0 && folder_status(a, &status_a) == 0 &&
           folder_status(b, &status_b) == 0 && is_one(&status_a, &status_b);
}

int file_check_distinct(const char *const outputs[], int output_count, const char *const inputs[], int input_count,
                        problem *why)
{
    for (int i = 0; i < output_count; i++) {
        for (int k = 0; outputs[i] && k < i; k++)
            if (outputs[k] && is_same_file(outputs[i], outputs[k]))
                return problem_in(why, outputs[i], "is two outputs at once; expected a file of its own for each");
        for (int k = 0; outputs[i] && k < input_count; k++)
            if (inputs[k] && is_same_file(outputs[i], inputs[k]))
                return problem_in(why, outputs[i], "is read, and would be overwritten; expected another file to write");
    }
    return 0;
}

int file_output_name(file_output *output, const char *path, problem *why)
{
    struct stat status;
    output->stream = 0;
    output->path = output->temporary = 0;
    if (!*path)
        return problem_of_usage(why, "an output file has an empty name");
    size_t length = strlen(path), room = length + 40;
    const char *slash = strrchr(path, '/');
    size_t folder = slash ? (size_t)(slash - path) + 1 : 0;
    int exists = stat(path, &status) == 0;
    if (exists && S_ISDIR(status.st_mode))
        return problem_in(why, path, "is a folder; expected the name of a file to write");
    output->path = memory_take(length + 1, 1);
    memcpy(output->path, path, length);
    output->temporary = memory_take(room, 1);
    /* to a file a link may lead as well, and a rename would take the link's place */
    if (exists && lstat(path, &status) == 0 && !S_ISREG(status.st_mode))
        memcpy(output->temporary, path, length);
    else /* the extension stays last: image libraries go by it */
        snprintf(output->temporary, room, "%.*s.%ld-%s", (int)folder, path, (long)getpid(), path + folder);
    return 0;
}

int file_output_open(file_output *output, const char *path, problem *why)
{
    if (file_output_name(output, path, why))
        return -1;
    output->stream = fopen(output->temporary, "wb");
    if (output->stream)
        return 0;
    problem_in(why, path, "cannot be written: %s; expected a place that can be written", strerror(errno));
    free(output->path);
    free(output->temporary);
    return -1;
}

void file_output_abandon(file_output *output)
{
    if (!output->temporary)
        return;
    if (output->stream)
        fclose(output->stream);
    if (strcmp(output->path, output->temporary) != 0)
        unlink(output->temporary);
    release(output);
}

int file_output_finish(file_output *output, problem *why)
{
    int failed = 0;
    if (output->stream) {
        failed = ferror(output->stream) != 0;
        failed |= fclose(output->stream) != 0;
        output->stream = 0;
    }
    if (!failed && strcmp(output->path, output->temporary) != 0)
        failed = rename(output->temporary, output->path) != 0;
    if (failed) {
        problem_in(why, output->path, "cannot be written: %s; expected a place that can be written", strerror(errno));
        file_output_abandon(output);
        return -1;
    }
    release(output);
    return 0;
}

int file_has_extension(const char *path, const char *extension)
{
    size_t length = strlen(path), tail = strlen(extension);
    if (length <= tail)
        return 0;
    for (size_t i = 0; i < tail; i++)
        if (tolower((unsigned char)path[length - tail + i]) != extension[i])
            return 0;
    return 1;
}
