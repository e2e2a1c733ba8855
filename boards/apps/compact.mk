APP_FLAGS := '-DGN_USER_CONFIG="compact_config.h"'
