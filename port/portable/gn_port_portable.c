#include "gn_port_portable.h"

void gn_port_before_dma(const void *bytes, size_t n_bytes)
{
    (void)bytes, (void)n_bytes;
}
