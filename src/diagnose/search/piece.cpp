// Pieces of a workbench's work, kept so that a rerun resumes where this run may be ended.
#include "diagnose/search/workbench.hpp"
#include "io/sha256.hpp"

namespace hysteron {
namespace {

void add_recording(ByteWriter& key, const Recording& recording) {
  key.text(recording.file);
  for (const std::vector<double>* channel :
       {&recording.time, &recording.displacement, &recording.velocity, &recording.force, &recording.acceleration,
        &recording.derived_acceleration, &recording.drive, &recording.temperature}) {
    key.numbers(*channel);
  }
  for (const ConditionChannel& condition : recording.conditions) {
    key.text(condition.name);
    key.numbers(condition.values);
  }
  for (const EarlierWork& stretch : recording.earlier) {
    key.number(stretch.ago);
    key.number(stretch.work);
  }
  key.whole(static_cast<std::uint64_t>(recording.drive_kind));
  key.whole(recording.velocity_measured ? 1 : 0);
  key.whole(static_cast<std::uint64_t>(recording.start));
}

void add_options(ByteWriter& key, const ObjectiveOptions& options) {
  key.whole(static_cast<std::uint64_t>(options.normalisation));
  key.whole(static_cast<std::uint64_t>(options.weighting));
  key.number(options.tolerance);
  key.whole(options.comparing ? 1 : 0);
  key.whole(options.skip_run_in ? 1 : 0);
}

}  // namespace

void add_recordings(ByteWriter& key, const std::vector<Recording>& recordings) {
  key.whole(recordings.size());
  for (const Recording& recording : recordings) {
    add_recording(key, recording);
  }
}

void add_layout(ByteWriter& key, const Layout& layout) {
  key.text(layout.model().law->id);
  key.whole(layout.model().effects.size());
  for (const Part* effect : layout.model().effects) {
    key.text(effect->id);
  }
  key.numbers(layout.held());
  key.whole(layout.dimension());
  for (const Coordinate& coordinate : layout.coordinates()) {
    key.whole(coordinate.parameter);
    key.whole(coordinate.node);
    key.whole(static_cast<std::uint64_t>(coordinate.scale));
    key.number(coordinate.lower);
    key.number(coordinate.upper);
    key.whole(coordinate.linear ? 1 : 0);
  }
  for (const ParameterLaw& law : layout.laws()) {
    key.numbers(law.drive_nodes);
    key.numbers(law.frequency_nodes);
    for (const std::vector<double>& nodes : law.condition_nodes) {
      key.numbers(nodes);
    }
  }
}

void add_fit(ByteWriter& key, const Fit& fit) {
  add_layout(key, *fit.layout);
  key.numbers(fit.point);
}

void add_parameters(ByteWriter& key, const Fit& fit) {
  add_layout(key, *fit.layout);
  for (const Term& term : fit.terms) {
    key.whole(term.parameter);
    key.whole(static_cast<std::uint64_t>(term.drive_power));
    key.whole(static_cast<std::uint64_t>(term.frequency_power));
    key.number(term.value);
    for (const int power : term.condition_powers) {
      key.whole(static_cast<std::uint64_t>(power));
    }
  }
}

void Workbench::keep_in(Checkpoint& checkpoint) {
  checkpoint_ = &checkpoint;
  ByteWriter all;
  add_recordings(all, split_->fit);
  all.whole(split_->judge.size());
  for (const Judged& judged : split_->judge) {
    add_recording(all, judged.recording);
    all.whole(judged.from);
  }
  for (const NoiseFloor& noise : noise_) {
    all.number(noise.sigma);
    all.number(noise.white);
    all.number(noise.cycles);
    all.whole(static_cast<std::uint64_t>(noise.method));
    all.whole(noise.rounded ? 1 : 0);
  }
  add_options(all, options_);
  all.whole(seed_);
  identity_ = sha256_hex(all.bytes());
}

std::string Workbench::key_of(const ByteWriter& key) const { return sha256_hex(identity_ + key.bytes()); }

bool Workbench::has_piece(const ByteWriter& key) const {
  return checkpoint_ != nullptr && checkpoint_->find(key_of(key)).has_value();
}

std::string Workbench::piece(const ByteWriter& key, const std::function<std::string()>& work) const {
  if (checkpoint_ == nullptr) {
    return work();
  }
  const std::string name = key_of(key);
  if (std::optional<std::string> known = checkpoint_->find(name)) {
    return *std::move(known);
  }
  std::string bytes = work();
  // What was stopped ended before its end.
  if (!stopped_()) {
    checkpoint_->keep(name, bytes);
  }
  return bytes;
}

Fit Workbench::fit_piece(const ByteWriter& key, const Hypothesis& what, const Layout& layout,
                         const std::function<Fit()>& work) const {
  const std::string bytes = piece(key, [&] {
    const Fit fit = work();
    ByteWriter result;
    result.numbers(fit.point);
    result.number(fit.cost);
    result.number(fit.heldout);
    return result.bytes();
  });
  ByteReader read(bytes);
  Fit fit;
  fit.what = what;
  fit.layout = std::make_shared<const Layout>(layout);
  fit.point = read.numbers();
  fit.terms = layout.terms(fit.point);
  fit.cost = read.number();
  fit.heldout = read.number();
  return fit;
}

}  // namespace hysteron
