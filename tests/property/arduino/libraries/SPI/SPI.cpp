#include <SPI.h>

HostSPI SPI;
void (*hostByte)(int);
