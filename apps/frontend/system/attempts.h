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
  /// Errors of bad input, or resource exhaustion, are printed to `messages`, which outlives it, a line each, with the program's
  /// name.
  explicit Attempts(std::ostream& messages, std::string name = "dmpc") : messages_(messages), name_(std::move(name)) {}

  /// Calls `step`; returns whether it succeeded. An Interrupted passes through; a broken pipe, which has no reader, is not
  /// printed.
  bool make(const std::function<void()>& step);

  /// The exit status of the first failed step. Rethrows an error of another kind than bad input and resource exhaustion, or a
  /// broken pipe, if there was one.
  int status() const;

 private:
  void say(const std::exception& error, int status);

  std::ostream& messages_;
  std::string name_;
  int status_ = 0;
  std::exception_ptr unsaid_;
};

}  // namespace dmpc::apps
