/* SPDX-License-Identifier: MIT */
/* What a surface does to light. */
#ifndef HD_MESH_MATERIAL_H
#define HD_MESH_MATERIAL_H

#include <stdbool.h>

#include "base/vector.h"

/* Phong's terms and the two rays that go on. On each side reflection + transmission <= 1. */
typedef struct HdMaterial {
    HdVec3 colour;      /* 0..1; tints diffuse light and what passes through */
    HdVec3 mirror_tint; /* 0..1; tints the mirror image */
    double ambient;
    double diffuse;
    double specular;
    int shininess; /* exponent, 1..HD_MAX_SHININESS */
    double reflection;
    double transmission;
    double inner_reflection; /* of rays that meet the face from inside the solid; */
    double inner_transmission;
    bool has_inner_side;        /* without it both sides reflect and transmit alike */
    double index_of_refraction; /* inside the solid, 1 outside; 1: rays go straight on */
    bool lit_from_behind; /* lights behind the face shine through: diffuse * transmission of them */
} HdMaterial;

#endif
