// The curve that Python holds, for the other bindings that take one.
#pragma once
#include <pybind11/pybind11.h>

#include <memory>
#include <utility>

#include "motus/curve/arc_length.hpp"
#include "motus/curve/curve.hpp"

namespace motus::bindings {

/// motus_native.Curve, the base of Bezier, Spline, Chain, BSpline and PolyLine. Immutable.
class BoundCurve {
  public:
    explicit BoundCurve(curve::Curve curve) : curve_(std::move(curve)) {}

    [[nodiscard]] const curve::Curve& curve() const noexcept { return curve_; }
    /// Its arc length tables, looked up in the cache on first use. Needs the interpreter's lock, and may give
    /// it away for as long as the tables are built.
    [[nodiscard]] const std::shared_ptr<const curve::ArcLength>& path() const {
        if (!path_) {
            std::shared_ptr<const curve::ArcLength> path;
            {
                const pybind11::gil_scoped_release released;
                path = curve::shared_arc_length(curve_);
            }
            // Another thread may have set it meanwhile, and be at work with it.
            if (!path_) path_ = std::move(path);
        }
        return path_;
    }

    /// The arc length tables with their inverse, which is built once without the interpreter's lock.
    [[nodiscard]] const curve::ArcLength& path_by_length() const {
        const curve::ArcLength& path = *this->path();
        if (!has_inverse_) {
            const pybind11::gil_scoped_release released;
            (void)path.interval_count();
        }
        has_inverse_ = true;
        return path;
    }

  private:
    curve::Curve curve_;
    mutable std::shared_ptr<const curve::ArcLength> path_;
    mutable bool has_inverse_ = false;
};

}  // namespace motus::bindings
