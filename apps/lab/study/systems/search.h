// A coordinate descent: one option after the other, each value tried with the best so far of all others; one round.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace dmpc::apps {

struct SearchedOption {
  std::string name;
  std::vector<std::string> values;  ///< from the default on, which the search begins with
};

/// A setting that was tried.
struct SearchStep {
  std::string option, value;  ///< empty for the defaults
  std::optional<double> seconds;
};

/// Not thread-safe.
class Search {
 public:
  /// By option the index of its value.
  using Setting = std::vector<std::size_t>;

  explicit Search(std::vector<SearchedOption> options);

  /// The settings to be timed next; empty at the end.
  const std::vector<Setting>& wanted() const { return wanted_; }
  /// Their times in that order; nothing for one that does not fit. A new value must be faster.
  void take(const std::vector<std::optional<double>>& seconds);

  const std::vector<SearchedOption>& options() const { return options_; }
  const Setting& best() const { return best_; }
  /// Nothing while no setting fits.
  std::optional<double> seconds() const { return seconds_; }
  const std::vector<SearchStep>& steps() const { return steps_; }
  /// "defaults 3.10 ms, page-size 4KiB 2.00 ms, in-flight 1 no room".
  std::string steps_text() const;

 private:
  void want_next_option();

  std::vector<SearchedOption> options_;
  std::size_t next_option_ = 0;
  std::vector<Setting> wanted_;
  Setting best_;
  std::optional<double> seconds_;
  std::vector<SearchStep> steps_;
};

}  // namespace dmpc::apps
