#pragma once
#include <Arduino.h>

struct SPISettings {
    SPISettings(unsigned long, int, int)
    {
    }
};

// hostByte: what a test does with a byte that is sent.
extern void (*hostByte)(int byte);

struct HostSPI {
    void begin()
    {
    }
    void beginTransaction(SPISettings)
    {
    }
    uint8_t transfer(uint8_t byte)
    {
        if (hostByte) hostByte(byte);
        return 0xA5;
    }
    uint16_t transfer16(uint16_t word)
    {
        return uint16_t(transfer(uint8_t(word >> 8)) << 8 | transfer(uint8_t(word)));
    }
    void transfer(void *bytes, size_t n)
    {
        for (size_t i = 0; i < n; i++) static_cast<uint8_t *>(bytes)[i] = transfer(static_cast<uint8_t *>(bytes)[i]);
    }
};
extern HostSPI SPI;
