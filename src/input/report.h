/* SPDX-License-Identifier: MIT */
/* Reports problems in a scene's JSON with their place, and applies a command line's changes:
   "solids[1].circumradius=2". */
#ifndef HD_INPUT_REPORT_H
#define HD_INPUT_REPORT_H

#include <jansson.h>
#include <stdbool.h>

#include "base/error.h"
#include "input/check.h"
#include "input/fields.h"
#include "input/json.h"

/* Flags for reading scenes: an integer is a number like others, however long it is. */
#define HD_JSON_FLAGS (JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL)

/* Sets the value in the tree. Its parent object or array must exist, except optional top-level
   objects ("image"); an array element must exist itself. The reader checks later whether the scene
   knows the key. */
void hd_scene_change_apply(json_t *root, HdSceneChange change, HdProblems *problems);

typedef struct HdSceneReport {
    const HdSceneSource *source;
    HdProblems *problems;
    char path[HD_JSON_PATH_SIZE]; /* path of the value being read */
    HdSceneChecker *checker;      /* checker of the whole scene; learns which parts are wrong */
} HdSceneReport;

/* Reports a problem of the value at the path, as "is -1, expected ..."; names the change that set
   it. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void hd_report(HdSceneReport *report, const char *format, ...);

/* Reports that the value at the path is not `expected`. */
void hd_report_value(HdSceneReport *report, const json_t *value, const char *expected);

/* Reports that the value is not what the field expects; `parts` as in hd_field_expected. */
void hd_report_field(HdSceneReport *report, const HdField *field, const json_t *value, int parts);

/* Reports that the value at the path is a word that seems to mean another one. */
void hd_report_mistaken(HdSceneReport *report, const json_t *value, const char *meant);

/* Reports that the value is none of the field's choices; suggests one or lists all. */
void hd_report_choice(HdSceneReport *report, const HdField *field, const json_t *value);

/* Reports each key of the object at the path that its type does not know. */
void hd_report_unknown_keys(HdSceneReport *report, const HdObjectType *type, const json_t *json);

#endif
