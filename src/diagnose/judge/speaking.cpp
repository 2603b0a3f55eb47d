#include "diagnose/judge/speaking.hpp"

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

// Standard errors.
constexpr double surely = 2.0;
constexpr double loud = 3.0;

}  // namespace

double z_for(const std::string& effect, const Signature& signature) {
  for (std::size_t k = 0; k < signature.speaks_for.size(); ++k) {
    if (signature.speaks_for[k] == effect) {
      return std::max(signature.sign[k] == 0 ? std::fabs(signature.z) : signature.z * signature.sign[k], 0.0);
    }
  }
  return 0.0;
}

std::optional<Speaking> speaking_for(const std::string& effect, const std::vector<Signature>& signatures) {
  std::optional<Speaking> best;
  for (const Signature& row : signatures) {
    const double z = z_for(effect, row);
    if (std::ranges::find(row.speaks_for, effect) != row.speaks_for.end() && (!best || z > best->z)) {
      best = Speaking{&row, z};
    }
  }
  return best;
}

std::optional<Speaking> speaking_for(const Candidate& candidate) {
  return speaking_for(candidate.id, candidate.signatures);
}

double loudness(const Signature& signature) {
  double result = 0.0;
  for (const int sign : signature.sign) {
    result = std::max(result, sign == 0 ? std::fabs(signature.z) : signature.z * sign);
  }
  return result;
}

bool beyond_placebos(const Speaking& speaking) {
  constexpr double quantile = 0.95;
  return speaking.signature->placebo_quantile >= quantile;
}

bool shows(const Speaking& speaking) { return speaking.z >= surely && beyond_placebos(speaking); }

bool speaks(const Speaking& speaking) { return shows(speaking) && speaking.z >= loud; }

bool leaves_the_contrast(const Candidate& candidate, const std::string& instead, bool law, const Evidence& evidence) {
  const std::optional<Speaking> speaking = speaking_for(candidate);
  const auto left = [&](const std::string& by, bool of_law) {
    const auto at = std::ranges::find_if(evidence.contrasts_left, [&](const ContrastLeft& row) {
      const bool same = speaking && (row.signature.empty() || row.signature == speaking->signature->id);
      return same && row.effect == candidate.id && row.instead == by && row.law == of_law;
    });
    return at == evidence.contrasts_left.end() ? std::optional<double>{} : at->z;
  };
  const std::optional<double> augmented = left({}, false);
  const std::optional<double> other = left(instead, law);
  return augmented && other && *augmented < surely && *other >= loud;
}

InItsPlace in_its_place(const Candidate& candidate, const Evidence& evidence) {
  InItsPlace result;
  for (const ContrastLeft& row : evidence.contrasts_left) {
    const bool has_it = row.law && std::ranges::any_of(evidence.other_laws, [&](const OtherLaw& law) {
                          return law.model == row.instead && std::ranges::find(law.has, candidate.id) != law.has.end();
                        });
    if (row.effect == candidate.id && !row.instead.empty() && !has_it) {
      ++result.tried;
      result.leave_the_contrast += leaves_the_contrast(candidate, row.instead, row.law, evidence) ? 1 : 0;
    }
  }
  return result;
}

}  // namespace hysteron
