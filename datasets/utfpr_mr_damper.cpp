// utfpr-mr-damper: recordings and card in datasets/utfpr-mr-damper.
#include "datasets/dataset.hpp"
#include "datasets/support/shipped.hpp"

namespace hysteron {

extern const DatasetEntry dataset_utfpr_mr_damper;

const DatasetEntry dataset_utfpr_mr_damper = {
    "utfpr-mr-damper",
    "Small MR damper on a crank-driven table, 30 recordings",
    "Labcontrol, UTFPR, https://github.com/labcontrol-data/mr-damper, commit e42439f0, doi 10.5281/zenodo.4445334",
    "Measured. Near-sines of 3.8 to 20 mm and 0.46 to 1.2 Hz at 0, 0.87, 1.98 and 3.21 V, up to 1 kN, sampled at 100 "
    "Hz, from\n"
    "rest. The voltage is nominal.",
    [](const Stream&) { return load_shipped("utfpr-mr-damper"); },
    "MIT, copyright 2021 Labcontrol",
};

}  // namespace hysteron
