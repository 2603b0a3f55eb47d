// The drive channel without the noise of its measurement: what the device saw is smoother than what was recorded.
#pragma once

#include <cstddef>
#include <vector>

namespace hysteron {

// Fourth differences, scaled so that white noise keeps its standard deviation; empty for fewer than five values. What
// is smooth leaves next to nothing in them.
std::vector<double> fourth_differences(const std::vector<double>& values);

// Standard deviation of the channel's white noise, by the median of its fourth differences; 0 for a channel that is
// smooth, constant or steps without noise.
double drive_noise(const std::vector<double>& drive);

// Whether it moves by more than 2 % of its largest size, and by more than its noise does.
bool varies(const std::vector<double>& drive);

// Whether it rises and falls, each as varies() asks.
bool returns(const std::vector<double>& drive);

// How many values a device was driven at: such as differ by less than 2 % of the largest size are one, since nobody
// sets a current more exactly. 0 for none.
std::size_t count_levels(std::vector<double> values);

// Its mean where it does not vary; else each sample is that of a parabola through up to 17 around it, as far as
// its neighbours to both sides lie on a line with it within their noise, so that steps, ramps and curves stay.
std::vector<double> quiet_drive(const std::vector<double>& drive);

// As quiet_drive, and one value alone where it does not vary.
std::vector<double> quiet_condition(const std::vector<double>& values);

}  // namespace hysteron
