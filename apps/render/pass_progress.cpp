#include "apps/render/pass_progress.h"

#include <algorithm>

namespace dmpc::apps {

std::string PassProgress::label() const {
  return "Pass " + std::to_string(pass_) + " of at most " + std::to_string(passes_max_) + ":";
}

void PassProgress::update(std::uint32_t done, std::uint32_t total) {
  const bool is_next = total_ != 0 && (done < done_ || total != total_);
  pass_ = std::min(pass_ + (is_next ? 1 : 0), passes_max_);
  done_ = done;
  total_ = total;
  share_ = (pass_ - 1 + static_cast<double>(done) / total) / passes_max_;
  constexpr std::uint64_t steps = 1'000'000;
  progress_.show(label(), static_cast<std::uint64_t>(share_ * steps), steps);
}

}  // namespace dmpc::apps
