// Which cases a generator of tests has made, and how often what an invariant speaks of was there: a test that is blind to
// something says so.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <map>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace dmpc::tests {

/// Counts by name. Not thread-safe.
class Coverage {
 public:
  /// `generator` stands before each of its lines.
  explicit Coverage(std::string generator) : generator_(std::move(generator)) {}

  /// One more case that is of this kind, or is not: a kind that is asked for and never comes is one at 0.
  void count(const std::string& kind, bool is_of_kind = true) { counts_[kind] += is_of_kind ? 1 : 0; }

  /// The kinds that never came, except for what is called so: threads may come to it now and not then.
  std::vector<std::string> blind_spots(const std::string& but_for = "\n") const {
    std::vector<std::string> kinds;
    for (const auto& [kind, number] : counts_) {
      if (number == 0 && !kind.starts_with(but_for)) {
        kinds.push_back(kind);
      }
    }
    return kinds;
  }

  /// What is not as it should be of the seeds that a test chose: its blind spots, where these are enough for all kinds. Where
  /// somebody else has chosen them, by this variable of the environment, the counts are printed for who sums them up, and nothing
  /// is.
  std::vector<std::string> missed(const char* seeds_variable, bool are_enough, const std::string& but_for = "\n") const {
    if (std::getenv(seeds_variable) != nullptr) {
      print(std::cout);
      return {};
    }
    return are_enough ? blind_spots(but_for) : std::vector<std::string>();
  }

  /// A line each, as tests/covered sums them up: "covered: forest: threads: 28".
  void print(std::ostream& output) const {
    for (const auto& [kind, number] : counts_) {
      output << "covered: " << generator_ << ": " << kind << ": " << number << '\n';
    }
    output.flush();
  }

 private:
  std::string generator_;
  std::map<std::string, std::uint64_t> counts_;
};

}  // namespace dmpc::tests
