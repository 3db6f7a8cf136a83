/* A temporary folder in which commands of the simulator run in this process, and what is checked about a refusal. */
#ifndef SANDBOX_H
#define SANDBOX_H

#include "commands.h"
#include "core/tap.h"

#include <dirent.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char sandbox_folder[256];
static char sandbox_message[4096]; /* what the latest command said on standard error */

/* Valid until the function was called 16 times more: make paths anew for each command. */
static TAP_UNUSED const char *sandbox_path(const char *name)
{
    enum { PATHS = 16 };
    static char paths[PATHS][512];
    static int next;
    char *path = paths[next++ % PATHS];
    snprintf(path, sizeof paths[0], "%s/%s", sandbox_folder, name);
    return path;
}

static TAP_UNUSED void sandbox_open(void)
{
    const char *base = getenv("TMPDIR");
    snprintf(sandbox_folder, sizeof sandbox_folder, "%s/gnomon-test-XXXXXX", base ? base : "/tmp");
    if (!mkdtemp(sandbox_folder)) {
        perror(sandbox_folder);
        exit(1);
    }
}

static TAP_UNUSED void sandbox_write(const char *name, const void *bytes, size_t size)
{
    FILE *file = fopen(sandbox_path(name), "wb");
    if (!file || fwrite(bytes, 1, size, file) != size || fclose(file) != 0) {
        perror(name);
        exit(1);
    }
}

static TAP_UNUSED void sandbox_write_text(const char *name, const char *text)
{
    sandbox_write(name, text, strlen(text));
}

static TAP_UNUSED int sandbox_has(const char *name)
{
    return access(sandbox_path(name), F_OK) == 0;
}

/* Files in the folder whose names are none of the inputs (all inputs start with "in"); the names go to the log. */
static TAP_UNUSED int sandbox_leftovers(void)
{
    int count = 0;
    DIR *folder = opendir(sandbox_folder);
    for (struct dirent *entry; folder && (entry = readdir(folder));)
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0 &&
            strncmp(entry->d_name, "in", 2) != 0) {
            note("left behind: %s", entry->d_name);
            count++;
        }
    if (folder)
        closedir(folder);
    return count;
}

static TAP_UNUSED void sandbox_close(void)
{
    DIR *folder = opendir(sandbox_folder);
    for (struct dirent *entry; folder && (entry = readdir(folder));)
        unlink(sandbox_path(entry->d_name));
    if (folder)
        closedir(folder);
    rmdir(sandbox_folder);
}

typedef int (*sandbox_command)(int argc, char **argv);

/* Send a stream to a file, or back (file -1). Returns what to give to send it back. */
static TAP_UNUSED int sandbox_redirect(FILE *stream, int file)
{
    fflush(stream);
    int before = dup(fileno(stream));
    dup2(file, fileno(stream));
    close(file);
    return before;
}

/* Run a command in this process with up to twelve arguments, 0 after the last. Returns its exit status; standard output
 * is kept in the file in-output, standard error in sandbox_message. */
static TAP_UNUSED int sandbox_run(sandbox_command command, const char *const arguments[])
{
    char *argv[13];
    int argc = 0;
    for (; arguments[argc] && argc < 12; argc++)
        argv[argc] = (char *)(uintptr_t)arguments[argc];
    argv[argc] = 0;
    int out = sandbox_redirect(stdout, open(sandbox_path("in-output"), O_RDWR | O_CREAT | O_TRUNC, 0600));
    int err = sandbox_redirect(stderr, open(sandbox_path("in-messages"), O_RDWR | O_CREAT | O_TRUNC, 0600));
    int status = command(argc, argv);
    sandbox_redirect(stdout, out);
    sandbox_redirect(stderr, err);
    FILE *file = fopen(sandbox_path("in-messages"), "rb");
    size_t size = file ? fread(sandbox_message, 1, sizeof sandbox_message - 1, file) : 0;
    sandbox_message[size] = 0;
    if (file)
        fclose(file);
    return status;
}

/* After sandbox_run: was the input refused as promised? `where` is FILE:LINE or FILE: byte OFFSET, `what` stands
 * somewhere in the message, which says what was expected; nothing was written. */
static TAP_UNUSED int sandbox_refused(int status, const char *name, const char *where, const char *what)
{
    char start[600];
    snprintf(start, sizeof start, "%s%s: ", sandbox_path(name), where);
    int good = status == EXIT_BAD_INPUT && strncmp(sandbox_message, start, strlen(start)) == 0 &&
               strstr(sandbox_message, what) && strstr(sandbox_message, "expected") && sandbox_leftovers() == 0;
    if (!good)
        note("exit status %d, got: %s# wanted %s... %s ... expected ...", status, sandbox_message, start, what);
    return good;
}

#endif
