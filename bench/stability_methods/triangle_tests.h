/* SPDX-License-Identifier: MIT */
/* Published tests of a ray against a triangle, in float and in world coordinates. None is part of
   the product. They are compiled twice: to the letter, and with contraction. */
#ifndef HD_BENCH_TRIANGLE_TESTS_H
#define HD_BENCH_TRIANGLE_TESTS_H

#include <stdbool.h>

typedef struct HdFloat3 {
    float x, y, z;
} HdFloat3;

/* A ray with the values that tests compute once. */
typedef struct HdFloatRay {
    HdFloat3 origin, direction;
    HdFloat3 moment; /* origin x direction */
    int axis[3];     /* the dominant axis comes last; the first two keep the orientation */
    float shear[3];
} HdFloatRay;

/* A triangle, counterclockwise from outside, with the values that tests compute once. */
typedef struct HdFloatTriangle {
    HdFloat3 a, b, c;
    float to_unit[3][4]; /* Baldwin and Weber's transformation, and */
    float normal_sign;   /* the direction of its third row */
} HdFloatTriangle;

typedef struct HdMeeting {
    float t;
    float share_b, share_c; /* barycentric */
    bool entering;
} HdMeeting;

typedef struct HdTriangleTest {
    const char *name;
    /* Returns whether the ray's line crosses the triangle. */
    bool (*cross)(const HdFloatRay *ray, const HdFloatTriangle *triangle, HdMeeting *meeting);
} HdTriangleTest;

typedef struct HdTriangleTests {
    void (*prepare_ray)(HdFloatRay *ray);                /* computed from origin and direction */
    void (*prepare_triangle)(HdFloatTriangle *triangle); /* computed from the corners */
    int count;
    const HdTriangleTest *tests;
} HdTriangleTests;

/* The last of the strict ones is watertight with the tie rule. The contracted ones need a processor
   with fused multiplication. */
extern const HdTriangleTests hd_triangle_tests, hd_triangle_tests_contracted;

#endif
