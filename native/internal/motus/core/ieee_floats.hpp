// Arithmetic as IEEE 754 has it, whatever mode the program has set. For the topics of the library alone.
#pragma once
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace motus {

/// The thread's floating-point mode for a scope: rounds to nearest, and keeps numbers too small for a full
/// mantissa. Programs let threads take such numbers for 0 (FTZ and DAZ).
class IeeeFloats {
  public:
#if defined(__x86_64__)
    IeeeFloats() : was_(_mm_getcsr()), is_other_((was_ & ~flags) != standard) {
        if (is_other_) _mm_setcsr(standard);
    }
    ~IeeeFloats() {
        if (is_other_) _mm_setcsr(was_);
    }
#else
    IeeeFloats() = default;
    ~IeeeFloats() = default;
#endif
    IeeeFloats(const IeeeFloats&) = delete;
    IeeeFloats& operator=(const IeeeFloats&) = delete;
    IeeeFloats(IeeeFloats&&) = delete;
    IeeeFloats& operator=(IeeeFloats&&) = delete;

#if defined(__x86_64__)
  private:
    static constexpr unsigned standard = 0x1f80;  // no traps, to nearest, neither FTZ nor DAZ
    static constexpr unsigned flags = 0x3f;       // exceptions that have occurred so far
    unsigned was_;
    bool is_other_;
#endif
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
