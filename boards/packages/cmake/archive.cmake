# The library alone, for FetchContent, add_subdirectory and cmake --install of the whole archive: link gnomon::gnomon.
cmake_minimum_required(VERSION 3.13)
project(gnomon_archive LANGUAGES C)
add_subdirectory(lib)
