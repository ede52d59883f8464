/* SPDX-License-Identifier: MIT */
#include "device/launch_size.h"

#include <math.h>

#include "base/minmax.h"

enum {
    THREADS_PER_UNIT = 2048, /* at once, on most devices */
    MOST_UNITS = 1 << 12,
    LEAST_START = 1 << 14,
    START_PER_LEAST = 16,
    GROUPS_PER_UNIT = 4
};

static const double MOST_GROWTH = 2.0, CEILING_GROWTH = 1.25;

/* A launch of less than SMALLER of another's work should be nearer to the time in proportion to its
   work than to the same time. One that takes longer than ALIKE times the other has dearer pixels.
 */
static const double SMALLER = 0.75, ALIKE = 1.1, LEAST_SHRINKING = 0.25, TAILS = 1.5;
static const double TAIL_DECAY = 0.9;

static int within(double work, int least, int most) {
    if (!(work > (double)least))
        return least;
    return work < (double)most ? (int)work : most;
}

HdLaunchSize hd_launch_size_start(int compute_units, double longest) {
    int units = hd_min(compute_units, MOST_UNITS);
    int start = within((double)units * THREADS_PER_UNIT, LEAST_START, HD_MOST_LAUNCH_WORK);
    return (HdLaunchSize){
        .limit = start,
        .least = start / START_PER_LEAST,
        .most = HD_MOST_LAUNCH_WORK,
        .ceiling = HD_MOST_LAUNCH_WORK,
        .fewest_groups = units > 0 ? units * GROUPS_PER_UNIT : 0,
        .longest = longest,
    };
}

HdLaunchSize hd_launch_size_fixed(int work) {
    return (HdLaunchSize){.limit = work, .least = work, .most = work, .ceiling = work};
}

void hd_launch_size_begin_frame(HdLaunchSize *size) {
    if (!size->too_long && size->limit == size->ceiling)
        size->ceiling = within(CEILING_GROWTH * (double)size->ceiling, size->least, size->most);
    if (!size->has_tail)
        size->tail *= TAIL_DECAY;
    size->too_long = size->has_tail = false;
}

int hd_launch_size_items(const HdLaunchSize *size, int left, int work, int grain) {
    int fitting = size->limit > work ? size->limit / work : 1;
    if (fitting / grain < size->fewest_groups)
        fitting = size->fewest_groups * grain;
    if (fitting >= left)
        return left;
    int parts = (left - 1) / fitting + 1;
    int even = ((left - 1) / parts + grain) / grain * grain;
    if (even > fitting)
        even = hd_max(fitting / grain, 1) * grain;
    return hd_min(even, left);
}

/* Of two launches, the time that does not grow with the work. Sizes that fall little by little are
   compared with the first of them. */
static void look_for_tail(HdLaunchSize *size, double work, double seconds) {
    double before = size->slow_seconds, share = before > 0.0 ? work / size->slow_work : 2.0;
    if (seconds <= size->longest)
        return;
    if (share < SMALLER && seconds > 0.5 * (1.0 + share) * before && seconds < ALIKE * before) {
        double tail = fmin(seconds, (seconds - share * before) / (1.0 - share));
        size->tail = fmax(tail, size->tail);
        size->has_tail = true;
    }
    if (share < SMALLER || share > 1.0) {
        size->slow_work = work;
        size->slow_seconds = seconds;
    }
}

static double longest_allowed(const HdLaunchSize *size) {
    return fmax(TAILS * size->tail, size->longest);
}

static void note_too_long(HdLaunchSize *size, int fitting) {
    size->too_long = true;
    size->ceiling = size->limit = hd_min(fitting, size->limit);
}

void hd_launch_size_note(HdLaunchSize *size, double work, double seconds) {
    if (2.0 * work < (double)size->least)
        return;
    look_for_tail(size, work, seconds);
    const double longest = longest_allowed(size), aim = HD_LAUNCH_AIM * longest;
    const double growth = seconds > aim / MOST_GROWTH ? aim / seconds : MOST_GROWTH;
    int fitting = within(fmax(growth, LEAST_SHRINKING) * work, size->least, size->ceiling);
    if (seconds > longest)
        note_too_long(size, fitting);
    else if (fitting > size->limit)
        size->limit = fitting;
}
