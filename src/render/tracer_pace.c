/* SPDX-License-Identifier: MIT */
#include "render/tracer_pace.h"

static bool awaits_gpu(const HdTracerPace *paces, int count) {
    for (int i = 0; i < count; i++)
        if (!paces[i].is_gone && !paces[i].is_cpu && paces[i].seconds <= 0.0)
            return true;
    return false;
}

/* When a tracer has finished so many frames more. */
static double end_of(const HdTracerPace *pace, int more, double now) {
    double from = pace->busy_until > now ? pace->busy_until : now;
    return from + more * pace->seconds;
}

/* Who finishes another frame first, if each has taken as many as `taken` says: -1: nobody. */
static int first_to_finish(const HdTracerPace *paces, const int *taken, int count, double now) {
    int first = -1;
    double least = 0.0;
    for (int i = 0; i < count; i++) {
        if (paces[i].is_gone || paces[i].seconds <= 0.0)
            continue;
        double end = end_of(&paces[i], taken[i] + 1, now);
        if (first < 0 || end < least) {
            first = i;
            least = end;
        }
    }
    return first;
}

bool hd_tracer_pace_wants(const HdTracerPace *paces, int count, int number, int left, double now) {
    const HdTracerPace *own = &paces[number];
    int taken[HD_MOST_TRACERS] = {0};
    if (own->is_cpu && awaits_gpu(paces, count))
        return false;
    if (own->seconds <= 0.0)
        return own->in_flight == 0;
    for (int i = 0; i < left; i++) {
        int first = first_to_finish(paces, taken, count, now);
        if (first == number)
            return true;
        taken[first]++;
    }
    return false;
}

void hd_tracer_pace_begun(HdTracerPace *pace, double now) {
    pace->busy_until = end_of(pace, 1, now);
    pace->in_flight++;
}

void hd_tracer_pace_finished(HdTracerPace *pace, double seconds, double now) {
    pace->seconds = pace->seconds > 0.0 ? 0.5 * (pace->seconds + seconds) : seconds;
    pace->in_flight--;
    pace->busy_until = now + pace->in_flight * pace->seconds;
}

void hd_tracer_pace_given_back(HdTracerPace *pace, double now) {
    pace->in_flight--;
    pace->busy_until = now + pace->in_flight * pace->seconds;
}
