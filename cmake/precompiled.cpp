// Of no content: CMake compiles a precompiled header with a source of the same target.
