/* SPDX-License-Identifier: MIT */
/* The choice of devices from a registry of the test's own: "near" and "far", whose devices are
   plain C under other names, and "c". */
#define _XOPEN_SOURCE 700
#include "choice/devices.h"

#include "small_scene.h"
#include "system/machine.h"
#include "test_folder.h"
#include "wrapped.h"

static HdError error;
static HdRenderOptions options;
static HdScene scene;
static HdJob job;
static HdDeviceTeam team;
static HdCandidates candidates;

/* Reads the clock; each reading takes a millisecond. */
static double read_clock(void) {
    static double now;
    return now += 1e-3;
}
REPLACE(hd_monotonic_seconds, read_clock)

/* ---- the registry ---- */

enum { NEAR, FAR, C, MOST = 40 };

static bool is_missing; /* its devices cannot be opened */
static struct {
    HdDevice list[MOST];
    int count, asked;
    HdStatus status;
} there[HD_BACKEND_COUNT];

static HdStatus list_devices(int backend, HdDevice *devices, int capacity, int *count,
                             HdError *failure) {
    there[backend].asked++;
    assert_true(there[backend].count <= capacity);
    *count = there[backend].count;
    memcpy(devices, there[backend].list, sizeof *devices * (size_t)*count);
    return there[backend].status == HD_OK
               ? HD_OK
               : hd_fail(failure, there[backend].status, "its driver is ill");
}

#define LISTING(name, backend)                                                                     \
    static HdStatus name(HdDevice *devices, int capacity, int *count, HdError *failure) {          \
        return list_devices(backend, devices, capacity, count, failure);                           \
    }
LISTING(list_near, NEAR)
LISTING(list_far, FAR)
LISTING(list_c, C)

static HdStatus open_c(const HdDevice *device, const HdRenderOptions *asked, void **renderer,
                       HdError *failure) {
    HdRenderOptions own = *asked;
    own.lanes = 0; /* not every processor has kernels of several lanes */
    return is_missing ? hd_fail(failure, HD_UNAVAILABLE, "it is missing")
                      : hd_backend_c.functions->open(device, &own, renderer, failure);
}

static HdRendererFunctions c_functions;
static HdBackend near = {.name = "near", .functions = &c_functions, .enumerate = list_near};
static HdBackend far = {.name = "far", .functions = &c_functions, .enumerate = list_far};
static const HdBackend c = {.name = "c",
                            .needs_no_driver = true,
                            .uses_host_threads = true,
                            .functions = &c_functions,
                            .enumerate = list_c};

static const HdBackend *find_backend(const char *name) {
    int i = 0;
    while (i < HD_BACKEND_COUNT && strcmp(hd_backends[i]->name, name) != 0)
        i++;
    return i < HD_BACKEND_COUNT ? hd_backends[i] : NULL;
}
REPLACE(hd_backend_find, find_backend)

static const HdBackend *find_c(void) {
    return &c;
}
REPLACE(hd_backend_always_there, find_c)

static void replace_backends(void) {
    replaced_hd_backends[NEAR] = &near;
    replaced_hd_backends[FAR] = &far;
    replaced_hd_backends[C] = &c;
}
AT_START(replace_backends)

static HdDevice *add(int backend, const char *name, int units) {
    const int index = there[backend].count++;
    HdDevice *device = &there[backend].list[index];
    *device = (HdDevice){.index = index,
                         .driver = "driver 1",
                         .compute_units = units,
                         .clock_mhz = 1000,
                         .has_wide_atomics = true,
                         .is_cpu = backend == C};
    snprintf(device->name, sizeof device->name, "%s", name);
    return device;
}

static int begin(void **state) {
    (void)state;
    c_functions = *hd_backend_c.functions;
    c_functions.open = open_c;
    near.needs_no_driver = far.needs_no_driver = false;
    setenv("HEDRON_CACHE", "off", 1);
    memset(there, 0, sizeof there);
    is_missing = false;
    options = (HdRenderOptions){.threads = 1};
    if (small_scene(&scene, "hexahedron", &error) != HD_OK)
        return 1;
    job = (HdJob){.scene = &scene, .frame_count = 1};
    add(C, "Processor", 2);
    return 0;
}

static int end(void **state) {
    (void)state;
    hd_close_devices(&team);
    hd_scene_free(&scene);
    return 0;
}

/* ---- the result ---- */

/* Returns the last result: "near:0 far:1"; or the message. */
static char names[1024];

static void add_name(int number, const HdDevice *device) {
    const size_t length = number > 0 ? strlen(names) : 0;
    snprintf(names + length, sizeof names - length, "%s%s:%d", number > 0 ? " " : "",
             device->backend->name, device->index);
}

static const char *result_text(HdStatus status, HdStatus expected) {
    assert_int_equal(status, expected);
    return status == HD_OK ? names : error.message;
}

static const char *opened_by(HdDeviceSelection selection, HdStatus expected) {
    selection.options = &options;
    selection.job = &job;
    hd_close_devices(&team);
    const HdStatus status = hd_open_devices(&team, &selection, &error);
    assert_true(status == HD_OK || team.count == 0);
    for (int i = 0; i < team.count; i++) {
        assert_non_null(team.list[i].renderer);
        add_name(i, &team.list[i].device);
    }
    return result_text(status, expected);
}

static const char *found_by(HdDeviceSelection selection, HdStatus expected) {
    selection.options = &options;
    selection.job = &job;
    const HdStatus status = hd_candidates_find(&candidates, &selection, &error);
    for (int i = 0; i < candidates.count; i++)
        add_name(i, &candidates.list[i].device);
    return result_text(status, expected);
}

static const char *named(const char *backend, const char *device, HdStatus expected) {
    static HdDevice devices[HD_BACKEND_COUNT * HD_MAX_DEVICES];
    int count;
    const HdStatus status = hd_devices_named(backend, device, devices, &count, &error);
    for (int i = 0; i < count; i++)
        add_name(i, &devices[i]);
    return result_text(status, expected);
}

#define expect_opened(expected, ...)                                                               \
    assert_string_equal(opened_by((HdDeviceSelection){__VA_ARGS__}, HD_OK), expected)
#define expect_found(expected, ...)                                                                \
    assert_string_equal(found_by((HdDeviceSelection){__VA_ARGS__}, HD_OK), expected)
#define expect_failure(status, part, ...)                                                          \
    expect_contains(opened_by((HdDeviceSelection){__VA_ARGS__}, status), part)

/* ---- one ---- */

TEST(gpus_come_first_then_the_fastest) {
    expect_opened("c:0", .kind = HD_ONLY_CPU);
    assert_string_equal(team.why, "the C backend, since only a CPU will do");
    assert_int_equal(there[NEAR].asked + there[FAR].asked, 0);
    add(FAR, "Processor by driver", 9)->is_cpu = true;
    add(FAR, "Slow", 1);
    add(FAR, "Fast", 3)->clock_mhz = 900;
    add(FAR, "Cool", 5)->clock_mhz = 500;
    there[NEAR].status = HD_UNAVAILABLE;
    expect_opened("far:2", .backend = "far");
    assert_string_equal(team.why, "the best device of the backend named by --backend");
    there[NEAR].status = HD_OK;
    add(NEAR, "Old", 1);
    expect_found("near:0 far:2 far:3 far:1 far:0 c:0", .kind = HD_PREFER_GPU);
    assert_int_equal(candidates.compared, 4);
    assert_true(candidates.is_free && candidates.frame_seconds > 0.0);
    expect_failure(HD_UNAVAILABLE, "no device can do this: Old: it is not a CPU",
                   .kind = HD_ONLY_CPU, .backend = "near");
}

TEST(names_are_numbers_and_parts_of_names) {
    static const char *const found[][3] = {{"near:1", "near:1", NULL}, {"GIGA", "far:0", "far"},
                                           {"0", "far:0", "far"},      {"0", "near:0", NULL},
                                           {"1", "near:1", NULL},      {"proc", "c:0", NULL}};
    static const char *const none[] = {"near:2", "near:x", "1\xc3\xa9"};
    add(NEAR, "Turbo 10", 1);
    add(NEAR, "Giga 20", 9);
    add(FAR, "Giga 30", 9);
    expect_opened("near:0", .device = "turbo");
    assert_string_equal(team.why,
                        "named by --device; not used: far: no device of that number or name");
    for (size_t i = 0; i < sizeof found / sizeof *found; i++)
        expect_opened(found[i][1], .device = found[i][0], .backend = found[i][2]);
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        expect_failure(HD_UNAVAILABLE, "near: no device of that", .device = none[i]);
    expect_failure(HD_UNAVAILABLE,
                   "no device can do this (asked for device '30 '): near: no device of that number "
                   "or name",
                   .device = "30 ");
    expect_contains(error.message, "; see 'hedron devices'");
    expect_failure(HD_BAD_INPUT, "--device is 'near:1', but --backend is 'far'", .device = "near:1",
                   .backend = "far");
}

TEST(a_small_job_asks_no_driver_and_a_large_one_compares_devices) {
    add(NEAR, "Turbo", 9);
    add(FAR, "Processor by driver", 9)->is_cpu = true;
    expect_opened("c:0", .kind = HD_WANT_ANY);
    assert_int_equal(there[NEAR].asked, 0);
    assert_string_equal(team.why, "it needs about 0.003 s, less than other devices take to start");
    assert_string_equal(team.note, "");
    job.frame_count = 1 << 24;
    expect_found("near:0 c:0", .kind = HD_WANT_ANY);
    assert_int_equal(candidates.compared, 2);
    assert_true(candidates.is_free);
    expect_found("c:0", .device = "c:0");
    assert_int_equal(candidates.compared, 0);
    assert_false(candidates.is_free);
}

TEST(a_skipped_gpu_is_reported) {
    static const char unused_gpus[] =
        "near:0 (Broken) is not used: no compiler is here; far:0 (Wrong) is not used: it "
        "computes wrongly: 1 + 1; --math fast would take it, for other bytes";
    HdDevice *broken = add(NEAR, "Broken", 9);
    snprintf(broken->unusable, sizeof broken->unusable, "no compiler is here");
    snprintf(add(FAR, "Wrong", 9)->not_strict, 100, "it computes wrongly: 1 + 1");
    there[C].list[0].is_cpu = true;
    job.frame_count = 1 << 24;
    expect_found("c:0", .kind = HD_WANT_ANY);
    assert_string_equal(candidates.unused_gpus, unused_gpus);
    assert_string_equal(candidates.reasons,
                        "Broken: no compiler is here; Wrong: it computes wrongly: 1 + 1");
    expect_opened("c:0", .kind = HD_PREFER_GPU);
    assert_memory_equal(team.note, unused_gpus, sizeof unused_gpus - 1);
    assert_string_equal(team.note + sizeof unused_gpus - 1,
                        "; no suitable GPU was found; tracing with c on Processor");
    expect_contains(team.why, "no GPU can do this; not used: Broken: no compiler is here; ");
    /* A device that the user's own selection excludes need not be reported. */
    options.lanes = 4;
    expect_found("c:0", .kind = HD_WANT_ANY);
    assert_string_equal(candidates.unused_gpus, "");
    options.lanes = 1;
    assert_string_equal(found_by((HdDeviceSelection){.backend = "far"}, HD_UNAVAILABLE),
                        "no device can do this: Wrong: it computes wrongly: 1 + 1");
    assert_string_equal(candidates.unused_gpus, "");
    there[FAR].status = HD_FAILED;
    expect_found("c:0", .kind = HD_WANT_ANY);
    expect_contains(candidates.unused_gpus, "; far is not used: its driver is ill");
    there[FAR].status = HD_UNAVAILABLE;
    expect_found("c:0", .kind = HD_WANT_ANY);
    assert_null(strstr(candidates.unused_gpus, "far"));
    expect_contains(candidates.reasons, "; far: its driver is ill");
}

/* ---- several ---- */

TEST(a_list_names_each_once) {
    static const char *const wrong[][2] = {
        {"near:1,giga", "--device is 'near:1,giga', which names near:1 (Giga) twice"},
        {"near:1,,c:0", "'near:1,,c:0', which has an empty part"},
        {"near:1,", "which has an empty part"},
        {"c:0,all", "--device is 'c:0,all', expected 'all' without others"}};
    static const char *const several[] = {"near:0,c:0", "all"};
    add(NEAR, "Turbo", 9);
    add(NEAR, "Giga", 9);
    expect_opened("near:1 c:0 near:0", .device = "near:1,c:0,turbo");
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        expect_failure(HD_BAD_INPUT, wrong[i][1], .device = wrong[i][0]);
    expect_failure(HD_UNAVAILABLE, "(asked for device '2'): near: no device of that",
                   .device = "near:0,near:2");
    for (int i = 0; i < 2; i++)
        expect_failure(HD_BAD_INPUT, "', expected one device", .device = several[i],
                       .is_for_one = true);
}

TEST(more_devices_than_the_list_holds) {
    char list[8 * HD_MAX_WORKERS + 8] = "near:0";
    near.needs_no_driver = far.needs_no_driver = true; /* there is no result to read */
    for (int i = 0; i < MOST; i++)
        add(NEAR, "Card", 1 + i % 20), add(FAR, "Chip", 1);
    found_by((HdDeviceSelection){.backend = "near"}, HD_OK);
    assert_int_equal(candidates.count, HD_MAX_CANDIDATES);
    for (int i = 0; i < HD_MAX_CANDIDATES; i++)
        assert_int_equal(candidates.list[i].device.index, 19 - i / 2 + (i % 2) * 20);
    for (int i = 1; i < HD_MAX_WORKERS + 1; i++)
        snprintf(list + strlen(list), 9, ",%s:%d", i < MOST ? "near" : "far", i % MOST);
    expect_failure(HD_BAD_INPUT, "--device names more than 64 devices", .device = list);
    *strrchr(list, ',') = '\0';
    opened_by((HdDeviceSelection){.device = list}, HD_OK);
    assert_int_equal(team.count, HD_MAX_WORKERS);
    opened_by((HdDeviceSelection){.device = "all"}, HD_OK);
    assert_int_equal(team.count, HD_MAX_WORKERS);
}

TEST(all_means_the_devices_that_can_render_it) {
    add(NEAR, "Turbo", 9)->nvidia_arch = 61;
    add(NEAR, "Turbo", 9)->nvidia_arch = 61;
    add(FAR, "Turbo", 9)->nvidia_arch = 61;
    add(FAR, "Giga", 9);
    add(FAR, "Processor by driver", 9)->is_cpu = true;
    expect_opened("near:0 near:1 far:1 c:0", .device = "all");
    assert_string_equal(team.why, "one of all, by --device");
    assert_string_equal(team.note, "");
    expect_opened("far:0 far:1 far:2", .device = "all", .backend = "far");
    expect_opened("c:0", .device = "all", .kind = HD_ONLY_CPU);
    snprintf(there[FAR].list[1].unusable, 100, "no compiler is here");
    expect_opened("near:0 near:1 c:0", .device = "all");
    assert_string_equal(team.note, "far:1 (Giga) is left out: no compiler is here");
    is_missing = true;
    expect_failure(HD_UNAVAILABLE,
                   "no device can do this: near:0 (Turbo) is left out: near: it is missing; "
                   "near:1 (Turbo) is left out: near: it is missing; far:0 ",
                   .device = "all");
    there[FAR].count = 0;
    there[FAR].status = HD_UNAVAILABLE;
    expect_failure(HD_UNAVAILABLE, "no device can do this: far: its driver is ill", .device = "all",
                   .backend = "far");
}

TEST(plain_c_leaves_a_core_to_each_gpu) {
    options.threads = 0;
    for (int gpus = 0; gpus < 3; gpus++) {
        char text[256], expected[64];
        const int left = hd_processor_count() - gpus, threads = left > 1 ? left : 1;
        opened_by((HdDeviceSelection){.device = "all"}, HD_OK);
        assert_int_equal(team.count, gpus + 1);
        hd_renderer_describe(team.list[gpus].renderer, text, sizeof text);
        snprintf(expected, sizeof expected, "%d thread%s", threads, threads == 1 ? "" : "s");
        expect_contains(text, expected);
        add(NEAR, "Turbo", 9);
    }
}

TEST(devices_are_named_whatever_they_can_do) {
    snprintf(add(NEAR, "Turbo", 9)->unusable, 100, "no compiler is here");
    add(NEAR, "Giga", 9);
    there[FAR].status = HD_FAILED;
    assert_string_equal(named(NULL, NULL, HD_OK), "near:0 near:1 c:0");
    assert_string_equal(named("near", "all", HD_OK), "near:0 near:1");
    assert_string_equal(named(NULL, "giga", HD_OK), "near:1");
    assert_string_equal(named(NULL, "near:0", HD_OK), "near:0");
    named("c", "near:0", HD_BAD_INPUT);
    assert_string_equal(named(NULL, "7", HD_UNAVAILABLE),
                        "there is no such device ('7'): near: no device of that number or name; "
                        "far: its driver is ill");
    assert_string_equal(named("far", NULL, HD_UNAVAILABLE),
                        "there is no such device: far: its driver is ill");
}

TEST(every_backend_is_found_by_its_name) {
    assert_ptr_equal(real_hd_backend_find("cuda"), &hd_backend_cuda);
    assert_null(real_hd_backend_find("d"));
    assert_ptr_equal(real_hd_backend_always_there(), &hd_backend_c);
}

EACH(begin, end)
