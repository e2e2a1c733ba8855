/* A port that compiles and is no faster than the portable code. Copy the folder, rename it, and fill in what pays. */
#ifndef GN_PORT_TEMPLATE_H
#define GN_PORT_TEMPLATE_H

#include "gn_port.h"

/* To keep the portable version of a kernel, delete its line here and its function. */
#define gn_kernel_dark_texels16 gn_port_dark_texels16

#endif
