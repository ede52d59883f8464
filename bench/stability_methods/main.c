/* SPDX-License-Identifier: MIT */
/* Counts failures of published methods and of the kernels' own. bench/study stability reads the
   output, a line for each study, case, method and place:

     STUDY CASE METHOD SCALE OFFSET KEY=NUMBER...

   SCALE is the size of things, OFFSET their distance from the world's origin in sizes. Keys:

     crossings  tried (rays), missed, twice, wrong (either), misplaced
     paths      tried, completed (30 bounces), followed (as the path in double); tried_far,
                followed_far (300 bounces)
     shadows    tried (segments that are open), blocked; tried_shut, opened; nan (of both)

   Exit codes: 0 done, 1 a failure, 2 wrong usage. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "studies.h"

const HdPlace hd_places[] = {
    {1e-6, 0},   {1e-4, 0},   {1e-2, 0},   {1e0, 0},    {1e2, 0},    {1e4, 0},    {1e6, 0},
    {1e0, 1},    {1e0, 1e2},  {1e0, 1e4},  {1e0, 1e6},  {1e-6, 1},   {1e-6, 1e2}, {1e-6, 1e4},
    {1e-6, 1e6}, {1e-4, 1},   {1e-4, 1e2}, {1e-4, 1e4}, {1e-4, 1e6}, {1e-2, 1},   {1e-2, 1e2},
    {1e-2, 1e4}, {1e-2, 1e6}, {1e2, 1},    {1e2, 1e2},  {1e2, 1e4},  {1e2, 1e6},  {1e4, 1},
    {1e4, 1e2},  {1e4, 1e4},  {1e4, 1e6},  {1e6, 1},    {1e6, 1e2},  {1e6, 1e4},  {1e6, 1e6},
};
const int hd_place_count = 11, hd_all_place_count = sizeof hd_places / sizeof *hd_places;

typedef struct Study {
    const char *name;
    bool (*run)(int count);
} Study;

static const Study studies[] = {
    {"crossings", hd_study_crossings},
    {"paths", hd_study_paths},
    {"shadows", hd_study_shadows},
};

bool hd_can_contract(void) {
#ifdef HD_CPU_X86
    return __builtin_cpu_supports("fma");
#else
    return true;
#endif
}

int main(int count, char **words) {
    const Study *study = NULL;
    for (size_t i = 0; count == 3 && i < sizeof studies / sizeof *studies; i++)
        if (strcmp(words[1], studies[i].name) == 0)
            study = &studies[i];
    long number = study != NULL ? strtol(words[2], NULL, 10) : 0;
    if (number < 1 || number > 100 * 1000 * 1000) {
        fprintf(stderr, "usage: hedron_stability_methods crossings|paths|shadows COUNT\n");
        return 2;
    }
    return study->run((int)number) ? 0 : 1;
}
