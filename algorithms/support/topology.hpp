// Who informs whom in a swarm.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "algorithms/support/population.hpp"

namespace hysteron::support {

using Neighbourhood = std::vector<std::vector<std::size_t>>;  // informants of each particle, itself included

inline Neighbourhood ring_neighbourhood(std::size_t count) {
  Neighbourhood informants(count);
  for (std::size_t i = 0; i < count; ++i) informants[i] = {i, (i + count - 1) % count, (i + 1) % count};
  return informants;
}

// A torus of rows x columns, rows the largest divisor of the swarm size not above its square root; a prime size
// leaves one row, that is the ring.
inline Neighbourhood von_neumann_neighbourhood(std::size_t count) {
  std::size_t rows = 1;
  for (std::size_t divisor = 1; divisor * divisor <= count; ++divisor) {
    if (count % divisor == 0) rows = divisor;
  }
  const std::size_t columns = count / rows;
  Neighbourhood informants(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = i / columns;
    const std::size_t column = i % columns;
    informants[i] = {i, row * columns + (column + columns - 1) % columns, row * columns + (column + 1) % columns,
                     ((row + rows - 1) % rows) * columns + column, ((row + 1) % rows) * columns + column};
  }
  return informants;
}

// Each particle informs itself and `links` particles drawn with replacement (Clerc).
inline Neighbourhood random_neighbourhood(std::size_t count, std::size_t links, const Stream& stream,
                                          std::uint64_t generation) {
  Neighbourhood informants(count);
  for (std::size_t i = 0; i < count; ++i) informants[i].push_back(i);
  for (std::size_t i = 0; i < count; ++i) {
    Draws draws(stream, generation, i);
    for (std::size_t link = 0; link < links; ++link) informants[draws.below(count)].push_back(i);
  }
  return informants;
}

// The informant with the lowest cost; the particle itself wins ties.
inline std::size_t best_informant(std::span<const std::size_t> informants, std::span<const double> cost) {
  std::size_t best = informants.front();
  for (const std::size_t candidate : informants) {
    if (cost[candidate] < cost[best]) best = candidate;
  }
  return best;
}

}  // namespace hysteron::support
