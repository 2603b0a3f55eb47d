// MATLAB files, level 5 and 7.3: src/io/mat.hpp.
#include "io/mat.hpp"

#include "io/format.hpp"
#include "io/mat73.hpp"

namespace hysteron {
namespace {

constexpr Ending endings[] = {{".mat"}};

// Version 1 in the byte order that is named, which no text has there; or an HDF5 file.
bool begins(std::string_view head) {
  using namespace std::string_view_literals;
  const std::string_view mark = head.size() < 128 ? std::string_view{} : head.substr(124, 4);
  return mark == "\x00\x01IM"sv || mark == "\x01\x00MI"sv || is_mat73(head);
}

}  // namespace

extern const InputFormat format_mat;
const InputFormat format_mat = {.name = "MAT",
                                .endings = endings,
                                .begins = begins,
                                .parse = parse_mat,
                                .read = read_mat,
                                .samples = samples_by_size};

}  // namespace hysteron
