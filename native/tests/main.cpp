// Catch2's main function. Compiled here of Catch2 2, as Debian's library has it for this system alone;
// version 3 brings it in a library.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
