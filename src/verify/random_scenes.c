/* SPDX-License-Identifier: MIT */
#include "verify/random_scenes.h"

#include <inttypes.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>

#include "input/check.h"
#include "render/backends.h"
#include "system/interrupt.h"
#include "system/machine.h"
#include "system/thread_pool.h"
#include "verify/first_difference.h"
#include "verify/scene_builder.h"
#include "verify/trust.h"

enum { WIDTH = 24, HEIGHT = 16, MAX_SOLIDS = 5, MAX_LIGHTS = 3 };
/* Planes that the kernels are built for; a floor takes five, cubes the fewest of all solids. */
enum { PLANES = 32, FLOOR_PLANES = 5, MIN_PLANES = 3 };

#define SHALLOW    .plane_count = PLANES, .depth = 8
#define DEEP       .plane_count = PLANES, .depth = 16
#define HAS_MESHES .node_stack = 32
#define ALL        .refracts = true, .lit_from_behind = true, .many_lights = true, .environment = true
/* Tables that are small enough are in constant memory (HdSceneTables.small_tables). */
#define SMALL .small_tables = true

/* Kind of scenes that the same kernels render. */
typedef struct Kind {
    const char *name;
    HdSceneTables needs; /* needs that the kernels are built for (hd_scene_tables_raise) */
    bool has_meshes, has_few_lights, has_many_lights, is_bounded;
} Kind;

static const Kind kinds[] = {
    {.name = "few lights", .needs = {SHALLOW, SMALL}, .has_few_lights = true},
    {.name = "few lights from behind",
     .needs = {SHALLOW, SMALL, .lit_from_behind = true},
     .has_few_lights = true},
    {.name = "refracting, few lights",
     .needs = {SHALLOW, SMALL, .refracts = true},
     .has_few_lights = true},
    {.name = "deep and lit from behind",
     .needs = {DEEP, SMALL, .lit_from_behind = true, .many_lights = true}},
    {.name = "many lights",
     .needs = {SHALLOW, SMALL, .many_lights = true},
     .has_many_lights = true},
    {.name = "many lights from behind",
     .needs = {SHALLOW, SMALL, .lit_from_behind = true, .many_lights = true},
     .has_many_lights = true},
    {.name = "all features of solids", .needs = {SHALLOW, SMALL, ALL}},
    {.name = "all, deep", .needs = {DEEP, SMALL, ALL}},
    {.name = "meshes", .needs = {SHALLOW, SMALL, HAS_MESHES}, .has_meshes = true},
    {.name = "all features with meshes",
     .needs = {SHALLOW, SMALL, HAS_MESHES, ALL, .cut_outs = true},
     .has_meshes = true},
    {.name = "error bound", .needs = {SHALLOW, SMALL, ALL, .bounded = true}, .is_bounded = true},
    {.name = "meshes in global memory, error bound",
     .needs = {SHALLOW, HAS_MESHES, ALL, .cut_outs = true, .bounded = true},
     .has_meshes = true,
     .is_bounded = true},
};

enum { KINDS = sizeof kinds / sizeof *kinds };

/* The kinds alternate. */
static int kind_of(uint64_t seed) {
    return (int)(seed % KINDS);
}

/* ---- random numbers ---- */

typedef struct Random {
    uint64_t state;
    const Kind *kind;
    int planes_left; /* for solids */
} Random;

/* SplitMix64 (Steele, Lea and Flood 2014, Fast Splittable Pseudorandom Number Generators). */
static uint64_t next(Random *rng) {
    uint64_t z = rng->state += 0x9e3779b97f4a7c15U;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9U;
    z = (z ^ z >> 27) * 0x94d049bb133111ebU;
    return z ^ z >> 31;
}

static double from_to(Random *rng, double least, double most) {
    return least + (most - least) * (double)(next(rng) >> 11) * 0x1p-53;
}

static int below(Random *rng, int count) {
    return (int)(next(rng) % (uint64_t)count);
}

static bool chance(Random *rng, double share) {
    return from_to(rng, 0.0, 1.0) < share;
}

/* C does not fix the order in which arguments are evaluated; the drawing order must be fixed. */
static HdVec3 vector(Random *rng, double least, double most) {
    HdVec3 v;
    v.x = from_to(rng, least, most);
    v.y = from_to(rng, least, most);
    v.z = from_to(rng, least, most);
    return v;
}

/* ---- materials ---- */

/* Draws reflection and transmission, with a sum of at most 1. */
static void draw_shares(Random *rng, double *reflection, double *transmission) {
    *reflection = chance(rng, 0.3) ? 0.0 : from_to(rng, 0.0, 0.9);
    *transmission = chance(rng, 0.15) ? 0.0 : from_to(rng, 0.0, 1.0 - *reflection);
}

static HdMaterial draw_material(Random *rng, bool is_opaque) {
    static const int exponents[] = {1, 2, 3, 7, 20, 64, 200, 1000};
    HdMaterial material = build_material(vector(rng, 0.0, 1.0), 0.0, 0.0);
    material.ambient = chance(rng, 0.25) ? from_to(rng, 0.0, 0.2) : 0.0;
    material.diffuse = chance(rng, 0.9) ? from_to(rng, 0.0, 1.0) : 0.0;
    material.specular = chance(rng, 0.5) ? from_to(rng, 0.0, 0.6) : 0.0;
    material.shininess = exponents[below(rng, (int)(sizeof exponents / sizeof *exponents))];
    if (chance(rng, 0.4))
        material.mirror_tint = vector(rng, 0.5, 1.0);
    draw_shares(rng, &material.reflection, &material.transmission);
    material.has_inner_side = !is_opaque && chance(rng, 0.5);
    if (material.has_inner_side)
        draw_shares(rng, &material.inner_reflection, &material.inner_transmission);
    material.lit_from_behind = rng->kind->needs.lit_from_behind && chance(rng, 0.6);
    if (!is_opaque)
        return material;
    material.transmission = 0.0;
    material.lit_from_behind = false;
    return material;
}

/* ---- scenes ---- */

static HdFalloff draw_falloff(Random *rng) {
    HdFalloff falloff = {0};
    double size = from_to(rng, 2.0, 8.0);
    int which = below(rng, 3);
    falloff.distance = which == 1 ? size : 0.0;
    falloff.end = which == 2 ? size : 0.0;
    return falloff;
}

static void draw_edge_lights(Random *rng, HdSolid *solid) {
    HdEdgeLights *lights = &solid->lights;
    *lights = (HdEdgeLights){.colour_count = 1};
    lights->per_edge = rng->kind->has_many_lights ? 2 + below(rng, 5) : 1 + below(rng, 3);
    if (rng->kind->has_few_lights)
        lights->per_edge = 1;
    lights->colour_count = 1 + below(rng, 2);
    for (int i = 0; i < lights->colour_count; i++)
        lights->colours[i] = vector(rng, 0.0, 1.0);
    lights->intensity = from_to(rng, 0.05, 0.4) / (rng->kind->has_many_lights ? 8.0 : 1.0);
    lights->falloff = draw_falloff(rng);
    if (chance(rng, 0.7)) {
        lights->disc_radius = from_to(rng, 0.005, 0.1) * solid->circumradius;
        lights->disc_radiance = from_to(rng, 0.5, 2.0);
    }
}

/* Solids that refract must not touch others: each gets its own sector. */
static void draw_place(Random *rng, HdSolid *solid, int number) {
    static const HdVec3 places[MAX_SOLIDS] = {
        {2.2, 0.0, 0.0}, {-2.2, 0.3, 0.2}, {0.0, 2.3, 0.4}, {0.2, -2.3, -0.2}, {0.0, 0.0, 2.4}};
    solid->circumradius = from_to(rng, 0.5, 1.6);
    solid->centre = vector(rng, -2.6, 2.6);
    solid->centre.z = from_to(rng, 0.0, 2.2);
    if (rng->kind->needs.refracts) {
        solid->circumradius = from_to(rng, 0.5, 1.1);
        solid->centre = places[number];
    }
    if (chance(rng, 0.85))
        solid->rotation_degrees = vector(rng, -180.0, 180.0);
}

static void draw_solid(Random *rng, HdSolid *solid, int number) {
    static const int planes[HD_SOLID_KIND_COUNT] = {4, MIN_PLANES, 4, 6, 10};
    *solid = (HdSolid){.lights = {.colour_count = 1}};
    solid->kind = (HdSolidKind)below(rng, HD_SOLID_KIND_COUNT);
    if (planes[solid->kind] > rng->planes_left - MIN_PLANES * (MAX_SOLIDS - 1 - number))
        solid->kind = HD_HEXAHEDRON;
    rng->planes_left -= planes[solid->kind];
    draw_place(rng, solid, number);
    solid->face = draw_material(rng, false);
    if (rng->kind->needs.refracts && chance(rng, 0.6))
        solid->face.index_of_refraction = from_to(rng, 0.7, 2.4);
    solid->rim = draw_material(rng, true);
    if (chance(rng, 0.5))
        solid->rim_width = from_to(rng, 0.02, 0.08) * solid->circumradius;
    bool has_lights = !rng->kind->has_few_lights || (number < 2 && solid->kind == HD_TETRAHEDRON);
    if (has_lights && chance(rng, rng->kind->has_many_lights ? 0.9 : 0.6))
        draw_edge_lights(rng, solid);
}

static bool draw_floor(Random *rng, HdScene *scene) {
    double x[4], y[4];
    for (int i = 0; i < 4; i++) {
        x[i] = (i == 1 || i == 2 ? 1.0 : -1.0) * from_to(rng, 3.5, 5.5);
        y[i] = (i < 2 ? 1.0 : -1.0) * from_to(rng, 3.5, 5.5);
    }
    build_floor(scene, hd_vec3(x[0], y[0], -1.5), hd_vec3(x[1], y[1], -1.5),
                hd_vec3(x[2], y[2], -1.5), hd_vec3(x[3], y[3], -1.5));
    scene->floor.material = draw_material(rng, true);
    return !chance(rng, 0.5) ||
           build_texture(&scene->floor.texture, 3 + below(rng, 30), 2 + below(rng, 30));
}

static bool draw_mesh(Random *rng, HdScene *scene, int number) {
    HdMesh *mesh = &scene->meshes[number];
    const HdMaterial first = draw_material(rng, false), second = draw_material(rng, false);
    if (chance(rng, 0.3))
        return build_cube_mesh(mesh, &first, &second);
    int rows = 3 + below(rng, 5);
    double bump = from_to(rng, 0.0, 0.3);
    bool is_smooth = chance(rng, 0.5), is_mapped = chance(rng, 0.5);
    if (!build_sphere_mesh(mesh, rows, bump, is_smooth, is_mapped, &first))
        return false;
    if (is_mapped)
        mesh->materials[0].picture = number;
    if (is_mapped && rng->kind->needs.cut_outs)
        mesh->materials[0].mask_picture = number;
    return is_smooth || build_colours(mesh);
}

static bool draw_meshes(Random *rng, HdScene *scene) {
    int meshes = 1 + below(rng, 2), instances = meshes + below(rng, 3);
    if (!build_meshes(scene, meshes, instances, meshes))
        return false;
    for (int i = 0; i < meshes; i++)
        if (!build_texture(&scene->pictures[i].texture, 8, 5) || !draw_mesh(rng, scene, i))
            return false;
    for (int i = 0; i < instances; i++) {
        HdVec3 place = vector(rng, -2.5, 2.5), rotation = vector(rng, -180.0, 180.0);
        build_instance(scene, i, i < meshes ? i : below(rng, meshes), place, rotation,
                       from_to(rng, 0.3, 1.1));
        scene->instances[i].has_material = chance(rng, 0.3);
        if (scene->instances[i].has_material)
            scene->instances[i].material = draw_material(rng, false);
    }
    return finish_meshes(scene);
}

static bool draw_sky(Random *rng, HdScene *scene) {
    const int height = 1 + below(rng, 20);
    const double top = from_to(rng, 0.1, 3.0), rotation = from_to(rng, -400.0, 400.0);
    return build_sky(scene, 2 * height, height, top, rotation);
}

static void draw_picture(Random *rng, HdScene *scene) {
    scene->depth = rng->kind->needs.depth - below(rng, 3);
    if (scene->depth > 8 || chance(rng, 0.4))
        scene->cutoff = from_to(rng, 0.001, 0.02);
    scene->background = vector(rng, 0.0, 0.4);
    scene->exposure = chance(rng, 0.5) ? 1.0 : from_to(rng, 0.5, 2.0);
    if (!rng->kind->is_bounded) {
        scene->sampling = chance(rng, 0.5) ? HD_SAMPLING_MULTIJITTER : HD_SAMPLING_GRID;
        scene->samples_per_side += scene->sampling == HD_SAMPLING_MULTIJITTER && chance(rng, 0.5);
        scene->sample_rows = chance(rng, 0.3) ? 1 + below(rng, 3) : 0;
        return;
    }
    scene->sampling = chance(rng, 0.5) ? HD_SAMPLING_MULTIJITTER : HD_SAMPLING_GRID;
    scene->max_error = from_to(rng, 1.0, 16.0);
    scene->cutoff = 0.0;
}

static bool draw_scene(Random *rng, HdScene *scene, HdCamera *camera) {
    int solids = rng->kind->has_meshes ? below(rng, 3) : 1 + below(rng, MAX_SOLIDS);
    int lights = below(rng, MAX_LIGHTS + 1);
    int samples = rng->kind->is_bounded ? 2 + below(rng, 2) : 1 + below(rng, 2);
    if (!build_scene(scene, WIDTH, HEIGHT, samples, 0, solids, lights))
        return false;
    draw_picture(rng, scene);
    rng->planes_left = PLANES - FLOOR_PLANES;
    for (int i = 0; i < solids; i++)
        draw_solid(rng, &scene->solids[i], i);
    for (HdLight *light = scene->lights; light < scene->lights + lights; light++) {
        light->position = vector(rng, -5.0, 5.0);
        light->position.z = from_to(rng, 2.0, 6.0);
        light->intensity = vector(rng, 0.0, 1.2);
        light->falloff = draw_falloff(rng);
    }
    if ((chance(rng, 0.8) && !draw_floor(rng, scene)) ||
        (rng->kind->needs.environment && chance(rng, 0.6) && !draw_sky(rng, scene)) ||
        (rng->kind->has_meshes && !draw_meshes(rng, scene)))
        return false;
    HdVec3 eye = vector(rng, -5.5, 5.5), target = vector(rng, -0.8, 0.8);
    eye.z = from_to(rng, -0.5, 4.5);
    build_camera(camera, eye, target, from_to(rng, 40.0, 100.0));
    return true;
}

/* Builds the same scene on every machine. Most are valid; an invalid one is drawn again. */
static HdStatus build_random(uint64_t seed, HdScene *scene, HdCamera *camera, HdError *error) {
    HdError ignored;
    Random rng = {.state = seed, .kind = &kinds[kind_of(seed)]};
    for (;;) {
        if (!draw_scene(&rng, scene, camera)) {
            hd_scene_free(scene);
            return HD_NO_ROOM(error, "the scene of seed %" PRIu64, seed);
        }
        if (hd_scene_validate(scene, &ignored) == HD_OK)
            return HD_OK;
        hd_scene_free(scene);
    }
}

/* ---- the test ---- */

enum { DEVICE, PLAIN_C, SIDES };
enum { ANY = -1, MAX_WORKERS = 16 };

typedef struct Worker {
    HdRenderer *renderers[SIDES];
    int kind; /* kind that the device's kernels are built for; ANY: none yet */
} Worker;

typedef struct Run {
    const HdRandomTest *test;
    HdDevice plain;
    Worker workers[MAX_WORKERS];
    int worker_count;
    pthread_mutex_t mutex; /* guards the members below, and serialises compilation */
    HdRandomResult *result;
    HdStatus status; /* of the first failure */
    HdError *error;
    atomic_bool has_failed; /* workers begin no further scene */
} Run;

/* Pixels with an error bound have other sizes: such kernels render no other scenes. */
static const HdSceneTables *needs_of(const HdRandomTest *test, int kind) {
    static const HdSceneTables general = {.plane_count = 32,
                                          .depth = 32,
                                          .node_stack = 32,
                                          .refracts = true,
                                          .lit_from_behind = true,
                                          .cut_outs = true,
                                          .environment = true};
    return test->general ? &general : &kinds[kind].needs;
}

/* ---- one scene ---- */

static HdStatus render(const Run *run, HdRenderer *renderer, const HdScene *scene,
                       const HdCamera *camera, int kind, uint64_t *hash, HdError *error) {
    HdFrame frame;
    HD_TRY(hd_put_and_render(renderer, scene, camera, needs_of(run->test, kind), 0, &frame, error));
    *hash = hd_frame_hash(&frame);
    hd_frame_free(&frame);
    return HD_OK;
}

static HdStatus compare(Run *run, Worker *worker, uint64_t seed, bool *differs, HdError *error) {
    HdScene scene;
    HdCamera camera;
    uint64_t found = 0, expected = 0;
    int kind = kind_of(seed);
    HD_TRY(build_random(seed, &scene, &camera, error));
    /* The first renderer that needs kernels compiles them and keeps them for the others. */
    const bool has_kernels = worker->kind == kind;
    if (!has_kernels)
        pthread_mutex_lock(&run->mutex);
    HdStatus status = render(run, worker->renderers[DEVICE], &scene, &camera, kind, &found, error);
    if (!has_kernels)
        pthread_mutex_unlock(&run->mutex);
    worker->kind = kind;
    if (status == HD_OK)
        status = render(run, worker->renderers[PLAIN_C], &scene, &camera, kind, &expected, error);
    hd_scene_free(&scene);
    *differs = found != expected;
    return status;
}

/* ---- the run ---- */

static void note(Run *run, uint64_t seed, HdStatus status, bool differs, const HdError *error) {
    HdRandomResult *result = run->result;
    pthread_mutex_lock(&run->mutex);
    if (status != HD_OK && run->status == HD_OK) {
        run->status = status;
        *run->error = *error;
        run->has_failed = true;
    }
    result->scenes += status == HD_OK;
    if (status == HD_OK && differs) {
        if (result->different == 0 || seed < result->first_seed)
            result->first_seed = seed;
        result->different++;
    }
    pthread_mutex_unlock(&run->mutex);
}

/* Orders the scenes by kind, since a kind's kernels are reused. */
static void work(void *context, int thread, int number) {
    Run *run = context;
    const HdRandomTest *test = run->test;
    (void)thread;
    for (int kind = 0; kind < KINDS; kind++)
        for (int i = number; i < test->scenes; i += run->worker_count) {
            HdError error;
            uint64_t seed = test->seed + (uint64_t)i;
            bool differs = false;
            if (kind_of(seed) != kind || (test->kind != ANY && test->kind != kind))
                continue;
            HdStatus status = hd_interrupt_signal() != 0
                                  ? hd_fail(&error, HD_INTERRUPTED, "interrupted")
                                  : compare(run, &run->workers[number], seed, &differs, &error);
            note(run, seed, status, differs, &error);
            if (run->has_failed)
                return;
        }
}

static bool has_failed(const void *context) {
    return ((const Run *)context)->has_failed;
}

static HdStatus open_workers(Run *run, HdError *error) {
    const HdRandomTest *test = run->test;
    const HdRenderOptions plain = {.precision = test->options.precision, .threads = 1};
    HdRenderOptions options = test->options;
    options.test.keeps_pipeline = true;
    HdStatus status = HD_OK;
    for (int i = 0; status == HD_OK && i < run->worker_count; i++) {
        Worker *worker = &run->workers[i];
        worker->kind = ANY;
        status = hd_renderer_open(&worker->renderers[DEVICE], test->device, &options, error);
        if (status == HD_OK)
            status = hd_renderer_open(&worker->renderers[PLAIN_C], &run->plain, &plain, error);
    }
    return status;
}

static HdStatus run_workers(Run *run, HdError *error) {
    HdThreadPool *pool;
    HdStatus status = open_workers(run, error);
    if (status == HD_OK)
        status = hd_thread_pool_create(&pool, run->worker_count, error);
    if (status == HD_OK) {
        hd_thread_pool_run(pool, run->worker_count, work, run, has_failed);
        hd_thread_pool_destroy(pool);
        status = run->status;
    }
    for (int i = 0; i < run->worker_count; i++)
        for (int side = 0; side < SIDES; side++)
            hd_renderer_close(run->workers[i].renderers[side]);
    return status;
}

/* ---- differences ---- */

static HdStatus build(const void *what, HdScene *scene, HdCamera *camera, HdError *error) {
    const HdRandomResult *result = what;
    return build_random(result->first_seed, scene, camera, error);
}

static HdStatus report_difference(const HdRandomTest *test, HdRandomResult *result,
                                  HdError *error) {
    char text[sizeof result->text / 2];
    int kind = kind_of(result->first_seed);
    const HdMismatch mismatch = {test->device, &test->options, needs_of(test, kind), build, result};
    HdStatus status = hd_first_difference(&mismatch, text, sizeof text, error);
    snprintf(result->text, sizeof result->text, "the scene of seed %" PRIu64 " (%s): %s",
             result->first_seed, kinds[kind].name, text);
    return status == HD_INTERRUPTED ? status : HD_OK;
}

HdStatus hd_random_test(const HdRandomTest *test, HdRandomResult *result, HdError *error) {
    Run run = {.test = test, .result = result, .error = error};
    *result = (HdRandomResult){0};
    HD_TRY(hd_find_plain_device(&run.plain, error));
    run.worker_count = test->threads > 0 ? test->threads : hd_processor_count();
    if (run.worker_count > MAX_WORKERS)
        run.worker_count = MAX_WORKERS;
    pthread_mutex_init(&run.mutex, NULL);
    HdStatus status = run_workers(&run, error);
    pthread_mutex_destroy(&run.mutex);
    if (status == HD_INTERRUPTED || result->different == 0)
        return status;
    HdError later; /* only the first failure is reported */
    HdStatus reported = report_difference(test, result, &later);
    return status == HD_OK ? reported : status;
}
