// Tables of benchmarks: a line for readers, and for .ci/bench.py a line of JSON, for each row. The lines of
// JSON are appended to the file that the environment variable MOTUS_BENCH_ROWS names, in the form that
// blend_tests/bench/table.py has too.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "motus/core/instruction_sets.hpp"

namespace motus::bench {

/// A measure: its name, its unit (ns, us, ms and s are compared between commits), the digits after the point
/// that readers see, and whether they see a power of ten.
struct Column {
    std::string name;
    std::string unit;
    int digits = 2;
    bool is_scientific = false;
};

/// In the column's unit. Nothing leaves it empty.
using Cell = std::optional<double>;

/// Prints its title and the names of its columns, then a row at a time. Row names are unique in a table.
class Table {
  public:
    Table(std::string title, std::vector<Column> columns, int width = 44)
        : title_(std::move(title)), columns_(std::move(columns)), width_(width) {
        append("{\"facts\": {\"instruction_set\": " + quoted(instruction_set()) + "}}");
        std::printf("\n%s\n  %*s", title_.c_str(), -width_, "");
        for (const Column& column : columns_) std::printf(" %*s", size(column), head(column).c_str());
        std::printf("\n");
    }

    /// A cell for each column; those that are left out at the end are empty.
    void row(const std::string& name, const std::vector<Cell>& cells) const {
        std::string measures;
        std::printf("  %*s", -width_, name.c_str());
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            const Cell cell = i < cells.size() ? cells[i] : Cell{};
            std::printf(" %*s", size(columns_[i]), shown(columns_[i], cell).c_str());
            if (cell) measures += (measures.empty() ? "" : ", ") + measure(columns_[i], *cell);
        }
        std::printf("\n");
        append("{\"table\": " + quoted(title_) + ", \"row\": " + quoted(name) + ", \"measures\": [" +
               measures + "]}");
    }

  private:
    /// Multiples and shares carry their sign with each number.
    [[nodiscard]] static bool is_sign(const std::string& unit) { return unit == "x" || unit == "%"; }

    [[nodiscard]] static std::string head(const Column& column) {
        return column.unit.empty() || is_sign(column.unit) ? column.name : column.name + ", " + column.unit;
    }

    [[nodiscard]] static int size(const Column& column) {
        return std::max(10, static_cast<int>(head(column).size()));
    }

    [[nodiscard]] static std::string number(double value, int digits, bool is_scientific) {
        std::array<char, 400> text{};  // no double is longer without a power of ten
        std::snprintf(text.data(), text.size(), is_scientific ? "%.*e" : "%.*f", digits, value);
        return text.data();
    }

    [[nodiscard]] static std::string shown(const Column& column, const Cell& cell) {
        if (!cell) return "-";
        const std::string sign = is_sign(column.unit) ? " " + column.unit : "";
        return number(*cell, column.digits, column.is_scientific) + sign;
    }

    /// JSON has no NaN and no infinity.
    [[nodiscard]] static std::string measure(const Column& column, double value) {
        return "{\"name\": " + quoted(column.name) + ", \"unit\": " + quoted(column.unit) +
               ", \"value\": " + (std::isfinite(value) ? number(value, 9, true) : "null") + "}";
    }

    [[nodiscard]] static std::string quoted(const std::string& text) {
        std::string result = "\"";
        for (const char letter : text) {
            if (letter == '"' || letter == '\\') result += '\\';
            result += letter;
        }
        return result + "\"";
    }

    static void append(const std::string& line) {
        const char* const path = std::getenv("MOTUS_BENCH_ROWS");
        if (path == nullptr) return;
        std::FILE* const file = std::fopen(path, "a");
        if (file == nullptr) return;
        std::fprintf(file, "%s\n", line.c_str());
        std::fclose(file);
    }

    std::string title_;
    std::vector<Column> columns_;
    int width_;
};

}  // namespace motus::bench
