// Python's names for the types of arguments. Functions take objects of any type and check them by themselves,
// so that an exception can name the argument; these classes put the type that is wanted into the signature,
// which help() shows and of which native/bindings/motus_native.pyi is made.
#pragma once
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace motus::bindings {

namespace py = pybind11;

/// A type as Python writes it, for use as a template's argument.
template <std::size_t size>
struct TypeName {
    // Implicit, so that Typed<"float"> can be written; a literal is a C array, and pybind11 reads one.
    // NOLINTNEXTLINE(google-explicit-constructor, modernize-avoid-c-arrays)
    consteval TypeName(const char (&name)[size]) { std::copy_n(name, size, text); }
    char text[size]{};  // NOLINT(modernize-avoid-c-arrays)
};

/// An object of any type, for which signatures show the type `name`.
template <TypeName name>
class Typed : public py::object {
  public:
    Typed() = default;
    Typed(py::handle given, borrowed_t /*unused*/) : py::object(given, borrowed_t{}) {}
    Typed(py::handle given, stolen_t /*unused*/) : py::object(given, stolen_t{}) {}
    // NOLINTNEXTLINE(google-explicit-constructor): any object is one
    Typed(const py::object& given) : py::object(given) {}
    // NOLINTNEXTLINE(google-explicit-constructor)
    Typed(py::object&& given) : py::object(std::move(given)) {}

    /// Asked by pybind11 before the function is called.
    [[nodiscard]] static bool check_(py::handle given) { return static_cast<bool>(given); }
};

using Number = Typed<"float">;
using WholeNumber = Typed<"int">;
using Flag = Typed<"bool">;
using Text = Typed<"str">;
using ArrayLike = Typed<"numpy.typing.ArrayLike">;
using Float64Array = Typed<"numpy.typing.NDArray[numpy.float64]">;
using Float32Array = Typed<"numpy.typing.NDArray[numpy.float32]">;
using Int32Array = Typed<"numpy.typing.NDArray[numpy.int32]">;
using OptionalNumber = Typed<"float | None">;
using OptionalArrayLike = Typed<"numpy.typing.ArrayLike | None">;
using OptionalFloat64Array = Typed<"numpy.typing.NDArray[numpy.float64] | None">;
using OptionalFloat32Array = Typed<"numpy.typing.NDArray[numpy.float32] | None">;
using OptionalInt32Array = Typed<"numpy.typing.NDArray[numpy.int32] | None">;
using ArrayLikes = Typed<"typing.Sequence[numpy.typing.ArrayLike]">;
using IndexOrArrayLike = Typed<"int | numpy.typing.ArrayLike">;
using WholeNumbers = Typed<"typing.Sequence[int]">;
using OptionalWholeNumbers = Typed<"typing.Sequence[int] | None">;
using OptionalSurfaces = Typed<"typing.Sequence[StrandSurface] | None">;
using OptionalTexts = Typed<"typing.Sequence[str] | None">;

// Names of options, each read by choice() (core/arguments.hpp), which refuses others.
using ExtendName = Typed<"typing.Literal['clamp', 'extrapolate', 'loop', 'ping_pong']">;
using FrameModeName = Typed<"typing.Literal['world_up', 'minimal', 'banking', 'curvature', 'tilt', 'rail']">;
using AxisName = Typed<"typing.Literal['X', 'Y', 'Z', '-X', '-Y', '-Z']">;
using EmitterShapeName =
    Typed<"typing.Literal['square', 'disc', 'box', 'sphere', 'cone', 'surface', 'frustum']">;
using CollisionName = Typed<"typing.Literal['stay', 'slide', 'melt']">;
using StereoModeName = Typed<"typing.Literal['off_axis', 'parallel', 'toe_in']">;
using GaitName = Typed<
    "typing.Literal['tripod', 'tetrapod', 'ripple', 'wave', 'trot', 'pace', 'walk', 'run', 'canter', "
    "'gallop', 'hop']">;
using InheritScaleName =
    Typed<"typing.Literal['FULL', 'FIX_SHEAR', 'ALIGNED', 'AVERAGE', 'NONE', 'NONE_LEGACY']">;
using DistanceName = Typed<"typing.Literal['straight', 'surface', 'edges']">;
using FalloffName = Typed<
    "typing.Literal['classic', 'smooth', 'sphere', 'root', 'linear', 'sharp', 'constant', 'gaussian', "
    "'curve']">;

}  // namespace motus::bindings

namespace pybind11::detail {

template <motus::bindings::TypeName type_name>
struct handle_type_name<motus::bindings::Typed<type_name>> {
    static constexpr auto name = const_name(type_name.text);
};

}  // namespace pybind11::detail
