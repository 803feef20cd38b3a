/* SPDX-License-Identifier: MIT OR Apache-2.0 */
/*
 * ocb.counters/1: how much work is a query? Machine-independent beside the time.
 *
 * The host asks for counters in a pass of its own that is not timed, so counting may be a separate, slower copy of the
 * query code; the timed functions need not count at all. It must be the same algorithm: the answer is compared with
 * that of the timed function.
 */
#ifndef OPENCOLLBENCH_EXT_COUNTERS_H
#define OPENCOLLBENCH_EXT_COUNTERS_H

#include "../plugin.h"
#include "contacts.h"
#include "distance.h"

#define OCB_EXT_COUNTERS "ocb.counters/1"

#ifdef __cplusplus
extern "C" {
#endif

/* Bits of ocb_counts.flags: what the plugin has counted. What is not flagged is not read. */
enum {
    OCB_COUNTS_BV_TESTS = 1,
    OCB_COUNTS_PRIMITIVE_TESTS = 2,
    OCB_COUNTS_PER_TRIANGLE = 4
};

/* Work of one query. The host fills it before the call: struct_size, zeros, and the two arrays, themselves zeroed. */
typedef struct ocb_counts {
    uint32_t struct_size;
    /* OCB_COUNTS_* bits, set by the plugin. */
    uint32_t flags;
    /* Overlap or distance tests between two bounding volumes (16 in one SIMD step are 16). */
    uint64_t bv_tests;
    /* Overlap or distance tests between two primitives; for meshes, two triangles. */
    uint64_t primitive_tests;
    /*
     * In how many primitive tests each triangle of A and of B took part: the plugin adds 1 to both for each test.
     * The host's memory, writable during the call, one entry per triangle of the object; NULL when not wanted. Even
     * when a and b are the same object, these are two arrays.
     */
    uint32_t *tests_a;
    uint32_t *tests_b;
} ocb_counts;

/*
 * The table that get_extension("ocb.counters/1") returns. Static. Each function answers as its timed twin does and
 * counts; a function is NULL when its twin is missing. Arguments as for ocb_algorithm.collide. [querying, not timed]
 */
typedef struct ocb_counters {
    uint32_t struct_size;
    uint32_t reserved;
    ocb_status (*count_collide)(ocb_instance *instance, ocb_object *a, const double *pose_a, ocb_object *b,
                                const double *pose_b, const ocb_collide_request *request, ocb_collide_result *result,
                                ocb_counts *counts);
    ocb_status (*count_distance)(ocb_instance *instance, ocb_object *a, const double *pose_a, ocb_object *b,
                                 const double *pose_b, const ocb_distance_request *request, ocb_distance_result *result,
                                 ocb_counts *counts);
    ocb_status (*count_contacts)(ocb_instance *instance, ocb_object *a, const double *pose_a, ocb_object *b,
                                 const double *pose_b, const ocb_contacts_request *request, ocb_contacts_result *result,
                                 ocb_counts *counts);
} ocb_counters;

#ifdef __cplusplus
}
#endif

#endif
