/* SPDX-License-Identifier: MIT */
#include "output/parcel.h"

#include <stdlib.h>

#include "image/mark.h"
#include "image/picture.h"
#include "output/video.h"
#include "system/atomic_file.h"
#include "system/path.h"

struct HdParcel {
    HdOutputs *outputs;
    HdFrame frame;
    HdImage8 image; /* what films get, and room for what a device encodes; empty: nobody needs it */
    HdAtomicFile files[HD_MAX_OUTPUTS]; /* stream NULL: not written, or published */
};

static bool has_image(const HdOutputs *outputs) {
    return hd_outputs_film_count(outputs) > 0 ||
           !hd_outputs_wish(hd_outputs_plan(outputs)).radiance;
}

HdStatus hd_parcel_create(HdParcel **out, HdOutputs *outputs, int width, int height,
                          HdError *error) {
    HdParcel *parcel = calloc(1, sizeof *parcel);
    *out = NULL;
    if (parcel == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for a frame's outputs");
    parcel->outputs = outputs;
    HdStatus status = hd_frame_create(&parcel->frame, width, height, error);
    if (status == HD_OK && has_image(outputs))
        status = hd_image8_create(&parcel->image, width, height, error);
    parcel->frame.rgba = parcel->image.rgba;
    if (status == HD_OK)
        *out = parcel;
    else
        hd_parcel_free(parcel);
    return status;
}

static void drop_pictures(HdParcel *parcel) {
    for (int i = 0; i < HD_MAX_OUTPUTS; i++)
        if (parcel->files[i].stream != NULL)
            hd_atomic_file_discard(&parcel->files[i]);
}

void hd_parcel_free(HdParcel *parcel) {
    if (parcel == NULL)
        return;
    drop_pictures(parcel);
    hd_image8_free(&parcel->image);
    hd_frame_free(&parcel->frame);
    free(parcel);
}

size_t hd_parcel_bytes(const HdOutputs *outputs, int width, int height) {
    size_t pixels = (size_t)width * (size_t)height;
    return sizeof(HdParcel) + pixels * 3 * sizeof(float) + (has_image(outputs) ? 4 * pixels : 0);
}

HdFrame *hd_parcel_frame(HdParcel *parcel) {
    return &parcel->frame;
}

void hd_parcel_convert(HdParcel *parcel) {
    const HdOutputStyle *style = &hd_outputs_plan(parcel->outputs)->style;
    hd_frame_to_image8(&parcel->frame, style->picture.curve, &parcel->image);
}

HdStatus hd_parcel_film(HdParcel *parcel, int index, HdError *error) {
    return hd_video_add(hd_outputs_film(parcel->outputs, index), &parcel->image, error);
}

static HdStatus write_picture(HdParcel *parcel, int index, int number, HdError *error) {
    const HdOutputPlan *plan = hd_outputs_plan(parcel->outputs);
    const uint64_t fingerprint = hd_picture_fingerprint(plan->fingerprint, number);
    HdAtomicFile *file = &parcel->files[index];
    char path[HD_MAX_PATH];
    HdStatus status = hd_output_file(plan->names[index], number, path, error);
    if (status == HD_OK)
        status = hd_picture_prepare(file, &parcel->frame, &plan->style.picture,
                                    plan->is_marked ? &fingerprint : NULL, path, error);
    if (status != HD_OK)
        file->stream = NULL;
    return status;
}

HdStatus hd_parcel_write(HdParcel *parcel, int number, HdError *error) {
    HdStatus status = HD_OK;
    for (int i = 0; i < hd_outputs_plan(parcel->outputs)->count && status == HD_OK; i++)
        if (hd_outputs_film(parcel->outputs, i) == NULL)
            status = write_picture(parcel, i, number, error);
    return status;
}

HdStatus hd_parcel_publish(HdParcel *parcel, HdError *error) {
    HdStatus status = HD_OK;
    for (int i = 0; i < HD_MAX_OUTPUTS && status == HD_OK; i++)
        if (parcel->files[i].stream != NULL)
            status = hd_atomic_file_commit(&parcel->files[i], error);
    return status;
}
