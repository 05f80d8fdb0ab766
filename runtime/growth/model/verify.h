/* Verifying the growth sections of a module. */
#ifndef TARTAN_GROWTH_VERIFY_H
#define TARTAN_GROWTH_VERIFY_H

#include "runtime/module/verify.h"

/* One rewrite system at most, and all parts are its own; as many of each as its limits allow; labels ascend;
 * boundaries have a shape; goals are there once, and expressions are functions. */
tn_status tn_growth_verify(const tn_checker *checker);

/* The code, once its instructions have been verified: seeds are polygons; successors' brackets nest, each with one
 * edge, and their turtle ends in the direction in which it started; guards are labels, context and successors, in this
 * order; rules, groups and functions fit. */
tn_status tn_growth_verify_whole(const tn_checker *checker);

#endif
