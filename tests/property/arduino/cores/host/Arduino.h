#pragma once
#include <stdint.h>
#include <stdio.h>
#include <string.h>

void setup(void);
void loop(void);

#ifdef __cplusplus
// What a sketch finds on a board. hostWrite and hostWait: what a test does with pins and time.
enum { LOW, HIGH, OUTPUT, MSBFIRST, SPI_MODE0 };
extern void (*hostWrite)(int pin, int level);
extern void (*hostWait)(unsigned long ms);
extern unsigned long hostMillis;

inline void pinMode(int, int)
{
}
inline void digitalWrite(int pin, int level)
{
    if (hostWrite) hostWrite(pin, level);
}
inline unsigned long millis()
{
    return hostMillis;
}
inline void delay(unsigned long ms)
{
    hostMillis += ms;
    if (hostWait) hostWait(ms);
}

struct HostSerial {
    void begin(long)
    {
    }
    void println(const char *text)
    {
        puts(text);
    }
    void println(double number)
    {
        printf("%.2f\n", number);
    }
};
extern HostSerial Serial;
#endif
