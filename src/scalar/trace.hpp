// A scalar that records what is done with it, so that the equations of a part can be written out as straight-line code
// in another language (src/export). Values that do not depend on an input are computed at once; equal expressions are
// recorded once.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "scalar/dual.hpp"

namespace hysteron {

enum class TraceOperation {
  constant,
  input,
  negate,
  add,
  subtract,
  multiply,
  divide,
  minimum,  // b < a ? b : a
  maximum,  // a < b ? b : a
  absolute,
  square_root,
  exponential,  // as exp of scalar/math.hpp, and so on
  logarithm,
  power,
  power_law,
  hyperbolic_tangent,
  earlier,  // the drive this long ago
  less,     // true or false, as the two below
  both,
  either,
  choose,  // a ? b : c
};

struct Trace {
  int node = -1;  // on the tape; -1: the constant
  double constant = 0.0;

  Trace() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): constants mix freely in model equations
  Trace(double value);

  Trace& operator+=(const Trace& o) { return *this = *this + o; }
  Trace& operator-=(const Trace& o) { return *this = *this - o; }
  Trace& operator*=(const Trace& o) { return *this = *this * o; }

  friend Trace operator+(const Trace& a, const Trace& b);
  friend Trace operator-(const Trace& a, const Trace& b);
  friend Trace operator*(const Trace& a, const Trace& b);
  friend Trace operator/(const Trace& a, const Trace& b);
  friend Trace operator-(const Trace& a);
};

struct TraceMask {
  int node = -1;
};

TraceMask operator<(const Trace& a, const Trace& b);
inline TraceMask operator>(const Trace& a, const Trace& b) { return b < a; }
TraceMask operator&(const TraceMask& a, const TraceMask& b);
TraceMask operator|(const TraceMask& a, const TraceMask& b);
Trace select(const TraceMask& mask, const Trace& yes, const Trace& no);

// A sum is written as a sum: the language it ends in may have no fma.
inline Trace fma(const Trace& a, const Trace& b, const Trace& c) { return a * b + c; }
Trace min(const Trace& a, const Trace& b);
Trace max(const Trace& a, const Trace& b);
Trace abs(const Trace& a);
Trace sqrt(const Trace& a);
Trace exp(const Trace& a);
Trace log(const Trace& a);
Trace pow(const Trace& a, const Trace& n);
Trace power_law(const Trace& a, const Trace& n);
Trace tanh(const Trace& a);
Trace drive_before(const Trace& lag);

// What is recorded, in order: a node uses nodes before it. The newest tape of a thread is the one written to.
class Tape {
 public:
  struct Node {
    TraceOperation operation;
    int a = -1;  // an input's number
    int b = -1;
    int c = -1;
    double value = 0.0;
  };

  Tape();
  ~Tape();
  Tape(const Tape&) = delete;
  Tape& operator=(const Tape&) = delete;
  Tape(Tape&&) = delete;
  Tape& operator=(Tape&&) = delete;

  Trace input(int number);
  // An argument that equations take as a plain number: the constant `value`, and its negative, stand for the input.
  void stand_in(double value, const Trace& input);
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  // Records what is not there yet.
  int node_of(const Trace& value);
  int add(const Node& node);
  // The input that a number stands for, else the number itself.
  [[nodiscard]] Trace meant_by(double value) const;

 private:
  std::vector<Node> nodes_;
  std::map<std::tuple<TraceOperation, int, int, int, std::uint64_t>, int> known_;
  std::vector<std::pair<double, Trace>> stand_ins_;
  Tape* before_;
};

}  // namespace hysteron
