/* SPDX-License-Identifier: MIT */
/* The leak hunt: aims rays at edges and corners of closed meshes (hunt.h) on every backend and
   device that opens, in float and double, with both pipelines and on CPUs with every number of
   lanes. It counts those that cross a surface too seldom (leaks) or too often (double hits). At
   least RAYS are aimed for each backend and precision; another --seed aims other ones, so that a
   long hunt can be made in parts.

   Exit codes: 0 no leaks, 1 leaks or a failure, 2 wrong usage, 77 nothing of --backend opens. */
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../conformance/render_scene.h"
#include "../options.h"
#include "hunt.h"
#include "input/check.h"
#include "render/backends.h"
#include "render/frame.h"
#include "verify/golden.h"
#include "verify/trust.h"

enum { PIPELINES = 2, MAX_RENDERERS = LANE_COUNTS * PIPELINES };

/* Few rays go into small pictures, so that enough remain for every scene and renderer. */
enum { TINY_SIDE = 33, SMALL_SIDE = 65, LARGE_SIDE = 257 };
static const double few_rays = 1e5, many_rays = 2e7;

static const char usage[] =
    "usage: hedron_leak_hunt RAYS [--backend cuda|opencl|c]\n"
    "                        [--precision float|double] [--lanes 1|2|4|8|16] [--seed N]\n"
    "RAYS may be written as 1e9\n";
static const HdPipeline pipelines[PIPELINES] = {HD_PIPELINE_MEGA, HD_PIPELINE_WAVEFRONT};

typedef struct Options {
    double rays;
    const HdBackend *backend; /* NULL: all */
    int precision, lanes;     /* an HdPrecision, an index into lane_counts; or ALL */
    int seed;
} Options;

typedef struct Total {
    Catch caught;
    int renderers;
} Total;

/* The renderers of one device and precision. */
typedef struct Party {
    HdRenderer *renderers[MAX_RENDERERS];
    int count;
    HdPrecision precision;
    int side;
    int seed;
    double share; /* rays for each renderer, placement and kind */
} Party;

static void add_catch(Catch *sum, const Catch *more) {
    sum->rays += more->rays;
    sum->leaks += more->leaks;
    sum->double_hits += more->double_hits;
}

static void print_catch(const char *name, const Catch *caught) {
    printf("  %-28s %12" PRIu64 " rays, %" PRIu64 " leaks, %" PRIu64 " double hits\n", name,
           caught->rays, caught->leaks, caught->double_hits);
    fflush(stdout);
}

static void upload(HdRenderer *renderer, const Hunt *hunt) {
    HdError error;
    if (hd_scene_validate(&hunt->scene, &error) != HD_OK ||
        hd_put_scene(renderer, &hunt->scene, &hd_golden_needs, &error) != HD_OK)
        fail(hunt->placement->name, &error);
}

static void hunt_frame(HdRenderer *renderer, Hunt *hunt, double step, HdFrame *frame,
                       Catch *caught) {
    HdError error;
    const HdFrameMaker maker = {.renderer = renderer, .scene = &hunt->scene};
    HdCamera camera = hunt_camera(hunt, step);
    if (hd_frame_render(&maker, &camera, frame, &error) != HD_OK)
        fail(hunt->placement->name, &error);
    hunt_judge(hunt, frame->rgb, caught);
}

/* Hunts until the share of rays is spent; the mesh is made for the first frame's eye. */
static void hunt_with(HdRenderer *renderer, Hunt *hunt, const Party *party, Catch *caught) {
    HdError error;
    HdFrame frame;
    Catch mine = {0};
    double step = party->precision == HD_PRECISION_FLOAT ? 0x1p-24 : 0x1p-53;
    hunt_move_light(hunt, step);
    upload(renderer, hunt);
    if (hd_frame_create(&frame, party->side, party->side, &error) != HD_OK)
        fail(hunt->placement->name, &error);
    for (int i = 0; i == 0 || (double)mine.rays < party->share; i++)
        hunt_frame(renderer, hunt, i == 0 ? 0.0 : step, &frame, &mine);
    hd_frame_free(&frame);
    add_catch(caught, &mine);
}

static void hunt_placement(const Party *party, int number, Catch *caught) {
    for (int kind = 0; kind < HUNT_KINDS; kind++) {
        Hunt hunt;
        hunt_begin(&hunt, (HuntKind)kind, &placements[number], party->side,
                   (uint64_t)party->seed << 32 | (uint32_t)(1 + number * HUNT_KINDS + kind));
        for (int i = 0; i < party->count; i++)
            hunt_with(party->renderers[i], &hunt, party, caught);
        hunt_end(&hunt);
    }
}

/* ---- devices ---- */

/* Adds the renderer to the party if it opens. */
static void join(Party *party, const HdDevice *device, const HdRenderOptions *wanted) {
    HdError error;
    HdRenderer *renderer;
    char text[256];
    HdStatus status = hd_renderer_open(&renderer, device, wanted, &error);
    if (status == HD_UNAVAILABLE) {
        printf("  without %d lanes: %s\n", wanted->lanes, error.message);
        return;
    }
    if (status != HD_OK)
        fail(device->name, &error);
    hd_renderer_describe(renderer, text, (int)sizeof text);
    printf("  %s\n", text);
    party->renderers[party->count++] = renderer;
}

/* Adds the C backend with all numbers of lanes; devices that compile their kernels, which takes
   long, with their default. */
static void gather(Party *party, const HdDevice *device, const Options *options) {
    int lane_choices = device->backend == &hd_backend_c ? LANE_COUNTS : 1;
    for (int i = 0; i < lane_choices; i++)
        for (int p = 0; p < PIPELINES; p++) {
            HdRenderOptions wanted = {.precision = party->precision, .pipeline = pipelines[p]};
            if (options->lanes != ALL)
                wanted.lanes = lane_counts[options->lanes];
            else if (lane_choices > 1)
                wanted.lanes = lane_counts[i];
            if (lane_choices == 1 || options->lanes == ALL || options->lanes == i)
                join(party, device, &wanted);
        }
}

static void hunt_device(const HdDevice *device, HdPrecision precision, const Options *options,
                        Total *total) {
    Party party = {.precision = precision, .seed = options->seed};
    Catch sum = {0};
    printf("%s %s, %s\n", device->backend->name, precision_names[precision], device->name);
    gather(&party, device, options);
    if (party.count == 0)
        return;
    party.side = options->rays < few_rays    ? TINY_SIDE
                 : options->rays < many_rays ? SMALL_SIDE
                                             : LARGE_SIDE;
    party.share = options->rays / (party.count * PLACEMENT_COUNT * (int)HUNT_KINDS);
    for (int i = 0; i < PLACEMENT_COUNT; i++) {
        Catch caught = {0};
        hunt_placement(&party, i, &caught);
        print_catch(placements[i].name, &caught);
        add_catch(&sum, &caught);
    }
    print_catch("in all", &sum);
    add_catch(&total->caught, &sum);
    total->renderers += party.count;
    for (int i = 0; i < party.count; i++)
        hd_renderer_close(party.renderers[i]);
}

static void hunt_backend(const HdBackend *backend, const Options *options, Total *total) {
    HdDevice devices[HD_MAX_DEVICES];
    int count = find_devices(backend, devices);
    for (int i = 0; i < count; i++)
        for (int p = HD_PRECISION_FLOAT; p <= HD_PRECISION_DOUBLE; p++)
            if (options->precision == ALL || options->precision == p)
                hunt_device(&devices[i], (HdPrecision)p, options, total);
}

/* ---- the command line ---- */

static bool parse_rays(const char *text, double *rays) {
    char *end;
    *rays = strtod(text, &end);
    return end != text && *end == '\0' && *rays >= 1.0 && *rays <= 1e15;
}

static bool parse(Options *options, int count, char **arguments) {
    const Option list[] = {
        {"--backend", .backend = &options->backend},
        {"--precision", .number = &options->precision, .choices = precision_names},
        {"--lanes", .number = &options->lanes, .choices = lane_names},
        {"--seed", .number = &options->seed},
        {.name = NULL},
    };
    return count > 1 && parse_rays(arguments[1], &options->rays) &&
           parse_options(list, count - 1, arguments + 1);
}

int main(int count, char **arguments) {
    Options options = {.precision = ALL, .lanes = ALL};
    Total total = {{0}, 0};
    if (!parse(&options, count, arguments)) {
        fputs(usage, stderr);
        return EXIT_USAGE;
    }
    /* The plain C backend first: it always exists. */
    for (int i = HD_BACKEND_COUNT - 1; i >= 0; i--)
        if (options.backend == NULL || options.backend == hd_backends[i])
            hunt_backend(hd_backends[i], &options, &total);
    if (total.renderers == 0) {
        printf("nothing opened\n");
        return options.backend != NULL ? EXIT_SKIPPED : 1;
    }
    printf("total of %d renderers:\n", total.renderers);
    print_catch("", &total.caught);
    return total.caught.leaks > 0 || total.caught.double_hits > 0 ? 1 : 0;
}
