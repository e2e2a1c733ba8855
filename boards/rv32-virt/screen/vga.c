/* The VGA card on the machine's PCI bus, through the registers of its "dispi" interface: 16 bits per pixel, a linear
 * frame buffer. The firmware hands out the addresses itself: there is no one else. */
#include "../../displays/framebuffer.h"
#include "../../displays/screen.h"

#define REGISTER(address) (*(volatile uint32_t *)(uintptr_t)(address))
#define HALF(address)     (*(volatile uint16_t *)(uintptr_t)(address))
#define BYTE(address)     (*(volatile uint8_t *)(uintptr_t)(address))

enum {
    PCI_CONFIG = 0x30000000, /* 32 KB per device */
    PCI_DEVICES = 32,
    PCI_COMMAND = 0x04,
    PCI_MEMORY_ON = 2,
    PCI_BAR0 = 0x10,
    PCI_BAR2 = 0x18,
    VGA_ID = 0x11111234,
    FRAME_BUFFER = 0x40000000,
    REGISTERS = 0x42000000,
    ATTRIBUTES = REGISTERS + 0x400,
    UNBLANK = 0x20,
    DISPI = REGISTERS + 0x500,
    DISPI_WIDTH = 1,
    DISPI_HEIGHT = 2,
    DISPI_BITS = 3,
    DISPI_ENABLE = 4,
    DISPI_ON_LINEAR = 0x41
};

static panel_status find_card(uint32_t *config)
{
    for (uint32_t device = 0; device < PCI_DEVICES; device++) {
        *config = PCI_CONFIG + (device << 15);
        if (REGISTER(*config) == VGA_ID) return PANEL_OK;
    }
    return PANEL_ERR_CONFIG;
}

static void set_dispi(uint32_t index, uint32_t value)
{
    HALF(DISPI + 2 * index) = (uint16_t)value;
}

static void set_mode(uint32_t config)
{
    REGISTER(config + PCI_BAR0) = FRAME_BUFFER;
    REGISTER(config + PCI_BAR2) = REGISTERS;
    REGISTER(config + PCI_COMMAND) = REGISTER(config + PCI_COMMAND) | PCI_MEMORY_ON;
    BYTE(ATTRIBUTES) = UNBLANK;
    set_dispi(DISPI_ENABLE, 0);
    set_dispi(DISPI_WIDTH, SCREEN_WIDTH);
    set_dispi(DISPI_HEIGHT, SCREEN_HEIGHT);
    set_dispi(DISPI_BITS, 16);
    set_dispi(DISPI_ENABLE, DISPI_ON_LINEAR);
}

panel_status screen_open(panel *p, display *d)
{
    static framebuffer f = {.pixels = (uint8_t *)FRAME_BUFFER,
                            .pitch_bytes = 2 * SCREEN_WIDTH,
                            .width = SCREEN_WIDTH,
                            .height = SCREEN_HEIGHT};
    const panel_config config = {.width = SCREEN_WIDTH, .height = SCREEN_HEIGHT};
    panel_bus bus;
    uint32_t card;
    panel_status status = find_card(&card);
    if (status) return status;
    set_mode(card);
    framebuffer_bus(&f, &bus);
    status = panel_init(p, &panel_linear, &config, &bus);
    if (status) return status;
    *d = (display){.panel = p,
                   .format = GN_FORMAT_RGB565}; /* no buffers: memory is there at once, nothing to overlap with */
    return display_init(d);
}
