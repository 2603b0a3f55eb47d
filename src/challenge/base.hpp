// The true law of a concealed campaign, drawn for a device.
#pragma once

#include <string>
#include <vector>

#include "challenge/effects.hpp"

namespace hysteron::challenge {

// A law whose peak force at the highest drive and speed is about the device's.
[[nodiscard]] Physics draw_law(const Stream& stream, Law law, const Device& device);

// Another law for campaign.toml to name, and the effects whose naming is then no mistake: they are what the named law
// lacks of the true one.
struct WrongBase {
  std::string model;
  std::vector<std::string> acceptable;
};
[[nodiscard]] WrongBase wrong_base_for(Law law, const Stream& stream);

// The parameters of a model that are affine in the drive.
[[nodiscard]] std::vector<std::string> driven_parameters(const std::string& model);

}  // namespace hysteron::challenge
