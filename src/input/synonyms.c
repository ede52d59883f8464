/* SPDX-License-Identifier: MIT */
#include "input/synonyms.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* A word may mean something else in each place; only one of its names is there. */
static const struct Synonym {
    const char *word, *name;
} synonyms[] = {
    {"fov", "field_of_view"},
    {"position", "eye"},
    {"position", "centre"},
    {"centre", "position"},
    {"center", "position"},
    {"translation", "position"},
    {"translate", "position"},
    {"instances", "meshes"},
    {"models", "meshes"},
    {"objects", "meshes"},
    {"obj", "file"},
    {"model", "file"},
    {"mesh", "file"},
    {"shading", "normals"},
    {"smooth", "normals"},
    {"angle", "crease"},
    {"look_at", "target"},
    {"lookat", "target"},
    {"center", "centre"},
    {"color", "colour"},
    {"colors", "colours"},
    {"ior", "index_of_refraction"},
    {"refraction", "index_of_refraction"},
    {"transparency", "transmission"},
    {"opacity", "transmission"},
    {"emission", "ambient"},
    {"radius", "circumradius"},
    {"radius", "disc_radius"},
    {"size", "circumradius"},
    {"size", "scale"},
    {"type", "kind"},
    {"shape", "kind"},
    {"count", "per_edge"},
    {"lights", "per_edge"},
    {"fps", "frames_per_second"},
    {"gamma", "curve"},
    {"file", "path"},
    {"path", "file"},
    {"hexahedron", "cube"},
};

static char lower(char c) {
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static bool is_same_word(const char *a, const char *b) {
    while (*a != '\0' && lower(*a) == lower(*b)) {
        a++;
        b++;
    }
    return *a == *b;
}

static bool means(const char *word, const char *name) {
    for (size_t i = 0; i < sizeof synonyms / sizeof synonyms[0]; i++)
        if (is_same_word(synonyms[i].word, word) && strcmp(synonyms[i].name, name) == 0)
            return true;
    return is_same_word(word, name);
}

void hd_synonym_offer(HdNearest *nearest, const char *name) {
    if (!means(nearest->word, name)) {
        hd_nearest_offer(nearest, name);
        return;
    }
    nearest->name = name;
    nearest->distance = -1;
}
