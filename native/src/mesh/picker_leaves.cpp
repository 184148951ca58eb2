#include "picker_leaves.hpp"

#include <cstddef>
#include <cstdint>

#include "motus/core/instruction_sets.hpp"

// This include compiles the file once for each of Highway's targets; code for no target stands at the end.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "picker_leaves.cpp"
#include <hwy/foreach_target.h>

#include "motus/core/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::mesh::HWY_NAMESPACE {
namespace {

using namespace motus::HWY_NAMESPACE;

/// What grows to a box along some axes.
class Bounds {
  public:
    explicit Bounds(std::size_t axis) : axis_(axis) {}

    /// Of NaN and a number, Min and Max give the number.
    HWY_INLINE void add(const PickerPoint& point) {
        const Four at = hn::LoadU(as_four, point.data() + axis_);
        low_ = hn::Min(at, low_);
        high_ = hn::Max(at, high_);
    }
    HWY_INLINE void add(const Bounds& other) {
        low_ = hn::Min(other.low_, low_);
        high_ = hn::Max(other.high_, high_);
    }
    HWY_INLINE void store(PickerBox& box) const {
        hn::StoreU(low_, as_four, box.low.data() + axis_);
        hn::StoreU(high_, as_four, box.high.data() + axis_);
    }

  private:
    std::size_t axis_;
    Four low_ = hn::Set(as_four, PickerBox::inf);
    Four high_ = hn::Set(as_four, -PickerBox::inf);
};

void around_vertices(const PickerLeaves& leaves, std::size_t first, std::size_t last, PickerBox* out) {
    for (std::size_t leaf = first; leaf < last; ++leaf, ++out) {
        const PickerPoint* const points = &leaves.points[leaf * fan_out];
        for (std::size_t axis = 0; axis < 4; axis += lanes_of_four) {
            Bounds one(axis), other(axis);  // neither waits for the other
            for (std::size_t i = 0; i < fan_out; i += 2) {
                one.add(points[i]);
                other.add(points[i + 1]);
            }
            one.add(other);
            one.store(*out);
        }
    }
}

void around_triangles(const PickerLeaves& leaves, std::size_t first, std::size_t last, PickerBox* out) {
    for (std::size_t leaf = first; leaf < last; ++leaf, ++out) {
        for (std::size_t axis = 0; axis < 4; axis += lanes_of_four) {
            Bounds a(axis), b(axis), c(axis);
            for (std::size_t slot = leaves.starts[leaf]; slot < leaves.starts[leaf + 1]; ++slot) {
                const auto& corners = leaves.corners[slot];
                a.add(leaves.points[corners[0]]);
                b.add(leaves.points[corners[1]]);
                c.add(leaves.points[corners[2]]);
            }
            a.add(b);
            a.add(c);
            a.store(*out);
        }
    }
}

constexpr LeafKernel kernel{HWY_STR(HWY_NAMESPACE), &around_vertices, &around_triangles};

}  // namespace
}  // namespace motus::mesh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace motus::mesh {

std::span<const LeafKernel> leaf_kernels() {
    static const Kernels<LeafKernel> kernels({MOTUS_EVERY_TARGET(kernel)});
    return kernels.runnable();
}

}  // namespace motus::mesh
#endif
