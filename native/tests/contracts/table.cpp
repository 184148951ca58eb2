#include "contracts/contract.hpp"

namespace motus::contracts {

Table whole_table() {
    Table table;
    for (const auto add : {add_core, add_noise, add_curve, add_path, add_bones, add_chains, add_ik,
                           add_look_at, add_layers, add_mesh, add_sculpt, add_lattice, add_dynamics,
                           add_stereo, add_strand, add_snow, add_walker, add_colour})
        add(table);
    return table;
}

}  // namespace motus::contracts
