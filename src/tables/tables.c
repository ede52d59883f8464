/* SPDX-License-Identifier: MIT */
#include "tables/table.h"

#include <math.h>
#include <string.h>

#include "image/frame.h"
#include "kernels/host/shared.h"
#include "scene/light_bound.h"
#include "scene/sample_pattern.h"
#include "tables/builder.h"

_Static_assert((int)HD_BOUNDED_FLOATS == HD_BOUNDED_SUMS &&
                   (int)HD_RADIANCE_FLOATS == HD_RADIANCE_SUMS,
               "a float comes of each sum");
_Static_assert((int)HD_MAX_FIRST_FLOATS == HD_FIRST_FLOATS, "a frame has what kernels find");

_Static_assert(HD_RADIANCE_LIMIT == HD_CONTRIBUTION_LIMIT * (HD_MAX_DEPTH + 1),
               "the deepest tree has so many levels");

static double greatest(HdVec3 a) {
    return fmax(a.x, fmax(a.y, a.z));
}

/* The weights of rays that end, and those of all hits at one depth, add up to at most 1 in each
   channel. The bound uses the maximum channel of each. */
double hd_max_left_out(const HdScene *scene) {
    double rays = greatest(hd_max_radiance(scene));
    double lights = greatest(hd_surface_bound(scene));
    return 3.0 * scene->exposure * (rays + (scene->depth + 1) * lights);
}

HdStatus hd_compile_scene(HdSceneTables *tables, const HdScene *scene, HdPrecision precision,
                          int lanes, HdError *error) {
    memset(tables, 0, sizeof *tables);
    tables->precision = precision;
    tables->lanes = lanes;
    HdStatus status = precision == HD_PRECISION_FLOAT
                          ? hd_compile_scene_float(tables, scene, error)
                          : hd_compile_scene_double(tables, scene, error);
    if (status != HD_OK)
        hd_scene_tables_free(tables);
    return status;
}

HdStatus hd_compile_frame(HdFrameTables *tables, const HdScene *scene, const HdCamera *camera,
                          HdPrecision precision, const HdPixelList *list, HdError *error) {
    memset(tables, 0, sizeof *tables);
    tables->precision = precision;
    tables->width = list != NULL ? HD_LISTED_WIDTH : scene->width;
    tables->height =
        list != NULL ? (list->entry_count + HD_LISTED_WIDTH - 1) / HD_LISTED_WIDTH : scene->height;
    tables->samples = hd_sample_count(scene);
    tables->floats = hd_scene_has_error_bound(scene) ? HD_BOUNDED_FLOATS : HD_RADIANCE_FLOATS;
    HdStatus status = precision == HD_PRECISION_FLOAT
                          ? hd_compile_frame_float(tables, scene, camera, list, error)
                          : hd_compile_frame_double(tables, scene, camera, list, error);
    if (status != HD_OK)
        hd_frame_tables_free(tables);
    return status;
}
