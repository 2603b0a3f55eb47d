// The equations of a part as straight-line code, recorded from the one description in models/.
#pragma once

#include <optional>
#include <vector>

#include "scalar/trace.hpp"
#include "simulate/part.hpp"

namespace hysteron {

// What an expression may depend on.
enum class Argument {
  parameter,  // numbered, as states and memory are
  state,
  memory,
  x,
  v,
  drive,
  time,
  age,
  a,
  jerk,
  below,    // force of the links nearer to the law
  speed,    // bound of |velocity|
  change,   // bound of the change of velocity
  elapsed,  // s since the sample before
  acting,   // drive as the effects so far leave it
};

struct ArgumentNumber {
  Argument argument;
  int index;
};
ArgumentNumber argument_of_input(int number);

// Straight-line code: nodes in order, of which some are results.
struct Function {
  struct Result {
    ArgumentNumber target;  // for rates the state, for a series element's law its place in Yield
    int node;
  };
  std::vector<Tape::Node> nodes;
  std::vector<Result> results;
};

// A function is absent where the part has none.
struct PartEquations {
  std::optional<Function> drive;  // results: the members of the motion that change
  std::optional<Function> rate;   // results: rates of the states
  std::optional<Function> force;
  std::optional<Function> stiffness;
  std::optional<Function> towards;
  std::optional<Function> slack;
  std::optional<Function> stiffness_near;
  std::optional<Function> yield;  // results: deflection, slope, bend, gain, hold, width; the state is state 0
  std::optional<Function> recall;
  std::optional<Function> excite_first;  // at the first sample; results: acting drive and memory
  std::optional<Function> excite;        // at any other
  bool loaded = false;                   // the rate needs the force below
  int settles = -1;                      // see part.hpp
};

// Throws InputError, naming the part, where its equations branch on a number that is only known while marching.
PartEquations equations_of(const Part& part);

}  // namespace hysteron
