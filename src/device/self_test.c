/* SPDX-License-Identifier: MIT */
#include "device/self_test.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "scene/camera.h"

static const char *const frame_names[HD_SELF_TEST_FRAMES] = {"solid", "floor", "mesh"};

/* By frame, precision, refraction and light from behind, which the floor has nothing of. They
   change with the kernels, on purpose only: the unit test of this file tells the new ones. */
static const uint64_t hashes[HD_SELF_TEST_FRAMES][2][2][2] = {
    [HD_SELF_TEST_SOLID] = {{{0xcd3bc2e8742b4d9a, 0xf815259a7fc445a2},
                             {0x23885c049df6be57, 0xc4af9ffd3d3480cf}},
                            {{0x283ee83e31a5a45e, 0xd5752f7e6a8ea815},
                             {0xc4003be42dedcf45, 0xffb4107fdd87a446}}},
    [HD_SELF_TEST_FLOOR] = {{{0x3aeda832e140caea}}, {{0x7fec99e0bbfce896}}},
    [HD_SELF_TEST_MESH] = {{{0x725afa96238f8955, 0xdbba712b1919574f},
                            {0x5618e362a7a1a362, 0xfae88fd411559ce9}},
                           {{0x5d1a4b1da7fa3fdc, 0x532de987a64c8261},
                            {0x107fbb5865e3fb9d, 0xe504dd55ccdb216d}}},
};

static uint64_t expected_hash(HdSelfTestFrame frame, HdPrecision precision, bool refracts,
                              bool lit_from_behind) {
    bool has_any = frame != HD_SELF_TEST_FLOOR;
    return hashes[frame][precision][refracts && has_any][lit_from_behind && has_any];
}

static int count_frames(bool has_meshes) {
    return has_meshes ? HD_SELF_TEST_FRAMES : HD_SELF_TEST_FRAMES_WITHOUT_MESHES;
}

void hd_self_test_stamp(const HdKernelShape *shape, char *text, size_t capacity) {
    const HdKernelNeeds *needs = &shape->needs;
    if (shape->math != HD_MATH_STRICT) {
        snprintf(text, capacity, "not tested, for the arithmetic is fast");
        return;
    }
    size_t length = 0;
    int count = count_frames(needs->node_stack_bound > 0);
    for (int frame = 0; frame < count && length < capacity; frame++)
        length += (size_t)snprintf(text + length, capacity - length, "%s%016" PRIx64 "%s",
                                   frame == 0 ? "passed the self-test (" : ", ",
                                   expected_hash((HdSelfTestFrame)frame, shape->precision,
                                                 needs->refracts, needs->lit_from_behind),
                                   frame + 1 < count ? "" : ")");
}

/* The tables claim to need what `like` does, so that they are rendered by the same kernels. */
static HdStatus compile(HdSceneTables *tables, HdFrameTables *view, const HdScene *scene,
                        const HdSceneTables *like, HdError *error) {
    HdCamera camera;
    HdStatus status = hd_camera_at(&camera, scene, 0, error);
    if (status == HD_OK)
        status = hd_compile_scene(tables, scene, like->precision, like->lanes, error);
    if (status != HD_OK)
        return status;
    hd_scene_tables_raise(tables, like);
    tables->many_lights = like->many_lights; /* kernels without them look at each light */
    status = hd_compile_frame(view, scene, &camera, like->precision, error);
    view->floats = like->surveyed ? HD_SURVEY_FLOATS : HD_RADIANCE_FLOATS;
    if (status != HD_OK)
        hd_scene_tables_free(tables);
    return status;
}

/* Without what else surveyed pixels come with. */
static void keep_radiance(HdFrame *image) {
    size_t pixels = (size_t)image->width * (size_t)image->height;
    for (size_t pixel = 0; pixel < pixels; pixel++)
        memmove(image->rgb + 3 * pixel, image->rgb + (size_t)image->floats * pixel,
                3 * sizeof *image->rgb);
    image->floats = 3;
}

static HdStatus render(const HdBackend *backend, void *renderer, const HdScene *scene,
                       const HdSceneTables *like, uint64_t *hash, HdError *error) {
    HdSceneTables tables;
    HdFrameTables view;
    HdFrame image;
    HdStatus status = compile(&tables, &view, scene, like, error);
    if (status != HD_OK)
        return status;
    status = hd_frame_create_with(&image, scene->width, scene->height, view.floats, error);
    if (status == HD_OK) {
        status = backend->functions->upload(renderer, &tables, error);
        if (status == HD_OK)
            status = hd_backend_render(backend, renderer, &view, &image, error);
        keep_radiance(&image);
        *hash = hd_frame_hash(&image);
        hd_frame_free(&image);
    }
    hd_frame_tables_free(&view);
    hd_scene_tables_free(&tables);
    return status;
}

static HdStatus test_frame(const HdBackend *backend, void *renderer, const HdDevice *device,
                           HdSelfTestFrame frame, const HdSceneTables *like, bool *is_wrong,
                           HdError *error) {
    HdScene scene;
    uint64_t hash = 0, expected = expected_hash(frame, like->precision, like->refracts,
                                                like->lit_from_behind);
    HdStatus status =
        hd_self_test_scene(&scene, frame, like->refracts, like->lit_from_behind, error);
    if (status != HD_OK)
        return status;
    status = render(backend, renderer, &scene, like, &hash, error);
    hd_scene_free(&scene);
    *is_wrong = status == HD_OK && hash != expected;
    if (*is_wrong)
        status = hd_fail(error, HD_UNAVAILABLE,
                         "%s (%s) computes wrongly: the kernels that were compiled for it render "
                         "the test frame '%s' with the hash %016" PRIx64 ", expected %016" PRIx64
                         "; another version of its driver or compiler may do better",
                         device->name, device->driver, frame_names[frame], hash, expected);
    return status;
}

HdStatus hd_self_test(const HdBackend *backend, void *renderer, const HdDevice *device,
                      const HdSceneTables *scene, HdSelfTestFrame *frame, bool *is_wrong,
                      HdError *error) {
    HdStatus status = HD_OK;
    *is_wrong = false;
    int count = count_frames(scene->node_stack > 0);
    for (int i = 0; status == HD_OK && i < count; i++) {
        *frame = (HdSelfTestFrame)i;
        status = test_frame(backend, renderer, device, *frame, scene, is_wrong, error);
    }
    return status;
}
