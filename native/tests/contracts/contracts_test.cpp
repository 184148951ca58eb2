// Holds every public function to its contract.
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "contracts/contract.hpp"

using namespace motus::contracts;

TEST_CASE("every function refuses and takes what its contract says", "[contracts]") {
    const Table table = whole_table();
    for (const Row& row : table.rows)
        for (const std::string& one : breaches(row)) FAIL_CHECK(one);
    CHECK(table.rows.size() > 100);
}

TEST_CASE("what was moved from can be asked, assigned and destroyed", "[contracts]") {
    for (const Moved& one : whole_table().moved) {
        INFO(one.type);
        CHECK_NOTHROW(one.check());
    }
}

TEST_CASE("docs/contracts.md is made of the table", "[contracts]") {
    std::ifstream file(MOTUS_CONTRACTS_PAGE);
    std::stringstream kept;
    kept << file.rdbuf();
    INFO("./motus docs contracts");
    CHECK(kept.str() == page(whole_table()));
}
