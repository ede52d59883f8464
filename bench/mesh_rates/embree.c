/* SPDX-License-Identifier: MIT */
/* Embree 3, by its packets, streams and single rays. */
#include <embree3/rtcore.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../kernel_rates/processor_time.h"
#include "rival.h"

struct HdRival {
    RTCDevice device;
    RTCScene scene;
    double build_seconds;
};

/* A shadow ray's own share of a packet: what filters it is multiplied up. */
typedef struct FilterContext {
    struct RTCIntersectContext base; /* first, so that it is what Embree hands on */
    float *const *passing;           /* HdHits.passing */
} FilterContext;

/* How far a ray must stay from where it starts; Embree knows no triangle to leave out. */
static const float clearance = 1e-4f;

/* The identifier of a lane's ray; Embree's own function for it is for C++ only. */
static unsigned number_of(const struct RTCFilterFunctionNArguments *call, unsigned lane) {
    enum { FIELDS_BEFORE = 10 };
    unsigned number;
    size_t place = (size_t)FIELDS_BEFORE * call->N + lane;
    memcpy(&number, (const char *)call->ray + place * sizeof number, sizeof number);
    return number;
}

/* Of the sphere, since no ray to the light crosses the shell. */
static void filter_light(const struct RTCFilterFunctionNArguments *call) {
    const FilterContext *context = (const FilterContext *)call->context;
    for (unsigned lane = 0; lane < call->N; lane++) {
        if (call->valid[lane] == 0)
            continue;
        unsigned ray = number_of(call, lane);
        for (int channel = 0; channel < 3; channel++)
            context->passing[channel][ray] *= (float)hd_object_filter[channel];
        call->valid[lane] = 0; /* go on */
    }
}

HdRival *hd_rival_create(const HdObject *object, int threads, bool is_robust) {
    char setting[32];
    HdRival *rival = calloc(1, sizeof *rival);
    const HdMesh *mesh = &object->scene.meshes[0];
    if (rival == NULL)
        return NULL;
    snprintf(setting, sizeof setting, "threads=%d", threads);
    rival->device = rtcNewDevice(setting);
    rival->scene = rtcNewScene(rival->device);
    rtcSetSceneBuildQuality(rival->scene, RTC_BUILD_QUALITY_MEDIUM);
    rtcSetSceneFlags(rival->scene, is_robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    RTCGeometry geometry = rtcNewGeometry(rival->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    float *vertices =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), (size_t)mesh->vertex_count);
    uint32_t *corners =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof *corners, (size_t)mesh->triangle_count);
    for (int i = 0; i < mesh->vertex_count; i++) {
        HdVec3 p = hd_sub(mesh->vertices[i], object->centre);
        vertices[3 * i] = (float)p.x;
        vertices[3 * i + 1] = (float)p.y;
        vertices[3 * i + 2] = (float)p.z;
    }
    memcpy(corners, mesh->corners, 3 * sizeof *corners * (size_t)mesh->triangle_count);
    rtcSetGeometryOccludedFilterFunction(geometry, filter_light);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(rival->scene, geometry);
    rtcReleaseGeometry(geometry);
    double begin = hd_processors_seconds();
    rtcCommitScene(rival->scene);
    rival->build_seconds = hd_processors_seconds() - begin;
    return rival;
}

void hd_rival_free(HdRival *rival) {
    if (rival == NULL)
        return;
    rtcReleaseScene(rival->scene);
    rtcReleaseDevice(rival->device);
    free(rival);
}

double hd_rival_build_seconds(const HdRival *rival) {
    return rival->build_seconds;
}

static void begin(FilterContext *context, const HdRays *rays, HdHits *hits) {
    rtcInitIntersectContext(&context->base);
    context->base.flags = rays->kind == HD_RAYS_DIFFUSE ? RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT
                                                        : RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    context->passing = hits->passing;
    for (int i = 0; i < rays->count && rays->kind == HD_RAYS_SHADOW; i++)
        hits->passing[0][i] = hits->passing[1][i] = hits->passing[2][i] = 1.0f;
}

static float extent_of(const HdRays *rays) {
    return rays->kind == HD_RAYS_SHADOW ? 1.0f : INFINITY;
}

static void search_singly(const HdRival *rival, const HdRays *rays, HdHits *hits) {
    FilterContext context;
    begin(&context, rays, hits);
    for (int i = 0; i < rays->count; i++) {
        struct RTCRayHit ray = {.ray = {.org_x = rays->origin[0][i],
                                        .org_y = rays->origin[1][i],
                                        .org_z = rays->origin[2][i],
                                        .tnear = clearance,
                                        .dir_x = rays->direction[0][i],
                                        .dir_y = rays->direction[1][i],
                                        .dir_z = rays->direction[2][i],
                                        .tfar = extent_of(rays),
                                        .mask = ~0u,
                                        .id = (unsigned)i},
                                .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
        if (rays->kind == HD_RAYS_SHADOW) {
            rtcOccluded1(rival->scene, &context.base, &ray.ray);
            continue;
        }
        rtcIntersect1(rival->scene, &context.base, &ray);
        hits->t[i] = ray.ray.tfar;
        hits->triangle[i] = (int)ray.hit.primID;
    }
}

/* Fills a packet of `width` rays that begins with number `first`. */
#define FILL_PACKET(packet, width)                                                                 \
    do {                                                                                           \
        memcpy((packet)->ray.org_x, rays->origin[0] + first, sizeof(float) * (width));             \
        memcpy((packet)->ray.org_y, rays->origin[1] + first, sizeof(float) * (width));             \
        memcpy((packet)->ray.org_z, rays->origin[2] + first, sizeof(float) * (width));             \
        memcpy((packet)->ray.dir_x, rays->direction[0] + first, sizeof(float) * (width));          \
        memcpy((packet)->ray.dir_y, rays->direction[1] + first, sizeof(float) * (width));          \
        memcpy((packet)->ray.dir_z, rays->direction[2] + first, sizeof(float) * (width));          \
        for (int lane = 0; lane < (width); lane++) {                                               \
            (packet)->ray.tnear[lane] = clearance;                                                 \
            (packet)->ray.tfar[lane] = extent_of(rays);                                            \
            (packet)->ray.time[lane] = 0.0f;                                                       \
            (packet)->ray.mask[lane] = ~0u;                                                        \
            (packet)->ray.id[lane] = (unsigned)(first + lane);                                     \
            (packet)->ray.flags[lane] = 0;                                                         \
            (packet)->hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;                                  \
        }                                                                                          \
    } while (0)

#define KEEP_PACKET(packet, width)                                                                 \
    do {                                                                                           \
        memcpy(hits->t + first, (packet)->ray.tfar, sizeof(float) * (width));                      \
        memcpy(hits->triangle + first, (packet)->hit.primID, sizeof(int) * (width));               \
    } while (0)

#define SEARCH_BY_PACKETS(width)                                                                   \
    static void search_by_##width(const HdRival *rival, const HdRays *rays, HdHits *hits) {        \
        FilterContext context;                                                                     \
        int valid[width];                                                                          \
        memset(valid, -1, sizeof valid);                                                           \
        begin(&context, rays, hits);                                                               \
        for (int first = 0; first < rays->count; first += (width)) {                               \
            struct RTCRayHit##width packet;                                                        \
            FILL_PACKET(&packet, width);                                                           \
            if (rays->kind == HD_RAYS_SHADOW) {                                                    \
                rtcOccluded##width(valid, rival->scene, &context.base, &packet.ray);               \
                continue;                                                                          \
            }                                                                                      \
            rtcIntersect##width(valid, rival->scene, &context.base, &packet);                      \
            KEEP_PACKET(&packet, width);                                                           \
        }                                                                                          \
    }

SEARCH_BY_PACKETS(4)
SEARCH_BY_PACKETS(8)
SEARCH_BY_PACKETS(16)

static void search_by_streams(const HdRival *rival, const HdRays *rays, HdHits *hits) {
    enum { PACKETS = 64 };
    static struct RTCRayHit16 packets[PACKETS];
    FilterContext context;
    begin(&context, rays, hits);
    for (int start = 0; start < rays->count; start += PACKETS * 16) {
        int count = (rays->count - start) / 16 < PACKETS ? (rays->count - start) / 16 : PACKETS;
        for (int i = 0; i < count; i++) {
            int first = start + 16 * i;
            FILL_PACKET(&packets[i], 16);
        }
        if (rays->kind == HD_RAYS_SHADOW) {
            rtcOccludedNM(rival->scene, &context.base, (struct RTCRayN *)&packets[0].ray, 16,
                          (unsigned)count, sizeof packets[0]);
            continue;
        }
        rtcIntersectNM(rival->scene, &context.base, (struct RTCRayHitN *)packets, 16,
                       (unsigned)count, sizeof packets[0]);
        for (int i = 0; i < count; i++) {
            int first = start + 16 * i;
            KEEP_PACKET(&packets[i], 16);
        }
    }
}

const HdRivalWay hd_rival_ways[] = {{"single", search_singly},      {"packets of 4", search_by_4},
                                    {"packets of 8", search_by_8},  {"packets of 16", search_by_16},
                                    {"streams", search_by_streams}, {NULL, NULL}};
