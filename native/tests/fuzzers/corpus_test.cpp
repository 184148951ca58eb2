// What fuzzers found worth keeping (corpus/TARGET/) is tried again.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "random.hpp"
#include "targets.hpp"

using namespace motus;
using namespace motus::fuzzers;

namespace {

std::vector<std::filesystem::path> corpus_of(const Target& target) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(MOTUS_CORPUS) / target.name))
        files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("what fuzzers have found keeps the library's promises", "[fuzz]") {
    for (const Target& target : targets) {
        const std::vector<std::filesystem::path> files = corpus_of(target);
        CHECK(files.size() > 10);
        for (const std::filesystem::path& file : files) {
            INFO(file);
            CHECK_NOTHROW(target.run(bytes_of(file)));
        }
    }
}

TEST_CASE("any bytes are arguments with which the library keeps its promises", "[fuzz]") {
    test::Random random(51);
    for (const Target& target : targets) {
        INFO(target.name);
        for (int round = 0; round < 300; ++round) {
            std::vector<std::uint8_t> bytes(random.below(400));
            for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.below(256));
            INFO("round " << round);
            CHECK_NOTHROW(target.run(bytes));
        }
    }
}

TEST_CASE("a broken promise is told", "[fuzz]") {
    CHECK_THROWS_AS(expect(false, "nothing"), Broken);
    CHECK_THROWS_AS(returns([] { throw std::invalid_argument("Wrong."); }), Broken);
    CHECK_FALSE(returns([] { throw std::invalid_argument("speed: must be finite"); }));
    CHECK(returns([] {}));
}
