/* Cortex-M55, M85: eight texels in a vector. */
#ifndef GN_PORT_HELIUM_H
#define GN_PORT_HELIUM_H

#include "gn_port.h"

#define gn_kernel_dark_texels16 gn_port_dark_texels16

#endif
