// Writes docs/contracts.md to standard output; or, with the argument --breaches, what breaks the contracts.
#include <exception>
#include <iostream>
#include <string_view>

#include "contracts/contract.hpp"

using namespace motus::contracts;

namespace {

int tell_breaches(const Table& table) {
    int count = 0;
    for (const Row& row : table.rows)
        for (const std::string& one : breaches(row)) std::cout << one << '\n', ++count;
    for (const Moved& one : table.moved) {
        try {
            one.check();
        } catch (const std::exception& problem) {
            std::cout << one.type << ", moved from: " << problem.what() << '\n';
            ++count;
        }
    }
    return count == 0 ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
    const Table table = whole_table();
    if (count > 1 && std::string_view(arguments[1]) == "--breaches") return tell_breaches(table);
    std::cout << page(table);
}
