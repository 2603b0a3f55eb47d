#include "bench/bbob_log.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace hysteron::bbob {
namespace {

constexpr double targets_a_decade = 100.0;
constexpr double moments_a_decade = 20.0;
constexpr double precision = 1e-8;

// Whether a number of evaluations is a moment of the .tdat.
bool is_moment(std::size_t evaluations, std::size_t dimension) {
  const auto count = static_cast<double>(evaluations);
  const double k = std::round(moments_a_decade * std::log10(count));
  for (const double near : {k - 1.0, k, k + 1.0}) {
    if (std::floor(std::pow(10.0, near / moments_a_decade)) == count) return true;
  }
  for (std::size_t unit = dimension; unit <= evaluations; unit *= 10) {
    if (evaluations == unit || evaluations == 2 * unit || evaluations == 5 * unit) return true;
  }
  return false;
}

// The largest target below a value: 10^(k/100).
double target_below(double value) {
  if (!(value > precision)) return -1.0;
  return std::pow(10.0, (std::ceil(std::log10(value) * targets_a_decade) - 1.0) / targets_a_decade);
}

}  // namespace

std::string Log::row(const std::vector<double>& x, double value) const {
  std::string text =
      fmt::format("{} 0 {:+.9e} {:+.9e} {:+.9e}", evaluations_, best_, value, best_ + function_->optimum());
  for (const double coordinate : x) text += fmt::format(" {:+.4e}", coordinate);
  return text + "\n";
}

void Log::begin(const Function& function) {
  function_ = &function;
  evaluations_ = 0;
  best_ = std::numeric_limits<double>::infinity();
  target_ = std::numeric_limits<double>::infinity();
  last_.clear();
  last_dat_.clear();
  last_tdat_.clear();
  std::string header = fmt::format(
      "% f evaluations | g evaluations | best noise-free fitness - Fopt ({:.12e}) + sum g_i+ | measured fitness | best "
      "measured fitness or single-digit g-values",
      function.optimum());
  for (std::size_t k = 1; k <= function.dimension(); ++k) header += fmt::format(" | x{}", k);
  Block& block = blocks_[function.number()][function.dimension()];
  block.dat += header + "\n";
  block.tdat += header + "\n";
}

void Log::evaluated(const std::vector<double>& x, double value) {
  ++evaluations_;
  const double above = value - function_->optimum();
  const bool better = above < best_;
  if (better) best_ = above;
  last_ = row(x, value);
  Block& block = blocks_[function_->number()][function_->dimension()];
  if (better && best_ <= target_) {
    block.dat += last_;
    last_dat_ = last_;
    target_ = target_below(best_);
  }
  if (is_moment(evaluations_, function_->dimension())) {
    block.tdat += last_;
    last_tdat_ = last_;
  }
}

void Log::end() {
  Block& block = blocks_[function_->number()][function_->dimension()];
  if (last_dat_ != last_) block.dat += last_;
  if (last_tdat_ != last_) block.tdat += last_;
  block.runs += fmt::format(", {}:{}|{:.1e}", function_->instance(), evaluations_, best_);
}

std::map<std::string, std::string> Log::files() const {
  std::map<std::string, std::string> result;
  for (const auto& [function, dimensions] : blocks_) {
    std::string info;
    for (const auto& [dimension, block] : dimensions) {
      const std::string stem = fmt::format("data_f{0}/bbobexp_f{0}_DIM{1}", function, dimension);
      result[stem + ".dat"] = block.dat;
      result[stem + ".tdat"] = block.tdat;
      info += fmt::format(
          "suite = 'bbob', funcId = {}, DIM = {}, Precision = {:.3e}, algId = '{}', logger = 'bbob', data_format = "
          "'bbob-new2'\n% {}\n{}.dat{}\n",
          function, dimension, precision, algorithm_, algorithm_, stem, block.runs);
    }
    result[fmt::format("bbobexp_f{}.info", function)] = info;
  }
  return result;
}

}  // namespace hysteron::bbob
