// A law of the catalogue with effects, as it is exported, and the shell that builds and runs what comes out.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

#include "app/program.hpp"
#include "core/random.hpp"
#include "export/c_source.hpp"
#include "export/exported.hpp"
#include "export/names.hpp"

namespace hysteron::testing {

// A law with effects behind it.
struct Case {
  std::string law;
  std::vector<std::string> effects;

  [[nodiscard]] std::string name() const {
    std::string text = law;
    for (const std::string& effect : effects) {
      text += "+" + effect;
    }
    return text;
  }
  [[nodiscard]] std::string test_name() const {
    std::string text = name();
    std::ranges::replace_if(
        text, [](char letter) { return letter == '-' || letter == '+'; }, '_');
    return text;
  }
};
inline std::ostream& operator<<(std::ostream& out, const Case& value) { return out << value.name(); }

// Every law alone, every effect behind one law, and long chains.
inline std::vector<Case> every_entry() {
  std::vector<Case> result;
  for (const Part* law : model_catalogue()) {
    result.push_back({std::string(law->id), {}});
  }
  for (const Part* effect : effect_catalogue()) {
    result.push_back({"bouc-wen", {std::string(effect->id)}});
  }
  result.push_back({"modified-bouc-wen", {"clearance", "compliance", "self-heating", "coil-lag", "sensor-delay"}});
  result.push_back({"lugre", {"series-dashpot", "inertia", "magnetic-remanence", "degradation"}});
  result.push_back({"baber-noori", {"stiction", "pre-yield-hysteresis", "velocity-lag", "asymmetry"}});
  return result;
}

// Parameters off their neutral values; the first of the law follows the drive. A delay of the force is not negative.
inline ExportedModel model_of(const Case& of, std::uint64_t seed = 5) {
  ExportedModel result;
  result.model = make_model(of.law, of.effects);
  result.name = identifier(of.law);
  const std::vector<Parameter> cards = result.model.parameters();
  const Stream stream(seed);
  for (std::size_t k = 0; k < cards.size(); ++k) {
    const Parameter& card = cards[k];
    const double u = 0.15 + 0.7 * stream.uniform(seed, static_cast<std::uint32_t>(k));
    double value = card.scale == Scale::logarithmic ? card.box.lower * std::pow(card.box.upper / card.box.lower, u)
                                                    : card.box.lower + u * (card.box.upper - card.box.lower);
    if (card.fixed) {
      value = card.initial;
    } else if (card.name == "lag") {
      value = 0.5 * std::fabs(value);
    }
    result.held.push_back(value);
    result.terms.push_back({k, 0, 0, value});
    if (k == 0) {
      result.terms.push_back({k, 1, 0, 0.5 * value});
    }
  }
  return result;
}

inline Recording first_samples(Recording recording, std::size_t count) {
  for (std::vector<double>* channel : channels_of(recording)) {
    channel->resize(std::min(channel->size(), count));
  }
  return recording;
}

inline void write(const ExportedFiles& files, const std::filesystem::path& folder) {
  for (const auto& [name, text] : files) {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary) << text;
  }
}

// A shell command in a folder.
inline Outcome shell(const std::string& command, const std::filesystem::path& folder) {
  return finish(start_other("/bin/sh", {"-c", command}, folder), folder);
}

inline constexpr const char* strict = "cc -std=c99 -pedantic -Wall -Wextra -Werror -O1 ";

inline double peak(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) {
    result = std::max(result, std::fabs(value));
  }
  return result;
}

}  // namespace hysteron::testing
