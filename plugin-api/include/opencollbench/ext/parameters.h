/* SPDX-License-Identifier: MIT OR Apache-2.0 */
/*
 * ocb.parameters/1: named knobs of an algorithm, e.g. triangles per leaf.
 *
 * A parameter changes how an answer is found, never what is true: with every allowed value the answers are judged alike.
 */
#ifndef OPENCOLLBENCH_EXT_PARAMETERS_H
#define OPENCOLLBENCH_EXT_PARAMETERS_H

#include "../plugin.h"

#define OCB_EXT_PARAMETERS "ocb.parameters/1"

#ifdef __cplusplus
extern "C" {
#endif

/* Type of a parameter. Values travel as double. */
enum {
    OCB_PARAMETER_REAL = 1,
    /* Whole numbers; a switch is an integer from 0 to 1. */
    OCB_PARAMETER_INTEGER = 2
};

/* One knob. Static. */
typedef struct ocb_parameter {
    uint32_t struct_size;
    /* OCB_PARAMETER_REAL or OCB_PARAMETER_INTEGER. */
    uint32_t kind;
    /* 1 to 64 characters of a-z 0-9 _ beginning with a letter, unique in the algorithm. */
    const char *name;
    /* One sentence for people, with the unit if there is one. */
    const char *description;
    /* minimum <= default_value <= maximum, all finite. */
    double minimum;
    double maximum;
    double default_value;
} ocb_parameter;

/* The table that get_extension("ocb.parameters/1") returns. Static. */
typedef struct ocb_parameters {
    uint32_t struct_size;
    /* How many parameters: at most 64. */
    uint32_t parameter_count;
    /* Pointers to them. */
    const ocb_parameter *const *parameters;
    /*
     * Sets a parameter. The host has checked name, type and range; what is never set has its default. Return
     * OCB_UNSUPPORTED for a name that is not in the list. Called after `create`.
     * [load]
     */
    ocb_status (*set)(ocb_instance *instance, const char *name, double value);
} ocb_parameters;

#ifdef __cplusplus
}
#endif

#endif
