/* Cores, parts that people own, and clocks of boards. C includes this file; docs/cost.sh and the playground read its
 * lines. Where the figures come from: docs/COST.md. */
/* clang-format off */

/* CORE(in BOARD_CPU, name, instructions per one of a Cortex-M3, cycles per instruction); the last is for all others */
CORE("cortex-m0", "Cortex-M0+", 2.15, 1.35)
CORE("cortex-m55", "Cortex-M55", 1.0, 1.2)
CORE("cortex-m7", "Cortex-M7", 1.0, 1.0)
CORE("cortex-m33", "Cortex-M33", 1.0, 1.4)
CORE("cortex-m4", "Cortex-M4", 1.0, 1.4)
CORE("cortex-m3", "Cortex-M3", 1.0, 1.4)
CORE("rv32", "RV32IMAC", 1.22, 1.4)
CORE("xtensa", "Xtensa LX7", 1.22, 1.4)
CORE("", "other", 1.22, 1.4)

/* PART(name, core, its cores, MHz, KB of RAM in one piece, KB of flash, MHz of its panel; 1: hot code is in RAM) */
PART("RP2040", "cortex-m0", 2, 125, 256, 2048, 62.5, 1)
PART("RP2350 Arm", "cortex-m33", 2, 150, 512, 4096, 62.5, 1)
PART("RP2350 RISC-V", "rv32", 2, 150, 512, 4096, 62.5, 1)
PART("ESP32-C3", "rv32", 1, 160, 384, 4096, 40, 0)
PART("ESP32-C6", "rv32", 1, 160, 512, 4096, 40, 0)
PART("ESP32-S3", "xtensa", 2, 240, 512, 8192, 40, 0)
PART("STM32F103", "cortex-m3", 1, 72, 20, 64, 18, 0)
PART("STM32F411", "cortex-m4", 1, 100, 128, 512, 50, 0)
PART("STM32F429", "cortex-m4", 1, 180, 192, 2048, 45, 0)
PART("STM32H743", "cortex-m7", 1, 480, 512, 2048, 60, 0)
PART("nRF52840", "cortex-m4", 1, 64, 256, 1024, 32, 0)

/* BOARD(folder of boards/, MHz); one that is not here gets 100 MHz, marked as assumed */
BOARD("pico", 125)
BOARD("microbit", 16)
BOARD("lm3s6965evb", 50)
BOARD("stm32f429-discovery", 168)
BOARD("black-pill", 100)
BOARD("nrf52840-dk", 64)
BOARD("mps2-an385", 25)
BOARD("mps2-an386", 25)
BOARD("mps2-an505", 20)
BOARD("mps3-an547", 32)

/* WITHOUT(folder): memory that no such part has; the playground leaves it out */
WITHOUT("nrf51-large")
