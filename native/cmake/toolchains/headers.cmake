# What a toolchain file includes whose compiler makes programs for another system: glm, Highway and Catch2 are headers alone,
# the same for every system, and Debian has them in /usr/include, beside headers of the C library that are not.
# Here they get a folder of their own, in which alone CMake looks for packages.
set(MOTUS_HEADERS_FROM /usr CACHE PATH "Folder with include/glm, include/hwy and include/catch2, and their CMake packages")
set(headers ${CMAKE_BINARY_DIR}/headers)
foreach(item include/glm include/hwy include/catch2 lib/libCatch2WithMain.a)
    if(NOT EXISTS ${headers}/${item})
        cmake_path(GET item PARENT_PATH folder)
        file(MAKE_DIRECTORY ${headers}/${folder})
        file(CREATE_LINK ${MOTUS_HEADERS_FROM}/${item} ${headers}/${item} SYMBOLIC)
    endif()
endforeach()
# Copies, as Catch2's package looks for its headers where a link to it leads.
file(COPY ${MOTUS_HEADERS_FROM}/share/cmake/glm DESTINATION ${headers}/share/cmake)
file(COPY ${MOTUS_HEADERS_FROM}/lib/cmake/Catch2 DESTINATION ${headers}/lib/cmake)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES MOTUS_HEADERS_FROM)

set(CMAKE_FIND_ROOT_PATH ${headers})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind LIBRARY INCLUDE PACKAGE)
    set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
set(CMAKE_PREFIX_PATH /)
