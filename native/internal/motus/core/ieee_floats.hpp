// Arithmetic as IEEE 754 has it, whatever mode the program has set. For the topics of the library alone.
#pragma once
#if defined(__x86_64__)
#include <xmmintrin.h>
#elif defined(__aarch64__)
#include <cstdint>
#endif

namespace motus {

#if defined(__x86_64__)
/// The register in which a thread of this kind of processor has its floating-point mode.
struct FloatMode {
    using Bits = unsigned;
    static constexpr Bits standard = 0x1f80;  // no traps, to nearest, neither FTZ nor DAZ
    static constexpr Bits flags = 0x3f;       // exceptions that have occurred so far
    static constexpr Bits flushing =
        0x8040;  // FTZ and DAZ: numbers too small for a full mantissa are taken for 0
    static Bits read() { return _mm_getcsr(); }
    static void write(Bits bits) { _mm_setcsr(bits); }
};
#elif defined(__aarch64__)
/// The register in which a thread of this kind of processor has its floating-point mode.
struct FloatMode {
    using Bits = std::uint64_t;
    static constexpr Bits standard = 0;  // no traps, to nearest, not FZ
    static constexpr Bits flags = 0;     // which have a register of their own
    static constexpr Bits flushing = Bits{1}
                                     << 24;  // FZ: numbers too small for a full mantissa are taken for 0
    static Bits read() {
        Bits bits = 0;
        __asm__ volatile("mrs %0, fpcr" : "=r"(bits));
        return bits;
    }
    static void write(Bits bits) { __asm__ volatile("msr fpcr, %0" : : "r"(bits)); }
};
#else
/// Of a kind of processor whose mode is not known to the library.
struct FloatMode {
    using Bits = unsigned;
    static constexpr Bits standard = 0, flags = 0, flushing = 0;
    static Bits read() { return standard; }
    static void write(Bits) {}
};
#endif

/// The thread's floating-point mode for a scope: rounds to nearest, and keeps numbers too small for a full
/// mantissa. Programs let threads take such numbers for 0 (FTZ and DAZ).
class IeeeFloats {
  public:
    IeeeFloats() : was_(FloatMode::read()), is_other_((was_ & ~FloatMode::flags) != FloatMode::standard) {
        if (is_other_) FloatMode::write(FloatMode::standard);
    }
    ~IeeeFloats() {
        if (is_other_) FloatMode::write(was_);
    }
    IeeeFloats(const IeeeFloats&) = delete;
    IeeeFloats& operator=(const IeeeFloats&) = delete;
    IeeeFloats(IeeeFloats&&) = delete;
    IeeeFloats& operator=(IeeeFloats&&) = delete;

  private:
    FloatMode::Bits was_;
    bool is_other_;
};

// A compiler that looks into a function may move calls of it across a change of the mode, which is no input
// of the function to the compiler: GCC does so with calls that are only not inlined.
#if defined(__has_cpp_attribute)
#if __has_cpp_attribute(gnu::noipa)
#define MOTUS_CALLED_APART [[gnu::noipa]]
#endif
#endif
#if !defined(MOTUS_CALLED_APART)
#define MOTUS_CALLED_APART [[gnu::noinline]]
#endif

/// A call that compilers move no arithmetic into or out of.
template <class Work>
MOTUS_CALLED_APART auto call_apart(const Work& work) {
    return work();
}

/// Calls work() in the standard mode. Threads that work() starts inherit this mode, or have the standard one.
template <class Work>
auto in_ieee_floats(const Work& work) {
    [[maybe_unused]] const IeeeFloats mode;
    return call_apart(work);
}

}  // namespace motus
