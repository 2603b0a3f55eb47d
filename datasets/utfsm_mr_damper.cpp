// utfsm-mr-damper: recordings and card in datasets/utfsm-mr-damper.
#include "datasets/dataset.hpp"
#include "datasets/support/shipped.hpp"

namespace hysteron {

extern const DatasetEntry dataset_utfsm_mr_damper;

const DatasetEntry dataset_utfsm_mr_damper = {
    "utfsm-mr-damper",
    "MR damper in a servo-hydraulic press, 20 recordings",
    "M. Quiroz, UTFSM, https://github.com/DanielMaurelE/vRTHS_AMBC_MRdamper, commit 08753ffd",
    "Measured. Sines of 2 mm 5 Hz, 5 mm 3 Hz, 10 mm 2 Hz and 25 mm 0.5 Hz at 0, 0.25, 0.5, 0.75 and 1 A, up to 1.7 kN, "
    "sampled\n"
    "at 200 or 1000 Hz, from rest to rest. The current is nominal, the displacement the absolute stroke.",
    [](const Stream&) { return load_shipped("utfsm-mr-damper"); },
    "MIT, copyright 2022 mequiroz",
};

}  // namespace hysteron
