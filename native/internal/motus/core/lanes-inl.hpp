// Vectors of numbers in the instructions of one of Highway's targets: once for each of these, in a source
// that <hwy/foreach_target.h> includes. For the topics of the library alone.
#if defined(MOTUS_CORE_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MOTUS_CORE_LANES_INL_HPP
#undef MOTUS_CORE_LANES_INL_HPP
#else
#define MOTUS_CORE_LANES_INL_HPP
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace motus::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

inline constexpr hn::ScalableTag<float> as_floats;
inline constexpr hn::ScalableTag<std::uint32_t> as_words;
inline constexpr hn::ScalableTag<std::int32_t> as_integers;
inline constexpr std::size_t lanes = hn::MaxLanes(as_floats);
using Floats = hn::Vec<decltype(as_floats)>;
using Words = hn::Vec<decltype(as_words)>;
using Integers = hn::Vec<decltype(as_integers)>;

HWY_INLINE Floats floats(float number) {
    return hn::Set(as_floats, number);
}

HWY_INLINE Words words(std::uint32_t word) {
    return hn::Set(as_words, word);
}

/// Four floats, or one at a time of four, if the instruction set has no more.
inline constexpr hn::CappedTag<float, 4> as_four;
inline constexpr std::size_t lanes_of_four = hn::MaxLanes(as_four);
using Four = hn::Vec<decltype(as_four)>;

/// number(i) in each lane i; not by way of memory, where what is written number by number cannot be read at
/// once without a wait.
template <class Number>
HWY_INLINE Four four_of(const Number& number) {
#if HWY_TARGET == HWY_SCALAR
    return hn::Set(as_four, number(0));
#else
    return hn::InterleaveLower(hn::InterleaveLower(hn::Set(as_four, number(0)), hn::Set(as_four, number(2))),
                               hn::InterleaveLower(hn::Set(as_four, number(1)), hn::Set(as_four, number(3))));
#endif
}

}  // namespace motus::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
