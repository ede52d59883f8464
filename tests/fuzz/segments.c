/* SPDX-License-Identifier: MIT */
/* Files beside a film in progress: removes its segments and a killed run's unfinished file, and
   nothing else. Input: names of files, one a line. */
#define _XOPEN_SOURCE 700

#include "output/resume.h"

#include <fcntl.h>
#include <regex.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fuzz.h"
#include "image/picture.h"

enum { MAX_NAMES = 8, MAX_LENGTH = 200 };

typedef enum Kind { SEGMENT, UNFINISHED, KIND_COUNT } Kind;

static bool matches(Kind kind, const char *name) {
    static const char *const patterns[KIND_COUNT] = {
        "^film[.]mkv[.]part-[0-9]+-[0-9a-f]{1,16}$",
        "^film[.]mkv([.]part-.*)?[.]tmp-[0-9]+-[0-9]+$"};
    static regex_t compiled[KIND_COUNT];
    static bool are_compiled;
    for (int i = 0; i < KIND_COUNT && !are_compiled; i++)
        fuzz_expect(regcomp(&compiled[i], patterns[i], REG_EXTENDED | REG_NOSUB) == 0,
                    "no pattern");
    are_compiled = true;
    return regexec(&compiled[kind], name, 0, NULL, 0) == 0;
}

static void path_of(char path[HD_MAX_PATH], const char *film, const char *name) {
    const char *slash = strrchr(film, '/');
    snprintf(path, HD_MAX_PATH, "%.*s/%s", (int)(slash - film), film, name);
}

/* Makes the files with valid names; returns their number. */
static int make_files(char *text, const char *film, const char *names[MAX_NAMES]) {
    char path[HD_MAX_PATH], *rest = NULL;
    int count = 0;
    for (char *name = strtok_r(text, "\n", &rest); name != NULL && count < MAX_NAMES;
         name = strtok_r(NULL, "\n", &rest)) {
        path_of(path, film, name);
        const int file = strlen(name) > MAX_LENGTH || strchr(name, '/') != NULL
                             ? -1
                             : open(path, O_CREAT | O_EXCL | O_WRONLY, 0600);
        if (file < 0)
            continue;
        close(file);
        names[count++] = name;
    }
    return count;
}

/* Expects matching files gone and the others present; removes these at the end. */
static void check_files(const char *film, const char *names[], int count, Kind gone, bool is_end) {
    char path[HD_MAX_PATH];
    for (int i = 0; i < count; i++) {
        path_of(path, film, names[i]);
        const bool is_there = access(path, F_OK) == 0;
        if (matches(gone, names[i]))
            fuzz_expect(!is_there, "a file of an earlier run that stays");
        else if (!matches(SEGMENT, names[i]) && !matches(UNFINISHED, names[i]))
            fuzz_expect(is_there, "somebody else's file that is removed");
        if (is_end)
            unlink(path);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static HdError error;
    static int numbers[2 * HD_MIN_SEGMENT];
    const HdFrameList frames = {.frames = numbers, .count = 2 * HD_MIN_SEGMENT};
    const char *film = fuzz_file("film.mkv", "", 0), *names[MAX_NAMES];
    HdOutputPlan plan = {
        .style = {.frames_per_second = 1}, .has_fingerprint = true, .resumes = true};
    plan.list[plan.count++] =
        (HdOutput){.name = film, .format = hd_format_of(film), .is_film = true};
    HdSegments segments;
    char *text = fuzz_text(data, size);
    const int count = make_files(text, film, names);
    hd_stale_files_remove(&plan, &frames);
    const HdStatus status = hd_segments_find(&segments, &plan, &plan.list[0], &frames, &error);
    fuzz_expect(status == HD_OK, error.message);
    check_files(film, names, count, UNFINISHED, false);
    hd_segments_remove(&segments);
    check_files(film, names, count, SEGMENT, true);
    hd_segments_free(&segments);
    free(text);
    return 0;
}
