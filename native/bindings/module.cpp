// motus_native: the table of contents.
#include <pybind11/pybind11.h>

#include <string>

#include "areas.hpp"
#include "motus/version.hpp"

PYBIND11_MODULE(motus_native, m) {
    m.doc() = R"(
Native core of Motus.

Arrays are NumPy float64 unless said; (m, 3) means m rows of x, y, z. Metres, radians and seconds; quaternions w, x, y, z.
A wrong shape, type or value raises ValueError or TypeError that names the argument. Parameters and lengths outside a
curve's interval never raise: extend = "clamp" | "extrapolate" | "loop" | "ping_pong" says what they mean.)";
    m.attr("__version__") = std::string(motus::version);

    // All classes are local to the module: a second copy of it, of another package, has classes of its own.
    using namespace motus::bindings;
    bind_curve(m);
    bind_fcurve(m);       // before the layers: FCurve
    bind_pose_buffer(m);  // before the followers: PoseBuffer
    bind_timing(m);
    bind_frames(m);
    bind_follow(m);
    bind_pose(m);
    bind_tails(m);
    bind_two_bone(m);  // first of the chains: Reason
    bind_chain(m);
    bind_look_at(m);
    bind_layers(m);
    bind_rig_ik(m);
    bind_picker(m);  // before pull(): Picker
    bind_refine(m);
    bind_pull(m);
    bind_lattice(m);
    bind_noise(m);
    bind_colour(m);
    bind_snow(m);
    bind_snow_layer(m);
    bind_walker(m);
    bind_strand(m);
    bind_stereo(m);
    bind_pendulum(m);
    bind_second_order(m);
    bind_wave(m);
    bind_thread_state(m);
    bind_instruction_set(m);
    bind_memory(m);
    bind_bounded(m);
}
