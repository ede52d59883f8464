/* SPDX-License-Identifier: MIT */
/* The driver: the fake one (tests/fake_cuda), one that lacks functions, none; each in a process of
   its own, with its own path for the loader. */
#define _XOPEN_SOURCE 700
#include "device/cuda/api.h"

#include <sys/wait.h>

#include "device/backend.h"
#include "render/backends.h"
#include "test_folder.h"

static HdError error;
static HdCudaDriver driver;
static char said[4096];

/* ---- loading ---- */

/* Loads the driver in a process of this program, prints the result, and ends with the status. */
static int load(void) {
    HdDevice device;
    int count;
    HdStatus status = hd_cuda_load_driver(&driver, &error);
    if (status == HD_OK)
        status = hd_backend_enumerate(&hd_backend_cuda, &device, 1, &count, &error);
    if (status == HD_OK)
        printf("%s, %s", hd_cuda_error_name(&driver, HD_CU_ERROR_OUT_OF_MEMORY), device.driver);
    else
        printf("%s", error.message);
    return (int)status;
}

static void expect_loading(const char *folder, HdStatus expected, const char *message) {
    char command[4096];
    snprintf(command, sizeof command, "'%s' load_cuda_driver", unit_program);
    setenv("LD_LIBRARY_PATH", folder, 1);
    FILE *output = popen(command, "r");
    assert_non_null(output);
    said[fread(said, 1, sizeof said - 1, output)] = '\0';
    const int status = pclose(output);
    unsetenv("LD_LIBRARY_PATH");
    assert_string_equal(said, message);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), expected);
}

TEST(a_driver_is_loaded_or_reported_as_missing_or_old) {
    setenv("FAKE_CUDA_DRIVER", "13010", 1);
    expect_loading(FAKE_CUDA, HD_OK, "CUDA_ERROR_OUT_OF_MEMORY, sm_61, driver for CUDA 13.1");
    assert_int_equal(symlink(STUB_NVRTC, "libcuda.so.1"), 0);
    expect_loading(test_folder, HD_UNAVAILABLE,
                   "the NVIDIA driver is too old: libcuda.so.1 has no function cuInit");
    assert_int_equal(remove("libcuda.so.1"), 0);
    write_bytes("libcuda.so.1", "no library", 10);
    expect_loading(test_folder, HD_UNAVAILABLE,
                   "the NVIDIA driver (libcuda.so.1) is not installed");
}

TEST(remedies_for_a_failing_driver_are_reported) {
    static const struct {
        const char *code, *version;
        HdStatus status;
        const char *message;
    } cases[] = {
        {"999", "13010", HD_FAILED,
         "CUDA_ERROR_UNKNOWN (999); after suspend, run: sudo rmmod nvidia_uvm && "
         "sudo modprobe nvidia_uvm, or restart"},
        {"100", "13010", HD_UNAVAILABLE,
         "CUDA_ERROR_NO_DEVICE (100); it is of branch 590 or newer, which drives no card before "
         "sm_75: the branch 580 is the last for older ones, such as a GTX 1050"},
        {"100", "13009", HD_UNAVAILABLE,
         "CUDA_ERROR_NO_DEVICE (100); it finds no card that it supports, or CUDA_VISIBLE_DEVICES "
         "hides it"},
        {"2", "13010", HD_FAILED, "CUDA_ERROR_OUT_OF_MEMORY (2)"},
    };
    setenv("FAKE_CUDA_FAILS", "cuInit", 1);
    setenv("FAKE_CUDA_FAILS_AT", "1", 1);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char message[512];
        setenv("FAKE_CUDA_ERROR", cases[i].code, 1);
        setenv("FAKE_CUDA_DRIVER", cases[i].version, 1);
        snprintf(message, sizeof message, "the NVIDIA driver does not start: cuInit failed with %s",
                 cases[i].message);
        expect_loading(FAKE_CUDA, cases[i].status, message);
    }
    unsetenv("FAKE_CUDA_FAILS");
}

/* ---- errors ---- */

static HdCuResult outcome; /* asking for words */
static const char *word;

static HdCuResult tell(HdCuResult code, const char **text) {
    (void)code;
    *text = word;
    return outcome;
}

static void expect_failure(const char *function, HdCuResult code, bool is_loss,
                           const char *message) {
    driver = (HdCudaDriver){.cuGetErrorName = tell, .cuGetErrorString = tell};
    assert_int_equal(hd_cuda_fail(&driver, function, code, &error),
                     is_loss ? HD_UNAVAILABLE : HD_FAILED);
    assert_int_equal(hd_is_loss(&error), is_loss);
    expect_contains(error.message, message);
}

TEST(errors_have_their_words) {
    static const char *const words[] = {"WORD", "WORD", NULL};
    for (int i = 0; i < 3; i++) {
        word = words[i];
        outcome = i == 1 ? 1 : HD_CU_SUCCESS;
        expect_failure("cuMemAlloc", 2, false,
                       i == 0 ? "cuMemAlloc failed with WORD (2: WORD)"
                              : "cuMemAlloc failed with an unknown error (2: no description)");
    }
}

TEST(errors_that_lose_the_device) {
    static const HdCuResult losses[] = {46, 214, 220, 700, 702, 709, 714, 715, 716, 717, 718, 719};
    for (HdCuResult code = 1; code < 1000; code++) {
        bool is_loss = false;
        for (size_t i = 0; i < sizeof losses / sizeof *losses; i++)
            is_loss = is_loss || losses[i] == code;
        expect_failure("cuLaunchKernel", code, is_loss, "cuLaunchKernel failed");
    }
    /* Another program has exclusive use of the device. */
    expect_failure("cuDevicePrimaryCtxRetain", 46, false, "cuDevicePrimaryCtxRetain failed");
    expect_failure("cuDevicePrimaryCtxRetain", 700, true, "cuDevicePrimaryCtxRetain failed");
}

INSTEAD_OF("load_cuda_driver", load)
