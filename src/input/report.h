/* SPDX-License-Identifier: MIT */
/* What is wrong with the JSON of a scene, told with its place, and the changes that a command line
   makes to it: "solids[1].circumradius=2". */
#ifndef HD_INPUT_REPORT_H
#define HD_INPUT_REPORT_H

#include <jansson.h>
#include <stdbool.h>

#include "base/error.h"
#include "input/check.h"
#include "input/fields.h"
#include "input/json.h"

/* How JSON is read here: an integer is a number like others, however long it is. */
#define HD_JSON_FLAGS (JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL)

/* Puts the value in its place in the tree. The object or array that holds it must be there, but for
   the objects at the top that may be left out ("image"); an element of an array must be there
   itself. Whether the scene knows such a key is checked later, with the rest of the file. */
void hd_scene_change_apply(json_t *root, HdSceneChange change, HdProblems *problems);

typedef struct HdSceneReport {
    const HdSceneSource *source;
    HdProblems *problems;
    char path[HD_JSON_PATH_SIZE]; /* of the value that is read */
    HdSceneChecker *checker;      /* of the whole scene, to which no part is known that is wrong */
} HdSceneReport;

/* The problem of the value at the path, as "is -1, expected ..."; what comes from a change says so.
 */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void hd_report(HdSceneReport *report, const char *format, ...);

/* The value at the path is not what was expected. */
void hd_report_value(HdSceneReport *report, const json_t *value, const char *expected);

/* The same with what the field expects; `parts` as in hd_field_expected. */
void hd_report_field(HdSceneReport *report, const HdField *field, const json_t *value, int parts);

/* The value at the path is a word that seems to mean another one. */
void hd_report_mistaken(HdSceneReport *report, const json_t *value, const char *meant);

/* The value is none of the field's choices; tells the one that may be meant, or all of them. */
void hd_report_choice(HdSceneReport *report, const HdField *field, const json_t *value);

/* Tells every key of the object at the path that its type does not know. */
void hd_report_unknown_keys(HdSceneReport *report, const HdObjectType *type, const json_t *json);

#endif
