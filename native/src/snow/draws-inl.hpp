// Random numbers of several flakes: see lanes-inl.hpp.
#if defined(MOTUS_SNOW_DRAWS) == defined(HWY_TARGET_TOGGLE)
#ifdef MOTUS_SNOW_DRAWS
#undef MOTUS_SNOW_DRAWS
#else
#define MOTUS_SNOW_DRAWS
#endif

#include <cstddef>
#include <cstdint>

#include "lanes-inl.hpp"
#include "philox.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::snow::HWY_NAMESPACE {

/// Of the lanes; philox.hpp has the Words of one flake.
using Bits = hn::Vec<decltype(as_words)>;

/// Words of the flakes in even lanes; what stands in the odd ones means nothing.
struct Counters {
    Bits a, b, c, d;
};

/// Of words and a constant, in even lanes.
struct Product {
    Bits lower, upper;
};

HWY_INLINE Product product(Bits all, std::uint32_t by) {
    const auto both = hn::MulEven(all, words(by));
    return {hn::BitCast(as_words, both), hn::BitCast(as_words, hn::ShiftRight<32>(both))};
}

/// The first two rounds of philox() for flakes with these lower words in even lanes. Half of each is the same
/// for all flakes.
HWY_INLINE Counters after_two_rounds(Key key, std::uint32_t high, Bits lows, Stream stream) {
    const snow::Words once = philox_round({0, high, static_cast<std::uint32_t>(stream), 0}, key);
    const Product first = product(lows, philox_factor_of_a);
    const Bits c = first.upper ^ words(key.high);
    key = next_key(key);
    const snow::Words twice = philox_round({once.a, 0, 0, 0}, key);
    const Product second = product(c, philox_factor_of_c);
    return {second.upper ^ words(once.b ^ key.low), second.lower, first.lower ^ words(twice.c),
            words(twice.d)};
}

/// philox() of the flakes with these lower words in even lanes.
HWY_INLINE Counters words_of(Key key, std::uint32_t high, Bits lows, Stream stream) {
    Counters counters = after_two_rounds(key, high, lows, stream);
    key = next_key(next_key(key));
    for (int round = 2; round < philox_rounds; ++round) {
        const Product first = product(counters.a, philox_factor_of_a);
        const Product second = product(counters.c, philox_factor_of_c);
        counters = {second.upper ^ counters.b ^ words(key.low), second.lower,
                    first.upper ^ counters.d ^ words(key.high), first.lower};
        key = next_key(key);
    }
    return counters;
}

/// fraction() of each.
HWY_INLINE Floats fractions(Bits all) {
    return hn::ConvertTo(as_floats, hn::BitCast(as_integers, hn::ShiftRight<8>(all))) * floats(0x1p-24F);
}

struct Draws {
    Floats a, b, c, d;
};

/// Of the flakes with these lower words. A product is two lanes wide, hence the even flakes and the odd ones
/// by themselves.
HWY_INLINE Draws drawn(Key key, std::uint32_t high, const std::uint32_t* lows, Stream stream) {
    const Bits all = hn::LoadU(as_words, lows);
    const Counters even = words_of(key, high, all, stream);
    const Counters odd = words_of(key, high, hn::Reverse2(as_words, all), stream);
    // A single lane is an even one, which is all that OddEven() knows there.
    const auto joined = [](Bits of_even, Bits of_odd) HWY_ATTR {
        return fractions(hn::OddEven(hn::Reverse2(as_words, of_odd), of_even));
    };
    return {joined(even.a, odd.a), joined(even.b, odd.b), joined(even.c, odd.c), joined(even.d, odd.d)};
}

/// All four numbers of the stream.
inline void draw(const Kind& kind, const Run& run, Stream stream, std::size_t n, FloatRow& a, FloatRow& b,
                 FloatRow& c, FloatRow& d) {
    for (std::size_t i = 0; i < n; i += lanes) {
        const Draws all = drawn(kind.key, run.high, run.lows + i, stream);
        store(all.a, a, i);
        store(all.b, b, i);
        store(all.c, c, i);
        store(all.d, d, i);
    }
}

/// The first two.
inline void draw(const Kind& kind, const Run& run, Stream stream, std::size_t n, FloatRow& a, FloatRow& b) {
    for (std::size_t i = 0; i < n; i += lanes) {
        const Draws all = drawn(kind.key, run.high, run.lows + i, stream);
        store(all.a, a, i);
        store(all.b, b, i);
    }
}

inline void draw_lives(Key key, std::uint32_t high, const std::uint32_t* lows, std::size_t count,
                       float* out) {
    for (std::size_t i = 0; i < count; i += lanes)
        hn::StoreU(spread(drawn(key, high, lows + i, Stream::life).a), as_floats, out + i);
}

}  // namespace motus::snow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
