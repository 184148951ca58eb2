// The system's mathematics for modules that zig links for Windows: its own runtime library has a part of it
// as well, which rounds otherwise than what Blender calls. Of two libraries the linker takes the first one
// that has a name, here windows_mathematics.def's, but zig's if that is loaded before the name is asked for.
// The objects of a module come before all libraries, so this one asks for all of the names.
#include <math.h>

namespace {

using OfDouble = double (*)(double);
using OfFloat = float (*)(float);

[[gnu::used]] constexpr OfDouble OF_DOUBLES[] = {cos, exp, exp2, log, log10, log2, sin, tan};
[[gnu::used]] constexpr OfFloat OF_FLOATS[] = {cosf, exp2f, log10f, log2f, logf, sinf, tanf};

}  // namespace

// Both at once, which clang's optimizer makes of a sine and a cosine with a C library of GNU's kind, and
// which Windows lacks. Compiled with -fmath-errno, with which the optimizer leaves the two calls as they are.
extern "C" {

void sincos(double angle, double* sine, double* cosine) {
    *sine = sin(angle);
    *cosine = cos(angle);
}

void sincosf(float angle, float* sine, float* cosine) {
    *sine = sinf(angle);
    *cosine = cosf(angle);
}

}  // extern "C"
