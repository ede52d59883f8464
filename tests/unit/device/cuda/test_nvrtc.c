/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include "device/cuda/compile.h"

#include <dlfcn.h>
#include <fcntl.h>

#include "test_folder.h"

static HdError error;
static HdNvrtc nvrtc;
static char library[600]; /* which is none */

static int begin(void **state) {
    static const char *const places[] = {"HEDRON_NVRTC", "CUDA_HOME",   "CUDA_PATH",
                                         "HOME",         "VIRTUAL_ENV", "CONDA_PREFIX"};
    (void)state;
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        unsetenv(places[i]);
    setenv("HEDRON_CACHE", "there/cache", 1);
    snprintf(library, sizeof library, "%s/library.so", test_folder);
    write_bytes(library, "not a library", 13);
    return mkdir("there", 0700);
}

static int end(void **state) {
    (void)state;
    return remove_folder("there");
}

/* ---- a remembered version is not loaded: this one could not be ---- */

static void expect_checked(int arch, int driver_major, HdStatus expected) {
    assert_int_equal(hd_nvrtc_check("some device", arch, driver_major, &error), expected);
}

TEST(an_unchanged_remembered_library_is_not_loaded) {
    const struct timespec other[2] = {{.tv_sec = 1000}, {.tv_sec = 1000}};
    setenv("HEDRON_NVRTC", "/no/such/library.so", 1);
    expect_checked(61, 12, HD_UNAVAILABLE);
    hd_nvrtc_remember(library, 61, 12);
    expect_checked(61, 12, HD_OK);
    expect_checked(75, 12, HD_UNAVAILABLE);
    expect_checked(61, 13, HD_UNAVAILABLE);
    write_bytes(library, "longer than before", 18);
    expect_checked(61, 12, HD_UNAVAILABLE);
    hd_nvrtc_remember(library, 61, 12);
    assert_int_equal(utimensat(AT_FDCWD, library, other, 0), 0);
    expect_checked(61, 12, HD_UNAVAILABLE);
    hd_nvrtc_remember(library, 61, 12);
    expect_checked(61, 12, HD_OK);
    assert_int_equal(remove(library), 0);
    expect_checked(61, 12, HD_UNAVAILABLE);
    expect_contains(error.message, "/no/such/library.so");
    write_bytes(library, "not a library", 13);
    hd_nvrtc_remember(library, 61, 12);
    setenv("HEDRON_NVRTC", "/no/other/library.so", 1);
    expect_checked(61, 12, HD_UNAVAILABLE);
}

/* ---- choosing among stubs (stub_nvrtc.c), which alone compile for sm_7 ---- */

/* Puts a stub below the folder that such a variable names. */
static void put(const char *below, const char *name) {
    char command[2000];
    snprintf(command, sizeof command, "mkdir -p there/%s && cp %s there/%s/%s", below, STUB_NVRTC,
             below, name);
    assert_int_equal(system(command), 0);
}

static void expect_version(int arch, int driver_major, const char *path, int major, int minor) {
    int reported_major, reported_minor;
    assert_int_equal(hd_nvrtc_open(&nvrtc, "some device", arch, driver_major, path, &error), HD_OK);
    assert_int_equal(nvrtc.functions.version(&reported_major, &reported_minor), 0);
    assert_true(nvrtc.major == major && nvrtc.minor == minor);
    assert_true(reported_major == major && reported_minor == minor);
    hd_nvrtc_close(&nvrtc);
    assert_null(nvrtc.library);
}

static void expect_none(int arch, const char *path, const char *message) {
    assert_int_equal(hd_nvrtc_open(&nvrtc, "some device", arch, 12, path, &error), HD_UNAVAILABLE);
    expect_contains(error.message, message);
}

TEST(the_newest_that_suits_the_driver_is_taken) {
    static const char *const names[] = {"libnvrtc.so.12.3", "libnvrtc.so.12.8", "libnvrtc.so.11.9",
                                        "libnvrtc.so.13.0", "libnvrtc.so.14.1"};
    static const int cases[][4] = {{7, 12, 12, 8}, {7, 11, 11, 9},   {7, 13, 13, 0},  {7, 0, 14, 1},
                                   {7, 10, 14, 1}, {110, 12, 11, 9}, {130, 12, 13, 0}};
    setenv("CUDA_HOME", "there", 1);
    setenv("CUDA_PATH", "there", 1);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        put("lib64", names[i]);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_version(cases[i][0], cases[i][1], NULL, cases[i][2], cases[i][3]);
    /* An unsuitable one is reported once. */
    expect_none(8, NULL,
                "NVRTC 12.3 for sm_7 to sm_120, NVRTC 12.8 for sm_7 to sm_120, NVRTC 13.0");
    assert_null(strstr(strstr(error.message, "NVRTC 12.3") + 1, "NVRTC 12.3"));
}

#define PACKAGE "lib/python3.11/site-packages/nvidia/cuda_nvrtc/lib"

TEST(usual_folders_are_searched) {
    static const char *const found[][2] = {
        {"CUDA_HOME", "lib64"},
        {"CUDA_PATH", "lib64"},
        {"CONDA_PREFIX", "lib"},
        {"CONDA_PREFIX", PACKAGE},
        {"VIRTUAL_ENV", PACKAGE},
        {"HOME", ".local/" PACKAGE},
        {"HOME", ".local/share/hedron/" PACKAGE},
    };
    for (size_t i = 0; i < sizeof found / sizeof *found; i++) {
        put(found[i][1], "libnvrtc.so.12.8");
        setenv(found[i][0], "there", 1);
        expect_version(7, 12, NULL, 12, 8);
        setenv("HEDRON_NVRTC", "off", 1);
        expect_none(7, NULL, "found: none");
        unsetenv("HEDRON_NVRTC");
        unsetenv(found[i][0]);
        remove_folder("there");
    }
    setenv("CUDA_HOME", "", 1);
    put("lib64", "libnvrtc.so.12.8");
    expect_none(7, NULL,
                "compiles for some device (sm_7); to install one that does: python3 -m venv "
                "~/.local/share/hedron && ~/.local/share/hedron/bin/pip install "
                "nvidia-cuda-nvrtc-cu11, or name a libnvrtc.so in HEDRON_NVRTC; the driver's "
                "branch 470 is the last for this card; found: ");
}

TEST(a_named_library_is_the_only_candidate) {
    static const char *const ignored[] = {"libnvrtc.so.13.0", "libnvrtc.so.12.99",
                                          "libnvrtc.so.0.1"};
    setenv("CUDA_HOME", "there", 1);
    for (int i = 0; i < 3; i++)
        put("lib64", ignored[i]);
    put("", "libnvrtc.so.12.3");
    put("", "libnvrtc-builtins.so.12.3");
    setenv("HEDRON_NVRTC", "there/libnvrtc.so.12.3", 1);
    assert_true(hd_nvrtc_is_named());
    expect_version(7, 12, NULL, 12, 3);
    void *builtins = dlopen("there/libnvrtc-builtins.so.12.3", RTLD_NOLOAD | RTLD_LAZY);
    assert_non_null(builtins);
    dlclose(builtins);
    expect_version(7, 12, "there/lib64/libnvrtc.so.13.0", 13, 0);
    expect_none(7, "there/lib64/libnvrtc.so.12.99", "; found: NVRTC 12.99 for sm_0 to sm_0");
    expect_none(7, "there/lib64/libnvrtc.so.0.1",
                "there/lib64/libnvrtc.so.0.1 cannot be loaded as an NVRTC library, version 11.2");
    expect_none(7, library,
                "/library.so cannot be loaded as an NVRTC library, version 11.2 or newer");
    setenv("HEDRON_NVRTC", "", 1);
    assert_false(hd_nvrtc_is_named());
    setenv("HEDRON_NVRTC", "off", 1);
    assert_false(hd_nvrtc_is_named());
}

TEST(packages_suit_card_and_driver) {
    static const struct {
        int arch, driver_major;
        const char *ending; /* of the package's name */
    } cases[] = {{37, 12, "-cu11"}, {49, 0, "-cu11"},  {50, 12, "-cu12"}, {50, 11, "-cu11"},
                 {74, 13, "-cu12"}, {75, 13, "nvrtc"}, {75, 12, "-cu12"}, {75, 0, "nvrtc"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *package = hd_nvrtc_package(cases[i].arch, cases[i].driver_major);
        assert_string_equal(package + strlen(package) - 5, cases[i].ending);
    }
}

TEST(a_library_that_compiles_is_remembered) {
    char named[600];
    put("lib64", "libnvrtc.so.12.5");
    snprintf(named, sizeof named, "%s/there/lib64/libnvrtc.so.12.5", test_folder);
    setenv("HEDRON_NVRTC", named, 1);
    expect_checked(7, 12, HD_OK);
    assert_true(count_entries("there/cache") > 0);
    expect_checked(8, 12, HD_UNAVAILABLE);
    expect_contains(error.message, "found: NVRTC 12.5 for sm_7 to sm_120");
}

EACH(begin, end)
