/* SPDX-License-Identifier: MIT */
/* Fake programs in place of FFmpeg's: those in the folder "bin" of the test folder come first. */
#ifndef HD_FAKE_PROGRAMS_H
#define HD_FAKE_PROGRAMS_H

#include "test_folder.h"

static inline int make_folder_for_programs(void **state) {
    const char *path = getenv("PATH");
    char search[4096];
    if (make_test_folder(state) != 0 || mkdir("bin", 0777) != 0)
        return 1;
    snprintf(search, sizeof search, "%s/bin:%s", test_folder, path);
    return setenv("PATH", search, 1);
}

static inline void fake(const char *name, const char *script) {
    char path[100], text[1000];
    snprintf(path, sizeof path, "bin/%s", name);
    snprintf(text, sizeof text, "#!/bin/sh\nfor last; do :; done\nout=${last#file:}\n%s\n", script);
    write_bytes(path, text, strlen(text));
    assert_int_equal(chmod(path, 0777), 0);
}

/* An FFmpeg that writes frames to the file as they come, or the films to be joined; and an ffprobe
   that counts frames of so many bytes, with an error. */
static inline void fake_films(int frame_bytes, int error) {
    char script[200];
    fake("ffmpeg", "case \"$*\" in\n"
                   "*concat*) sed -n \"s/'\\\\\\\\''/@/g; /^file/ {\n"
                   "s/^file 'file:\\([^']*\\)'$/\\1/; s/@/'/g; p; }\" |\n"
                   "while read -r part; do cat \"$part\"; done >\"$out\" ;;\n"
                   "*) cat >\"$out\" ;;\nesac");
    snprintf(script, sizeof script, "echo $(($(wc -c <\"$out\") / %d + %d))", frame_bytes, error);
    fake("ffprobe", script);
}

static inline size_t read_bytes(const char *path, void *bytes, size_t size) {
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t count = fread(bytes, 1, size, file);
    fclose(file);
    return count;
}

#endif
