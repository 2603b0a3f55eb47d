// Recordings as MAT files of level 5. Those of 7.3 are read by another process, whose answer is the target mat_pipe.
#include "io/mat.hpp"

#include <algorithm>
#include <cmath>

#include "io/mat73.hpp"
#include "target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hysteron;
  const std::string_view bytes = fuzz::text_of(data, size);
  if (is_mat73(bytes)) return 0;
  Recording recording;
  if (fuzz::taken([&] { recording = parse_mat(bytes, "input.mat"); })) {
    for (const auto* channel : {&recording.time, &recording.displacement, &recording.force}) {
      fuzz::require(channel->size() == recording.size(), "channels are of one length");
      fuzz::require(std::ranges::all_of(*channel, [](double value) { return std::isfinite(value); }),
                    "numbers are finite");
    }
  }
  ReadOptions of_matrix;
  of_matrix.columns = {{"time", "1"}, {"displacement", "2 [mm]"}, {"force", "3 [kN]"}};
  fuzz::taken([&] { static_cast<void>(parse_mat(bytes, "input.mat", of_matrix)); });
  return 0;
}
