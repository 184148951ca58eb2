// The functions that bind the library: one for each source file of the bindings.
#pragma once
#include <pybind11/pybind11.h>

namespace motus::bindings {

void bind_curve(pybind11::module_& m);
void bind_fcurve(pybind11::module_& m);
void bind_timing(pybind11::module_& m);
void bind_frames(pybind11::module_& m);
void bind_follow(pybind11::module_& m);
void bind_pose(pybind11::module_& m);
void bind_pose_buffer(pybind11::module_& m);
void bind_tails(pybind11::module_& m);
void bind_two_bone(pybind11::module_& m);
void bind_chain(pybind11::module_& m);
void bind_look_at(pybind11::module_& m);
void bind_layers(pybind11::module_& m);
void bind_rig_ik(pybind11::module_& m);
void bind_picker(pybind11::module_& m);
void bind_refine(pybind11::module_& m);
void bind_pull(pybind11::module_& m);
void bind_lattice(pybind11::module_& m);
void bind_noise(pybind11::module_& m);
void bind_colour(pybind11::module_& m);
void bind_snow(pybind11::module_& m);
void bind_snow_layer(pybind11::module_& m);
void bind_walker(pybind11::module_& m);
void bind_strand(pybind11::module_& m);
void bind_stereo(pybind11::module_& m);
void bind_pendulum(pybind11::module_& m);
void bind_second_order(pybind11::module_& m);
void bind_wave(pybind11::module_& m);
void bind_thread_state(pybind11::module_& m);
void bind_instruction_set(pybind11::module_& m);
void bind_memory(pybind11::module_& m);
void bind_bounded(pybind11::module_& m);

}  // namespace motus::bindings
