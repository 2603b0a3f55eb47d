// The sixteen parameters of the asymmetric sigmoid that the Nelder-Mead study prints for six currents; 1 Hz, 2.5 mm.
#include <array>

#include "presets/preset.hpp"
#include "presets/support/nelder_mead_rows.hpp"

namespace hysteron {

extern const Preset preset_nelder_mead_tables;

namespace {

template <int row>
double at(double i, double /*f*/) {
  return nelder_mead::nearest(i).values[row];
}

constexpr PresetQuantity quantities[] = {
    {"f0", "N", "36.55, 136.20, 145.19, 175.78, 95.69, 67.23", &at<0>},
    {"a0", "s/m", "11309, 2109, 1982, 1688, 656.56, 895", &at<1>},
    {"a1", "s/m", "-23.2, -33.85, 34.81, 36.99, 81.85, 121.74", &at<2>},
    {"a2", "1/A", "118.6, 0.13, 0.116, 0.11, 0.11, 0.062", &at<3>},
    {"a3", "1/A", "-1.55, 37.48, 36.72, 28.51, 72.90, 78.02 (printed in (m/s)^-1)", &at<4>},
    {"a4", "s/m", "33.59, -39.71, -44.15, -40.44, 28.57, 5.80", &at<5>},
    {"k0", "s/m", "1433.8, 29.35, 36.58, 55.18, 134.14, 219.13", &at<6>},
    {"k1c", "s/m", "93.84, 49.62, 65.59, 66.33, 24.12, 21.07", &at<7>},
    {"k1e", "s/m", "40.85, 14.62, 13.40, 13.78, 20.50, 25.63", &at<8>},
    {"k2", "1", "-6109, -189, -91.5, -54.3, 14.87, 22.54", &at<9>},
    {"k3", "1", "-1046, 1.31, 1.07, 1.03, -1.76, -2.95", &at<10>},
    {"k4", "1", "-0.15, -0.46, -0.46, -0.47, -0.52, -0.48", &at<11>},
    {"k5", "1", "0.42, 0.39, 0.46, 0.46, 0.08, 0.03", &at<12>},
    {"k6", "1", "0.007, 0.33, 0.34, 0.33, 0.10, 0.06", &at<13>},
    {"I0", "A", "0.147, -0.05, -0.065, 1.66, -0.168, -0.10", &at<14>},
    {"I1", "A", "4.09, -0.51, -0.487, 0.02, -0.836, -0.93", &at<15>},
};

std::vector<double> parameters(std::span<const double> q) {
  std::vector<double> values(q.begin(), q.end());
  values.push_back(0.02);  // a_s: rounds the sign of the acceleration, of which the peak is 0.1 m/s^2
  return values;
}

}  // namespace

const Preset preset_nelder_mead_tables = {
    "nelder-mead-tables",
    "Asymmetric sigmoid of sixteen parameters, six currents",
    "parameter identification of a damper's modified Bouc-Wen model by the Nelder-Mead simplex, tables 1 and 2",
    "wang-sigmoid",
    {},
    PresetDrive::current,
    0.0,
    0.5,
    false,
    0.0,
    "A set for each current, the nearest of 0, 0.1, ... 0.5 A; what they say of other currents means nothing. The form "
    "is "
    "that of Wang et al.: as the study prints it, a \"1 +\" is missing in f_t and in v_h and the exponent of 1 + e^(a1 "
    "v_m) "
    "is -1 (`hysteron reproduce nelder-mead-tables` compares the readings). At 0.3 A I0 and I1 look exchanged; used as "
    "printed. For 1 Hz and 2.5 mm only.",
    quantities,
    parameters};

}  // namespace hysteron
