/* SPDX-License-Identifier: MIT OR Apache-2.0 */
/*
 * ocb.contacts/1: collision query, all contacts. Which pairs of triangles meet?
 *
 * Read plugin.h first; its rules on frames, poses, ownership and threads hold here too.
 */
#ifndef OPENCOLLBENCH_EXT_CONTACTS_H
#define OPENCOLLBENCH_EXT_CONTACTS_H

#include "../plugin.h"

#define OCB_EXT_CONTACTS "ocb.contacts/1"

#ifdef __cplusplus
extern "C" {
#endif

/* A contact: triangle `a` of object A and triangle `b` of object B have a point in common. */
typedef struct ocb_contact {
    uint32_t a;
    uint32_t b;
} ocb_contact;

/* What is asked of `contacts`, and the buffer for the answer. Made by the host. */
typedef struct ocb_contacts_request {
    uint32_t struct_size;
    /* No flag is defined yet; ignore bits that you do not know. */
    uint32_t flags;
    /* Room for `capacity` contacts; the host's memory, writable during the call. NULL only when capacity is 0. */
    ocb_contact *contacts;
    uint64_t capacity;
    /* Where to count the work of this query, or NULL: then it is timed. */
    ocb_counts *counts;
} ocb_contacts_request;

/* The answer of `contacts`. The host fills it before the call with struct_size and zeros. */
typedef struct ocb_contacts_result {
    uint32_t struct_size;
    /*
     * How many contacts there are, each pair counted once. Also when that is more than `capacity`: go on counting, and
     * write the first `capacity` of them, in any order.
     */
    uint64_t total;
} ocb_contacts_result;

/* The table that get_extension("ocb.contacts/1") returns. Static. */
typedef struct ocb_contacts {
    uint32_t struct_size;
    /* Arguments as for ocb_algorithm.collide. [query] */
    ocb_status (*contacts)(ocb_instance *instance, ocb_object *a, const double *pose_a, ocb_object *b,
                           const double *pose_b, const ocb_contacts_request *request, ocb_contacts_result *result);
} ocb_contacts;

#ifdef __cplusplus
}
#endif

#endif
