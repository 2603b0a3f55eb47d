#include "diagnose/residual/contrast_panel.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace hysteron::contrast {
namespace {

constexpr std::size_t most_rows = 2000;        // of a recording
constexpr double fewest_rows_of_cycle = 40.0;  // unless there are fewer samples
// Of the largest pivot: what is left of a column beside others that say the same.
constexpr double rank_tolerance = 1e-9;
// Recordings of equal weight from which on their signs alone make enough placebos.
constexpr double fewest_flips = 7.0;

}  // namespace

Panel::Panel(std::span<const Track> tracks, Values Track::*response, std::size_t placebos)
    : tracks_(tracks), placebos_(placebos) {
  for (const Track& track : tracks) {
    std::vector<std::size_t> samples;
    std::size_t hold = 0;
    for (std::size_t n = track.from; n < track.time.size() && !(track.*response).empty(); ++n) {
      while (hold < track.holds.size() && track.holds[hold].samples.end <= n) {
        ++hold;
      }
      if (hold == track.holds.size() || n < track.holds[hold].samples.first) {
        samples.push_back(n);
      }
    }
    const auto count = static_cast<double>(samples.size());
    const double step = (track.time.back() - track.time.front()) / static_cast<double>(track.time.size() - 1);
    const double of_cycle = track.period > 0.0 ? track.period / step / fewest_rows_of_cycle : count;
    const double width = std::clamp(of_cycle, 1.0, std::max(1.0, std::ceil(count / static_cast<double>(most_rows))));
    width_.push_back(static_cast<std::size_t>(width));
    const std::size_t first = weight_.size();
    for (std::size_t k = 0; k + width_.back() <= samples.size(); k += width_.back()) {
      double duration = 0.0;
      for (std::size_t j = 0; j < width_.back(); ++j) {
        duration += track.duration[samples[k + j]];
      }
      weight_.push_back(track.weight * duration);
      block_.push_back(track.half_cycle[samples[k]]);
    }
    rows_.push_back({first, weight_.size()});
    period_.push_back(track.period / step / static_cast<double>(width_.back()));
    samples_.push_back(std::move(samples));
  }
  response_ = built([response](const Track& track, std::size_t n) { return (track.*response)[n]; });
}

Values Panel::built(const Value& value) const {
  Values result;
  result.reserve(weight_.size());
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    for (std::size_t row = 0; row < rows_[k].end - rows_[k].first; ++row) {
      double sum = 0.0;
      for (std::size_t j = 0; j < width_[k]; ++j) {
        sum += value(tracks_[k], samples_[k][row * width_[k] + j]);
      }
      result.push_back(sum / static_cast<double>(width_[k]));
    }
  }
  return result;
}

double Panel::product(const Values& a, const Values& b) const {
  double sum = 0.0;
  for (std::size_t n = 0; n < weight_.size(); ++n) {
    sum += weight_[n] * a[n] * b[n];
  }
  return sum;
}

Panel::Column Panel::keep(Values values) {
  Values products;
  products.reserve(columns_.size() + 1);
  for (const Values& column : columns_) {
    products.push_back(product(column, values));
  }
  products.push_back(product(values, values));
  with_response_.push_back(product(values, response_));
  products_.push_back(std::move(products));
  columns_.push_back(std::move(values));
  return columns_.size() - 1;
}

Panel::Column Panel::add(const Value& value) { return keep(built(value)); }

Panel::Column Panel::add_within(const Value& value, std::span<const Column> without) {
  Values values = built(value);
  const auto count = static_cast<Eigen::Index>(without.size());
  for (const Stretch& rows : rows_) {
    const auto size = static_cast<Eigen::Index>(rows.end - rows.first);
    if (size <= count) {
      continue;
    }
    Eigen::MatrixXd by(size, count);
    Eigen::VectorXd of(size);
    for (Eigen::Index n = 0; n < size; ++n) {
      const std::size_t row = rows.first + static_cast<std::size_t>(n);
      const double root = std::sqrt(weight_[row]);
      for (Eigen::Index c = 0; c < count; ++c) {
        by(n, c) = root * columns_[without[static_cast<std::size_t>(c)]][row];
      }
      of(n) = root * values[row];
    }
    const Eigen::VectorXd theta = by.completeOrthogonalDecomposition().solve(of);
    for (std::size_t row = rows.first; row < rows.end; ++row) {
      for (Eigen::Index c = 0; c < count; ++c) {
        values[row] -= theta(c) * columns_[without[static_cast<std::size_t>(c)]][row];
      }
    }
  }
  return keep(std::move(values));
}

Values Panel::weights_of(std::span<const Column> by, const Values& products) const {
  const auto count = static_cast<Eigen::Index>(by.size());
  Eigen::MatrixXd gram(count, count);
  Eigen::VectorXd right(count);
  Eigen::VectorXd scale(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double square = products_[by[static_cast<std::size_t>(i)]].back();
    scale(i) = square > 0.0 ? 1.0 / std::sqrt(square) : 0.0;
    right(i) = scale(i) * products[static_cast<std::size_t>(i)];
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      const Column a = std::max(by[static_cast<std::size_t>(i)], by[static_cast<std::size_t>(j)]);
      const Column b = std::min(by[static_cast<std::size_t>(i)], by[static_cast<std::size_t>(j)]);
      gram(i, j) = scale(i) * scale(j) * products_[a][b];
    }
  }
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(count, count);
  solver.setThreshold(rank_tolerance);
  solver.compute(gram);
  const Eigen::VectorXd theta = scale.cwiseProduct(solver.solve(right));
  return {theta.data(), theta.data() + count};
}

// A signature without what the other columns explain of it.
struct Panel::Left {
  Values weighted;  // W M s
  Values signature;
  double square = 0.0;  // s' M W M s; 0 where too little is left
};

Panel::Left Panel::left_of(Column signature, std::span<const Column> without) const {
  Values products;
  for (const Column c : without) {
    products.push_back(products_[std::max(c, signature)][std::min(c, signature)]);
  }
  const Values theta = weights_of(without, products);
  Left left;
  left.signature = columns_[signature];
  for (std::size_t i = 0; i < without.size(); ++i) {
    for (std::size_t n = 0; n < weight_.size(); ++n) {
      left.signature[n] -= theta[i] * columns_[without[i]][n];
    }
  }
  left.weighted.resize(weight_.size());
  for (std::size_t n = 0; n < weight_.size(); ++n) {
    left.weighted[n] = weight_[n] * left.signature[n];
    left.square += left.weighted[n] * left.signature[n];
  }
  const double own = products_[signature].back();
  if (!(left.square > least_left * own) || !std::isfinite(left.square)) {
    left.square = 0.0;
  }
  return left;
}

std::optional<Contrast> Panel::partial(ContrastKind kind, std::span<const Column> signatures,
                                       std::span<const Column> without, Null null) const {
  std::vector<Left> lefts;
  const Left* best = nullptr;
  double most = -1.0;
  const auto explained = [](double score, const Left& left) { return score * score / left.square; };
  for (const Column signature : signatures) {
    Left left = left_of(signature, without);
    if (left.square > 0.0) {
      lefts.push_back(std::move(left));
    }
  }
  for (const Left& left : lefts) {
    double score = 0.0;
    for (std::size_t n = 0; n < weight_.size(); ++n) {
      score += left.weighted[n] * response_[n];  // `weighted` is orthogonal to all that is left out
    }
    if (explained(score, left) > most) {
      most = explained(score, left);
      best = &left;
    }
  }
  if (best == nullptr) {
    return std::nullopt;
  }
  Values products;
  for (const Column c : without) {
    products.push_back(with_response_[c]);
  }
  const Values theta = weights_of(without, products);
  Values left_response = response_;
  for (std::size_t i = 0; i < without.size(); ++i) {
    for (std::size_t n = 0; n < weight_.size(); ++n) {
      left_response[n] -= theta[i] * columns_[without[i]][n];
    }
  }
  // Sums over recordings and half-cycles; values are scores over weights.
  std::vector<Part> recordings;
  std::vector<Part> blocks;
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    Part whole{tracks_[k].recording, 0.0, 0.0, tracks_[k].motion};
    Part block = whole;
    const auto close = [&] {
      if (block.weight > 0.0) {
        whole.weight += block.weight;
        whole.value += block.value;
        block.value /= block.weight;
        blocks.push_back(block);
      }
      block = {tracks_[k].recording, 0.0, 0.0, tracks_[k].motion};
    };
    for (std::size_t n = rows_[k].first; n < rows_[k].end; ++n) {
      if (n > rows_[k].first && block_[n] != block_[n - 1]) {
        close();
      }
      block.weight += best->weighted[n] * best->signature[n];
      block.value += best->weighted[n] * left_response[n];
    }
    close();
    if (whole.weight > 0.0) {
      whole.value /= whole.weight;
      recordings.push_back(whole);
    }
  }
  std::optional<Contrast> result = pooled(kind, recordings, blocks);
  if (!result) {
    return std::nullopt;
  }
  const bool whole = effective_number(recordings) >= fewest_flips;
  Values of_placebos;
  for (std::size_t p = 0; p < placebos_; ++p) {
    double largest = 0.0;
    for (const Left& left : lefts) {
      double score = 0.0;
      for (std::size_t k = 0; k < tracks_.size(); ++k) {
        const std::size_t first = rows_[k].first;
        const std::size_t end = rows_[k].end;
        if (null == Null::flip) {
          for (std::size_t n = first; n < end; ++n) {
            score += placebo_sign(p, k, whole ? 0 : block_[n]) * left.weighted[n] * left_response[n];
          }
          continue;
        }
        const std::size_t shift = placebo_shift(p, k, end - first, period_[k]);
        double sum = 0.0;
        for (std::size_t n = first; n < end - shift; ++n) {
          sum += left.weighted[n] * left_response[n + shift];
        }
        for (std::size_t n = end - shift; n < end; ++n) {
          sum += left.weighted[n] * left_response[n + shift - (end - first)];
        }
        // A shift within a recording leaves its mean; the sign does not.
        score += placebo_sign(p, k, 0) * sum;
      }
      largest = std::max(largest, explained(score, left));
    }
    of_placebos.push_back(largest);
  }
  judge(*result, most, of_placebos);
  return result;
}

}  // namespace hysteron::contrast
