APP_FLAGS := '-DGN_USER_CONFIG="crc_config.h"'
