// rd8040-voltage-twin: the short stroke damper RD-8040-1 as the Levenberg-Marquardt study identified it (table 1),
// under a voltage that steps, so that the lag of the drive shows. The recordings of the study are not public: this is a
// stand-in made of the published parameters.
#include "datasets/dataset.hpp"
#include "datasets/support/stepped_voltage.hpp"

namespace hysteron {

extern const DatasetEntry dataset_rd8040_voltage_twin;

namespace {

Campaign generate(const Stream& stream) { return stepped_voltage_campaign(rd8040_1, 0.01, stream); }

}  // namespace

const DatasetEntry dataset_rd8040_voltage_twin = {
    "rd8040-voltage-twin", "Simulated twin of the MR damper RD-8040-1 under a voltage that steps",
    "identified parameters of the Levenberg-Marquardt study of long and short stroke MR dampers, table 1",
    "1 to 3 Hz, 5 to 15 mm sines from rest, 1000 samples a second for 3 s, voltage steps between 0 and 5 V every 0.17 "
    "s;\n"
    "the last recording (1.5 Hz, 12 mm) judges. Truth: bouc-wen + coil-lag, alpha and c0 linear in the lagged "
    "voltage,\n"
    "lag 1/157 s; white force noise of 1 % of each recording's peak force from the seed.",
    &generate};

}  // namespace hysteron
