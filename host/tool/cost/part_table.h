# Clocks, for the page's estimate of frames per second: board, MHz. A board that is not here gets 100 MHz, marked as assumed.
board pico 125
board microbit 16
board lm3s6965evb 50
board stm32f429-discovery 168
board black-pill 100
board nrf52840-dk 64
board mps2-an385 25
board mps2-an386 25
board mps2-an505 20
board mps3-an547 32
# Cores, by what BOARD_CPU has: instructions of the core per instruction of the cost model, cycles per instruction. Where they come
# from: docs/COST.md.
core cortex-m0 1.7 1.35
core cortex-m55 0.8 1.2
core cortex-m7 0.8 1.0
core cortex 0.8 1.4
core rv32 1.0 1.4
core  1.0 1.4
# Left out: memory that no such part has
without nrf51-large
