#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "motus/bones/ik/ik.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bones::ik {
namespace {

[[noreturn]] void refuse(const char* argument, const std::string& problem) {
    throw std::invalid_argument(std::string(argument) + ": " + problem);
}

void check_index(int index, std::size_t count, const char* argument, const char* what) {
    if (index < 0 || static_cast<std::size_t>(index) >= count)
        refuse(argument, std::string("there is no ") + what + " " + std::to_string(index));
}

/// Row of a bone that hangs on a chain: its parent's place in the chain is looked up.
ChainPlan::Hanging hanging(const ChainBones& chain, int parent, int bone, std::size_t row) {
    const auto found = std::find(chain.bones.begin(), chain.bones.end(), parent);
    return {static_cast<std::size_t>(bone), static_cast<std::size_t>(found - chain.bones.begin()), row};
}

}  // namespace

ChainPlan::ChainPlan(std::vector<int> parents, std::vector<ChainBones> chains,
                     const std::vector<Guard>& guards)
    : parents_(std::move(parents)), chains_(std::move(chains)), entries_(chains_.size()) {
    const std::size_t bones = parents_.size();
    for (const int parent : parents_) {
        if (parent < -1 || (parent >= 0 && static_cast<std::size_t>(parent) >= bones))
            refuse("parents", "there is no bone " + std::to_string(parent));
    }
    check_chains();
    for (const Guard& guard : guards) {
        check_index(guard.bone, bones, "guards", "bone");
        check_index(guard.chain, chains_.size(), "guards", "chain");
        const std::vector<int>& chain = chains_[static_cast<std::size_t>(guard.chain)].bones;
        const int parent = parents_[static_cast<std::size_t>(guard.bone)];
        const bool is_in = std::find(chain.begin(), chain.end(), guard.bone) != chain.end();
        const bool hangs = std::find(chain.begin(), chain.end(), parent) != chain.end();
        if (is_in || !hangs)
            refuse("guards", "bone " + std::to_string(guard.bone) + " is no child of chain " +
                                 std::to_string(guard.chain) + " outside it");
    }
    for (std::size_t i = 0; i < chains_.size(); ++i) {
        entries_[i].first_row = rows_.size();
        rows_.insert(rows_.end(), chains_[i].bones.begin(), chains_[i].bones.end());
        longest_chain_ = std::max<std::size_t>(longest_chain_, chains_[i].bones.size());
    }
    chain_bone_count_ = rows_.size();
    is_absolute_.assign(rows_.size(), 0);
    add_effectors(guards);
    add_guards(guards);
}

void ChainPlan::check_chains() const {
    for (const ChainBones& chain : chains_) {
        if (chain.bones.empty() || chain.bones.size() > chains::most_bones)
            refuse("chains", "a chain has 1 to " + std::to_string(chains::most_bones) + " bones");
        for (std::size_t i = 0; i < chain.bones.size(); ++i) {
            const int bone = chain.bones[i];
            check_index(bone, parents_.size(), "chains", "bone");
            if (i > 0 && parents_[static_cast<std::size_t>(bone)] != chain.bones[i - 1])
                refuse("chains", "bone " + std::to_string(bone) + " is no child of the one before it");
        }
        check_index(chain.effector, parents_.size(), "effectors", "bone");
        const int last = chain.bones.back();
        if (chain.effector != last && parents_[static_cast<std::size_t>(chain.effector)] != last)
            refuse("effectors", "bone " + std::to_string(chain.effector) +
                                    " is neither the chain's last bone nor a child of it");
    }
}

void ChainPlan::add_effectors(const std::vector<Guard>& guards) {
    for (std::size_t i = 0; i < chains_.size(); ++i) {
        const ChainBones& chain = chains_[i];
        Entry& entry = entries_[i];
        entry.has_free_effector = chain.effector != chain.bones.back();
        if (!entry.has_free_effector) continue;
        entry.is_effector_absolute = std::any_of(guards.begin(), guards.end(), [i](const Guard& guard) {
            return static_cast<std::size_t>(guard.chain) == i;
        });
        entry.effector = hanging(chain, chain.bones.back(), chain.effector, rows_.size());
        rows_.push_back(chain.effector);
        is_absolute_.push_back(entry.is_effector_absolute ? 1 : 0);
    }
}

void ChainPlan::add_guards(const std::vector<Guard>& guards) {
    std::vector<std::pair<std::size_t, Hanging>> found;
    for (const Guard& guard : guards) {
        const auto index = static_cast<std::size_t>(guard.chain);
        const ChainBones& chain = chains_[index];
        if (guard.bone == chain.effector) continue;
        const int parent = parents_[static_cast<std::size_t>(guard.bone)];
        found.emplace_back(index, hanging(chain, parent, guard.bone, rows_.size()));
        rows_.push_back(guard.bone);
        is_absolute_.push_back(1);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [index, guard] : found) {
        Entry& entry = entries_[index];
        if (entry.guard_count == 0) entry.first_guard = guards_.size();
        ++entry.guard_count;
        guards_.push_back(guard);
    }
}

ChainPlan::Chain ChainPlan::chain(std::size_t index, std::size_t left_out) const {
    require(index < chains_.size(), "index: must be one of a chain");
    const Entry& entry = entries_[index];
    const std::span<const int> bones = chains_[index].bones;
    Chain chain;
    chain.parent = parents_[static_cast<std::size_t>(bones.front())];
    chain.left_out = std::min(left_out, bones.size() - 1);
    chain.bones = bones.subspan(chain.left_out);
    chain.first_row = entry.first_row + chain.left_out;
    chain.has_free_effector = entry.has_free_effector;
    chain.is_effector_absolute = entry.is_effector_absolute;
    chain.effector = entry.effector;
    chain.guards = {guards_.data() + entry.first_guard, entry.guard_count};
    return chain;
}

}  // namespace motus::bones::ik
