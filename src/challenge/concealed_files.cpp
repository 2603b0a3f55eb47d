#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "challenge/concealed.hpp"
#include "challenge/place.hpp"
#include "io/output.hpp"
#include "io/units.hpp"

namespace hysteron::challenge {
namespace {

std::string file_name(std::size_t recording) { return fmt::format("r{:02d}.csv", recording + 1); }

double square_mean(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum / static_cast<double>(a.size());
}

std::string_view design_name(Design design) {
  switch (design) {
    case Design::sines:
      return "sines";
    case Design::broadband:
      return "broadband";
    case Design::mixed:
      return "mixed";
  }
  return "";
}

// On a day in March: "# start: 2026-03-02T08:41:07".
std::string start_line(double seconds) {
  const auto all = std::lround(seconds) + 8 * 3600;
  return fmt::format("# start: 2026-03-{:02d}T{:02d}:{:02d}:{:02d}\n", 2 + all / 86400, all / 3600 % 24, all / 60 % 60,
                     all % 60);
}

}  // namespace

void write_recordings(const Concealed& concealed, const std::string& folder, std::uint64_t seed) {
  Draws draws(Stream(seed).child("units").child(static_cast<std::uint64_t>(concealed.task.number)));
  constexpr std::array<std::string_view, 2> times = {"s", "ms"};
  constexpr std::array<std::string_view, 3> lengths = {"mm", "m", "cm"};
  constexpr std::array<std::string_view, 2> forces = {"N", "kN"};
  constexpr std::array<std::string_view, 2> speeds = {"mm/s", "m/s"};
  struct Written {
    std::string name;
    UnitConversion unit;
    std::vector<double> Measured::*channel;
    int digits;
  };
  std::vector<Written> columns;
  const auto add = [&](std::string_view name, Quantity quantity, std::string_view unit,
                       std::vector<double> Measured::*channel, int digits) {
    columns.push_back({fmt::format("{} [{}]", name, unit), parse_unit(quantity, unit), channel, digits});
  };
  add("time", Quantity::time, draws.pick(times), &Measured::time, 9);
  add("displacement", Quantity::displacement, draws.pick(lengths), &Measured::x, 7);
  if (concealed.velocity_given) {
    add("velocity", Quantity::velocity, draws.pick(speeds), &Measured::v, 6);
  }
  add("force", Quantity::force, draws.pick(forces), &Measured::force, 7);
  if (concealed.drive_is_voltage) {
    add("voltage", Quantity::voltage, "V", &Measured::drive, 5);
  } else {
    add("current", Quantity::current, draws.chance(0.3) ? "mA" : "A", &Measured::drive, 5);
  }
  const char separator = draws.chance(0.2) ? ';' : ',';
  const std::filesystem::path path(folder);
  std::filesystem::create_directories(path);
  for (std::size_t r = 0; r < concealed.recordings.size(); ++r) {
    const Measured& recording = concealed.recordings[r];
    const std::optional<double>& started = concealed.excitation.tests[r].started;
    std::string text = started ? start_line(*started) : "";
    for (std::size_t c = 0; c < columns.size(); ++c) text += (c > 0 ? std::string(1, separator) : "") + columns[c].name;
    text += '\n';
    for (std::size_t k = 0; k < recording.time.size(); ++k) {
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const Written& column = columns[c];
        if (c > 0) text += separator;
        fmt::format_to(std::back_inserter(text), "{:.{}g}", column.unit.from_si((recording.*column.channel)[k]),
                       column.digits);
      }
      text += '\n';
    }
    write_file_atomically(path / file_name(r), text);
  }
  std::string toml = fmt::format("schema = \"hysteron.campaign/1\"\nmodel = \"{}\"\n", concealed.told_model);
  if (!concealed.told_by_current.empty()) {
    toml += "[by_current]\n";
    for (const std::string& parameter : concealed.told_by_current) toml += fmt::format("{} = 1\n", parameter);
  }
  if (concealed.roles_given) {
    for (std::size_t r = 0; r < concealed.recordings.size(); ++r) {
      toml += fmt::format("[[recording]]\nfile = \"{}\"\nrole = \"{}\"\n", file_name(r),
                          concealed.excitation.tests[r].held_out ? "validate" : "fit");
    }
  }
  write_file_atomically(path / "campaign.toml", toml);
}

nlohmann::json answer_of(const Concealed& concealed) {
  nlohmann::json answer = {{"campaign", concealed.name},
                           {"level", name_of(concealed.task.level)},
                           {"design", design_name(concealed.design)},
                           {"true_law", model_of(concealed.physics.law)},
                           {"told_model", concealed.told_model},
                           {"acceptable", concealed.acceptable},
                           {"disturbance", concealed.disturbance},
                           {"roles_given", concealed.roles_given},
                           {"velocity_given", concealed.velocity_given},
                           {"effects", nlohmann::json::array()},
                           {"forms", nlohmann::json::array()},
                           {"recordings", nlohmann::json::array()}};
  double foreign_power = 0.0;
  for (const HiddenTruth& truth : concealed.truths) {
    nlohmann::json parameters = nlohmann::json::array();
    for (const TrueParameter& parameter : truth.parameters) {
      parameters.push_back({{"name", parameter.name}, {"value", parameter.value}, {"unit", parameter.unit}});
    }
    const HiddenEffect& effect = hidden_effect(truth.id);
    answer["effects"].push_back({{"id", truth.id},
                                 {"form", truth.form},
                                 {"foreign", effect.foreign},
                                 {"excited", truth.excited},
                                 {"share_of_peak", truth.share},
                                 {"strength", truth.strength},
                                 {"parameters", parameters},
                                 {"change_nrmse", truth.change_nrmse},
                                 {"left_nrmse", truth.left_nrmse},
                                 {"left_nrmse_single", truth.left_nrmse_single},
                                 {"detectability", truth.detectability},
                                 {"power_over_strongest", truth.power_over_strongest}});
    answer["forms"].push_back(truth.form);
    if (effect.foreign) foreign_power += truth.power_over_strongest;
  }
  // Foreign causes beside effects of the catalogue: their power over that of the strongest effect.
  if (concealed.task.level == Level::beside) answer["foreign_power_over_strongest"] = foreign_power;
  // What the told law lacks of the true one sits somewhere too.
  if (!concealed.left.empty() && concealed.told_model == model_of(concealed.physics.law)) {
    answer["places"] = places_of(concealed.recordings, concealed.left, concealed.peaks);
  }
  answer["noise"] = {
      {"share_of_peak", concealed.chain.noise},     {"coloured_share", concealed.chain.coloured_share},
      {"correlation", concealed.chain.correlation}, {"outlier_rate", concealed.chain.outlier_rate},
      {"force_bits", concealed.chain.force_bits},   {"displacement_noise", concealed.chain.displacement_noise}};
  answer["peak_force_n"] = concealed.range.force;
  double all = 0.0;
  double held = 0.0;
  int held_count = 0;
  for (std::size_t r = 0; r < concealed.recordings.size(); ++r) {
    const Measured& recording = concealed.recordings[r];
    double peak = 0.0;
    for (const double value : recording.force) peak = std::max(peak, std::abs(value));
    const double floor = square_mean(recording.force, recording.clean) / (peak * peak);
    const Run& test = concealed.excitation.tests[r];
    answer["recordings"].push_back({{"file", file_name(r)},
                                    {"kind", test.kind},
                                    {"samples", recording.time.size()},
                                    {"held_out", concealed.roles_given && test.held_out},
                                    {"floor_nrmse", std::sqrt(floor)}});
    all += floor;
    if (test.held_out) {
      held += floor;
      ++held_count;
    }
  }
  answer["floor_nrmse"] = std::sqrt(all / static_cast<double>(concealed.recordings.size()));
  answer["floor_nrmse_heldout"] =
      concealed.roles_given && held_count > 0 ? std::sqrt(held / held_count) : answer["floor_nrmse"].get<double>();
  return answer;
}

}  // namespace hysteron::challenge
