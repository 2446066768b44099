// Steps of which none that fails keeps the next from its turn, so that a file that cannot be written takes no other with it.
#pragma once

#include <exception>
#include <functional>
#include <iosfwd>

namespace dmpc::apps {

/// Not thread-safe.
class Attempts {
 public:
  /// What fails for bad input is said on `messages`, which outlives it, a line each.
  explicit Attempts(std::ostream& messages) : messages_(messages) {}

  /// Calls `step`; whether it came to its end. An Interrupted passes; a broken pipe, of which nobody reads, is not said.
  bool make(const std::function<void()>& step);

  /// The exit status after all of them. Throws what was no bad input, or a broken pipe, if there was such a thing.
  int status() const;

 private:
  std::ostream& messages_;
  bool has_failed_ = false;
  std::exception_ptr unsaid_;
};

}  // namespace dmpc::apps
