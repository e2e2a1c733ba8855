# Flags of make for what is built under sanitizers, for its callers to pass: by Clang, the library not optimised, or by GCC. All that
# pass the same ones share its objects.
sanitizers="-g1 -fsanitize=address,undefined -fno-sanitize-recover=all" # -g1: line numbers alone, less to write and to link
sanitized_clang="BUILD=build/test/clang CC=clang OPT=-O0 SCENE_OPT=-O1 ONE_FILE=1"
sanitized_gcc="BUILD=build/test/gcc CC=gcc HOST_OPT=-O1"
