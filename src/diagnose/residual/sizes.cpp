#include "diagnose/residual/sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/squared.hpp"

namespace hysteron {

std::vector<SizeOfPart> sizes_of_parts(std::span<const Recording> recordings,
                                       const std::vector<std::vector<double>>& without,
                                       const std::vector<std::vector<double>>& with) {
  std::vector<SizeOfPart> result;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const std::vector<double>& x = recordings[r].displacement;
    const std::vector<double>& v = recordings[r].velocity;
    const std::size_t from = x.size() - without[r].size();
    const auto [low, high] = std::ranges::minmax(x);
    const double middle = 0.5 * (low + high);
    std::array<double, 4> squares{};
    std::array<double, 4> products{};
    for (std::size_t n = 0; n < without[r].size(); ++n) {
      const std::size_t quarter = (x[from + n] > middle ? 1U : 0U) + (v[from + n] > 0.0 ? 2U : 0U);
      const double does = without[r][n] - with[r][n];
      squares[quarter] += squared(does);
      products[quarter] += does * without[r][n];
    }
    for (std::size_t quarter = 0; quarter < squares.size(); ++quarter) {
      if (squares[quarter] > 0.0 && std::isfinite(squares[quarter]) && std::isfinite(products[quarter])) {
        result.push_back({r, static_cast<int>(quarter), products[quarter] / squares[quarter],
                          squares[quarter] / static_cast<double>(without[r].size())});
      }
    }
  }
  return result;
}

}  // namespace hysteron
