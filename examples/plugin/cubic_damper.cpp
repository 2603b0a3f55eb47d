// A model, an effect and a solver of one's own, in one file outside the tree.
//   F = c0 v + c3 v^3 + f0,   the cubic term alone behind any law: F <- F + d3 v^3,
// and random search: uniform points, the best counts.
#include "core/error.hpp"
#include "plugin/plugin.hpp"
#include "simulate/compile.hpp"

namespace {

using namespace hysteron;

struct CubicDamper {
  static constexpr std::string_view id = "cubic-damper";
  static constexpr std::string_view title = "Dashpot with a cubic term";
  static constexpr std::string_view reference = "example of a plugin";
  static constexpr std::string_view equations[] = {"F = c0 v + c3 v^3 + f0"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "c0", .unit = "N s/m", .meaning = "damping", .box = {0, 2e4}, .initial = 500, .linear = true, .role = PhysicalRole::damping},
      {.name = "c3", .unit = "N s^3/m^3", .meaning = "cubic damping", .box = {-1e5, 1e5}, .initial = 0, .linear = true},
      {.name = "f0", .unit = "N", .meaning = "offset force", .box = {-1.5e3, 1.5e3}, .initial = 0, .linear = true, .role = PhysicalRole::offset_force},
  };
  template <class T>
  static T force(const std::array<T, 3>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& /*below*/) {
    const auto& [c0, c3, f0] = p;
    return (c0 + c3 * in.v * in.v) * in.v + f0;
  }
};

constexpr Part cubic_damper = compile<CubicDamper>();

struct CubicDamping {
  static constexpr std::string_view id = "cubic-damping";
  static constexpr std::string_view title = "Cubic damping";
  static constexpr std::string_view reference = "example of a plugin";
  static constexpr std::string_view equations[] = {"F <- F + d3 v^3"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "d3", .unit = "N s^3/m^3", .meaning = "cubic damping", .box = {0, 1e5}, .initial = 0, .linear = true},
  };
  // A diagnosis sets these in the place of cubic damping, and cubic damping in theirs.
  static constexpr std::string_view kin[] = {"quadratic-damping", "viscous-damping"};
  // What shows it in the data: force per squared velocity.
  static constexpr ContrastSense contrasts[] = {{ContrastKind::speed_bend, Sense::positive}};
  static constexpr Knowledge knowledge = {
      .family = families::fluid,
      .in_words = "cubic damping",
      .shows = "the force rises with the cube of the speed",
      .experiment = "constant-velocity runs over at least a decade of speed",
      .kin = kin,
      .contrasts = contrasts,
  };
  template <class T>
  static T force(const std::array<T, 1>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const auto& [d3] = p;
    return below + d3 * in.v * in.v * in.v;
  }
};

constexpr Part cubic_damping = compile<CubicDamping>();

class RandomSearch final : public Solver {
 public:
  explicit RandomSearch(const Problem& problem) : problem_(problem) {}

  // Every draw is a pure function of round and coordinate: asked again it gives the same points.
  Request ask() override {
    constexpr std::uint32_t points = 64;
    Request request;
    for (std::uint32_t k = 0; k < points; ++k) {
      for (std::uint32_t d = 0; d < problem_.dimension; ++d) {
        request.points.push_back(problem_.stream.uniform(round_, k, d));
      }
    }
    return request;
  }
  void tell(const Request& /*request*/, const Response& /*response*/) override { ++round_; }

 private:
  Problem problem_;
  std::uint64_t round_ = 0;
};

const SolverEntry random_search = {
    "uniform-search",
    "Uniform random search",
    "example of a plugin",
    "Uniform points of the box; what a solver has to beat.",
    false,
    {},
    [](const Problem& problem) -> std::unique_ptr<Solver> {
      if (!problem.settings.empty()) throw InputError("solver uniform-search: it has no settings");
      return std::make_unique<RandomSearch>(problem);
    },
};

}  // namespace

extern "C" const Plugin* hysteron_plugin() {
  static const Part* const models[] = {&cubic_damper};
  static const Part* const effects[] = {&cubic_damping};
  static const SolverEntry* const solvers[] = {&random_search};
  static const Plugin plugin{plugin_layout(), models, effects, solvers};
  return &plugin;
}
