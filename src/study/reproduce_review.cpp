// The review: its polynomials (13)-(14), (19)-(21), (25)-(26) and (27)-(28) of parameters in current or voltage, each
// identified again in the two steps it describes (all parameters free at every level; then a few that follow the
// level), its forms of the hysteresis for odd and even n, and the mass term of Guo and Hu.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "presets/support/bouc_wen_form.hpp"
#include "report/terminal.hpp"
#include "study/reproduce_recording.hpp"

namespace hysteron::reproduce {
namespace {

using nlohmann::json;

constexpr const char* step_one = "step 1";
constexpr const char* step_two = "step 2";

// A parameter that follows the level: printed coefficients in ascending powers, in SI units of the source's form.
struct Law {
  const char* parameter;  // of the model
  const char* printed;    // in the source's letters and SI unit
  std::vector<double> coefficients;
  double factor;  // from the source's to the model's value: Z for alpha
};
struct Set {
  const char* id;
  const char* title;
  const char* model;
  DriveKind kind;
  std::vector<double> levels;
  std::vector<Law> laws;
  std::map<std::string, double> others;  // of the model; chosen here where the source does not print them
  const char* note;
};

double at(const std::vector<double>& coefficients, double level) {
  double value = 0.0;
  for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) value = value * level + *c;
  return value;
}

// The hysteresis of sets that do not print theirs: n = 2, beta = gamma, yielding after 1 mm.
constexpr double chosen_n = 2.0;
constexpr double chosen_x_y = 1e-3;
// z at saturation, m: what alpha multiplies.
constexpr double small_z = 0.02;
constexpr double large_z = 0.002;

std::vector<Set> sets() {
  const std::map<std::string, double> hysteresis{{"x_y", chosen_x_y}, {"share", 0.5}, {"n", chosen_n}};
  std::map<std::string, double> bouc_wen = hysteresis;
  bouc_wen["k0"] = 200.0;
  bouc_wen["f0"] = 0.0;
  std::map<std::string, double> modified = hysteresis;
  modified["k0"] = 1e3;
  modified["k1"] = 500.0;
  modified["x0"] = 0.0;
  std::map<std::string, double> modified_voltage = modified;
  modified_voltage["c1"] = 2e4;
  return {
      {"13-14",
       "Equations 13 and 14: Bouc-Wen, alpha and c0 in the current",
       "bouc-wen",
       DriveKind::current,
       {0.0, 0.2, 0.4, 0.6, 0.8, 1.0},
       {{"alpha", "alpha [N/m]", {100.0, 1120.0, 9760.0, -9660.0}, small_z},
        {"c0", "c0 [N s/m]", {10.0, 50.0, 1350.0, -4740.0, 4480.0}, 1.0}},
       bouc_wen,
       "alpha is printed in N/mm, the unit of c0 is not; N s/mm goes with it."},
      {"19-21",
       "Equations 19 to 21: modified Bouc-Wen, alpha, c0 and c1 in the current",
       "modified-bouc-wen",
       DriveKind::current,
       {0.0, 0.15, 0.3, 0.45, 0.6, 0.75, 0.9},
       {{"alpha", "alpha [N/m]", {38240.0, 412520.0, 905140.0, -826670.0}, large_z},
        {"c0", "c0 [N s/m]", {590.0, 11020.0, 10510.0, -11730.0}, 1.0},
        {"c1", "c1 [N s/m]", {4730.0, 64570.0, 57030.0, -54400.0}, 1.0}},
       modified,
       "No units are printed; N/mm and N s/mm. Beyond 0.9 A alpha and c0 fall again: not used."},
      {"25-26",
       "Equations 25 and 26: Bingham, yield force and damping in the current",
       "bingham",
       DriveKind::current,
       {0.0, 0.2, 0.4, 0.6, 0.8},
       {{"fc", "fc [N]", {0.14, 24.95, 75.67, -85.19}, 1.0}, {"c0", "c0 [N s/m]", {4.0, 184.0, -133.0, -79.0}, 1.0}},
       {{"f0", 0.0}},
       "No units are printed; N and N s/mm. From 0.92 A on c0 is negative: not used."},
      {"27-28",
       "Equations 27 and 28: modified Bouc-Wen, alpha and c0 in the voltage",
       "modified-bouc-wen",
       DriveKind::voltage,
       {0.0, 0.5, 1.0, 1.5, 2.0},
       {{"alpha", "alpha [N/m]", {5000.0, -3.4209, 2.3363}, small_z},
        {"c0", "c0 [N s/m]", {2700.0, -2.0484, 0.1794}, 1.0}},
       modified_voltage,
       "No units are printed; N/m and N s/m. As printed neither depends on the voltage by more than 0.15 %, which is "
       "below "
       "the noise: factors are probably lost in print."},
  };
}

// Values of all parameters of a model at a level, in the order of its card.
std::vector<double> values(const CompositeModel& model, const Set& set, double level) {
  std::vector<double> result;
  const auto names = model.parameter_names();
  const auto cards = model.parameters();
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto own = set.others.find(names[k]);
    double value = own != set.others.end() ? own->second : cards[k].initial;
    for (const Law& law : set.laws) {
      if (names[k] == law.parameter) value = at(law.coefficients, level) * law.factor;
    }
    result.push_back(value);
  }
  return result;
}

std::string each_label(const Set& set) { return std::string(set.id) + " each"; }
std::string all_label(const Set& set) { return std::string(set.id) + " all"; }
std::string file_of(const Set& set, double level) {
  return fmt::format("{:.2f}{}.csv", level, set.kind == DriveKind::voltage ? "V" : "A");
}
std::string term(const char* parameter, std::size_t power) {
  return power == 0 ? parameter : power == 1 ? std::string(parameter) + "*i" : fmt::format("{}*i^{}", parameter, power);
}

// ---- odd and even n

struct Form {
  const char* name;
  const char* equation;
  double (*rate)(double z, double v, double alpha, double beta, double A, int n);
};
double whole_power(double z, int n) { return std::pow(z, n); }
constexpr Form forms[] = {
    {"(5), (7), (12), (17), (24)", "-alpha |v| z |z|^(n-1) - beta v |z|^n + A v",
     [](double z, double v, double alpha, double beta, double A, int n) {
       return A * v - alpha * std::fabs(v) * z * std::pow(std::fabs(z), n - 1) - beta * v * std::pow(std::fabs(z), n);
     }},
    {"(2), odd n", "-alpha |v| z^n - beta v |z|^n + A v",
     [](double z, double v, double alpha, double beta, double A, int n) {
       return A * v - alpha * std::fabs(v) * whole_power(z, n) - beta * v * std::pow(std::fabs(z), n);
     }},
    {"(15), odd n", "-alpha |v| z^n - beta v z^n + A v",
     [](double z, double v, double alpha, double beta, double A, int n) {
       return A * v - alpha * std::fabs(v) * whole_power(z, n) - beta * v * whole_power(z, n);
     }},
    {"(3), (16), even n", "-alpha |v| z^(n-1) - beta v z^n + A v",
     [](double z, double v, double alpha, double beta, double A, int n) {
       return A * v - alpha * std::fabs(v) * whole_power(z, n - 1) - beta * v * whole_power(z, n);
     }},
    {"(3), (16) with |z| restored", "-alpha |v| z^(n-1) |z| - beta v z^n + A v",
     [](double z, double v, double alpha, double beta, double A, int n) {
       return A * v - alpha * std::fabs(v) * whole_power(z, n - 1) * std::fabs(z) - beta * v * whole_power(z, n);
     }},
};

// z over three periods of x = 5 sin(2 pi t) with A = 1, alpha = beta = 1/2, so that z saturates at 1; classical
// Runge-Kutta, 2000 steps a period.
std::vector<double> integrated(const Form& form, int n) {
  constexpr int steps = 2000;
  constexpr double h = 1.0 / steps;
  const auto rate = [&](double t, double z) {
    return form.rate(z, 5.0 * 2.0 * std::numbers::pi * std::cos(2.0 * std::numbers::pi * t), 0.5, 0.5, 1.0, n);
  };
  std::vector<double> result;
  double z = 0.0;
  for (int k = 0; k < 3 * steps; ++k) {
    const double t = k * h;
    const double a = rate(t, z);
    const double b = rate(t + 0.5 * h, z + 0.5 * h * a);
    const double c = rate(t + 0.5 * h, z + 0.5 * h * b);
    const double d = rate(t + h, z + h * c);
    z += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    result.push_back(z);
  }
  return result;
}

StudyTable form_table() {
  StudyTable table{
      "review-forms",
      "The hysteresis for odd and even n, as printed",
      "Largest difference of z from the form with absolute values, over its largest z, at A = 1, alpha = beta = "
      "1/2 and a stroke of five yield displacements. \"-\": not meant for this n.",
      {"equation", "z' =", "n = 1", "n = 2", "n = 3", "n = 4"},
      {}};
  for (const Form& form : forms) {
    std::vector<std::string> row{form.name, form.equation};
    const std::string_view name(form.name);
    for (int n = 1; n <= 4; ++n) {
      const bool odd = n % 2 == 1;
      if ((name.find("odd") != name.npos && !odd) || (name.find("(3)") != name.npos && odd)) {
        row.emplace_back("-");
        continue;
      }
      const std::vector<double> own = integrated(form, n);
      const std::vector<double> truth = integrated(forms[0], n);
      double largest = 0.0;
      double off = 0.0;
      for (std::size_t k = 0; k < own.size(); ++k) {
        largest = std::max(largest, std::fabs(truth[k]));
        const double distance = std::fabs(own[k] - truth[k]);
        off = std::isfinite(distance) ? std::max(off, distance) : 1e300;
      }
      row.push_back(off > 1e3 * largest ? "runs away" : off < 1e-12 * largest ? "0" : format_number(off / largest, 2));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

// ---- Guo and Hu

constexpr double guo_hu_mass = 10.0;  // kg, chosen
constexpr const char* without_mass = "guo-hu";
constexpr const char* with_mass = "guo-hu+inertia";

Recording guo_hu_recording() {
  const CompositeModel model = make_model("guo-hu", {"inertia"});
  std::vector<double> parameters;
  for (const Parameter& card : model.parameters()) parameters.push_back(card.initial);
  parameters.back() = guo_hu_mass;
  return sine_recording(model, parameters, "4Hz.csv", {0.010, 4.0, 0.0, DriveKind::none}, noise_share);
}

}  // namespace

Study review_polynomials(const ReproduceOptions& options) {
  Study study = round_trip(options, "review-polynomials");
  study.objective.tolerance = 1e-5;
  for (const Set& set : sets()) {
    const CompositeModel model = make_model(set.model, {});
    DataSpec each;
    each.label = each_label(set);
    each.each = true;
    for (const double level : set.levels) {
      each.made.push_back(sine_recording(model, values(model, set, level), file_of(set, level),
                                         {0.010, 1.0, level, set.kind}, noise_share));
    }
    DataSpec all = each;
    all.label = all_label(set);
    all.each = false;
    study.data.push_back(std::move(each));
    study.data.push_back(std::move(all));
    ModelSpec one = model_on(std::string(step_one) + " " + set.id, set.model, {each_label(set)});
    ModelSpec two = model_on(std::string(step_two) + " " + set.id, set.model, {all_label(set)});
    // The card, scaled to the largest force of all levels, ends above the smallest c1 printed.
    if (two.model == "modified-bouc-wen") two.layout.bounds["c1"] = {500.0, 1e6};
    for (const Law& law : set.laws)
      two.layout.by_current[law.parameter] = static_cast<int>(law.coefficients.size()) - 1;
    study.models.push_back(one);
    study.models.push_back(two);
  }
  DataSpec guo_hu;
  guo_hu.label = "guo-hu";
  guo_hu.made.push_back(guo_hu_recording());
  study.data.push_back(guo_hu);
  study.models.push_back(model_on(without_mass, without_mass, {"guo-hu"}));
  study.models.push_back(model_on(with_mass, with_mass, {"guo-hu"}));
  return study;
}

Reproduction review_polynomials_result(const Plan& plan, const std::vector<RunRecord>& records) {
  Reproduction result;
  for (const Set& set : sets()) {
    std::vector<std::map<std::string, double>> free;
    std::vector<double> levels;
    std::vector<double> free_nrmse;
    for (const double level : set.levels) {
      const std::string file = file_of(set, level);
      const std::size_t problem = problem_index(
          plan, fmt::format("{} {} @ {}/{}", step_one, set.id, each_label(set), file.substr(0, file.rfind('.'))));
      const RunRecord* run = problem < plan.problems.size() ? best_run(plan, records, problem) : nullptr;
      if (run == nullptr) continue;
      free.push_back(json::parse(run->parameters).get<std::map<std::string, double>>());
      levels.push_back(level);
      free_nrmse.push_back(*run->nrmse);
    }
    const std::size_t problem = problem_index(plan, fmt::format("{} {} @ {}", step_two, set.id, all_label(set)));
    const RunRecord* joint = problem < plan.problems.size() ? best_run(plan, records, problem) : nullptr;
    if (joint == nullptr || free.size() != set.levels.size()) continue;
    const json p = json::parse(joint->parameters);

    StudyTable table{std::string("review-") + set.id, set.title, set.note, {"parameter"}, {}};
    for (const double level : levels)
      table.header.push_back(fmt::format("{:g} {}", level, set.kind == DriveKind::voltage ? "V" : "A"));
    double worst = 0.0;
    std::string worst_name;
    for (const Law& law : set.laws) {
      std::vector<std::string> printed{std::string(law.printed) + ", printed"};
      std::vector<std::string> one{"step 1"};
      std::vector<std::string> two{"step 2"};
      std::vector<double> coefficients;
      for (std::size_t k = 0; k < law.coefficients.size(); ++k) {
        coefficients.push_back(p.at(term(law.parameter, k)).get<double>() / law.factor);
      }
      double largest = 0.0;
      double off = 0.0;
      for (std::size_t k = 0; k < levels.size(); ++k) {
        const double truth = at(law.coefficients, levels[k]);
        printed.push_back(format_number(truth, 4));
        one.push_back(format_number(free[k].at(law.parameter) / law.factor, 4));
        two.push_back(format_number(at(coefficients, levels[k]), 4));
        largest = std::max(largest, std::fabs(truth));
        off = std::max(off, std::fabs(at(coefficients, levels[k]) - truth));
      }
      if (off / largest > worst) {
        worst = off / largest;
        worst_name = law.printed;
      }
      table.rows.push_back(std::move(printed));
      table.rows.push_back(std::move(one));
      table.rows.push_back(std::move(two));
    }
    std::vector<std::string> errors{"NRMSE, step 1"};
    for (const double value : free_nrmse) errors.push_back(format_number(value, 3));
    table.rows.push_back(std::move(errors));
    std::vector<std::string> all{"NRMSE, step 2, all"};
    all.resize(levels.size() + 1);
    all[1] = format_number(*joint->nrmse, 3);
    table.rows.push_back(std::move(all));
    result.tables.push_back(std::move(table));

    StudyTable printed{std::string("review-") + set.id + "-coefficients",
                       std::string("Coefficients of ") + set.id,
                       "In powers of the level; through the values of step 1, and of step 2.",
                       {"coefficient", "printed", "through step 1", "step 2"},
                       {}};
    for (const Law& law : set.laws) {
      std::vector<double> own;
      for (const auto& one : free) own.push_back(one.at(law.parameter) / law.factor);
      const auto through = polynomial_through(levels, own, static_cast<int>(law.coefficients.size()) - 1);
      for (std::size_t k = 0; k < law.coefficients.size(); ++k) {
        printed.rows.push_back({fmt::format("{}, level^{}", law.printed, k), format_number(law.coefficients[k], 4),
                                format_number(through[k], 4),
                                format_number(p.at(term(law.parameter, k)).get<double>() / law.factor, 4)});
      }
    }
    result.tables.push_back(std::move(printed));
    result.findings.push_back(fmt::format(
        "Equations {}: step 2 gives the printed curves within {} % of their largest value ({}); NRMSE {} with a "
        "set for all levels, {} to {} with a set each (noise 0.010).",
        set.id, format_number(100.0 * worst, 2), worst_name, format_number(*joint->nrmse, 3),
        format_number(std::ranges::min(free_nrmse), 3), format_number(std::ranges::max(free_nrmse), 3)));
  }
  result.tables.push_back(form_table());
  result.findings.push_back(
      "Odd and even n: the program marches the form with absolute values, (5), at any n from 1 on. (2) is that form at "
      "odd "
      "n. (15) and (3), (16) as printed are other equations: the first lost the bars of beta v |z^n|, the second a "
      "factor "
      "|z|, without which even its dimensions differ.");
  StudyTable guo_hu{
      "review-guo-hu",
      "Guo and Hu with and without the mass term",
      fmt::format("Simulated with m = {:g} kg at 4 Hz, 10 mm, 1 % noise. The program's `guo-hu` has no mass "
                  "term; `guo-hu+inertia` is the full form, F = f0 + c0 v + (2 / pi) f_y atan(...) + m a.",
                  guo_hu_mass),
      {"model", "NRMSE", "m [kg]"},
      {}};
  for (const char* label : {without_mass, with_mass}) {
    const std::size_t problem = problem_index(plan, std::string(label) + " @ guo-hu");
    const RunRecord* run = problem < plan.problems.size() ? best_run(plan, records, problem) : nullptr;
    if (run == nullptr) continue;
    const json p = json::parse(run->parameters);
    guo_hu.rows.push_back({label, format_number(*run->nrmse, 3),
                           p.contains("inertia.m") ? format_number(p.at("inertia.m").get<double>(), 4) : "-"});
  }
  if (!guo_hu.rows.empty()) result.tables.push_back(std::move(guo_hu));
  result.remade.push_back(
      "All polynomials the review prints, with its two steps: all parameters free at every level, then those alone "
      "that "
      "have a polynomial follow it, with the printed order.");
  result.not_remade.push_back(
      "The review has no recordings and prints only the polynomials: simulated recordings (10 mm at 1 Hz, 1 % noise) "
      "stand "
      "in, and what it does not print is chosen: n = 2, beta = gamma, a yield displacement of 1 mm, z of 20 mm at "
      "saturation (2 mm for 19 to 21), k0 = 200 N/m (1000 N/m with k1 = 500 N/m in the modified model), c1 = 2e4 N s/m "
      "in 27 "
      "to 28.");
  result.not_remade.push_back(
      "alpha is compared at the chosen z: only alpha times z can be identified. Its optimum by the Simulink toolbox, "
      "over 36 "
      "configurations, is of another damper and not printed.");
  return result;
}

}  // namespace hysteron::reproduce
