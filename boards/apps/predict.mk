include boards/apps/screen.mk
APP_SRC := boards/apps/day.c
