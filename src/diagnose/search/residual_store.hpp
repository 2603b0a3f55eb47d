// Residuals of fits that several statistics look at, simulated once.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "diagnose/residual/residuals.hpp"

namespace hysteron {

// From any thread. Two that ask for the same at once both simulate it.
class ResidualStore {
 public:
  // What was kept under the key, or what `simulate` gives, a function of the key alone.
  [[nodiscard]] Residual get(const std::string& key, const std::function<Residual()>& simulate);

 private:
  // Bytes of residuals from which on everything is let go.
  static constexpr std::size_t most = std::size_t{1} << 28U;

  std::mutex guard_;
  std::map<std::string, Residual> kept_;
  std::size_t bytes_ = 0;
};

}  // namespace hysteron
