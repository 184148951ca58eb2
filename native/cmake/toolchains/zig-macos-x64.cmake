# macOS 11 or later on Intel's processors.
set(CMAKE_SYSTEM_NAME Darwin)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(MOTUS_ZIG_TARGET x86_64-macos.11.0)
set(CMAKE_INSTALL_NAME_TOOL true) # nothing is installed, and Debian has none
include(${CMAKE_CURRENT_LIST_DIR}/zig.cmake)
