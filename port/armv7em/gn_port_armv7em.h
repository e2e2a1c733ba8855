/* Cortex-M4, M7, M33 with the DSP extension: two 16-bit texels in a word. */
#ifndef GN_PORT_ARMV7EM_H
#define GN_PORT_ARMV7EM_H

#include "gn_port.h"

#define gn_kernel_dark_texels16 gn_port_dark_texels16

#endif
