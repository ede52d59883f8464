/* SPDX-License-Identifier: MIT */
/* Runs the commands about devices: devices, selftest, tune. */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <time.h>

#include "base/text.h"
#include "choice/devices.h"
#include "choice/measure.h"
#include "cli/console.h"
#include "cli/options.h"
#include "input/json.h"
#include "output/fingerprint.h"
#include "render/backends.h"
#include "run/load_scene.h"
#include "scene/frame_list.h"
#include "scene/sample_pattern.h"
#include "verify/self_test_report.h"

/* ---- devices ---- */

/* A driver's text may contain control sequences of a terminal. */
static void print_escaped(const char *before, const char *text) {
    char escaped[6 * sizeof((HdDevice *)NULL)->unusable];
    hd_escape(text, escaped, sizeof escaped);
    printf("%s%s\n", before, escaped);
}

static void print_device(const HdDevice *device) {
    printf("  %d", device->index);
    print_escaped("  ", device->name);
    print_escaped("     ", device->driver);
    if (device->unusable[0] != '\0')
        print_escaped("     cannot be used: ", device->unusable);
    const char *strict = device->not_strict[0] != '\0' ? "no, " : "yes";
    printf("     %s, double precision: %s, strict arithmetic: %s%s\n",
           device->is_cpu ? "CPU" : "GPU", device->has_double ? "yes" : "no",
           device->is_measured ? strict : "not measured yet (hedron selftest does)",
           device->not_strict);
}

static void print_backend(const HdBackend *backend, const HdDevice *devices, int count,
                          const char *unsupported_reason) {
    printf("%s\n", backend->name);
    if (unsupported_reason != NULL)
        print_escaped("  not available: ", unsupported_reason);
    for (int i = 0; i < count; i++)
        print_device(&devices[i]);
}

static json_t *describe_device(const HdDevice *device) {
    return json_pack(
        "{s:s, s:i, s:o, s:o, s:b, s:i, s:i, s:b, s:o, s:b, s:o}", "backend", device->backend->name,
        "index", device->index, "name", hd_json_device_text(device->name), "driver",
        hd_json_device_text(device->driver), "is_cpu", device->is_cpu, "compute_units",
        device->compute_units, "clock_mhz", device->clock_mhz, "has_double", device->has_double,
        "unusable", hd_json_text_or_null(device->unusable), "is_measured", device->is_measured,
        "not_strict", hd_json_text_or_null(device->not_strict));
}

static json_t *describe_backend(const HdBackend *backend, const HdDevice *devices, int count,
                                const char *unsupported_reason) {
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        list = hd_json_append(list, describe_device(&devices[i]));
    return json_pack("{s:s, s:b, s:o, s:o}", "name", backend->name, "available",
                     unsupported_reason == NULL, "reason", hd_json_text_or_null(unsupported_reason),
                     "devices", list);
}

HdStatus hd_command_devices(const HdOptions *options, HdError *error) {
    static HdDevice devices[HD_MAX_DEVICES];
    json_t *list = options->json ? json_array() : NULL;
    for (int i = 0; i < HD_BACKEND_COUNT; i++) {
        const HdBackend *backend = hd_backends[i];
        int count = 0;
        bool found = hd_backend_enumerate(backend, devices, HD_MAX_DEVICES, &count, error) == HD_OK;
        const char *unsupported_reason = found ? NULL : error->message;
        if (options->json)
            list =
                hd_json_append(list, describe_backend(backend, devices, count, unsupported_reason));
        else
            print_backend(backend, devices, count, unsupported_reason);
    }
    return options->json ? hd_json_print(json_pack("{s:s, s:o}", "kernels", hd_kernels_hash,
                                                   "backends", list),
                                         "the list of devices", error)
                         : HD_OK;
}

/* ---- selftest ---- */

enum { TIME_SIZE = 32, HASH_SIZE = 17 };

static void write_time(const HdSelfTestReport *report, char text[TIME_SIZE]) {
    const time_t seconds = (time_t)report->time;
    struct tm parts;
    text[0] = '\0';
    if (gmtime_r(&seconds, &parts) != NULL)
        strftime(text, TIME_SIZE, "%Y-%m-%dT%H:%M:%SZ", &parts);
}

static void print_test(const HdReportTest *test) {
    printf("  %-8s %s", hd_test_result_names[test->result], test->name);
    if (test->tuples > 0)
        printf(", %d tuples of operands", test->tuples);
    if (test->frames > 0)
        printf(", %d of them", test->frames);
    if (test->by_fma)
        printf(", division by fma");
    printf(" (%.2f s)\n", test->seconds);
    if (test->reason[0] != '\0')
        printf("           %s\n", test->reason);
}

static void print_report(const HdSelfTestReport *report) {
    const HdDevice *device = &report->device;
    char when[TIME_SIZE];
    write_time(report, when);
    printf("%s:%d  %s\n  %s\n", device->backend->name, device->index, device->name, device->driver);
    for (int i = 0; i < report->test_count; i++)
        print_test(&report->tests[i]);
    printf("  %s: hedron %s%s%s, %s, %.2f s\n", hd_test_result_names[report->result], HD_VERSION,
           report->compiler[0] != '\0' ? ", kernels by " : "", report->compiler, when,
           report->seconds);
}

static json_t *describe_test(const HdReportTest *test) {
    char hash[HASH_SIZE];
    snprintf(hash, sizeof hash, "%016" PRIx64, test->hash);
    return json_pack(
        "{s:s, s:s, s:o, s:o, s:o, s:b, s:s, s:f}", "name", test->name, "verdict",
        hd_test_result_names[test->result], "reason", hd_json_text_or_null(test->reason), "tuples",
        hd_json_count_or_null(test->tuples), "frames", hd_json_count_or_null(test->frames),
        "division_by_fma", test->by_fma, "hash", hash, "seconds", test->seconds);
}

static json_t *describe_report(const HdSelfTestReport *report) {
    const HdDevice *device = &report->device;
    json_t *tests = json_array();
    char when[TIME_SIZE];
    write_time(report, when);
    for (int i = 0; i < report->test_count; i++)
        tests = hd_json_append(tests, describe_test(&report->tests[i]));
    return json_pack(
        "{s:s, s:s, s:i, s:o, s:o, s:o, s:s, s:o, s:s, s:f}", "hedron", HD_VERSION, "backend",
        device->backend->name, "index", device->index, "name", hd_json_device_text(device->name),
        "driver", hd_json_device_text(device->driver), "compiler",
        hd_json_text_or_null(report->compiler), "verdict", hd_test_result_names[report->result],
        "tests", tests, "time", when, "seconds", report->seconds);
}

typedef struct Tally {
    int tested, wrong;
    json_t *list; /* reports */
} Tally;

static HdStatus test_device(const HdOptions *options, const HdDevice *device, Tally *tally,
                            HdError *error) {
    static HdSelfTestReport report;
    const HdTestEffort effort = options->deep    ? HD_TEST_DEEP
                                : options->quick ? HD_TEST_QUICK
                                                 : HD_TEST_WHOLE;
    HD_TRY(hd_self_test(&report, device, effort, error));
    tally->tested += report.result != HD_RESULT_UNTESTED;
    tally->wrong += report.result == HD_RESULT_WRONG;
    if (options->json)
        tally->list = hd_json_append(tally->list, describe_report(&report));
    else
        print_report(&report);
    fflush(stdout);
    return HD_OK;
}

static HdStatus check_results(const Tally *tally, int count, HdError *error) {
    if (tally->wrong > 0)
        return hd_fail(error, HD_FAILED, "%d of %d device%s computes wrongly", tally->wrong, count,
                       hd_plural(count));
    if (tally->tested == 0)
        return hd_fail(error, HD_UNAVAILABLE, "no device could be tested");
    return HD_OK;
}

HdStatus hd_command_selftest(const HdOptions *options, HdError *error) {
    static HdDevice devices[HD_BACKEND_COUNT * HD_MAX_DEVICES];
    int count;
    HD_TRY(hd_devices_named(options->devices.backend, options->devices.device, devices, &count,
                            error));
    HdStatus status = HD_OK;
    Tally tally = {.list = json_array()};
    for (int i = 0; status == HD_OK && i < count; i++)
        status = test_device(options, &devices[i], &tally, error);
    if (status == HD_OK && options->json)
        status = hd_json_print(json_pack("{s:O}", "certificates", tally.list), "the certificates",
                               error);
    json_decref(tally.list);
    return status == HD_OK ? check_results(&tally, count, error) : status;
}

/* ---- tune ---- */

typedef struct Run {
    const HdOptions *options;
    HdRenderOptions render; /* options of the scene */
    const HdScene *scene;   /* with as much work, without an error bound */
    HdDeviceTeam team;      /* closed before the measurement */
    const HdDevice *device; /* its only device */
    HdTuning tuning;
    const char *unsupported_reason; /* why the best options cannot be remembered; NULL: they can */
} Run;

static double ratio(const HdTuning *tuning, int index) {
    return tuning->candidates[index].seconds / tuning->candidates[0].seconds;
}

static void print_candidate(const HdTuning *tuning, int index) {
    const HdTuningCandidate *candidate = &tuning->candidates[index];
    char name[128];
    hd_launch_describe(&candidate->options, name, sizeof name);
    if (candidate->failure[0] == '\0')
        printf("%-52s %10.3f %7.3f\n", name, 1e3 * candidate->seconds, ratio(tuning, index));
    else
        printf("%-52s cannot be used: %s\n", name, candidate->failure);
}

static void print_table(const Run *run) {
    const HdDevice *device = run->device;
    char name[128];
    printf("%s on %s %d, %s (%s)\n", hd_scene_name(run->options->scene.path), device->backend->name,
           device->index, device->name, device->driver);
    printf("pictures of %d x %d pixels, %d x %d samples\n\n", run->tuning.width, run->tuning.height,
           run->scene->samples_per_side, hd_sample_rows(run->scene));
    printf("%-52s %10s %7s\n", "candidate", "ms", "ratio");
    for (int i = 0; i < run->tuning.count; i++)
        print_candidate(&run->tuning, i);
    hd_launch_describe(&run->tuning.candidates[run->tuning.best].options, name, sizeof name);
    printf("\nthe best: %s; ", name);
    if (run->unsupported_reason == NULL)
        printf("remembered for scenes of this kind\n");
    else
        printf("not remembered: %s\n", run->unsupported_reason);
}

static json_t *describe_candidate(const HdTuning *tuning, int index) {
    const HdTuningCandidate *candidate = &tuning->candidates[index];
    const HdRenderOptions *launch = &candidate->options;
    bool works = candidate->failure[0] == '\0';
    return json_pack(
        "{s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "pipeline", hd_pipeline_names[launch->pipeline],
        "lanes", hd_json_count_or_null(launch->lanes), "block",
        hd_json_count_or_null(launch->block), "grid", hd_json_count_or_null(launch->grid),
        "registers", hd_json_count_or_null(launch->registers), "ms",
        works ? json_real(1e3 * candidate->seconds) : json_null(), "ratio",
        works ? json_real(ratio(tuning, index)) : json_null(), "failure",
        hd_json_text_or_null(candidate->failure));
}

static HdStatus print_json(const Run *run, HdError *error) {
    const HdDevice *device = run->device;
    const HdTuning *tuning = &run->tuning;
    json_t *list = json_array();
    for (int i = 0; i < tuning->count; i++)
        list = hd_json_append(list, describe_candidate(tuning, i));
    json_t *root = json_pack(
        "{s:o, s:s, s:i, s:o, s:o, s:i, s:i, s:i, s:o, s:i, s:b, s:o}", "scene",
        hd_json_device_text(hd_scene_name(run->options->scene.path)), "backend",
        device->backend->name, "index", device->index, "name", hd_json_device_text(device->name),
        "driver", hd_json_device_text(device->driver), "width", tuning->width, "height",
        tuning->height, "samples", run->scene->samples_per_side, "candidates", list, "best",
        tuning->best, "remembered", run->unsupported_reason == NULL, "reason",
        hd_json_text_or_null(run->unsupported_reason));
    return hd_json_print(root, "the candidates", error);
}

/* Measures on the device that 'hedron render' would choose. */
static HdStatus measure(Run *run, const HdJob *job, HdError *error) {
    const HdDeviceSelection selection = {
        .backend = run->options->devices.backend,
        .device = run->options->devices.device,
        .is_for_one = true,
        .options = &run->render,
        .job = job,
    };
    HdConsole console;
    hd_console_open(&console, &run->options->reporting);
    hd_console_prepare(&console, "measuring");
    HdStatus status = hd_open_devices(&run->team, &selection, error);
    hd_close_devices(&run->team);
    if (status == HD_OK)
        status = hd_tune(&run->tuning, run->device, &run->render, job, error);
    hd_console_clear(&console);
    if (run->team.note[0] != '\0')
        fprintf(stderr, "hedron: %s\n", run->team.note);
    if (status == HD_INTERRUPTED)
        hd_fail(error, status, "interrupted; nothing is remembered");
    return status;
}

/* Without a cache folder remembers nothing; a folder that fails is an error. */
static HdStatus tune(Run *run, const HdJob *job, HdError *error) {
    HD_TRY(measure(run, job, error));
    HdStatus status =
        hd_tuning_remember(&run->tuning, run->device, &run->render, run->scene, error);
    run->unsupported_reason = status == HD_OK ? NULL : error->message;
    status = status == HD_UNAVAILABLE ? HD_OK : status;
    if (!run->options->json)
        print_table(run);
    const HdStatus printed = run->options->json ? print_json(run, error) : HD_OK;
    return status == HD_OK ? printed : status;
}

HdStatus hd_command_tune(const HdOptions *options, HdError *error) {
    static Run run;
    HdSceneFile file;
    HdFrameList frames;
    HdProblems notes = {.count = 0};
    HdStatus status = hd_load_scene(&file, &options->scene, &notes, error);
    hd_problems_print(&notes, stderr, "hedron", ": ");
    HD_TRY(status);
    run = (Run){.options = options, .scene = &file.scene, .device = &run.team.list[0].device};
    run.render = options->devices.render;
    run.render.has_deep_trees = hd_scene_has_deep_trees(&file.scene);
    hd_scene_drop_error_bound(&file.scene);
    status = hd_frame_list_parse(&frames, options->frames, file.scene.frame_count, error);
    if (status == HD_OK) {
        HdJob job = {
            .scene = &file.scene,
            .first_frame = frames.frames[0],
            .frame_count = frames.count,
        };
        status = tune(&run, &job, error);
        hd_frame_list_free(&frames);
    }
    hd_scene_file_free(&file);
    return status;
}
