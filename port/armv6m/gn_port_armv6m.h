/* Cortex-M0, M0+, M1: no wide multiplication. */
#ifndef GN_PORT_ARMV6M_H
#define GN_PORT_ARMV6M_H

#include "gn_port.h"

#endif
