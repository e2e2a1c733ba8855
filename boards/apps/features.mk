# The scene is that of the tests; every feature is built in.
APP_FLAGS := -Itests/support -DGN_MANY_CASCADES=3 -DGN_TRANSPARENT_LAYERS=2 -DGN_MAX_OTHER_TILES=8 -DGN_MAX_LIGHTS=4
