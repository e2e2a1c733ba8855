APP_FLAGS := '-DGN_USER_CONFIG="pocket_config.h"'
