idf_component_register(SRCS "clock.c" "st7789.c" REQUIRES driver esp_lcd)
