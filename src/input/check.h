/* SPDX-License-Identifier: MIT */
/* The values of scenes that no scene file told, checked by the table of fields. */
#ifndef HD_INPUT_CHECK_H
#define HD_INPUT_CHECK_H

#include "base/error.h"
#include "scene/check.h"

/* Checks the values of a part by the table, as HdSceneChecker needs it. */
void hd_check_values(HdSceneChecker *checker, HdScenePart part, const void *owner);

/* Checks the whole of a scene and each of its values, in prose; the error names the first that is
   wrong. Library code may rely on a scene in which nothing was found. */
HdStatus hd_scene_validate(const HdScene *scene, HdError *error);

#endif
