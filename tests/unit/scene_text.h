/* SPDX-License-Identifier: MIT */
/* Scene files for tests, and shorthands to read them. */
#ifndef HD_SCENE_TEXT_H
#define HD_SCENE_TEXT_H

#include <stdio.h>
#include <stdlib.h>

#include "input/scene_file.h"
#include "unit_test.h"

/* The required keys, and nothing else. */
static const char least_text[] = "{\"hedron\": 1, \"camera\": {\"eye\": [30, 0, 0]}}";

/* Every key, each with a value of its own that is not the default. Solids are far from each
   other. */
static const char rich_text[] =
    "{\n"
    "  \"hedron\": 1,\n"
    "  \"image\": {\"width\": 320, \"height\": 200, \"samples\": 2, \"depth\": 5,\n"
    "            \"cutoff\": 0.01, \"exposure\": 1.5},\n"
    "  \"camera\": {\"field_of_view\": 75, \"frames\": 24,\n"
    "             \"eye\": {\"r0\": 30, \"z0\": 1, \"phi0\": 0.1, \"r_amplitude\": 0.2,\n"
    "                     \"z_amplitude\": 0.3, \"r_frequency\": 2, \"z_frequency\": 3,\n"
    "                     \"phi_frequency\": 4, \"r_phase\": 0.4, \"z_phase\": 0.5},\n"
    "             \"target\": [0.5, 0.25, 0.125]},\n"
    "  \"output\": {\"path\": \"out/%04d.png\", \"frames_per_second\": \"25000/1001\",\n"
    "             \"curve\": \"linear\", \"bits\": 16, \"alpha\": true},\n"
    "  \"background\": [0.1, 0.2, 3],\n"
    "  \"environment\": {\"file\": \"sky.pfm\", \"curve\": \"linear\", \"intensity\": 2,\n"
    "                  \"rotation\": 70},\n"
    "  \"materials\": {\n"
    "    \"glass\": {\"colour\": [0.9, 0.8, 0.7], \"mirror_tint\": [0.6, 0.5, 0.4],\n"
    "              \"ambient\": 0.01, \"diffuse\": 0.02, \"specular\": 0.03, \"shininess\": 65,\n"
    "              \"reflection\": 0.04, \"transmission\": 0.05, \"inner_reflection\": 0.06,\n"
    "              \"inner_transmission\": 0.07, \"index_of_refraction\": 1.5,\n"
    "              \"lit_from_behind\": true},\n"
    "    \"dark\": {\"diffuse\": 0.125},\n"
    "    \"plain\": {}\n"
    "  },\n"
    "  \"solids\": [\n"
    "    {\"kind\": \"cube\", \"centre\": [1, 2, 3], \"circumradius\": 2,\n"
    "     \"rotation\": [10, 20, 30], \"material\": \"glass\"},\n"
    "    {\"kind\": \"icosahedron\", \"centre\": [100, 0, 0], \"material\": \"dark\",\n"
    "     \"rim\": {\"width\": 0.05, \"material\": \"plain\"},\n"
    "     \"edge_lights\": {\"per_edge\": 3, \"colours\": [[1, 0, 0], [0, 1, 0.5]],\n"
    "                     \"intensity\": 0.1, \"disc_radius\": 0.02, \"disc_radiance\": 4,\n"
    "                     \"falloff_distance\": 6}},\n"
    "    {\"kind\": \"tetrahedron\", \"centre\": [200, 0, 0], \"material\": \"plain\",\n"
    "     \"edge_lights\": {\"per_edge\": 1, \"falloff_end\": 7}}\n"
    "  ],\n"
    "  \"meshes\": [\n"
    "    {\"file\": \"model.obj\", \"position\": [11, 12, 13], \"rotation\": [40, 50, 60],\n"
    "     \"scale\": [1, 2, -3], \"up\": \"y\", \"size\": 6,\n"
    "     \"normals\": \"smooth\", \"crease\": 25, \"material\": \"dark\"},\n"
    "    {\"file\": \"other.obj\", \"scale\": 0.5, \"normals\": \"flat\", \"ambient\": 0.25}\n"
    "  ],\n"
    "  \"lights\": [\n"
    "    {\"position\": [4, 5, 6], \"colour\": [1, 0.5, 0.25], \"intensity\": 3,\n"
    "     \"falloff_distance\": 8},\n"
    "    {\"position\": [7, 8, 9], \"falloff_end\": 10}\n"
    "  ],\n"
    "  \"floor\": {\"corners\": [[-5, 5, -20], [5, 5, -20], [5, -5, -20], [-5, -5, -20]],\n"
    "            \"material\": \"dark\",\n"
    "            \"texture\": {\"file\": \"floor.png\", \"curve\": \"linear\"}}\n"
    "}\n";

/* Parses a copy with no zero byte behind it, so that a memory checker detects a byte read too
   many. */
static inline HdStatus parse_scene(HdSceneFile *file, const char *text, size_t size,
                                   const HdSceneChange *changes, int change_count, HdError *error) {
    char *copy = malloc(size > 0 ? size : 1);
    assert_non_null(copy);
    memcpy(copy, text, size);
    const HdSceneSource source = {
        .name = "a.json", .folder = "", .changes = changes, .change_count = change_count};
    const HdStatus status = hd_scene_file_parse(file, copy, size, &source, error);
    free(copy);
    return status;
}

static inline void expect_scene(HdSceneFile *file, const char *text, HdSceneChange change) {
    static HdError error;
    if (parse_scene(file, text, strlen(text), &change, change != NULL, &error) != HD_OK)
        fail_msg("%s", error.message);
}

/* Returns the message. */
static inline const char *expect_refused(const char *text, HdSceneChange change,
                                         const char *message) {
    static HdError error;
    static HdSceneFile file;
    error.message[0] = '\0';
    const HdStatus status = parse_scene(&file, text, strlen(text), &change, change != NULL, &error);
    expect_contains(error.message, message);
    assert_int_equal(status, HD_BAD_INPUT);
    assert_null(file.scene.solids);
    assert_null(file.scene.lights);
    assert_null(file.mesh_entries);
    return error.message;
}

#endif
