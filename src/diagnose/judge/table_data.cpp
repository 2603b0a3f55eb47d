#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double name_weights[] = {2.0, 0.5, 1.0, 3.0, 2.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.5, 0.5, 1.0, 1.0, 0.5, 0.5, 1.0};
constexpr double missing_weights[] = {2.0, 4.0, 0.5, 0.5, 1.0, 3.0};

}  // namespace

const Table& name_table() {
  static constexpr Table table{-9.0, name_weights, {}};
  return table;
}

const Table& set_table() {
  static constexpr Table table{-7.0, name_weights, {}};
  return table;
}

const Table& missing_table() {
  static constexpr Table table{-3.0, missing_weights, {}};
  return table;
}

}  // namespace hysteron
