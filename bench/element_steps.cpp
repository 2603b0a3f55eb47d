// What the steps that need not follow series elements (simulate/implicit.hpp) cost and lose:
//
//   hysteron_element_steps [--draws 16] [--page results/element-steps.md]
//
// Laws behind series elements, parameters drawn from their boxes, under a sine with a second tone. The march that
// follows everything at the usual tolerance is the reference of the error, the root mean square of the difference over
// the largest force. Beside it, in one run, the march that hypotheses are compared with, and the same coarse settings
// where steps follow the elements, whose relaxation is slowed to a fifth of the sampling interval.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include "bench/drawn.hpp"
#include "bench/page.hpp"
#include "bench/program.hpp"
#include "core/extent.hpp"
#include "simulate/composite.hpp"
#include "simulate/motion.hpp"

namespace {

using namespace hysteron;

constexpr const char* elements[] = {"compliance", "clearance", "entrapped-gas", "series-dashpot"};
constexpr const char* laws[] = {"viscous", "bouc-wen", "modified-bouc-wen", "modified-dahl"};
constexpr double frequency = 2.0;    // Hz
constexpr double least_time = 0.02;  // s of one timing, so that the clock's steps do not count

Motion motion_at(double rate) {
  std::vector<double> time;
  std::vector<double> x;
  std::vector<double> v;
  constexpr double w = 2.0 * std::numbers::pi * frequency;
  for (std::size_t n = 0; n < static_cast<std::size_t>(rate); ++n) {
    const double t = static_cast<double>(n) / rate;
    time.push_back(t);
    x.push_back(0.02 * std::sin(w * t) + 0.003 * std::sin(3.3 * w * t));
    v.push_back(0.02 * w * std::cos(w * t) + 0.0099 * w * std::cos(3.3 * w * t));
  }
  return make_motion(time, x, v, {});
}

// Coarse steps that follow the elements.
Motion following(const Motion& motion, double rate) {
  Motion result = comparing_motion(motion);
  result.implicit_elements = false;
  result.element_rate_limit = 5.0 * rate;
  return result;
}

double error_of(const std::vector<double>& force, const std::vector<double>& reference) {
  double sum = 0.0;
  for (std::size_t n = 0; n < force.size(); ++n) {
    sum += (force[n] - reference[n]) * (force[n] - reference[n]);
  }
  const double error = std::sqrt(sum / static_cast<double>(force.size())) / peak_of(reference);
  return std::isfinite(error) ? error : 1.0;  // a march that ran away is off by all
}

// Processor time of a march of eight candidates at once, s.
template <class T>
double time_of(const CompositeModel& model, const Motion& motion, const std::vector<T>& p) {
  std::vector<T> force(motion.time.size());
  const std::clock_t begun = std::clock();
  double elapsed = 0.0;
  int times = 0;
  while (elapsed < least_time) {
    std::vector<T> state(16);
    model.march<T>(motion, p.data(), 0, 0, force.size(), state.data(), force.data());
    ++times;
    elapsed = static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
  }
  return elapsed / times;
}

// Of one march over all laws and draws of an element at a rate.
struct Tried {
  std::vector<double> errors;
  double values = 0.0;       // s
  double derivatives = 0.0;  // s

  void look(const CompositeModel& model, const Motion& motion, const std::vector<std::vector<double>>& rows,
            const std::vector<std::vector<double>>& exact) {
    for (std::size_t k = 0; k < rows.size(); ++k) {
      errors.push_back(error_of(simulate(model, motion, rows[k]), exact[k]));
    }
    for (std::size_t first = 0; first + lane_count <= rows.size(); first += lane_count) {
      std::vector<Lanes> p(model.parameter_count());
      for (int lane = 0; lane < lane_count; ++lane) {
        for (std::size_t j = 0; j < p.size(); ++j) {
          p[j].set_lane(lane, rows[first + static_cast<std::size_t>(lane)][j]);
        }
      }
      values += time_of(model, motion, p);
      std::vector<LaneDual> dual(p.begin(), p.end());
      for (std::size_t j = 0; j < std::min<std::size_t>(p.size(), sweep_directions); ++j) {
        dual[j].d[j] = Lanes(1.0);
      }
      derivatives += time_of(model, motion, dual);
    }
  }
  [[nodiscard]] double quantile(double share) const {
    std::vector<double> sorted = errors;
    std::ranges::sort(sorted);
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }
};

std::string row_of(const std::string& element, double rate, std::size_t draws) {
  const Motion motion = motion_at(rate);
  Tried free;
  Tried follows;
  for (const char* law : laws) {
    const CompositeModel model = make_model(law, {element});
    std::vector<std::vector<double>> rows;
    std::vector<std::vector<double>> exact;
    for (std::size_t k = 0; k < draws; ++k) {
      rows.push_back(bench::drawn(model, Stream(7100 + k)));
      exact.push_back(simulate(model, motion, rows.back()));
    }
    free.look(model, comparing_motion(motion), rows, exact);
    follows.look(model, following(motion, rate), rows, exact);
  }
  const auto errors = [](const Tried& of) {
    return fmt::format("{:.2g} / {:.2g} / {:.2g}", 100.0 * of.quantile(0.5), 100.0 * of.quantile(0.9),
                       100.0 * of.quantile(1.0));
  };
  return fmt::format("| {} | {:.0f} | {} | {} | {:.1f} | {:.1f} |\n", element, rate, errors(free), errors(follows),
                     follows.values / free.values, follows.derivatives / free.derivatives);
}

int run(int argc, char** argv) {
  CLI::App program{"What steps that need not follow series elements cost and lose"};
  std::size_t draws = 16;
  std::string page;
  program.add_option("--draws", draws, "parameter sets of each law, a multiple of eight")->check(CLI::Range(8, 800));
  program.add_option("--page", page, "file to write in place of standard output");
  CLI11_PARSE(program, argc, argv);
  std::string text = fmt::format(
      "# Steps that need not follow series elements\n\nMade by\n\n    build/release/bench/hysteron_element_steps "
      "--draws {} --page results/element-steps.md\n\n"
      "Viscous, Bouc-Wen, modified Bouc-Wen and modified Dahl behind each element, {} parameter sets of each drawn "
      "from "
      "the whole box, 2 Hz\nwith a second tone. Errors against the march that follows everything, root mean square "
      "over "
      "the largest force in per cent:\nmedian / ninth decile / worst. A march that ran away counts as 100 %. Ratios of "
      "processor time, one core, in one run.\n\n"
      "| element | samples/s | free steps | steps that follow, as coarse | times as fast: forces | derivatives |\n"
      "|---|--:|--:|--:|--:|--:|\n",
      draws, draws);
  for (const char* element : elements) {
    for (const double rate : {100.0, 200.0, 1000.0}) {
      text += row_of(element, rate, draws);
      if (!page.empty()) fmt::print(stderr, "{} at {:.0f} samples/s\n", element, rate);
    }
  }
  bench::write_page(page, text);
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return hysteron::bench::guarded(run, argc, argv); }
