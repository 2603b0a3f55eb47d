// A Bouc-Wen damper with something concealed, and its diagnosis.
#pragma once

#include "diagnose/diagnose.hpp"
#include "fit/synthetic.hpp"

namespace hysteron::testing {

inline constexpr std::uint64_t seed = 5;

// Six sines of one damper, two amplitudes at three frequencies.
inline Campaign campaign_of(const std::string& model, const std::vector<std::string>& effects,
                            const std::map<std::string, double>& values, double noise) {
  LayoutOptions made;
  made.fix = values;
  const Layout layout(make_model(model, effects), DataScale{}, made);
  Campaign campaign;
  int index = 0;
  for (const double frequency : {0.5, 1.3, 3.0}) {
    for (const double amplitude : {0.004, 0.012}) {
      Recording recording =
          motion("r" + std::to_string(index) + ".csv", {{amplitude, frequency}}, 3.0 / frequency, 400, 0.2 / frequency);
      set_force(recording, layout, layout.terms(layout.initial()), {}, noise,
                Stream(seed).child(static_cast<std::uint64_t>(index)));
      campaign.recordings.push_back(recording);
      campaign.roles.push_back(Role::unassigned);
      ++index;
    }
  }
  return campaign;
}

// Of a Bouc-Wen damper.
inline Campaign campaign_with(const std::vector<std::string>& effects, const std::map<std::string, double>& values,
                              double noise) {
  std::map<std::string, double> made = {{"alpha", 600.0}, {"c0", 1500.0}, {"k0", 2000.0}, {"f0", 20.0},
                                        {"x_y", 8e-4},    {"share", 0.6}, {"n", 1.5}};
  made.insert(values.begin(), values.end());
  return campaign_of("bouc-wen", effects, made, noise);
}

inline std::unique_ptr<Diagnosis> diagnosis_of(const Campaign& campaign, const std::vector<std::string>& candidates) {
  DiagnoseOptions options;
  options.model = "bouc-wen";
  options.seed = seed;
  options.objective.threads = 2;
  options.candidates = candidates;
  return diagnose(campaign, options, [](double, const std::string&) {});
}

// Relatives and strangers of what is concealed, few enough to be quick.
inline const std::vector<std::string> few = {"quadratic-damping", "shear-thinning", "inertia",      "sensor-delay",
                                             "gas-spring",        "force-drift",    "seal-friction"};

}  // namespace hysteron::testing
