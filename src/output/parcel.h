/* SPDX-License-Identifier: MIT */
/* A frame on its way into the outputs of a run. Several parcels may be under way on several
   threads; each is worked on by one thread at a time, but films take its frame side by side. */
#ifndef HD_OUTPUT_PARCEL_H
#define HD_OUTPUT_PARCEL_H

#include <stddef.h>

#include "base/error.h"
#include "image/frame.h"
#include "output/outputs.h"

typedef struct HdParcel HdParcel;

/* For frames of this size, one after the other. The outputs must live on. */
HdStatus hd_parcel_create(HdParcel **parcel, HdOutputs *outputs, int width, int height,
                          HdError *error);

/* Drops pictures that were written but not published. NULL is allowed. */
void hd_parcel_free(HdParcel *parcel);

/* About how many bytes a parcel takes. */
size_t hd_parcel_bytes(const HdOutputs *outputs, int width, int height);

/* The frame, to be filled as hd_outputs_wish says, and read; it belongs to the parcel. */
HdFrame *hd_parcel_frame(HdParcel *parcel);

/* Makes of a frame that is not encoded what films take. */
void hd_parcel_convert(HdParcel *parcel);

/* Hands over what hd_parcel_convert or the device made to the film that is output `index` of the
   plan. A film takes its frames in order; blocks while FFmpeg is busy. */
HdStatus hd_parcel_film(HdParcel *parcel, int index, HdError *error);

/* Writes the pictures of frame `number` under temporary names. */
HdStatus hd_parcel_write(HdParcel *parcel, int number, HdError *error);

/* Gives the pictures their names. */
HdStatus hd_parcel_publish(HdParcel *parcel, HdError *error);

#endif
