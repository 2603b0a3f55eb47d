// Speed of the marches of every law, beside kernels written by hand and the peak arithmetic of the machine:
//
//   hysteron_kernels [--rounds 15] [--page results/kernels.md]
//
// Everything is timed in turn, once a round, by processor time; figures are medians over the rounds, ratios medians of
// the ratios within a round.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <deque>
#include <functional>
#include <numbers>
#include <string>
#include <type_traits>
#include <vector>

#include "bench/drawn.hpp"
#include "bench/fused_kernels.hpp"
#include "bench/page.hpp"
#include "bench/program.hpp"
#include "bench/work_of_march.hpp"
#include "core/error.hpp"
#include "core/robust.hpp"
#include "simulate/composite.hpp"

#if defined(__FMA__)
#include <immintrin.h>
#endif

namespace {

using namespace hysteron;

constexpr std::size_t samples = 1000;
constexpr double rate = 1000.0;       // Hz
constexpr double frequency = 2.0;     // Hz
constexpr double amplitude = 0.025;   // m
constexpr double least_time = 0.008;  // s of one timing
constexpr std::size_t drawn_candidates = 64;
constexpr std::size_t dual_candidates = lane_count;

Motion sine() {
  std::vector<double> time(samples);
  std::vector<double> x(samples);
  std::vector<double> v(samples);
  constexpr double omega = 2.0 * std::numbers::pi * frequency;
  for (std::size_t n = 0; n < samples; ++n) {
    time[n] = static_cast<double>(n) / rate;
    x[n] = amplitude * std::sin(omega * time[n]);
    v[n] = amplitude * omega * std::cos(omega * time[n]);
  }
  return make_motion(time, x, v, {});
}

// Something that is done again and again, `amount` of it a time (candidates, operations).
struct Timed {
  std::function<void()> once;
  double amount = 0.0;
  std::vector<double> speeds;  // amount per second, one a round

  void take_turn() {
    const double begun = bench::cpu_seconds();
    double elapsed = 0.0;
    double times = 0.0;
    while (elapsed < least_time) {
      once();
      times += 1.0;
      elapsed = bench::cpu_seconds() - begun;
    }
    speeds.push_back(times * amount / elapsed);
  }
};

double median_ratio(const Timed& of, const Timed& over) {
  std::vector<double> ratios;
  for (std::size_t k = 0; k < of.speeds.size(); ++k) {
    ratios.push_back(of.speeds[k] / over.speeds[k]);
  }
  return median_of(ratios);
}

// Independent chains of fused multiply-adds, as many as hide their latency and stay in registers.
Timed peak_arithmetic() {
  constexpr int chains = 12;
  constexpr int length = 20000;
  constexpr int per_vector = vector_bytes / sizeof(double);
  Timed result;
  result.amount = 2.0 * chains * length * per_vector;
  result.once = [] {
    VectorDouble sums[chains];
    repeat<chains>([&](auto i) { sums[i] = VectorDouble{} + static_cast<double>(i); });
    const VectorDouble factor = VectorDouble{} + 0.999;
    const VectorDouble term = VectorDouble{} + 1e-3;
    for (int k = 0; k < length; ++k) {
      repeat<chains>([&](auto i) __attribute__((always_inline)) {
#if defined(__AVX512F__)
        sums[i] = _mm512_fmadd_pd(sums[i], factor, term);
#elif defined(__FMA__)
        sums[i] = _mm256_fmadd_pd(sums[i], factor, term);
#else
        sums[i] = sums[i] * factor + term;
#endif
      });
      asm volatile("" : : : "memory");
    }
    VectorDouble sum{};
    repeat<chains>([&](auto i) { sum += sums[i]; });
    volatile double kept = sum[0];
    static_cast<void>(kept);
  };
  return result;
}

// Marches candidates pack by pack.
template <class T>
Timed marched(const CompositeModel& model, const Motion& motion, const std::vector<std::vector<double>>& rows) {
  constexpr std::size_t width = value_t<T>::lanes;
  std::vector<std::vector<T>> packs;
  for (std::size_t first = 0; first < rows.size(); first += width) {
    std::vector<T> p(model.parameter_count());
    for (std::size_t j = 0; j < p.size(); ++j) {
      for (std::size_t lane = 0; lane < width; ++lane) {
        if constexpr (std::is_same_v<T, value_t<T>>) {
          p[j].set_lane(static_cast<int>(lane), rows[first + lane][j]);
        } else {
          p[j].v.set_lane(static_cast<int>(lane), rows[first + lane][j]);
          if (j < sweep_directions) p[j].d[j].set_lane(static_cast<int>(lane), 1.0);
        }
      }
    }
    packs.push_back(p);
  }
  Timed result;
  result.amount = static_cast<double>(rows.size());
  result.once = [&model, &motion, packs, force = std::vector<T>(samples)]() mutable {
    for (const std::vector<T>& p : packs) {
      std::vector<T> state(16);
      model.march<T>(motion, p.data(), 0, 0, samples, state.data(), force.data());
    }
  };
  return result;
}

std::vector<double> initial(const CompositeModel& model) {
  std::vector<double> p;
  for (const Parameter& card : model.parameters()) {
    p.push_back(card.initial);
  }
  return p;
}

using Widest = std::conditional_t<wide_lanes_pay, WideLanes, Lanes>;

// A law of the catalogue.
struct Row {
  CompositeModel model;
  std::string rates = "-";
  double operations = 0.0;  // a sample; 0: not known
  Timed value;
  Timed one_pack;
  Timed derivative;
  Timed from_box;

  Row(const Part* law, const Motion& motion) {
    model.law = law;
    const std::vector<double> p = initial(model);
    try {
      const bench::WorkOfMarch work = bench::work_of_march(*law, motion, p);
      rates = fmt::format("{:.1f}", work.rates);
      operations = work.operations;
    } catch (const InputError&) {
      // Its equations cannot be written out, and so not be counted.
    }
    value = marched<Widest>(model, motion, {drawn_candidates, p});
    one_pack = marched<Lanes>(model, motion, {drawn_candidates, p});
    derivative = marched<LaneDual>(model, motion, {dual_candidates, p});
    std::vector<std::vector<double>> rows;
    for (std::size_t k = 0; k < drawn_candidates; ++k) {
      rows.push_back(bench::drawn(model, Stream(7300 + k)));
    }
    from_box = marched<Widest>(model, motion, rows);
  }
};

// A law beside the kernel that is written for it.
struct Limit {
  CompositeModel model;
  double knee;
  double yield;  // m
  bench::WorkOfMarch work;
  double difference;  // of the forces, over the largest
  Timed general;
  Timed one_pack;
  Timed two_packs;

  Limit(const char* law, double n, double x_y, const Motion& motion, const bench::PlainMotion& plain)
      : model(make_model(law, {})), knee(n), yield(x_y) {
    std::vector<double> p = initial(model);
    const std::vector<std::string> names = model.parameter_names();
    p[static_cast<std::size_t>(std::ranges::find(names, "n") - names.begin())] = n;
    p[static_cast<std::size_t>(std::ranges::find(names, "x_y") - names.begin())] = x_y;
    work = bench::work_of_march(*model.law, motion, p);
    general = marched<Widest>(model, motion, {drawn_candidates, p});
    std::vector<Lanes> packs;
    for (int pack = 0; pack < bench::most_packs; ++pack) {
      packs.insert(packs.end(), p.begin(), p.end());
    }
    const auto fused = [&](int count) {
      Timed result;
      result.amount = count * lane_count;
      result.once = [kernel = bench::fused_kernel(law, n == 1.0, count), &plain, packs,
                     out = std::vector<Lanes>(samples * bench::most_packs)]() mutable {
        kernel(plain, packs.data(), out.data());
      };
      return result;
    };
    one_pack = fused(1);
    two_packs = fused(2);
    std::vector<Lanes> out(samples);
    bench::fused_kernel(law, n == 1.0, 1)(plain, packs.data(), out.data());
    const std::vector<double> force = simulate(model, motion, p);
    double largest = 0.0;
    difference = 0.0;
    for (std::size_t k = 0; k < samples; ++k) {
      largest = std::max(largest, std::fabs(force[k]));
      difference = std::max(difference, std::fabs(force[k] - out[k].lane(0)));
    }
    difference /= largest;
  }
  [[nodiscard]] const Timed& fastest() const { return median_ratio(two_packs, one_pack) > 1.0 ? two_packs : one_pack; }
};

std::string page_of(const std::deque<Row>& rows, const std::deque<Limit>& limits, const Timed& peak, int rounds) {
  const auto share_of_peak = [&](const Timed& timed, double operations) {
    return 100.0 * samples * operations * median_ratio(timed, peak);
  };
  std::string text = fmt::format(
      "# Marches of the laws\n\nMade by\n\n    build/release/bench/hysteron_kernels --rounds {} --page "
      "results/kernels.md\n\n"
      "One core, {} samples at {:.0f} Hz, {:.0f} Hz, {:.0f} mm. Processor time of the process, since other work shares "
      "the machine: everything is\ntimed in turn in each of {} rounds; figures are medians over the rounds, ratios "
      "medians of the ratios within a round.\nVectors have {} bytes. Peak arithmetic, by independent fused "
      "multiply-adds in the same rounds: {:.1f} GFLOP/s.\n\n"
      "## Beside kernels written by hand\n\n"
      "`bench/fused_kernels.cpp` has the two hystereses written out: classical Runge-Kutta with one step a sample, "
      "whatever that\nloses, products and sums contracted to fused multiply-adds, one pack of eight candidates at a "
      "time or two side by side; the\nfaster counts. The march of the program takes the steps that its tolerance asks "
      "for and lands on reversals; it rounds every\nproduct of the equations, so that results are the same with every "
      "instruction set; and it marches two packs side by side, as\n"
      "fits do where candidates and threads allow. "
      "*Difference*: largest one of the forces, over the largest force; it is what single\nsteps lose. *Per step*: "
      "share of the limit if the march had taken one step a sample too.\n\n"
      "| law | n | x_y mm | by hand, one pack, candidates/s | the faster, candidates/s | of peak % | difference | "
      "steps a sample | march, candidates/s | of the limit % | per step % |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
      rounds, samples, rate, frequency, 1e3 * amplitude, rounds, vector_bytes, 1e-9 * median_of(peak.speeds));
  for (const Limit& limit : limits) {
    const Timed& fastest = limit.fastest();
    const double steps = limit.work.rates / 4.0;
    const double share = 100.0 * median_ratio(limit.general, fastest);
    // The hand-written kernel's own arithmetic: that of one step a sample.
    const double operations = limit.work.operations_of_step;
    text +=
        fmt::format("| {} | {:g} | {:g} | {:.0f} | {:.0f} | {:.0f} | {:.0e} | {:.2f} | {:.0f} | {:.0f} | {:.0f} |\n",
                    limit.model.law->id, limit.knee, 1e3 * limit.yield, median_of(limit.one_pack.speeds),
                    median_of(fastest.speeds), share_of_peak(fastest, operations), limit.difference, steps,
                    median_of(limit.general.speeds), share, share * steps);
  }
  text += fmt::format(
      "\n## All laws\n\n"
      "Parameters at the initial values of the cards; *from the box*: {} candidates drawn from the box, packed as they "
      "come, each\npack as slow as its stiffest lane. *Rates*: evaluations of the law's rates a sample, four to a "
      "step. *Operations*: floating-point\noperations of equations and Runge-Kutta sums a sample; an fma counts as "
      "two, a division as one, elementary functions as what\n`scalar/math.hpp` does for them, comparisons, "
      "selections, inputs between samples, and the choice of steps as none. The share of\nthe peak is by these. "
      "*Two at once*: speed over that of one pack of eight at a time. *Derivative*: time of a candidate with "
      "{}\nderivatives, which go one pack at a time, over that of its value.\n\n"
      "| law | states | rates | operations | candidates/s | of peak % | two at once | derivative, times the value | "
      "from the box, "
      "candidates/s |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|\n",
      drawn_candidates, sweep_directions);
  for (const Row& row : rows) {
    const bool known = row.operations > 0.0;
    text += fmt::format(
        "| {} | {} | {} | {} | {:.0f} | {} | {:.2f} | {:.1f} | {:.0f} |\n", row.model.law->id, row.model.law->states,
        row.rates, known ? fmt::format("{:.0f}", row.operations) : "-", median_of(row.value.speeds),
        known ? fmt::format("{:.0f}", share_of_peak(row.value, row.operations)) : "-",
        median_ratio(row.value, row.one_pack), median_ratio(row.value, row.derivative), median_of(row.from_box.speeds));
  }
  return text;
}

int run(int argc, char** argv) {
  CLI::App program{"Speed of the marches of every law"};
  int rounds = 15;
  std::string page;
  program.add_option("--rounds", rounds, "turns that everything is timed in")->check(CLI::Range(1, 1000));
  program.add_option("--page", page, "file to write in place of standard output");
  CLI11_PARSE(program, argc, argv);
  const Motion motion = sine();
  const bench::PlainMotion plain(motion);
  Timed peak = peak_arithmetic();
  std::deque<Row> rows;  // timings refer to their models
  for (const Part* law : model_catalogue()) {
    rows.emplace_back(law, motion);
  }
  std::deque<Limit> limits;
  for (const char* law : {"bouc-wen", "modified-bouc-wen"}) {
    for (const double n : {1.0, 1.5}) {
      for (const double x_y : {1e-2, 1e-3}) {
        limits.emplace_back(law, n, x_y, motion, plain);
      }
    }
  }
  for (int round = 0; round < rounds; ++round) {
    if (!page.empty()) fmt::print(stderr, "round {} of {}\n", round + 1, rounds);
    peak.take_turn();
    for (Limit& limit : limits) {
      limit.general.take_turn();
      limit.one_pack.take_turn();
      limit.two_packs.take_turn();
    }
    for (Row& row : rows) {
      row.value.take_turn();
      row.one_pack.take_turn();
      row.derivative.take_turn();
      row.from_box.take_turn();
    }
  }
  const std::string text = page_of(rows, limits, peak, rounds);
  bench::write_page(page, text);
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return hysteron::bench::guarded(run, argc, argv); }
