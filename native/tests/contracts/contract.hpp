// The table of contracts: of every public function what it refuses, what it takes and what it costs. A test
// calls each with every kind of extreme, and docs/contracts.md is made of it.
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "contracts/domain.hpp"
#include "contracts/numbers.hpp"

namespace motus::contracts {

/// What a function allocates.
enum class Memory {
    nothing,  ///< nothing at all, if it returns
    result,   ///< what it returns
    scratch,  ///< also for its work
};

/// An argument, or a member of one.
struct Slot {
    std::string name;  ///< as in messages
    Domain domain;
    Size size;
    bool is_out = false;
};

/// One call of a function, whose arguments are good until they are changed.
class Trial {
  public:
    Trial() = default;
    Trial(const Trial&) = delete;
    Trial& operator=(const Trial&) = delete;
    virtual ~Trial() = default;

    [[nodiscard]] virtual std::vector<Place> places(std::size_t slot) = 0;
    /// How many numbers are one element of the slot's list.
    [[nodiscard]] virtual std::size_t width(std::size_t slot) = 0;
    /// Makes a list longer or shorter; false if that cannot be done.
    [[nodiscard]] virtual bool resize(std::size_t slot, int by) = 0;
    virtual void call() = 0;
    /// Numbers of the result, and of what the call has written.
    [[nodiscard]] virtual std::vector<double> results() = 0;
    /// Whether nothing is written: at all, or beside what was to be written.
    [[nodiscard]] virtual bool is_untouched(bool at_all) = 0;
};

/// The contract of one function.
struct Row {
    std::string signature;  ///< without motus::, with the header's names: "curve::split(curve, t)"
    std::vector<Slot> slots;
    std::function<std::unique_ptr<Trial>()> make;
    std::string cost;
    Memory memory = Memory::nothing;
    std::string also;          ///< what else is refused, or holds
    bool is_alone = false;     ///< whether no other thread may use the object meanwhile
    bool is_infinite = false;  ///< whether finite numbers may give infinite ones, as the header says

    Row& costs(std::string what) { return cost = std::move(what), *this; }
    Row& allocates(Memory what) { return memory = what, *this; }
    Row& adds(std::string what) { return also = std::move(what), *this; }
    Row& alone() { return is_alone = true, *this; }
    Row& infinite() { return is_infinite = true, *this; }
};

/// What an object is after it was moved from.
struct Moved {
    std::string type;
    std::string says;
    std::function<void()> check;  ///< uses, assigns and destroys one; throws what breaks the contract
};

/// The whole table.
struct Table {
    std::vector<Row> rows;
    std::vector<Moved> moved;
};

/// Each fills in its topics.
void add_core(Table& table);
void add_curve(Table& table);
void add_path(Table& table);
void add_bones(Table& table);
void add_chains(Table& table);
void add_ik(Table& table);
void add_look_at(Table& table);
void add_layers(Table& table);
void add_mesh(Table& table);
void add_sculpt(Table& table);
void add_lattice(Table& table);
void add_dynamics(Table& table);
void add_stereo(Table& table);
void add_strand(Table& table);
void add_noise(Table& table);
void add_snow(Table& table);
void add_walker(Table& table);
void add_colour(Table& table);
[[nodiscard]] Table whole_table();

/// Sentences about each breach of a contract that calls with extremes show.
[[nodiscard]] std::vector<std::string> breaches(const Row& row);

/// docs/contracts.md.
[[nodiscard]] std::string page(const Table& table);

}  // namespace motus::contracts
