// Steps that run independently of each other's failures, so that a file that cannot be written does not prevent others.
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
  /// Errors of bad input and of resource exhaustion are printed to `messages`, which outlives it, one line each, with the
  /// program's name.
  explicit Attempts(std::ostream& messages, std::string name = "dmpc") : messages_(messages), name_(std::move(name)) {}

  /// Calls `step` and returns whether it succeeded. Interrupted passes through; a broken pipe, which has no reader, is not
  /// printed.
  bool make(const std::function<void()>& step);

  /// Returns the exit status of the first failed step. Rethrows a broken pipe, or an error other than bad input and resource
  /// exhaustion, if there was one.
  int status() const;

 private:
  void say(const std::exception& error, int status);

  std::ostream& messages_;
  std::string name_;
  int status_ = 0;
  std::exception_ptr unsaid_;
};

}  // namespace dmpc::apps
