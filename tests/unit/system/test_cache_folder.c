/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include "system/cache_folder.h"

#include <errno.h>
#include <fcntl.h>
#include <glob.h>
#include <signal.h>
#include <stdbool.h>
#include <sys/resource.h>
#include <time.h>

#include "system/atomic_file.h"
#include "test_folder.h"
#include "wrapped.h"

static HdError error;
static const char payload[] = "machine code\0with a NUL";
static char entry_file[512];

/* Returns the first entry of the folder "cache". */
static const char *find_entry(void) {
    glob_t found;
    assert_int_equal(glob("cache/*.entry", 0, NULL, &found), 0);
    snprintf(entry_file, sizeof entry_file, "%s", found.gl_pathv[0]);
    globfree(&found);
    return entry_file;
}

static int begin(void **state) {
    (void)state;
    setenv("HEDRON_CACHE", "cache", 1);
    return 0;
}

static int end(void **state) {
    (void)state;
    remove_folder("cache");
    return 0;
}

static void put(const char *key) {
    assert_int_equal(hd_cache_put("test", key, payload, sizeof payload, &error), HD_OK);
}

static HdStatus get(const char *key) {
    unsigned char *bytes;
    size_t size;
    HdStatus status = hd_cache_get("test", key, &bytes, &size, &error);
    if (status == HD_OK) {
        assert_int_equal(size, sizeof payload);
        assert_memory_equal(bytes, payload, sizeof payload);
    } else {
        assert_null(bytes);
    }
    free(bytes);
    return status;
}

static int mode_of(const char *path) {
    struct stat found;
    assert_int_equal(stat(path, &found), 0);
    return (int)found.st_mode & 0777;
}

/* Private to the user from the first instant, whatever the mask. */
TEST(only_the_user_can_read_entries) {
    HdAtomicFile file;
    put("a");
    assert_int_equal(mode_of(find_entry()), 0600);
    assert_int_equal(get("b"), HD_UNAVAILABLE);
    put("b");
    put("a");
    assert_int_equal(get("a"), HD_OK);
    assert_int_equal(get("b"), HD_OK);
    assert_int_equal(count_entries("cache"), 2);
    const mode_t before = umask(0);
    assert_int_equal(hd_atomic_file_open_private(&file, "cache/b", &error), HD_OK);
    umask(before);
    assert_int_equal(mode_of(file.temporary), 0600);
    hd_atomic_file_discard(&file);
    setenv("HEDRON_CACHE", "cache/deep/er", 1);
    put("a");
    assert_int_equal(mode_of("cache/deep/er"), 0700);
}

TEST(texts_are_kept) {
    char text[8];
    assert_int_equal(hd_cache_put_text("test", "block", "128", &error), HD_OK);
    assert_int_equal(hd_cache_get_text("test", "block", text, sizeof text, &error), HD_OK);
    assert_string_equal(text, "128");
    assert_int_equal(hd_cache_put_text("test", "block", "12345678", &error), HD_OK);
    assert_int_equal(hd_cache_get_text("test", "block", text, sizeof text, &error), HD_FAILED);
    assert_string_equal(text, "");
    assert_int_equal(hd_cache_put("test", "block", "1\0", 2, &error), HD_OK);
    assert_int_equal(hd_cache_get_text("test", "block", text, sizeof text, &error), HD_FAILED);
}

/* ---- damage ---- */

static size_t load(unsigned char *bytes, size_t capacity) {
    FILE *file = fopen(find_entry(), "rb");
    assert_non_null(file);
    size_t size = fread(bytes, 1, capacity, file);
    fclose(file);
    return size;
}

static void rewrite(const unsigned char *bytes, size_t size) {
    write_bytes(entry_file, bytes, size);
    assert_int_equal(chmod(entry_file, 0600), 0);
}

static void expect_untrusted(const char *reason) {
    assert_int_equal(get("a"), HD_FAILED);
    expect_contains(error.message, reason);
}

TEST(every_damage_is_noticed) {
    unsigned char bytes[512];
    put("a");
    const size_t size = load(bytes, sizeof bytes);
    for (size_t i = 0; i < size; i++) {
        rewrite(bytes, i);
        assert_int_equal(get("a"), HD_FAILED);
        bytes[i] ^= 0x10;
        rewrite(bytes, size);
        assert_int_equal(get("a"), HD_FAILED);
        bytes[i] ^= 0x10;
    }
    const struct {
        size_t damaged, size;
        const char *reason;
    } cases[] = {{0, size, "checksum"},
                 {size - 1, size, "checksum"},
                 {size, size + 1, "checksum"},
                 {size, 7, "its size is wrong"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bytes[cases[i].damaged] ^= 1;
        rewrite(bytes, cases[i].size);
        expect_untrusted(cases[i].reason);
        bytes[cases[i].damaged] ^= 1;
    }
    put("a");
    assert_int_equal(get("a"), HD_OK);
}

/* A whole entry under the name of another key's. */
TEST(entries_of_another_key_are_noticed) {
    char path[sizeof entry_file];
    put("a");
    snprintf(path, sizeof path, "%s", find_entry());
    assert_int_equal(remove(path), 0);
    put("b");
    assert_int_equal(rename(find_entry(), path), 0);
    expect_untrusted("another key");
}

TEST(only_regular_files_are_read) {
    put("a");
    assert_int_equal(rename(find_entry(), "elsewhere"), 0);
    assert_int_equal(symlink("../elsewhere", entry_file), 0);
    assert_int_equal(get("a"), HD_FAILED);
    assert_int_equal(remove(entry_file), 0);
    assert_int_equal(mkfifo(entry_file, 0600), 0);
    expect_untrusted("not a regular file");
    assert_int_equal(remove(entry_file), 0);
    assert_int_equal(mkdir(entry_file, 0700), 0);
    expect_untrusted("not a regular file");
    assert_int_equal(hd_cache_put("test", "a", payload, sizeof payload, &error), HD_BAD_INPUT);
    assert_int_equal(remove("elsewhere"), 0);
}

/* The entry ("") or the folder; only an entry is made again. */
TEST(folders_open_to_others_are_not_used) {
    static const struct {
        const char *path;
        mode_t mode;
        off_t size;
        const char *reason;
    } cases[] = {{"", 0620, 0, "other users may write to it"},
                 {"", 0602, 0, "other users may write to it"},
                 {"cache", 0720, 0, "cannot use the folder cache: other users may write to it"},
                 {"cache", 01777, 0, "cannot use the folder cache: other users may write to it"},
                 {"", 0600, 7, "its size is wrong"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        put("a");
        const char *path = cases[i].path[0] != '\0' ? cases[i].path : find_entry();
        assert_int_equal(chmod(path, cases[i].mode), 0);
        assert_true(cases[i].size == 0 || truncate(path, cases[i].size) == 0);
        expect_untrusted(cases[i].reason);
        if (strcmp(path, "cache") == 0) {
            assert_int_equal(hd_cache_put("test", "b", payload, sizeof payload, &error), HD_FAILED);
            expect_contains(error.message, cases[i].reason);
            assert_int_equal(chmod("cache", 0700), 0);
            assert_int_equal(get("b"), HD_UNAVAILABLE);
        }
        put("a");
        assert_int_equal(get("a"), HD_OK);
        if (geteuid() == 0) {
            assert_int_equal(chown(path, 12345, 12345), 0);
            expect_untrusted("another user");
            assert_int_equal(chown(path, 0, 0), 0);
        }
    }
}

/* ---- folders ---- */

/* "!PART": there is none, and the error names that part. */
TEST(the_folder_is_found_in_order) {
    static const struct {
        const char *own, *xdg, *home, *expected;
    } cases[] = {
        {"cache", "/xdg", "/tmp", "cache"},
        {NULL, "/xdg", "/tmp", "/xdg/hedron"},
        {"", "/xdg", "/tmp", "/xdg/hedron"},
        {"", "relative", "/tmp", "/tmp/.cache/hedron"},
        {"", NULL, "/tmp", "/tmp/.cache/hedron"},
        {"", NULL, "/no/such/home", "!/no/such/home"},
        {"off", "/xdg", "/tmp", "!HEDRON_CACHE is off"},
        {"", NULL, NULL, "!HOME"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *const values[] = {cases[i].own, cases[i].xdg, cases[i].home};
        static const char *const names[] = {"HEDRON_CACHE", "XDG_CACHE_HOME", "HOME"};
        char folder[HD_MAX_PATH];
        for (int k = 0; k < 3; k++)
            if (values[k] == NULL || setenv(names[k], values[k], 1) != 0)
                unsetenv(names[k]);
        const HdStatus status = hd_cache_folder(folder, &error);
        const bool has_one = cases[i].expected[0] != '!';
        assert_int_equal(status, has_one ? HD_OK : HD_UNAVAILABLE);
        if (has_one)
            assert_string_equal(folder, cases[i].expected);
        else
            expect_contains(error.message, cases[i].expected + 1);
    }
    assert_int_equal(get("a"), HD_UNAVAILABLE);
    assert_int_equal(hd_cache_put("test", "a", "", 0, &error), HD_UNAVAILABLE);
    write_bytes("file", "x", 1);
    setenv("HEDRON_CACHE", "file/cache", 1);
    assert_int_equal(get("a"), HD_UNAVAILABLE);
    assert_int_equal(hd_cache_put("test", "a", "x", 1, &error), HD_FAILED);
    expect_contains(error.message, "file/cache");
}

/* As on a full disk, or for too large an entry. */
TEST(a_failed_write_leaves_the_old_file) {
    static const char large[1 << 14];
    struct rlimit before, limit;
    put("a");
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    limit = before;
    limit.rlim_cur = 4096;
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    HdStatus status = hd_cache_put("test", "a", large, sizeof large, &error);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    assert_int_equal(status, HD_FAILED);
    assert_int_equal(hd_cache_put("test", "a", payload, HD_CACHE_MAX_ENTRY_BYTES, &error),
                     HD_FAILED);
    expect_contains(error.message, "too large");
    assert_int_equal(count_entries("cache"), 1);
    assert_int_equal(get("a"), HD_OK);
}

/* ---- the limit ---- */

/* Makes a file in the cache, and the cache if it is missing. */
static void make_file(const char *name, off_t size, int seconds_ago) {
    char path[256];
    mkdir("cache", 0700);
    snprintf(path, sizeof path, "cache/%s", name);
    write_bytes(path, "", 0);
    assert_int_equal(truncate(path, size), 0);
    const struct timespec then = {.tv_sec = time(NULL) - seconds_ago};
    assert_int_equal(utimensat(AT_FDCWD, path, (const struct timespec[2]){then, then}, 0), 0);
}

/* Expects these names in the cache, in order and each with a space behind it. */
static void expect_left(const char *names) {
    char text[512] = "";
    glob_t found;
    assert_int_equal(glob("cache/*", 0, NULL, &found), 0);
    for (size_t i = 0; i < found.gl_pathc; i++)
        strcat(strcat(text, found.gl_pathv[i] + strlen("cache/")), " ");
    globfree(&found);
    assert_string_equal(text, names);
}

static const char *stuck; /* cannot be removed */

static int unlink_but_stuck(int folder, const char *name, int flags) {
    if (stuck != NULL && strcmp(name, stuck) == 0) {
        errno = EACCES;
        return -1;
    }
    return real_unlinkat(folder, name, flags);
}

/* Names of any length; one that cannot be removed is skipped. */
TEST(the_longest_unused_go_first) {
    make_file("newest.entry", 400, 10);
    make_file("o.entry", 400, 300);
    make_file("ol.entry", 400, 250);
    make_file("mid.entry", 400, 200);
    make_file("foreign", 1000, 400);
    make_file("fresh.entry.tmp-1-0", 100, 10);
    make_file("stale.entry.tmp-2-0", 100, 4000);
    hd_cache_limit("cache", 1600);
    expect_left("foreign fresh.entry.tmp-1-0 mid.entry newest.entry o.entry ol.entry ");
    stuck = "o.entry";
    hd_cache_limit("cache", 1599);
    stuck = NULL;
    expect_left("foreign fresh.entry.tmp-1-0 mid.entry newest.entry o.entry ");
    hd_cache_limit("cache", 400);
    expect_left("foreign fresh.entry.tmp-1-0 newest.entry ");
    hd_cache_limit("nowhere", 0);
}

/* Their size counts, and the time of their use. */
TEST(a_put_keeps_to_the_limit) {
    static const char *const names[] = {"0.entry", "1.entry", "2.entry"};
    struct stat found;
    put("a");
    assert_int_equal(
        utimensat(AT_FDCWD, find_entry(), (const struct timespec[2]){{1, 0}, {1, 0}}, 0), 0);
    assert_int_equal(get("a"), HD_OK);
    assert_int_equal(stat(entry_file, &found), 0);
    assert_true(found.st_mtime > 1);
    for (int i = 0; i < 3; i++)
        make_file(names[i], HD_CACHE_MAX_BYTES / 3, 100 - i);
    put("b");
    assert_int_equal(access("cache/0.entry", F_OK), -1);
    assert_int_equal(count_entries("cache"), 4); /* with a and b */
    assert_int_equal(get("b"), HD_OK);
}

EACH(begin, end)
REPLACE(unlinkat, unlink_but_stuck)
