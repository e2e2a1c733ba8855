/* Cortex-M55, M85: four weights in a vector. */
#ifndef GN_PORT_HELIUM_H
#define GN_PORT_HELIUM_H

#include "gn_port.h"

#define gn_kernel_tent_row16 gn_port_tent_row16

#endif
