# Gnomon as a module of MicroPython, for ports built by CMake: USER_C_MODULES=this file.
add_library(usermod_gnomon INTERFACE)
target_sources(usermod_gnomon INTERFACE ${CMAKE_CURRENT_LIST_DIR}/modgnomon.c ${CMAKE_CURRENT_LIST_DIR}/src/gnomon.c)
target_include_directories(usermod_gnomon INTERFACE ${CMAKE_CURRENT_LIST_DIR}/src)
target_link_libraries(usermod INTERFACE usermod_gnomon)
