// Models, effects and solvers from outside the tree: a shared library that answers hysteron_plugin().
//
//   extern "C" const hysteron::Plugin* hysteron_plugin() {
//     static const hysteron::Part* const models[] = {&my_model};
//     static const hysteron::Plugin plugin{hysteron::plugin_layout(), models, {}, {}};
//     return &plugin;
//   }
//
// What it points at must live as long as the program. It must be built with the headers of the program that loads it,
// the same compiler family and instruction set; plugin_layout() tells the two apart where they differ.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fit/solver.hpp"
#include "simulate/knowledge.hpp"
#include "simulate/part.hpp"

namespace hysteron {

// A number that changes with the layout of what crosses the border.
constexpr std::uint64_t plugin_layout() {
  std::uint64_t sum = 14695981039346656037ULL;  // FNV-1a over the sizes
  for (const std::uint64_t part :
       {std::uint64_t{2} /* this header, and what Solver can be asked */, std::uint64_t{sizeof(Part)},
        std::uint64_t{sizeof(Parameter)}, std::uint64_t{sizeof(Knowledge)}, std::uint64_t{sizeof(Input<Lanes>)},
        std::uint64_t{sizeof(LaneDual)}, std::uint64_t{sizeof(SolverEntry)}, std::uint64_t{sizeof(Problem)},
        std::uint64_t{sizeof(Request)}, std::uint64_t{sizeof(Response)}, std::uint64_t{vector_bytes},
        std::uint64_t{lane_count}, std::uint64_t{sweep_directions}}) {
    sum = (sum ^ part) * 1099511628211ULL;
  }
  return sum;
}

struct Plugin {
  std::uint64_t layout;  // plugin_layout()
  std::span<const Part* const> models;
  std::span<const Part* const> effects;
  std::span<const SolverEntry* const> solvers;
};

// Adds what the library at `path` offers to the catalogues. Not while they are being read.
// Throws InputError for a file that is no plugin, was built for another layout, or offers an id that is taken.
void load_plugin(const std::string& path);
// The files of those loaded so far, in order.
const std::vector<std::string>& loaded_plugins();

}  // namespace hysteron
