// rotary-friction-damper: recordings and card in datasets/rotary-friction-damper.
#include "datasets/dataset.hpp"
#include "datasets/support/shipped.hpp"

namespace hysteron {

extern const DatasetEntry dataset_rotary_friction_damper;

const DatasetEntry dataset_rotary_friction_damper = {
    "rotary-friction-damper",
    "Banded rotary friction device, 12 recordings",
    "Coble, Huggins, Cao, Ricles & Downey 2022, "
    "https://github.com/ARTS-Laboratory/Dataset-Friction-Damper-with-Backlash,\n"
    "commit 0e09aa9d",
    "Measured. Sines of 25 mm at 0.5 and 1 Hz under band tensions of 20 to 80 lb (in the name of the file), up to 19 "
    "kN, sampled\n"
    "at 1024 Hz.",
    [](const Stream&) { return load_shipped("rotary-friction-damper"); },
    "CC BY-SA 4.0, copyright the authors",
};

}  // namespace hysteron
