// The curve that Python holds, for the other bindings that take one.
#pragma once
#include <pybind11/pybind11.h>

#include <memory>
#include <utility>

#include "motus/arc_length.hpp"
#include "motus/curve.hpp"

namespace motus::bindings {

/// motus_native.Curve, the base of Bezier, Spline, Chain, BSpline and PolyLine. Immutable.
class BoundCurve {
  public:
    explicit BoundCurve(Curve curve) : curve_(std::move(curve)) {}

    [[nodiscard]] const Curve& curve() const noexcept { return curve_; }
    /// Its arc length tables, looked up in the cache on first use. Needs the interpreter's lock, and may give
    /// it away for as long as the tables are built.
    [[nodiscard]] const std::shared_ptr<const ArcLength>& path() const {
        if (!path_) {
            std::shared_ptr<const ArcLength> path;
            {
                const pybind11::gil_scoped_release released;
                path = shared_arc_length(curve_);
            }
            // Another thread may have set it meanwhile, and be at work with it.
            if (!path_) path_ = std::move(path);
        }
        return path_;
    }

    /// The same, ready for distances: their inverse is built once, too, without the interpreter's lock.
    [[nodiscard]] const ArcLength& path_by_length() const {
        const ArcLength& path = *this->path();
        if (!has_inverse_) {
            const pybind11::gil_scoped_release released;
            (void)path.interval_count();
        }
        has_inverse_ = true;
        return path;
    }

  private:
    Curve curve_;
    mutable std::shared_ptr<const ArcLength> path_;
    mutable bool has_inverse_ = false;
};

}  // namespace motus::bindings
