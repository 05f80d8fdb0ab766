/* Verifying the growth sections of a module. */
#ifndef TARTAN_GROWTH_VERIFY_H
#define TARTAN_GROWTH_VERIFY_H

#include "runtime/module/verify.h"

/* One rewrite system at most, and all parts are its own; as many of each as its limits allow; labels ascend; branches
 * leave from points that are there; boundaries have a shape; goals are there once, and expressions are functions. */
tn_status tn_growth_verify(const tn_checker *checker);

#endif
