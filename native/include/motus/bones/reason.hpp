// Why the end of a chain, its end effector, is or is not on its target.
#pragma once

namespace motus::bones {

/// The reason why the end of a chain is or is not on its target. The codes are part of the Python interface.
enum class Reason : int {
    reached = 0,     ///< the end is on the target, within the tolerance
    too_far = 1,     ///< the target is farther than the chain reaches (or than softness lets it)
    too_near = 2,    ///< the target is nearer to the root than the chain can fold
    limit = 3,       ///< a joint limit is in the way
    iterations = 4,  ///< the iterations allowed were used up
};

}  // namespace motus::bones
