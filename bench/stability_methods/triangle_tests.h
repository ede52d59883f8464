/* SPDX-License-Identifier: MIT */
/* Tests of a ray against a triangle as others do them, in float and in world coordinates. None is
   part of the product. They are compiled twice: to the letter, and with contraction. */
#ifndef HD_BENCH_TRIANGLE_TESTS_H
#define HD_BENCH_TRIANGLE_TESTS_H

#include <stdbool.h>

typedef struct HdFloat3 {
    float x, y, z;
} HdFloat3;

/* A ray with what tests compute of it once. */
typedef struct HdFloatRay {
    HdFloat3 origin, direction;
    HdFloat3 moment; /* origin x direction */
    int axis[3];     /* the one nearest to the ray comes last; the first two keep the turn */
    float shear[3];
} HdFloatRay;

/* A triangle, counterclockwise from outside, with what tests compute of it once. */
typedef struct HdFloatTriangle {
    HdFloat3 a, b, c;
    float to_unit[3][4]; /* Baldwin and Weber's transformation, and */
    float normal_sign;   /* which way its third row looks */
} HdFloatTriangle;

typedef struct HdMeeting {
    float t;
    float share_b, share_c; /* barycentric */
    bool entering;
} HdMeeting;

typedef struct HdTriangleTest {
    const char *name;
    /* Whether the ray's line crosses the triangle anywhere. */
    bool (*cross)(const HdFloatRay *ray, const HdFloatTriangle *triangle, HdMeeting *meeting);
} HdTriangleTest;

typedef struct HdTriangleTests {
    void (*prepare_ray)(HdFloatRay *ray);                /* from origin and direction */
    void (*prepare_triangle)(HdFloatTriangle *triangle); /* from the corners */
    int count;
    const HdTriangleTest *tests;
} HdTriangleTests;

/* The last of the strict ones is watertight with the tie rule. The contracted ones need fused
   multiplication from the processor. */
extern const HdTriangleTests hd_triangle_tests, hd_triangle_tests_contracted;

#endif
