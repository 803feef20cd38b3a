/* SPDX-License-Identifier: MIT OR Apache-2.0 */
/*
 * ocb.distance/1: proximity query (PQ). How far apart are the surfaces, and where?
 *
 * An algorithm that returns an `ocb_distance` for this id is offered for proximity runs. Read plugin.h first; its rules
 * on frames, poses, ownership and threads hold here too.
 */
#ifndef OPENCOLLBENCH_EXT_DISTANCE_H
#define OPENCOLLBENCH_EXT_DISTANCE_H

#include "../plugin.h"

#define OCB_EXT_DISTANCE "ocb.distance/1"

#ifdef __cplusplus
extern "C" {
#endif

/* What is asked of `distance`. Made by the host. */
typedef struct ocb_distance_request {
    uint32_t struct_size;
    /* OCB_REQUEST_* bits (plugin.h); ignore bits that you do not know. */
    uint32_t flags;
    /* Where to count the work of this query, or NULL: then it is timed. */
    ocb_counts *counts;
} ocb_distance_request;

/* Bits of ocb_distance_result.flags: which optional parts of the answer are filled in. */
enum {
    OCB_DISTANCE_HAS_POINTS = 1,
    OCB_DISTANCE_HAS_TRIANGLES = 2
};

/* The answer of `distance`. The host fills it before the call with struct_size and zeros, the triangles with
 * OCB_NO_TRIANGLE. */
typedef struct ocb_distance_result {
    uint32_t struct_size;
    /* OCB_DISTANCE_HAS_* bits, set by the plugin. What is not flagged is not read. */
    uint32_t flags;
    /*
     * min |p - q| over all points p of A's surface and q of B's, in the world frame and in the meshes' length unit:
     * finite, >= 0, and 0 when the surfaces meet, or when solid bodies (OCB_REQUEST_SOLID) do: then without triangles
     * when one is inside the other, and the points, if any, are a common one of the bodies, twice. The exact minimum up
     * to rounding, not a bound.
     */
    double distance;
    /*
     * Witness points, world frame: point_a on A, point_b on B, |point_a - point_b| = distance. When the surfaces meet:
     * a common point, twice. They need not be unique, and no particular ones are expected; the host checks that they
     * lie on the surfaces and realise the distance.
     */
    double point_a[3];
    double point_b[3];
    /* The triangles that hold the witness points: 0-based positions in the `triangles` given to load_mesh. */
    uint32_t triangle_a;
    uint32_t triangle_b;
} ocb_distance_result;

/* The table that get_extension("ocb.distance/1") returns. Static. */
typedef struct ocb_distance {
    uint32_t struct_size;
    /* Arguments as for ocb_algorithm.collide. [query] */
    ocb_status (*distance)(ocb_instance *instance, ocb_object *a, const double *pose_a, ocb_object *b,
                           const double *pose_b, const ocb_distance_request *request, ocb_distance_result *result);
} ocb_distance;

#ifdef __cplusplus
}
#endif

#endif
