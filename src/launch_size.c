/* SPDX-License-Identifier: MIT */
#include "launch_size.h"

enum {
    THREADS_PER_UNIT = 2048, /* at once, on most devices */
    MOST_UNITS = 1 << 12,
    LEAST_START = 1 << 14,
    START_PER_LEAST = 16
};

static const double MOST_GROWTH = 2.0, CEILING_GROWTH = 1.25;

static int within(double work, int least, int most) {
    if (!(work > (double)least))
        return least;
    return work < (double)most ? (int)work : most;
}

HdLaunchSize hd_launch_size_start(int compute_units) {
    int units = compute_units < MOST_UNITS ? compute_units : MOST_UNITS;
    int start = within((double)units * THREADS_PER_UNIT, LEAST_START, HD_MOST_LAUNCH_WORK);
    return (HdLaunchSize){
        .limit = start,
        .least = start / START_PER_LEAST,
        .most = HD_MOST_LAUNCH_WORK,
        .ceiling = HD_MOST_LAUNCH_WORK,
    };
}

HdLaunchSize hd_launch_size_fixed(int work) {
    return (HdLaunchSize){.limit = work, .least = work, .most = work, .ceiling = work};
}

void hd_launch_size_begin_frame(HdLaunchSize *size) {
    if (!size->too_long && size->limit == size->ceiling)
        size->ceiling = within(CEILING_GROWTH * (double)size->ceiling, size->least, size->most);
    size->too_long = false;
}

int hd_launch_size_items(const HdLaunchSize *size, int left, int work, int grain) {
    int fitting = size->limit > work ? size->limit / work : 1;
    if (fitting >= left)
        return left;
    int parts = (left - 1) / fitting + 1;
    int even = ((left - 1) / parts + grain) / grain * grain;
    if (even > fitting)
        even = fitting > grain ? fitting / grain * grain : grain;
    return even < left ? even : left;
}

void hd_launch_size_note(HdLaunchSize *size, double work, double seconds) {
    if (2.0 * work < (double)size->least)
        return;
    bool can_double = !(seconds > HD_LAUNCH_AIM_SECONDS / MOST_GROWTH);
    double growth = can_double ? MOST_GROWTH : HD_LAUNCH_AIM_SECONDS / seconds;
    int fitting = within(growth * work, size->least, size->ceiling);
    if (seconds > HD_LAUNCH_SECONDS) {
        size->too_long = true;
        size->limit = fitting < size->limit ? fitting : size->limit;
        size->ceiling = size->limit;
    } else if (fitting > size->limit) {
        size->limit = fitting;
    }
}
