/* SPDX-License-Identifier: MIT */
/* Rates of the kernels' searches of meshes on one thread, and those of Embree where it is
   installed. bench/study triangles reads the output:

     build SET LANES
     object TRIANGLES
     rate KIND TRIANGLES WHO PER_CPU_SECOND    rays, a line for each round; WHO: hedron, or a way of
                                               Embree's with _ for blanks, robust_ before it in its
                                               robust mode
     same KIND TRIANGLES WAY SHARE             of the rays both met the same, up to rounding
     aimed TRIANGLES WHO RAYS LEAKS ODD        at edges and corners; so many pass through what they
                                               are aimed at, so many cross the closed surface an
                                               odd number of times: leaks, or hits that count twice
     built TRIANGLES WHO CPU_SECONDS           the hierarchy, on all threads, a line for each round

   Ends with 0, 1 where there is too little memory, 2 where it is called wrongly. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../kernel_rates/processor_time.h"
#include "rival.h"
#include "system/thread_pool.h"
#include "walks.h"

#define HD_BUILD_TYPE HdWalks
#include "../kernel_rates/builds.h"

enum { MOST_COUNTS = 16, MOST_THREADS = 64, RIVALS = 2 };

typedef struct Options {
    double seconds; /* of processor time for one rate */
    int rounds, side, threads;
    int counts[MOST_COUNTS], count_count;
} Options;

/* ---- rates ---- */

/* One search, by hedron or by a way of the rival's. */
typedef struct Searcher {
    const HdWalks *walks;
    const HdObject *object;
    const HdRival *rivals[RIVALS]; /* plain and robust; NULL: there is none */
    int rival;                     /* which one */
    const HdRivalWay *way;         /* NULL: hedron's */
} Searcher;

static void search(const Searcher *searcher, const HdRays *rays, HdHits *hits) {
    if (searcher->way != NULL)
        searcher->way->search(searcher->rivals[searcher->rival], rays, hits);
    else
        searcher->walks->search(searcher->object, rays, hits);
}

static double rate(const Searcher *searcher, const HdRays *rays, HdHits *hits, double seconds) {
    double start = hd_processor_seconds(), end = start, done = 0;
    while (end - start < seconds) {
        search(searcher, rays, hits);
        done += rays->count;
        end = hd_processor_seconds();
    }
    return done / (end - start);
}

static void print_name(const Searcher *searcher) {
    if (searcher->way == NULL) {
        printf("hedron");
        return;
    }
    printf("%s", searcher->rival > 0 ? "robust_" : "");
    for (const char *name = searcher->way->name; *name != '\0'; name++)
        putchar(*name == ' ' ? '_' : *name);
}

/* The next one after hedron, then each way of each rival; false: there is no more. */
static bool take_next(Searcher *searcher) {
    searcher->way = searcher->way == NULL ? hd_rival_ways : searcher->way + 1;
    if (searcher->rivals[searcher->rival] != NULL && searcher->way->name != NULL)
        return true;
    searcher->rival++;
    searcher->way = hd_rival_ways;
    return searcher->rival < RIVALS && searcher->rivals[searcher->rival] != NULL;
}

static bool is_near(float a, float b) {
    return a == b || fabsf(a - b) <= 1e-3f * (1.0f + fabsf(b));
}

/* The share of the rays that found the same. */
static double agreement(const HdRays *rays, const HdHits *a, const HdHits *b) {
    int same = 0;
    for (int i = 0; i < rays->count; i++) {
        if (rays->kind == HD_RAYS_SHADOW)
            same += is_near(a->passing[0][i], b->passing[0][i]) &&
                    is_near(a->passing[2][i], b->passing[2][i]);
        else
            same += a->triangle[i] < 0 ? b->triangle[i] < 0 : is_near(a->t[i], b->t[i]);
    }
    return (double)same / rays->count;
}

static void print_rate(const Options *options, const Searcher *searcher, const HdRays *rays,
                       HdHits *hits) {
    printf("rate %s %d ", hd_ray_kind_names[rays->kind], searcher->object->triangle_count);
    print_name(searcher);
    printf(" %.6e\n", rate(searcher, rays, hits, options->seconds));
}

static void measure(const Options *options, const Searcher *hedron, const HdRays *rays,
                    HdHits *hits, HdHits *others) {
    search(hedron, rays, hits);
    for (int round = 0; round < options->rounds; round++) {
        Searcher searcher = *hedron;
        print_rate(options, hedron, rays, hits);
        while (take_next(&searcher)) {
            print_rate(options, &searcher, rays, others);
            if (round > 0)
                continue;
            printf("same %s %d ", hd_ray_kind_names[rays->kind], searcher.object->triangle_count);
            print_name(&searcher);
            printf(" %.6f\n", agreement(rays, hits, others));
        }
    }
    fflush(stdout);
}

/* ---- leaks ---- */

/* Each crossing of the sphere multiplies by its filter. */
static int count_odd(const HdHits *hits, int count) {
    int odd = 0;
    for (int i = 0; i < count; i++)
        odd += lround(log((double)hits->passing[0][i]) / log(hd_object_filter[0])) % 2 != 0;
    return odd;
}

/* What a ray is aimed at lies in front of it: nothing that is met first is farther away. */
static int count_leaks(const HdHits *hits, const float *distance, int count) {
    const float rounding = 1e-3f;
    int leaks = 0;
    for (int i = 0; i < count; i++)
        leaks += hits->triangle[i] < 0 || hits->t[i] > distance[i] * (1.0f + rounding);
    return leaks;
}

static void measure_leaks(const Searcher *hedron, HdRays *rays, HdHits *hits, float *distance) {
    Searcher searcher = *hedron;
    hd_rays_aim(rays, hedron->object, distance);
    do {
        rays->kind = HD_RAYS_MIRRORED;
        search(&searcher, rays, hits);
        int leaks = count_leaks(hits, distance, rays->count);
        rays->kind = HD_RAYS_SHADOW;
        search(&searcher, rays, hits);
        printf("aimed %d ", searcher.object->triangle_count);
        print_name(&searcher);
        printf(" %d %d %d\n", rays->count, leaks, count_odd(hits, rays->count));
    } while (take_next(&searcher));
    fflush(stdout);
}

static bool measure_kinds(const Options *options, const Searcher *searcher) {
    int count = options->side * options->side;
    HdRays rays[HD_RAY_KINDS] = {0};
    HdHits hits = {0}, others = {0}, first = {0};
    bool done = hd_hits_create(&hits, count) && hd_hits_create(&others, count) &&
                hd_hits_create(&first, count);
    for (int kind = 0; kind < HD_RAY_KINDS && done; kind++)
        done = hd_rays_create(&rays[kind], (HdRayKind)kind, count);
    if (done) {
        hd_rays_look(&rays[HD_RAYS_PRIMARY], searcher->object, options->side);
        search(searcher, &rays[HD_RAYS_PRIMARY], &first);
    }
    for (int kind = 0; kind < HD_RAY_KINDS && done; kind++) {
        if (kind != HD_RAYS_PRIMARY)
            hd_rays_continue(&rays[kind], searcher->object, &rays[HD_RAYS_PRIMARY], &first);
        measure(options, searcher, &rays[kind], &hits, &others);
    }
    if (done)
        measure_leaks(searcher, &rays[HD_RAYS_SHADOW], &hits, others.t);
    for (int kind = 0; kind < HD_RAY_KINDS; kind++)
        hd_rays_free(&rays[kind]);
    hd_hits_free(&hits);
    hd_hits_free(&others);
    hd_hits_free(&first);
    return done;
}

/* ---- building ---- */

/* The hierarchy over a mesh that has one; its triangles lie in another order than at first. */
static bool build_again(HdMesh *mesh, int threads, double *seconds) {
    HdError error;
    HdThreadPool *pool;
    if (hd_thread_pool_create(&pool, threads, &error) != HD_OK)
        return false;
    hd_hierarchy_free(&mesh->tree);
    double begin = hd_processors_seconds();
    bool done = hd_mesh_build(mesh, pool, &error) == HD_OK;
    *seconds = hd_processors_seconds() - begin;
    hd_thread_pool_destroy(pool);
    return done;
}

static bool measure_builds(const Options *options, HdObject *object) {
    for (int round = 0; round < options->rounds; round++) {
        double seconds;
        if (!build_again(&object->scene.meshes[0], options->threads, &seconds))
            return false;
        printf("built %d hedron %.6e\n", object->triangle_count, seconds);
        HdRival *rival = hd_rival_create(object, options->threads, false);
        if (rival != NULL)
            printf("built %d embree %.6e\n", object->triangle_count, hd_rival_build_seconds(rival));
        hd_rival_free(rival);
    }
    return true;
}

/* ---- all of it ---- */

static bool measure_object(const Options *options, const HdWalks *walks, int triangles) {
    HdObject object;
    if (!hd_object_create(&object, triangles, walks->lanes))
        return false;
    printf("object %d\n", object.triangle_count);
    HdRival *plain = hd_rival_create(&object, options->threads, false);
    HdRival *robust = hd_rival_create(&object, options->threads, true);
    const Searcher searcher = {.walks = walks, .object = &object, .rivals = {plain, robust}};
    bool done = measure_kinds(options, &searcher);
    hd_rival_free(plain);
    hd_rival_free(robust);
    done = done && measure_builds(options, &object);
    hd_object_free(&object);
    return done;
}

/* Whether the options are understood. */
static bool read_arguments(Options *options, int count, char **words) {
    for (int i = 1; i < count; i++) {
        bool has_value = i + 1 < count;
        if (strcmp(words[i], "--seconds") == 0 && has_value)
            options->seconds = strtod(words[++i], NULL);
        else if (strcmp(words[i], "--rounds") == 0 && has_value)
            options->rounds = atoi(words[++i]);
        else if (strcmp(words[i], "--threads") == 0 && has_value)
            options->threads = atoi(words[++i]);
        else if (strcmp(words[i], "--side") == 0 && has_value)
            options->side = atoi(words[++i]);
        else if (words[i][0] != '-' && options->count_count < MOST_COUNTS)
            options->counts[options->count_count++] = (int)strtod(words[i], NULL);
        else
            return false;
    }
    for (int i = 0; i < options->count_count; i++)
        if (options->counts[i] < 64 || options->counts[i] > 100 * 1000 * 1000)
            return false;
    return options->count_count > 0 && options->side >= 4 && options->side <= 8192 &&
           (options->side & (options->side - 1)) == 0 && options->threads > 0 &&
           options->threads <= MOST_THREADS;
}

int main(int count, char **words) {
    Options options = {.seconds = 0.3, .rounds = 3, .side = 512, .threads = 1};
    if (!read_arguments(&options, count, words)) {
        fprintf(stderr, "usage: hedron_mesh_rates [--seconds S] [--rounds N] [--threads N] "
                        "[--side POWER_OF_TWO] TRIANGLES...\n");
        return 2;
    }
    const HdWalks *walks = find_build(false);
    printf("build %s %d\n", walks->instruction_set, walks->lanes);
    for (int i = 0; i < options.count_count; i++)
        if (!measure_object(&options, walks, options.counts[i]))
            return 1;
    return 0;
}
