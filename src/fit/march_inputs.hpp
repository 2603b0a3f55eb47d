// The drive that acts in place of the recorded one.
#pragma once

#include <array>
#include <vector>

#include "simulate/composite.hpp"

namespace hysteron {

// The effects that change the drive before the laws of the parameters are evaluated (PartOperations::recall and
// ::excite), in time order over the samples of a recording.
template <class T>
class MarchInputs {
 public:
  explicit MarchInputs(const CompositeModel& model) {
    model.for_links([this](const Link& link) {
      const PartOperations<T>& part = link.part->on<T>();
      // Outermost first, but what recalls the recording before all.
      if (part.recall != nullptr) recalls_.insert(recalls_.begin(), {part.recall, link.parameter});
      if (part.excite != nullptr) parts_.insert(parts_.begin(), {part.excite, link.parameter, {}});
    });
  }
  [[nodiscard]] bool none() const { return recalls_.empty() && parts_.empty(); }
  // Drive that acts at a sample whose parameters at the recorded drive are p.
  T act(const Command& command, const T* p) {
    T result(command.drive[command.at]);
    for (const Recall& part : recalls_) {
      part.recall(p + part.parameter, command, result);
    }
    for (Step& part : parts_) {
      part.excite(p + part.parameter, part.memory.data(), command.elapsed(), result);
    }
    return result;
  }

 private:
  struct Recall {
    decltype(PartOperations<T>::recall) recall;
    std::size_t parameter;
  };
  struct Step {
    decltype(PartOperations<T>::excite) excite;
    std::size_t parameter;
    std::array<T, excitation_memory> memory;
  };
  std::vector<Recall> recalls_;
  std::vector<Step> parts_;
};

}  // namespace hysteron
