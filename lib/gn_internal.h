/* The first include of every part of the library. */
#ifndef GN_INTERNAL_H
#define GN_INTERNAL_H

#if !defined(GN_ONE_FILE) && !defined(GN_SEPARATE_FILES)
#error "this file is a part of lib/gnomon.c: compile lib/gnomon.c alone"
#endif

#include "gnomon.h"

#endif
