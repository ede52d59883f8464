/* SPDX-License-Identifier: MIT */
/* Whether kernels that were compiled just now render rightly: tiny frames whose hashes are known,
   two, and a third one where the kernels can search meshes. A driver or compiler that computes
   something else is an error, not a wrong picture. */
#ifndef HD_DEVICE_SELF_TEST_H
#define HD_DEVICE_SELF_TEST_H

#include <stddef.h>

#include "device/backend.h"
#include "device/kernel_source.h"
#include "device/self_test_scenes.h"

/* Renders the frames with strict arithmetic by a backend's open renderer, whose last scene was
   `scene`, and compares their hashes with what they must be. They fit every build, so the kernels
   that were built for `scene` are what renders them. What such kernels leave out, refraction and
   light from behind, the frames have not. The renderer's scene is then another one.
   HD_UNAVAILABLE where a hash is wrong, which `*is_wrong` tells too and `*frame` of which, with the
   device, its driver and both hashes. */
HdStatus hd_self_test(const HdBackend *backend, void *renderer, const HdDevice *device,
                      const HdSceneTables *scene, HdSelfTestFrame *frame, bool *is_wrong,
                      HdError *error);

/* One line about the test that kernels of this shape must pass: the hashes, or that there is none
   for fast arithmetic. */
void hd_self_test_stamp(const HdKernelShape *shape, char *text, size_t capacity);

#endif
