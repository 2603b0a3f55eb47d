#include "scalar/trace.hpp"

#include <bit>
#include <stdexcept>

#include "scalar/math.hpp"

namespace hysteron {
namespace {

using Operation = TraceOperation;

thread_local Tape* newest = nullptr;

Tape& tape() {
  if (newest == nullptr) {
    throw std::logic_error("equations are recorded without a tape");
  }
  return *newest;
}

Trace at_node(int node) {
  Trace result;
  result.node = node;
  return result;
}

// `value` computes a result of constants.
template <class Value>
Trace unary(Operation operation, const Trace& a, const Value& value) {
  if (a.node < 0) {
    return {value(a.constant)};
  }
  return at_node(tape().add({operation, a.node}));
}

template <class Value>
Trace binary(Operation operation, const Trace& a, const Trace& b, const Value& value) {
  if (a.node < 0 && b.node < 0) {
    return {value(a.constant, b.constant)};
  }
  Tape& onto = tape();
  const int first = onto.node_of(a);
  return at_node(onto.add({operation, first, onto.node_of(b)}));
}

bool is_one(const Trace& a) { return a.node < 0 && a.constant == 1.0; }

}  // namespace

Tape::Tape() : before_(newest) { newest = this; }
Tape::~Tape() { newest = before_; }

int Tape::add(const Node& node) {
  const auto [found, fresh] =
      known_.try_emplace({node.operation, node.a, node.b, node.c, std::bit_cast<std::uint64_t>(node.value)},
                         static_cast<int>(nodes_.size()));
  if (fresh) {
    nodes_.push_back(node);
  }
  return found->second;
}

Trace Tape::input(int number) { return at_node(add({Operation::input, number})); }

void Tape::stand_in(double value, const Trace& input) { stand_ins_.emplace_back(value, input); }

int Tape::node_of(const Trace& value) {
  return value.node >= 0 ? value.node : add({Operation::constant, -1, -1, -1, value.constant});
}

Trace Tape::meant_by(double value) const {
  for (const auto& [number, input] : stand_ins_) {
    if (value == number) {
      return input;
    }
    if (value == -number) {
      return -input;
    }
  }
  Trace result;
  result.constant = value;
  return result;
}

Trace::Trace(double value) : constant(value) {
  if (newest != nullptr) {
    *this = newest->meant_by(value);
  }
}

Trace operator+(const Trace& a, const Trace& b) {
  return binary(Operation::add, a, b, [](double x, double y) { return x + y; });
}
Trace operator-(const Trace& a, const Trace& b) {
  return binary(Operation::subtract, a, b, [](double x, double y) { return x - y; });
}
Trace operator*(const Trace& a, const Trace& b) {
  if (is_one(a)) {
    return b;
  }
  if (is_one(b)) {
    return a;
  }
  return binary(Operation::multiply, a, b, [](double x, double y) { return x * y; });
}
Trace operator/(const Trace& a, const Trace& b) {
  return binary(Operation::divide, a, b, [](double x, double y) { return x / y; });
}
Trace operator-(const Trace& a) {
  return unary(Operation::negate, a, [](double x) { return -x; });
}

TraceMask operator<(const Trace& a, const Trace& b) {
  Tape& onto = tape();
  const int first = onto.node_of(a);
  return {onto.add({Operation::less, first, onto.node_of(b)})};
}
TraceMask operator&(const TraceMask& a, const TraceMask& b) { return {tape().add({Operation::both, a.node, b.node})}; }
TraceMask operator|(const TraceMask& a, const TraceMask& b) {
  return {tape().add({Operation::either, a.node, b.node})};
}
Trace select(const TraceMask& mask, const Trace& yes, const Trace& no) {
  Tape& onto = tape();
  const int first = onto.node_of(yes);
  return at_node(onto.add({Operation::choose, mask.node, first, onto.node_of(no)}));
}

Trace min(const Trace& a, const Trace& b) {
  return binary(Operation::minimum, a, b, [](double x, double y) { return min(x, y); });
}
Trace max(const Trace& a, const Trace& b) {
  return binary(Operation::maximum, a, b, [](double x, double y) { return max(x, y); });
}
Trace abs(const Trace& a) {
  return unary(Operation::absolute, a, [](double x) { return abs(x); });
}
Trace sqrt(const Trace& a) {
  return unary(Operation::square_root, a, [](double x) { return sqrt(x); });
}
Trace exp(const Trace& a) {
  return unary(Operation::exponential, a, [](double x) { return exp(x); });
}
Trace log(const Trace& a) {
  return unary(Operation::logarithm, a, [](double x) { return log(x); });
}
Trace pow(const Trace& a, const Trace& n) {
  return binary(Operation::power, a, n, [](double x, double y) { return pow(x, y); });
}
Trace power_law(const Trace& a, const Trace& n) {
  return binary(Operation::power_law, a, n, [](double x, double y) { return power_law(x, y); });
}
Trace tanh(const Trace& a) {
  return unary(Operation::hyperbolic_tangent, a, [](double x) { return tanh(x); });
}
Trace drive_before(const Trace& lag) {
  Tape& onto = tape();
  return at_node(onto.add({Operation::earlier, onto.node_of(lag)}));
}

}  // namespace hysteron
