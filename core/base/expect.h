// The always-on assertion. A broken invariant is a programming error, never the user's error.
#pragma once

#include <source_location>
#include <stdexcept>
#include <string>

namespace dmpc::core {

/// A broken invariant inside dmpc. The command line maps it to exit status 3, distinct from bad input.
struct InternalError : std::logic_error {
  using std::logic_error::logic_error;
};

/// Bad input. The message names what, where (file, line, option), what was expected and what to do. Exit status 1.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Valid input that needs more memory than this computer, the nodes or a database have. Exit status 4.
struct CapacityError : InputError {
  using InputError::InputError;
};

/// Wrong use of the command line (for example, options that exclude each other). Exit status 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] inline void fail(const char* sentence, const std::source_location& where) {
  throw InternalError(std::string(where.file_name()) + ":" + std::to_string(where.line()) + ": expected that " + sentence);
}

/// Throws InternalError unless `condition` holds; `sentence` states the invariant. Enabled in every build.
inline void expect(bool condition, const char* sentence, const std::source_location& where = std::source_location::current()) {
  if (!condition) [[unlikely]] {
    fail(sentence, where);
  }
}

}  // namespace dmpc::core
