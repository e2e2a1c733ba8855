/* Cortex-M3 and M4, M7, M33 without their extensions. */
#ifndef GN_PORT_ARMV7M_H
#define GN_PORT_ARMV7M_H

#include "gn_port.h"

#endif
