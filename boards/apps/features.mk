# The scene is that of the tests; every feature is built in.
APP_FLAGS := -Itests/support -DGN_CASTER_CULLING=1 -DGN_TRANSPARENT_LAYERS=2 -DGN_MAX_OTHER_TILES=8 -DGN_MAX_LIGHTS=4
