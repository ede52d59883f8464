/* SPDX-License-Identifier: MIT */
#include "render_scene.h"

#include <stdio.h>
#include <stdlib.h>

#include "input/check.h"
#include "verify/golden.h"
#include "verify/trust.h"

_Noreturn void fail(const char *what, const HdError *error) {
    fflush(stdout);
    fprintf(stderr, "%s: %s\n", what, error->message);
    exit(1);
}

int find_devices(const HdBackend *backend, HdDevice devices[HD_MAX_DEVICES]) {
    HdError error;
    int count = 0;
    if (hd_backend_enumerate(backend, devices, HD_MAX_DEVICES, &count, &error) == HD_OK)
        return count;
    printf("skip            %s: %s\n", backend->name, error.message);
    return 0;
}

HdFrame render_scene(const Target *target, const HdScene *scene, const HdCamera *camera,
                     const char *name) {
    HdError error;
    HdFrame frame;
    if (hd_scene_validate(scene, &error) != HD_OK ||
        hd_put_and_render(
            target->renderer, scene, camera, target->one_build ? &hd_golden_needs : NULL,
            target->first_hits ? HD_LAYER_BIT(HD_LAYER_DEPTH) : 0, &frame, &error) != HD_OK)
        fail(name, &error);
    return frame;
}
