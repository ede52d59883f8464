/* SPDX-License-Identifier: MIT */
#include "render/frame.h"

#include "tables/tables.h"

HdStatus hd_frame_maker_open(HdFrameMaker *maker, HdError *error) {
    maker->refinement = NULL;
    return hd_scene_is_surveyed(maker->scene)
               ? hd_refinement_create(&maker->refinement, maker->scene, maker->renderer,
                                      maker->wish.curve, error)
               : HD_OK;
}

void hd_frame_maker_close(HdFrameMaker *maker) {
    hd_refinement_free(maker->refinement);
    maker->refinement = NULL;
}

int hd_frame_most_flights(const HdFrameMaker *maker) {
    return maker->refinement != NULL ? 1 : HD_FRAMES_IN_FLIGHT;
}

HdStatus hd_frame_prepare(const HdFrameMaker *maker, const HdCamera *camera, HdFlight *flight,
                          HdError *error) {
    *flight = (HdFlight){.camera = *camera};
    if (maker->refinement != NULL)
        return HD_OK;
    HdStatus status = hd_compile_frame(&flight->tables, maker->scene, camera,
                                       hd_renderer_options(maker->renderer)->precision, error);
    flight->tables.watched = (HdWatched){maker->watch, HD_WATCH_FRAME};
    return status;
}

HdStatus hd_frame_begin(const HdFrameMaker *maker, HdFlight *flight, HdError *error) {
    if (maker->refinement != NULL)
        return HD_OK;
    HdStatus status = hd_renderer_submit(maker->renderer, &flight->tables, &maker->wish, error);
    if (status != HD_OK)
        hd_flight_drop(flight);
    return status;
}

HdStatus hd_frame_end(const HdFrameMaker *maker, HdFlight *flight, HdFrame *frame, HdError *error) {
    if (maker->refinement != NULL)
        return hd_refinement_render(maker->refinement, &flight->camera, maker->watch, frame, error);
    HdStatus status = hd_renderer_collect(maker->renderer, frame, error);
    if (status == HD_OK && frame->first != NULL)
        status = hd_renderer_first_hits(maker->renderer, &flight->tables, frame, error);
    hd_frame_fill_samples(frame, flight->tables.samples);
    hd_flight_drop(flight);
    return status;
}

void hd_flight_drop(HdFlight *flight) {
    hd_frame_tables_free(&flight->tables);
}

HdStatus hd_frame_render(const HdFrameMaker *maker, const HdCamera *camera, HdFrame *frame,
                         HdError *error) {
    HdFrameMaker own = *maker;
    HdFlight flight;
    own.wish.radiance = true;
    HdStatus status = hd_frame_maker_open(&own, error);
    if (status == HD_OK)
        status = hd_frame_prepare(&own, camera, &flight, error);
    if (status == HD_OK)
        status = hd_frame_begin(&own, &flight, error);
    if (status == HD_OK)
        status = hd_frame_end(&own, &flight, frame, error);
    hd_renderer_drop(own.renderer);
    hd_frame_maker_close(&own);
    return status;
}
