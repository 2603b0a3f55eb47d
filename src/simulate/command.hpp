// The recorded drive of a recording, seen from one of its samples.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <type_traits>

#include "scalar/math.hpp"

namespace hysteron {

struct Command {
  std::span<const double> time;   // s, increasing
  std::span<const double> drive;  // A or V, as many
  std::size_t at = 0;             // the sample

  // s since the sample before; negative at the first.
  [[nodiscard]] double elapsed() const { return at == 0 ? -1.0 : time[at] - time[at - 1]; }

  // Drive `lag` s before the sample (negative: after it), linear between samples and held beyond the ends.
  template <class T>
  [[nodiscard]] T earlier(const T& lag) const {
    if constexpr (requires { lag.node; }) {
      return drive_before(lag);  // recorded (scalar/trace.hpp), not looked up
    } else if constexpr (std::is_same_v<T, double>) {
      return point(lag).value;
    } else if constexpr (is_pack<T>) {
      T result;
      for (int lane = 0; lane < T::lanes; ++lane) {
        result.set_lane(lane, point(lag.lane(lane)).value);
      }
      return result;
    } else {
      value_t<T> value;
      value_t<T> slope;
      for (int lane = 0; lane < value_t<T>::lanes; ++lane) {
        const Point there = point(lag.v.lane(lane));
        value.set_lane(lane, there.value);
        slope.set_lane(lane, -there.slope);
      }
      return chain(lag, value, slope);
    }
  }

 private:
  struct Point {
    double value;
    double slope;  // A/s or V/s
  };
  [[nodiscard]] Point point(double lag) const {
    const double wanted = time[at] - lag;
    if (!(wanted > time.front())) {
      return {drive.front(), 0.0};
    }
    if (!(wanted < time.back())) {
      return {drive.back(), 0.0};
    }
    const auto after = static_cast<std::size_t>(std::ranges::upper_bound(time, wanted) - time.begin());
    const double slope = (drive[after] - drive[after - 1]) / (time[after] - time[after - 1]);
    return {drive[after - 1] + slope * (wanted - time[after - 1]), slope};
  }
};

}  // namespace hysteron
