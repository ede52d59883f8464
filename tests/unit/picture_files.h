/* SPDX-License-Identifier: MIT */
/* Pictures that tests write and read in their folder. Define _XOPEN_SOURCE as 700 first. */
#ifndef HD_PICTURE_FILES_H
#define HD_PICTURE_FILES_H

#include <fcntl.h>

#include "image/picture.h"
#include "test_folder.h"

static inline size_t read_bytes(const char *path, unsigned char *bytes, size_t room) {
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t size = fread(bytes, 1, room, file);
    fclose(file);
    return size;
}

/* Reads a texture of the fuzz corpus, whose first byte is the fuzz target's own. */
static inline size_t load_texture_file(const char *name, unsigned char *bytes, size_t room) {
    char path[4096];
    snprintf(path, sizeof path, "%s/tests/fuzz/corpus/texture/%s", unit_project, name);
    const size_t size = read_bytes(path, bytes, room) - 1;
    memmove(bytes, bytes + 1, size);
    return size;
}

/* Writes the frame as a picture with a label, and frees it. */
static inline void write_frame(HdFrame *frame, const HdFormat *format, const HdPictureStyle *style,
                               const HdPictureLabel *label, const char *path) {
    static HdError error;
    HdAtomicFile file;
    if (hd_picture_prepare(&file, frame, format, style, label, path, &error) != HD_OK ||
        hd_atomic_file_commit(&file, HD_WITHOUT_SYNC, &error) != HD_OK)
        fail_msg("%s", error.message);
    hd_frame_free(frame);
}

/* Reads all rows of a picture of at most `room` values. */
static inline HdStatus read_picture(const char *path, HdCurve curve, HdPictureFacts *facts,
                                    HdPictureValue *values, int room, HdError *error) {
    HdPictureReader *reader;
    HdStatus status = hd_picture_reader_open(&reader, path, error);
    if (status != HD_OK)
        return status;
    *facts = *hd_picture_reader_facts(reader);
    if ((int64_t)facts->width * facts->height * 3 > room)
        status = HD_BAD_INPUT;
    if (status == HD_OK)
        status = hd_picture_reader_start(reader, curve, error);
    for (int y = 0; y < facts->height && status == HD_OK; y++)
        status = hd_picture_reader_next(reader, values + 3 * facts->width * y, error);
    hd_picture_reader_close(reader);
    return status;
}

/* Redirects standard error to a file, until end_capture returns its size. */
static inline int begin_capture(void) {
    const int file = open("stderr.txt", O_RDWR | O_CREAT | O_TRUNC, 0666);
    assert_true(file >= 0);
    fflush(stderr);
    const int old_descriptor = dup(2);
    dup2(file, 2);
    close(file);
    return old_descriptor;
}

static inline off_t end_capture(int old_descriptor) {
    struct stat found;
    fflush(stderr);
    assert_int_equal(fstat(2, &found), 0);
    dup2(old_descriptor, 2);
    close(old_descriptor);
    return found.st_size;
}

#endif
