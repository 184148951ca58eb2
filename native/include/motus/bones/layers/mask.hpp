// How much of each bone a layer takes (a bone mask), and bones in topological order.
//
// Costs: O(bones). Both allocate some memory for their work. Any number of threads at once.
#pragma once
#include <span>
#include <vector>

namespace motus::bones::layers {

/// The bones of a rig, each after its parent. parents: index of each bone's parent, -1 for none;
/// std::invalid_argument where one is no bone, or bones are their own ancestors.
[[nodiscard]] std::vector<int> parents_first(std::span<const int> parents);

/// Weights of a mask whose border is soft: at a bone that is in the mask (chosen > 0) while its parent is not
/// the weight is 1 / (feather + 1) of what was chosen, and rises from bone to bone until `feather` bones
/// further down all of it counts. order: as parents_first() has it. chosen and mask, which do not overlap:
/// one number a bone, 0 to 1. feather >= 0. std::invalid_argument where sizes differ, or one is no bone.
void feathered(std::span<const int> parents, std::span<const int> order, std::span<const double> chosen,
               int feather, std::span<double> mask);

}  // namespace motus::bones::layers
