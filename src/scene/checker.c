/* SPDX-License-Identifier: MIT */
#include "scene/checker.h"

#include <stdio.h>

void hd_checker_enter(HdSceneChecker *checker, const char *prose, const char *json) {
    const char *name = checker->naming == HD_NAMING_JSON ? json : prose;
    snprintf(checker->place, sizeof checker->place, "%s%s", name, name[0] != '\0' ? ": " : "");
}

void hd_checker_leave(HdSceneChecker *checker) {
    checker->place[0] = '\0';
}

void hd_checker_enter_item(HdSceneChecker *checker, const char *prose, const char *json,
                           int index) {
    if (checker->naming == HD_NAMING_JSON)
        snprintf(checker->place, sizeof checker->place, "%s[%d]: ", json, index);
    else
        snprintf(checker->place, sizeof checker->place, "%s %d: ", prose, index + 1);
}
