#include "apps/lab/study/systems/search.h"

#include <utility>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/line/words.h"
#include "core/base/expect.h"

namespace dmpc::apps {

Search::Search(std::vector<SearchedOption> options) : options_(std::move(options)), best_(options_.size(), 0) {
  wanted_ = {best_};
}

void Search::want_next_option() {
  wanted_.clear();
  for (; wanted_.empty() && next_option_ < options_.size(); ++next_option_) {
    for (std::size_t value = 1; value < options_[next_option_].values.size(); ++value) {
      wanted_.push_back(best_);
      wanted_.back()[next_option_] = value;
    }
  }
}

void Search::take(const std::vector<std::optional<double>>& seconds) {
  core::expect(seconds.size() == wanted_.size(), "every setting of a search has its time");
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    const bool is_default = steps_.empty();
    const std::size_t option = is_default ? 0 : next_option_ - 1;
    steps_.push_back(is_default ? SearchStep{"", "", seconds[i]}
                                : SearchStep{options_[option].name, options_[option].values[wanted_[i][option]], seconds[i]});
    if (seconds[i] && (!seconds_ || *seconds[i] < *seconds_)) {
      seconds_ = seconds[i];
      best_ = wanted_[i];
    }
  }
  want_next_option();
}

std::string Search::steps_text() const {
  return joined(steps_, ", ", [](const SearchStep& step) {
    return (step.option.empty() ? "defaults" : step.option + " " + step.value) + " " +
           (step.seconds ? amount_text(*step.seconds, "s") : "no room");
  });
}

}  // namespace dmpc::apps
