# SCREEN_OF=BOARD says whose display is predicted.
ifeq ($(SCREEN_OF),)
$(error SCREEN_OF=BOARD says whose display is predicted)
endif
screen_setting = $(shell sed -n 's/^$(1) := //p' boards/$(SCREEN_OF)/board.mk)
SCREEN_SIZE := $(call screen_setting,SCREEN_SIZE)
SCREEN_FORMAT := $(call screen_setting,SCREEN_FORMAT)
SCREEN_SETTINGS := $(call screen_setting,SCREEN_SETTINGS)
SCREEN_ZOOM := $(or $(call screen_setting,SCREEN_ZOOM),16)
include boards/apps/screen.mk
APP_SRC := boards/apps/day.c
