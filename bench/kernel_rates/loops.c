/* SPDX-License-Identifier: MIT */
/* One build of the loops; HD_BUILD names it, HD_BUILD_SET is its instruction set. */
#include "loops.h"

#include <stdlib.h>

#include "cpu/dialect.h"
#include "kernels/common/render.h"

#define QUOTED_(name)  #name
#define QUOTED(name)   QUOTED_(name)
#define OF_BUILD(name) HD_PASTE(HD_BUILD, _##name)
#define NOT_INLINED    __attribute__((noinline))

typedef struct Packet {
    Ray ray;
    int is_eye;
} Packet;

typedef struct Points {
    Surface surface;
    LitPoints lit;
    Vec3 mirrored;
} Points;

/* A packet of the view and its hits. */
typedef struct Sight {
    Ray ray;
    LocalOrigin local_origin;
    Hit hit;
    vmask struck, on_solid;
} Sight;

static vint live_lanes(vmask alive) {
    return count_lanes(splat_int(0), alive);
}

static int sum_of_lanes(vint a) {
    int sum = 0;
    for (int lane = 0; lane < HD_LANES; lane++)
        sum += lane_int(&a, lane);
    return sum;
}

/* Returns the packet that begins at sample `first` of an item; 0 if it lies outside the picture. */
static int look(const HdTable *scene, const HdTable *frame, int item, int first, Sight *sight) {
    HD_DECLARE_TABLES(scene, frame)
    Vec3 direction;
    vmask alive = sample_directions(SAMPLE_ARGUMENTS item, first, &direction);
    if (!any_lane(alive))
        return 0;
    sight->ray = eye_ray(direction, alive);
    sight->local_origin = local_origin_of(SCENE_ARGUMENTS sight->ray.last_hit, 1);
    sight->hit = closest_hit(SCENE_ARGUMENTS & sight->ray, sight->local_origin);
    sight->struck = alive & ~lt_int(sight->hit.object, splat_int(0));
    sight->on_solid = sight->struck & lt_int(sight->hit.object, splat_int(header->solid_count));
    return 1;
}

/* A pass over the view's packets: the first counts the wanted ones, the second takes `most` of them
   evenly. */
typedef struct Walk {
    int most;
    int found, wanted; /* wanted: packets that the first pass found; 0 during it */
    HdWork work;
    size_t size; /* bytes of an item of work */
} Walk;

/* Returns the place to store a sample of the view, or NULL if it is not to be taken. */
static void *take(Walk *walk) {
    long long number = walk->found++;
    if (walk->wanted == 0)
        return NULL;
    long long count = walk->wanted < walk->most ? walk->wanted : walk->most;
    if (walk->work.count >= count || number * count < walk->work.count * (long long)walk->wanted)
        return NULL;
    return (char *)walk->work.items + walk->size * (size_t)walk->work.count++;
}

typedef void Visit(const HdTable *scene, const HdTable *frame, const Sight *sight, Walk *walk);

static void walk_view(const HdTable *scene, const HdTable *frame, Visit *visit, Walk *walk) {
    const View *view = frame[HD_TABLE_view].data;
    int blocks_per_row = (view->width + HD_BLOCK_SIDE - 1) / HD_BLOCK_SIDE;
    int blocks = blocks_per_row * ((view->height + HD_BLOCK_SIDE - 1) / HD_BLOCK_SIDE);
    int samples = HD_PIXELS_PER_ITEM * view->samples;
    for (int item = 0; item < blocks * (HD_BLOCK_PIXELS / HD_PIXELS_PER_ITEM); item++)
        for (int first = 0; first < samples; first += HD_LANES) {
            Sight sight;
            if (look(scene, frame, item, first, &sight))
                visit(scene, frame, &sight, walk);
        }
}

static HdWork walk_twice(const HdTable *scene, const HdTable *frame, Visit *visit, Walk *walk) {
    walk_view(scene, frame, visit, walk);
    walk->wanted = walk->found;
    walk->found = 0;
    if (walk->wanted > 0)
        walk->work.items = aligned_alloc(64, (walk->size * (size_t)walk->most + 63) / 64 * 64);
    if (walk->work.items != NULL)
        walk_view(scene, frame, visit, walk);
    return walk->work;
}

static void visit_rays(const HdTable *scene, const HdTable *frame, const Sight *sight, Walk *walk) {
    (void)scene;
    (void)frame;
    if (!any_lane(sight->on_solid))
        return;
    Packet *packet = take(walk);
    if (packet != NULL)
        *packet = (Packet){.ray = sight->ray, .is_eye = 1};
}

static HdWork make_rays(const HdTable *scene, const HdTable *frame, int most) {
    Walk walk = {.most = most, .size = sizeof(Packet)};
    return walk_twice(scene, frame, visit_rays, &walk);
}

/* Visits the lit points as the ray tree does before it computes direct light. */
static void visit_points(const HdTable *scene, const HdTable *frame, const Sight *sight,
                         Walk *walk) {
    HD_DECLARE_TABLES(scene, frame)
    Points points;
    if (!any_lane(sight->struck))
        return;
    Hit hit = sight->hit;
    points.surface =
        surface_at(SCENE_ARGUMENTS & sight->ray, sight->local_origin, &hit, sight->struck);
    const LaneMaterial *material = &points.surface.material;
    Vec3 direction = sight->ray.direction;
    vreal zero = splat(R(0.0));
    points.mirrored = vec3_scale_add(
        points.surface.normal, vec3_dot(points.surface.normal, direction) * R(-2.0), direction);
    points.lit.active =
        sight->struck & (lt(zero, material->diffuse) | lt(zero, material->specular));
    points.lit.object = spread_first(sight->hit.object, sight->struck);
    points.lit.face = sight->hit.face;
    points.lit.inside = sight->on_solid & ~sight->hit.entering;
    if (!any_lane(points.lit.active))
        return;
    Points *place = take(walk);
    if (place != NULL)
        *place = points;
}

static HdWork make_points(const HdTable *scene, const HdTable *frame, int most) {
    Walk walk = {.most = most, .size = sizeof(Points)};
    return walk_twice(scene, frame, visit_points, &walk);
}

static uint64_t live_rays(const HdWork *rays) {
    const Packet *packets = rays->items;
    uint64_t live = 0;
    for (int i = 0; i < rays->count; i++)
        live += (uint64_t)sum_of_lanes(live_lanes(packets[i].ray.alive));
    return live;
}

NOT_INLINED uint64_t OF_BUILD(search)(const HdTable *scene, const HdTable *frame,
                                      const HdWork *rays);
NOT_INLINED uint64_t OF_BUILD(light)(const HdTable *scene, const HdTable *frame,
                                     const HdWork *points, double *sum);

NOT_INLINED uint64_t OF_BUILD(search)(const HdTable *scene, const HdTable *frame,
                                      const HdWork *rays) {
    HD_DECLARE_TABLES(scene, frame)
    const Packet *packets = rays->items;
    vreal nearest = splat(REAL_LARGE);
    vint mixed = splat_int(0);
    for (int i = 0; i < rays->count; i++) {
        const Ray *ray = &packets[i].ray;
        LocalOrigin local_origin =
            local_origin_of(SCENE_ARGUMENTS ray->last_hit, packets[i].is_eye);
        Hit hit = closest_hit(SCENE_ARGUMENTS ray, local_origin);
        nearest = vmin(hit.t, nearest);
        mixed = mixed + count_lanes(hit.object & hit.face, hit.entering);
    }
    return (uint64_t)(sum_of_lanes(mixed) + (int)lane_real(&nearest, 0));
}

NOT_INLINED uint64_t OF_BUILD(light)(const HdTable *scene, const HdTable *frame,
                                     const HdWork *points, double *sum) {
    HD_DECLARE_TABLES(scene, frame)
    const Points *all = points->items;
    vint tests = splat_int(0);
    Vec3 radiance = vec3_zero();
    for (int i = 0; i < points->count; i++) {
        const Points *each = all + i;
        radiance = vec3_add(radiance, direct_light(SCENE_ARGUMENTS & each->surface, &each->lit,
                                                   each->mirrored, &tests));
    }
    vreal white = radiance.x + radiance.y + radiance.z;
    *sum = (double)lane_real(&white, 0);
    return (uint64_t)sum_of_lanes(tests);
}

/* Sums the chains' numbers. The compiler must not know them, or it would compute ahead. */
static double sum_of_chains(const vreal *chains) {
    double sum = 0;
    for (int i = 0; i < HD_PEAK_CHAINS; i++)
        sum += (double)lane_real(chains + i, HD_LANES - 1);
    return sum;
}

static double multiply_adds(long rounds) {
    volatile real factor = R(0.999), term = R(0.001);
    vreal a = splat(factor), b = splat(term), chains[HD_PEAK_CHAINS];
    for (int i = 0; i < HD_PEAK_CHAINS; i++)
        chains[i] = splat((real)i);
    for (long round = 0; round < rounds; round++)
        for (int i = 0; i < HD_PEAK_CHAINS; i++)
            chains[i] = multiply_add(chains[i], a, b);
    return sum_of_chains(chains);
}

static double multiplications_and_additions(long rounds) {
    volatile real factor = R(0.999), term = R(0.001);
    vreal a = splat(factor), b = splat(term), chains[HD_PEAK_CHAINS];
    for (int i = 0; i < HD_PEAK_CHAINS; i++)
        chains[i] = splat((real)i);
    for (long round = 0; round < rounds; round += 2) {
        for (int i = 0; i < HD_PEAK_CHAINS; i++)
            chains[i] = chains[i] * a;
        for (int i = 0; i < HD_PEAK_CHAINS; i++)
            chains[i] = chains[i] + b;
    }
    return sum_of_chains(chains);
}

extern const HdLoops HD_BUILD;
const HdLoops HD_BUILD = {
    .instruction_set = HD_BUILD_SET,
    .lanes = HD_LANES,
    .search_symbol = QUOTED(OF_BUILD(search)),
    .light_symbol = QUOTED(OF_BUILD(light)),
    .make_rays = make_rays,
    .make_points = make_points,
    .live_rays = live_rays,
    .search = OF_BUILD(search),
    .light = OF_BUILD(light),
    .multiply_adds = multiply_adds,
    .multiplications_and_additions = multiplications_and_additions,
};
