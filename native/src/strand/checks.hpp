// What strands and their inputs must be. Private to the library.
#pragma once
#include <span>

#include "motus/strand/motion.hpp"
#include "motus/strand/strand.hpp"

namespace motus::strand {

/// Throws std::invalid_argument, naming the argument, if a size does not fit or a number is outside its
/// domain.
void require_sound(std::span<const Link> links, const Inputs& inputs, const Solving& solving);

}  // namespace motus::strand
