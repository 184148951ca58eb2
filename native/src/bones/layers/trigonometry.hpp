// Sine, cosine and angles by arithmetic and square roots alone.
#pragma once
#include <cmath>

#include "motus/core/sine.hpp"

namespace motus::bones::layers {

struct Angle {
    double sine, cosine;
};

[[nodiscard]] inline Angle angle_of(double radians) {
    const SineCosine<double> both = sine_cosine(radians);
    return {both.sine, both.cosine};
}

/// Angle of the point (x, y), both >= 0, from the x axis: 0 to a quarter turn; to 2e-16.
/// Sun's fdlibm (1993), s_atan.c, whose reduction to four intervals needs no table of others.
[[nodiscard]] inline double arc_tangent(double y, double x) {
    if (y > x) return 1.57079632679489661923 - arc_tangent(x, y);
    if (y <= 0.0) return 0.0;
    double ratio = y / x;  // 0 to 1
    double offset = 0.0;
    if (ratio >= 0.6875) {
        ratio = (ratio - 1.0) / (ratio + 1.0);
        offset = 7.85398163397448278999e-01;
    } else if (ratio >= 0.4375) {
        ratio = (2.0 * ratio - 1.0) / (2.0 + ratio);
        offset = 4.63647609000806093515e-01;
    }
    const double z = ratio * ratio;
    const double w = z * z;
    const double odd =
        z * (3.33333333333329318027e-01 +
             w * (1.42857142725034663711e-01 +
                  w * (9.09088713343650656196e-02 +
                       w * (6.66107313738753120669e-02 +
                            w * (4.97687799461593236017e-02 + w * 1.62858201153657823623e-02)))));
    const double even = w * (-1.99999999998764832476e-01 +
                             w * (-1.11111104054623557880e-01 +
                                  w * (-7.69187620504482999495e-02 +
                                       w * (-5.83357013379057348645e-02 + w * -3.65315727442169155270e-02))));
    return offset + (ratio - ratio * (odd + even));
}

}  // namespace motus::bones::layers
