#include <array>
#include <charconv>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "mpi/mpi_peers.hpp"

namespace hysteron {
namespace {

std::optional<int> number(const char* name) {
  const char* text = std::getenv(name);
  if (text == nullptr) return {};
  const std::string_view word(text);
  int value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return {};
  return value;
}

}  // namespace

std::optional<Launched> launched() {
  // Open MPI; MPICH and its kin.
  constexpr std::array names{std::pair{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                             std::pair{"PMI_RANK", "PMI_SIZE"}};
  for (const auto& [rank, size] : names) {
    const auto own = number(rank);
    const auto all = number(size);
    if (own && all) return Launched{*own, *all};
  }
  return {};
}

}  // namespace hysteron
