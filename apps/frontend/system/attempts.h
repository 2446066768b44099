// Steps of which none that fails keeps the next from its turn, so that a file that cannot be written takes no other with it.
#pragma once

#include <exception>
#include <functional>
#include <iosfwd>
#include <string>
#include <utility>

namespace dmpc::apps {

/// Not thread-safe.
class Attempts {
 public:
  /// What fails for bad input, or for want of room, is said on `messages`, which outlives it, a line each, by the program's name.
  explicit Attempts(std::ostream& messages, std::string name = "dmpc") : messages_(messages), name_(std::move(name)) {}

  /// Calls `step`; whether it came to its end. An Interrupted passes; a broken pipe, of which nobody reads, is not said.
  bool make(const std::function<void()>& step);

  /// The exit status after all of them: that of the first that failed. Throws what was neither bad input nor want of room, or a
  /// broken pipe, if there was such a thing.
  int status() const;

 private:
  void say(const std::exception& error, int status);

  std::ostream& messages_;
  std::string name_;
  int status_ = 0;
  std::exception_ptr unsaid_;
};

}  // namespace dmpc::apps
