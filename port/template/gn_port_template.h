/* A port that compiles and does nothing better than the portable code. Copy the folder, rename it, and fill in what
 * pays. */
#ifndef GN_PORT_TEMPLATE_H
#define GN_PORT_TEMPLATE_H

#include "gn_port.h"

/* Leave out the line, and the function, of a kernel that the portable code should do. */
#define gn_kernel_dark_texels16 gn_port_dark_texels16

#endif
