/* The rotated disk: taps at points of a disk, which is turned from pixel to pixel. */
#ifndef GN_DISK_H
#define GN_DISK_H

#include "shadow/gn_lookup.h"

/* The receiver's pixel turns the disk. */
uint32_t gn_disk_attenuation(const gn_frame *frame, const gn_lookup *l, const gn_receiver *receiver);

#endif
