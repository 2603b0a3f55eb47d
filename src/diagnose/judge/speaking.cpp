#include "diagnose/judge/speaking.hpp"

#include <algorithm>
#include <cmath>

namespace hysteron {

std::optional<Speaking> speaking_for(const std::string& effect, const Evidence& evidence) {
  std::optional<Speaking> best;
  for (const Signature& row : evidence.signatures) {
    for (std::size_t k = 0; k < row.speaks_for.size(); ++k) {
      if (row.speaks_for[k] == effect) {
        const double z = row.sign[k] == 0 ? std::fabs(row.z) : row.z * row.sign[k];
        if (!best || z > best->z) {
          best = Speaking{&row, z};
        }
      }
    }
  }
  if (best) {
    best->z = std::max(best->z, 0.0);
  }
  return best;
}

double loudness(const Signature& signature) {
  double result = 0.0;
  for (const int sign : signature.sign) {
    result = std::max(result, sign == 0 ? std::fabs(signature.z) : signature.z * sign);
  }
  return result;
}

bool shows(const Speaking& speaking) {
  constexpr double surely = 2.0;
  constexpr double beyond_placebos = 0.95;
  return speaking.z >= surely && speaking.signature->placebo_quantile >= beyond_placebos;
}

bool speaks(const Speaking& speaking) {
  constexpr double loud = 3.0;
  return shows(speaking) && speaking.z >= loud;
}

}  // namespace hysteron
