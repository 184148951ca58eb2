# WebAssembly without threads, for browsers, with the C library that zig has for WASI.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(MOTUS_ZIG_TARGET wasm32-wasi)
# What FindThreads would look for: there are none, and nothing is linked for them.
set(CMAKE_HAVE_PTHREAD_H TRUE CACHE INTERNAL "")
set(CMAKE_HAVE_LIBC_PTHREAD TRUE CACHE INTERNAL "")
include(${CMAKE_CURRENT_LIST_DIR}/zig.cmake)
