// Catch2's main function. Compiled here, as Debian's library has it for this system alone.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
