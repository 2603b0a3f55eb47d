// Identifies a dashpot of 1500 N s/m from its own force.
#include <cmath>
#include <cstdio>

#include "fit/identify.hpp"

int main() {
  hysteron::Recording sine;
  for (int n = 0; n < 400; ++n) {
    const double time = 0.005 * n;
    sine.time.push_back(time);
    sine.displacement.push_back(0.01 * std::sin(6.0 * time));
    sine.velocity.push_back(0.06 * std::cos(6.0 * time));
    sine.force.push_back(1500.0 * sine.velocity.back());
  }
  const hysteron::Campaign campaign{{sine}, {hysteron::Role::fit}, {}, {}, {}};
  const hysteron::Identification result =
      hysteron::identify(campaign, "viscous", {}, [](const auto&, const auto&) { return true; });
  const hysteron::Estimate& c0 = result.estimates.front();
  std::printf("%s = %.1f %s\n", c0.name.c_str(), c0.term.value, c0.unit.c_str());
}
