#include "challenge/base.hpp"

#include <cmath>

namespace hysteron::challenge {

Physics draw_law(const Stream& stream, Law law, const Device& device) {
  Draws draws(stream, "law");
  Physics p;
  p.law = law;
  p.force_scale = device.force;
  p.length_scale = device.amplitude;
  const double yield = device.force * draws.uniform(0.45, 0.75);
  const double damping = (device.force - yield) / device.speed;
  const double idle_yield = draws.uniform(0.12, 0.4);
  const double idle_damping = draws.uniform(0.3, 0.7);
  p.alpha_a = idle_yield * yield;
  p.alpha_b = (1.0 - idle_yield) * yield / device.level;
  p.c_a = idle_damping * damping;
  p.c_b = (1.0 - idle_damping) * damping / device.level;
  const double spring = draws.chance(0.5) ? draws.uniform(0.01, 0.12) * device.force / device.amplitude : 0.0;
  const double offset = draws.chance(0.5) ? draws.uniform(-0.08, 0.08) * device.force : 0.0;
  const double knee = device.amplitude * draws.log_uniform(0.01, 0.07);
  switch (law) {
    case Law::bouc_wen:
    case Law::modified_bouc_wen: {
      p.A = draws.log_uniform(1.0, 50.0);
      p.n = draws.uniform(1.0, 2.5);
      const double share = draws.uniform(0.4, 0.7);
      const double full = knee * p.A;
      p.beta = share * p.A / std::pow(full, p.n);
      p.gamma = (1.0 - share) * p.A / std::pow(full, p.n);
      if (law == Law::bouc_wen) {
        p.k0 = spring;
        p.f0 = offset;
      } else {
        p.c1 = device.force / device.speed * draws.log_uniform(3.0, 15.0);
        p.k0 = 0.02 * device.force / device.amplitude * draws.uniform(0.2, 2.0);
        p.k1 = spring;
      }
      break;
    }
    case Law::tanh_hysteresis:
      p.k0 = spring;
      p.f0 = offset;
      p.v_y = device.speed * draws.uniform(0.05, 0.15);
      p.v_h = p.v_y * draws.uniform(0.3, 0.9);
      break;
    case Law::bingham:
      p.f0 = offset;
      break;
    case Law::lugre:
      p.k0 = spring;
      p.f0 = offset;
      p.x_b = knee;
      p.ratio = draws.uniform(1.0, 1.5);
      p.v_st = device.speed * draws.log_uniform(0.03, 0.15);
      p.s1 = damping * draws.uniform(0.05, 0.3);
      break;
  }
  return p;
}

WrongBase wrong_base_for(Law law, const Stream& stream) {
  Draws draws(stream, "wrong base");
  switch (law) {
    case Law::bouc_wen:
      if (draws.chance(0.5)) return {"bingham", {"pre-yield-hysteresis", "linear-stiffness", "coulomb-friction"}};
      return {"hyperbolic-tangent", {"pre-yield-hysteresis"}};
    case Law::modified_bouc_wen:
      if (draws.chance(0.5)) return {"bouc-wen", {"series-dashpot", "linear-stiffness"}};
      return {"bingham", {"series-dashpot", "linear-stiffness", "pre-yield-hysteresis", "coulomb-friction"}};
    case Law::lugre:
      return {"bouc-wen", {"seal-friction", "coulomb-friction", "pre-yield-hysteresis"}};
    case Law::tanh_hysteresis:
    case Law::bingham:
      break;
  }
  return {"bouc-wen", {}};
}

std::vector<std::string> driven_parameters(const std::string& model) {
  return {model == "bingham" ? "fc" : "alpha", "c0"};
}

}  // namespace hysteron::challenge
