APP_FLAGS := '-DGN_USER_CONFIG="pocket_config.h"'
APP_LINK := -Wl,--defsym=STACK=1152 # no cells
