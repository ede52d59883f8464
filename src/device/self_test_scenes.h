/* SPDX-License-Identifier: MIT */
/* The frames of the self-test. */
#ifndef HD_DEVICE_SELF_TEST_SCENES_H
#define HD_DEVICE_SELF_TEST_SCENES_H

#include <stdbool.h>

#include "scene/scene.h"

typedef enum HdSelfTestFrame {
    HD_SELF_TEST_SOLID, /* two solids with rims and edge lights, mirrors and glass at once */
    HD_SELF_TEST_FLOOR, /* a textured floor */
    HD_SELF_TEST_MESH,  /* two meshes in two places each over that floor, one of glass */
    HD_SELF_TEST_FRAMES,
    HD_SELF_TEST_FRAMES_WITHOUT_MESHES = HD_SELF_TEST_MESH
} HdSelfTestFrame;

/* Builds a frame's scene, which has at most as many planes, as great a depth and as deep
   hierarchies as the smallest bounds of kernels (hd_kernel_needs). The caller frees it. */
HdStatus hd_self_test_scene(HdScene *scene, HdSelfTestFrame frame, bool refracts,
                            bool lit_from_behind, HdError *error);

#endif
