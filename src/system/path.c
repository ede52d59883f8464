/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include "system/path.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <pwd.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/types.h>
#include <unistd.h>

static HdStatus fail_too_long(const char *path, HdError *error) {
    return hd_fail(error, HD_BAD_INPUT,
                   "the file name \"%s\" is too long, expected fewer than %d bytes", path,
                   HD_MAX_PATH);
}

static HdStatus join(const char *first, const char *second, char out[HD_MAX_PATH], HdError *error) {
    size_t first_length = strlen(first), second_length = strlen(second);
    if (first_length + second_length >= HD_MAX_PATH)
        return fail_too_long(second, error);
    memmove(out, first, first_length);
    memmove(out + first_length, second, second_length + 1);
    return HD_OK;
}

static HdStatus home_from_database(const char *rest, char out[HD_MAX_PATH], HdError *error) {
    char buffer[16384];
    struct passwd entry, *found = NULL;
    int reason = getpwuid_r(getuid(), &entry, buffer, sizeof buffer, &found);
    if (found == NULL || found->pw_dir == NULL || found->pw_dir[0] == '\0')
        return hd_fail(error, HD_BAD_INPUT,
                       "cannot expand \"~%s\": HOME is not set and user %lu has no home folder%s%s",
                       rest, (unsigned long)getuid(), reason != 0 ? ": " : "",
                       reason != 0 ? strerror(reason) : "");
    return join(found->pw_dir, rest, out, error);
}

HdStatus hd_path_expand_home(const char *path, char out[HD_MAX_PATH], HdError *error) {
    if (path[0] != '~' || (path[1] != '\0' && path[1] != '/'))
        return join("", path, out, error);
    const char *home = getenv("HOME");
    if (home == NULL || home[0] == '\0')
        return home_from_database(path + 1, out, error);
    return join(home, path + 1, out, error);
}

/* Creates first and checks second: another process may create the same folder meanwhile. */
static HdStatus make_folder(const char *folder, unsigned mode, const char *path, HdError *error) {
    struct stat found;
    if (mkdir(folder, mode) == 0)
        return HD_OK;
    const int reason = errno;
    if (stat(folder, &found) == 0 && S_ISDIR(found.st_mode))
        return HD_OK;
    return hd_fail(error, HD_FAILED, "cannot make the folder %s for %s: %s", folder, path,
                   reason == EEXIST ? "a file has that name" : strerror(reason));
}

bool hd_path_has_ending(const char *path, const char *ending) {
    size_t length = strlen(path), tail = strlen(ending);
    return length >= tail && strcasecmp(path + length - tail, ending) == 0;
}

size_t hd_folder_length(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash == NULL ? 0 : (size_t)(slash - path) + 1;
}

bool hd_path_of_program(char out[HD_MAX_PATH]) {
    ssize_t length = readlink("/proc/self/exe", out, HD_MAX_PATH - 1);
    if (length <= 0)
        return false;
    out[length] = '\0';
    const size_t folder = hd_folder_length(out);
    out[folder > 0 ? folder - 1 : 0] = '\0';
    return folder > 0;
}

void hd_path_visit(const char *folder, void (*visit)(void *context, const char *name),
                   void *context) {
    DIR *stream = opendir(folder[0] != '\0' ? folder : ".");
    const struct dirent *entry;
    while (stream != NULL && (entry = readdir(stream)) != NULL)
        visit(context, entry->d_name);
    if (stream != NULL)
        closedir(stream);
}

HdStatus hd_path_make_parents(const char *path, unsigned mode, HdError *error) {
    char folder[HD_MAX_PATH] = "";
    HD_TRY(join("", path, folder, error));
    for (size_t i = 1; folder[i] != '\0'; i++) {
        if (folder[i] != '/' || folder[i - 1] == '/')
            continue;
        folder[i] = '\0';
        HD_TRY(make_folder(folder, mode, path, error));
        folder[i] = '/';
    }
    return HD_OK;
}

/* Moves one step down or up from `path` ("" is the root), and follows links as far as they lead. */
static bool step(char path[HD_MAX_PATH], const char *part, size_t length) {
    size_t used = strlen(path);
    if (length == 0 || (length == 1 && part[0] == '.'))
        return true;
    if (length == 2 && strncmp(part, "..", 2) == 0) {
        path[used > 0 ? hd_folder_length(path) - 1 : 0] = '\0';
        return true;
    }
    if (used + length + 2 > HD_MAX_PATH)
        return false;
    snprintf(path + used, HD_MAX_PATH - used, "/%.*s", (int)length, part);
    char *found = realpath(path, NULL);
    bool fits = found == NULL || strlen(found) < HD_MAX_PATH;
    if (found != NULL && fits)
        snprintf(path, HD_MAX_PATH, "%s", found);
    free(found);
    return fits;
}

/* Finds the one canonical name of a file from folders that exist or would be created. */
static bool resolve(const char *path, char out[HD_MAX_PATH]) {
    out[0] = '\0';
    if (path[0] != '/' && (getcwd(out, HD_MAX_PATH) == NULL || strcmp(out, "/") == 0))
        out[0] = '\0';
    for (;; path++) {
        const size_t length = strcspn(path, "/");
        if (!step(out, path, length))
            return false;
        path += length;
        if (*path == '\0')
            return true;
    }
}

bool hd_path_is_same(const char *first, const char *second) {
    struct stat a, b;
    char first_name[HD_MAX_PATH], second_name[HD_MAX_PATH];
    if (stat(first, &a) == 0 && stat(second, &b) == 0)
        return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
    return resolve(first, first_name) && resolve(second, second_name) &&
           strcmp(first_name, second_name) == 0;
}

/* a part of a pattern; "%%" and "%#" are characters */
typedef enum Part { PART_CHARACTER, PART_NUMBER, PART_WRONG } Part;

enum { MAX_DIGITS = 9 };

/* Moves `*text`, which starts with a percent sign, past the directive if it is valid. */
static Part read_directive(const char **text, int *digits) {
    const char *p = *text + 1;
    if (p[0] == '%' || p[0] == '#') {
        *text = p + 1;
        return PART_CHARACTER;
    }
    if (p[0] == '0' && p[1] >= '1' && p[1] <= '0' + MAX_DIGITS) {
        *digits = p[1] - '0';
        p += 2;
    }
    if (p[0] != 'd')
        return PART_WRONG;
    *text = p + 1;
    return PART_NUMBER;
}

/* Moves `*text` past the next part unless it is wrong; sets the least `*digits` of a number. */
static Part read_part(const char **text, bool counts_hashes, int *digits) {
    size_t hashes = counts_hashes ? strspn(*text, "#") : 0;
    *digits = 1;
    if (**text == '%')
        return read_directive(text, digits);
    if (hashes > MAX_DIGITS)
        return PART_WRONG;
    *text += hashes > 0 ? hashes : 1;
    if (hashes == 0)
        return PART_CHARACTER;
    *digits = (int)hashes;
    return PART_NUMBER;
}

/* Returns whether there is a number, with '#' as one from `hashes` on. */
static bool has_number(const char *path, const char *hashes) {
    int digits;
    while (*path != '\0') {
        const Part part = read_part(&path, path >= hashes, &digits);
        if (part == PART_NUMBER)
            return true;
        if (part == PART_WRONG)
            path += *path == '#' ? strspn(path, "#") : 1;
    }
    return false;
}

bool hd_pattern_has_directive(const char *path) {
    return has_number(path, path + strlen(path));
}

bool hd_pattern_has_number(const char *path) {
    return has_number(path, path + hd_folder_length(path));
}

/* Expands the pattern and counts its frame numbers. */
static HdStatus expand(const char *pattern, int frame, char out[HD_MAX_PATH], int *numbers,
                       HdError *error) {
    /* If the pattern has "%d" or "%0Nd", and in folders, a '#' is an ordinary character. */
    const char *hashes =
        pattern + (hd_pattern_has_directive(pattern) ? strlen(pattern) : hd_folder_length(pattern));
    size_t length = 0;
    int digits;
    *numbers = 0;
    for (const char *text = pattern; *text != '\0';) {
        char piece[16];
        const Part part = read_part(&text, text >= hashes, &digits);
        if (part == PART_WRONG)
            return hd_fail(error, HD_BAD_INPUT,
                           "the pattern \"%s\" has \"%.*s\", expected %%d, %%0Nd with N from 1 to "
                           "%d, 1 to %d #, or %%%% for a percent sign, %%# for #",
                           pattern, *text == '#' ? (int)strspn(text, "#") : 4, text, MAX_DIGITS,
                           MAX_DIGITS);
        const int size = part == PART_NUMBER ? snprintf(piece, sizeof piece, "%0*d", digits, frame)
                                             : snprintf(piece, sizeof piece, "%c", text[-1]);
        if (length + (size_t)size >= HD_MAX_PATH)
            return fail_too_long(pattern, error);
        memcpy(out + length, piece, (size_t)size);
        length += (size_t)size;
        *numbers += part == PART_NUMBER;
    }
    out[length] = '\0';
    return HD_OK;
}

HdStatus hd_pattern_format(const char *pattern, int frame, char out[HD_MAX_PATH], HdError *error) {
    int numbers;
    HD_TRY(expand(pattern, frame, out, &numbers, error));
    if (numbers != 1)
        return hd_fail(error, HD_BAD_INPUT,
                       "the pattern \"%s\" has %d frame numbers, expected exactly one %%d, %%0Nd "
                       "or run of #",
                       pattern, numbers);
    if (frame < 0)
        return hd_fail(error, HD_BAD_INPUT,
                       "the frame %d of \"%s\" is negative, expected 0 or more", frame, pattern);
    return HD_OK;
}

HdStatus hd_pattern_check(const char *pattern, HdError *error) {
    char name[HD_MAX_PATH];
    return hd_pattern_format(pattern, 0, name, error);
}

HdStatus hd_pattern_format_single(const char *name, char out[HD_MAX_PATH], HdError *error) {
    int numbers;
    HD_TRY(expand(name, 0, out, &numbers, error));
    if (numbers > 0)
        return hd_fail(error, HD_BAD_INPUT, "the name \"%s\" has a frame number, expected none",
                       name);
    return HD_OK;
}

/* ---- bytes ---- */

#define CANNOT_READ "cannot read the %s %s: "

ssize_t hd_read_fully(int descriptor, void *bytes, size_t size) {
    size_t done = 0;
    while (done < size) {
        const ssize_t count = read(descriptor, (char *)bytes + done, size - done);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return -1;
        if (count == 0)
            break;
        done += (size_t)count;
    }
    return (ssize_t)done;
}

FILE *hd_file_open(const char *path, struct stat *found, const char **reason) {
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    *found = (struct stat){0};
    const bool is_known = descriptor >= 0 && fstat(descriptor, found) == 0;
    const bool is_regular = is_known && S_ISREG(found->st_mode);
    FILE *file = is_regular ? fdopen(descriptor, "rb") : NULL;
    *reason = is_known && !is_regular ? "it is not a regular file" : strerror(errno);
    if (file == NULL && descriptor >= 0)
        close(descriptor);
    return file;
}

static HdStatus read_file(int descriptor, const char *what, const char *path, int64_t has,
                          int64_t max_bytes, unsigned char **bytes, size_t *size, HdError *error) {
    if (has > max_bytes || (uintmax_t)has >= SIZE_MAX)
        return hd_fail(error, HD_BAD_INPUT, CANNOT_READ "it has %lld bytes, expected at most %lld",
                       what, path, (long long)has, (long long)max_bytes);
    *size = (size_t)has;
    *bytes = malloc(*size + 1);
    if (*bytes == NULL)
        return HD_NO_ROOM(error, "the %zu bytes of the %s %s", *size, what, path);
    const ssize_t done = hd_read_fully(descriptor, *bytes, *size);
    if (done < 0)
        return hd_fail(error, HD_BAD_INPUT, CANNOT_READ "%s", what, path, strerror(errno));
    if (done < (ssize_t)*size)
        return hd_fail(error, HD_BAD_INPUT, CANNOT_READ "it ended after %zd of %zu bytes", what,
                       path, done, *size);
    return HD_OK;
}

HdStatus hd_file_read(const char *path, const char *what, int64_t max_bytes, unsigned char **bytes,
                      size_t *size, HdError *error) {
    struct stat found;
    const char *reason;
    FILE *file = hd_file_open(path, &found, &reason);
    *bytes = NULL;
    if (file == NULL)
        return hd_fail(error, HD_BAD_INPUT, CANNOT_READ "%s", what, path, reason);
    const HdStatus status =
        read_file(fileno(file), what, path, found.st_size, max_bytes, bytes, size, error);
    fclose(file);
    if (status != HD_OK) {
        free(*bytes);
        *bytes = NULL;
    }
    return status;
}
