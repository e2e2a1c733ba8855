APP_FLAGS := '-DGN_USER_CONFIG="compact_config.h"'
APP_LINK := -Wl,--defsym=STACK=1152 # the compact arithmetic takes a third of what the general one does
