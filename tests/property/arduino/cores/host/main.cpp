#include <Arduino.h>

HostSerial Serial;
void (*hostWrite)(int, int);
void (*hostWait)(unsigned long);
unsigned long hostMillis;

__attribute__((weak)) int main()
{
    setup();
    return 0;
}
