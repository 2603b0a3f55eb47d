// Effects in series with the damper.
#include <algorithm>
#include <cmath>

#include "challenge/effect_list.hpp"
#include "challenge/forms_series.hpp"

namespace hysteron::challenge {

void add_series(Effects& list) {
  list.push_back({.id = "clearance",
                  .group = Group::dead_zone,
                  .needs = needs::small,
                  .laws = series_laws,
                  .least = 1e-3,
                  .most = 0.6});
  // The contact gives by a part of the gap: a play that is small against it is a compliance.
  list.back().forms = {in_series("clearance/damped-contact", "hard, unilateral, damped", InSeries::whole,
                                 [](const Device& d, double s, Draws shape) {
                                   const double gap = s * d.smallest_amplitude;
                                   const double k = d.force / (gap * shape.log_uniform(0.05, 0.4));
                                   return part<DampedContact>(gap, k, 2e-4 * k);
                                 }),
                       in_series("clearance/hertz", "soft, power 1.5", InSeries::elastic,
                                 [](const Device& d, double s, Draws shape) {
                                   const double gap = s * d.smallest_amplitude;
                                   return part<HertzContact>(gap, d.force, gap * shape.log_uniform(0.08, 0.4));
                                 }),
                       in_series("clearance/off-centre", "begins near one end of the play", InSeries::elastic,
                                 [](const Device& d, double s, Draws shape) {
                                   const double gap = s * d.smallest_amplitude;
                                   const double k = d.force / (gap * shape.log_uniform(0.06, 0.3));
                                   const double place = shape.uniform(0.08, 0.3);
                                   return part<OffCentreContact>(gap, k, shape.chance(0.5) ? place : 1.0 - place);
                                 }),
                       in_series("clearance/rubbing", "with friction in the gap", InSeries::whole,
                                 [](const Device& d, double s, Draws shape) {
                                   const double gap = s * d.smallest_amplitude;
                                   const double k = d.force / (gap * shape.log_uniform(0.06, 0.3));
                                   return part<RubbingContact>(gap, k, d.force * shape.uniform(0.01, 0.04),
                                                               0.01 * d.speed);
                                 })};

  list.push_back({.id = "compliance",
                  .group = Group::dead_zone,
                  .needs = needs::levels_and_frequencies,
                  .laws = {Law::bouc_wen, Law::lugre},
                  .least = 1e-3,
                  .most = 0.5});
  list.back().forms = {
      in_series("compliance/hardening", "stiffer under load", InSeries::elastic,
                [](const Device& d, double s, Draws shape) {
                  const double give = s * d.amplitude;
                  const double part_of_cube = shape.uniform(0.3, 1.0);
                  return part<HardeningCompliance>(d.force / (give * (1.0 + part_of_cube)),
                                                   give / std::sqrt(part_of_cube));
                }),
      in_series(
          "compliance/aerated-oil", "bulk modulus that rises with pressure", InSeries::elastic,
          [](const Device& d, double s, Draws shape) {
            const double give = s * d.amplitude;
            const double bend = shape.uniform(0.7, 1.8);
            return part<AeratedOil>(d.force * bend / (give * std::expm1(bend)), give / bend);
          },
          "entrapped-gas"),
      in_series("compliance/kelvin-voigt", "with viscous loss", InSeries::whole,
                [](const Device& d, double s, Draws shape) {
                  return part<KelvinVoigtCompliance>(d.force / (s * d.amplitude), shape.uniform(0.002, 0.008));
                }),
      in_series(
          "compliance/standard-solid", "with relaxation", InSeries::whole, [](const Device& d, double s, Draws shape) {
            const double share = shape.uniform(0.2, 0.6);
            return part<StandardSolidCompliance>(d.force / (s * d.amplitude), share, shape.log_uniform(0.02, 0.2));
          })};

  list.push_back({.id = "entrapped-gas",
                  .group = Group::dead_zone,
                  .needs = needs::small,
                  .laws = series_laws,
                  .least = 1e-3,
                  .most = 0.5});
  list.back().forms = {
      in_series("entrapped-gas/isothermal", "Boyle's law", InSeries::elastic,
                [](const Device& d, double s, Draws shape) {
                  return part<IsothermalPocket>(s * d.amplitude, d.force * shape.log_uniform(0.05, 0.2));
                }),
      in_series("entrapped-gas/adiabatic", "Poisson's law", InSeries::elastic,
                [](const Device& d, double s, Draws shape) {
                  return part<AdiabaticPocket>(s * d.amplitude, d.force * shape.log_uniform(0.04, 0.2));
                }),
      in_series("entrapped-gas/one-chamber", "to one sense of the force only", InSeries::elastic,
                [](const Device& d, double s, Draws shape) {
                  const double length = 1.6 * s * d.amplitude;
                  const double force = d.force * shape.log_uniform(0.05, 0.2);
                  return part<OneChamberPocket>(length, force, 20.0 * d.force / d.amplitude / std::max(s, 0.02),
                                                shape.chance(0.5) ? 1.0 : -1.0);
                }),
      in_series("entrapped-gas/dissolving", "goes into solution under pressure", InSeries::whole,
                [](const Device& d, double s, Draws shape) {
                  const double force = d.force * shape.log_uniform(0.06, 0.2);
                  const double solubility = shape.uniform(0.01, 0.05);
                  return part<DissolvingPocket>(s * d.amplitude, force, solubility, shape.log_uniform(0.2, 2.0));
                })};

  list.push_back({.id = "series-dashpot",
                  .group = Group::curvature,
                  .needs = needs::frequencies,
                  .laws = {Law::bouc_wen},
                  .least = 1e-3,
                  .most = 3.0});
  list.back().forms = {
      in_series("series-dashpot/orifice", "leak by the power 0.6", InSeries::dashpot,
                [](const Device& d, double s, Draws) { return part<OrificeLeak>(s * d.speed, d.force); }),
      in_series("series-dashpot/check", "leaks less to one side", InSeries::dashpot,
                [](const Device& d, double s, Draws shape) {
                  return part<CheckedLeak>(d.force / (s * d.speed), shape.uniform(1.3, 2.2));
                }),
      in_series("series-dashpot/returning", "with a soft return spring", InSeries::whole,
                [](const Device& d, double s, Draws shape) {
                  const double drag = d.force / (s * d.speed);
                  return part<ReturningLeak>(drag, drag / shape.log_uniform(0.6, 4.0));
                })};

  list.push_back({.id = "cavitation",
                  .group = Group::even,
                  .needs = {.levels = 3, .frequencies = 2},
                  .laws = series_laws,
                  .least = 0.03,
                  .most = 0.8});
  list.back().forms = {
      in_series("cavitation/parted-column", "sharp limit, void closes without force", InSeries::whole,
                [](const Device& d, double s, Draws) {
                  return part<PartedColumn>((1.0 - s) * d.force, 400.0 * d.force / d.amplitude, 2e-3 * d.speed);
                }),
      in_series("cavitation/vacuum", "bubble under falling pressure", InSeries::elastic,
                [](const Device& d, double s, Draws shape) {
                  return part<VacuumColumn>((1.0 - s) * d.force, d.amplitude * shape.log_uniform(0.003, 0.015));
                }),
      form("cavitation/choked", "smooth limit, no void", [](const Device& d, double s, Draws shape) {
        return part<ChokedSuction>((1.0 - s) * d.force, shape.uniform(4.0, 8.0));
      })};
}

}  // namespace hysteron::challenge
