# What the toolchain files of the modules that are shipped include: one compiler for all systems, clang with its own standard
# library, as the wheel `ziglang` of PyPI has it. They set MOTUS_ZIG_TARGET before. .ci/platforms.py gets the program.
set(MOTUS_ZIG zig CACHE FILEPATH "The program zig")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES MOTUS_ZIG)

# CMake wants a program a tool, and ccache knows a compiler of clang's kind by its name. Zig compiles its standard library for
# each degree of optimisation: for CMake's first trials it would do so once more. What it is not told it adds is debug information.
set(tools ${CMAKE_BINARY_DIR}/zig)
foreach(tool IN ITEMS "clang++:c++ -target ${MOTUS_ZIG_TARGET} -O3 -g0" "ar:ar" "ranlib:ranlib")
    string(REGEX MATCH "^([^:]+):(.+)$" parts ${tool})
    set(script ${tools}/zig-${CMAKE_MATCH_1})
    file(CONFIGURE OUTPUT ${script} CONTENT "#!/bin/sh\nexec \"${MOTUS_ZIG}\" ${CMAKE_MATCH_2} \"$@\"\n" @ONLY)
    file(CHMOD ${script} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
endforeach()
set(CMAKE_CXX_COMPILER ${tools}/zig-clang++)
set(CMAKE_AR ${tools}/zig-ar CACHE FILEPATH "")
set(CMAKE_RANLIB ${tools}/zig-ranlib CACHE FILEPATH "")
# Products and quotients of complex numbers as instructions. As functions they would come from zig's compiler_rt, whose one object
# file then also replaces the system's sin, exp, memcpy and others: Blender's own F-curves, say, would differ in the last bit.
set(CMAKE_CXX_FLAGS_INIT -fcomplex-arithmetic=improved)
include(${CMAKE_CURRENT_LIST_DIR}/headers.cmake)
