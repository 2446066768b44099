// The always-on assertion: a broken invariant is the programmer's error, never the user's.
#pragma once

#include <source_location>
#include <stdexcept>
#include <string>

namespace dmpc::core {

/// A broken invariant inside dmpc. The command line turns it into exit status 3; it never looks like bad input.
struct InternalError : std::logic_error {
  using std::logic_error::logic_error;
};

/// Bad input: the message names what, where (file, line, option), what was expected and what to do. Exit status 1.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Input that would do if there were more room: on this computer, in the nodes' memory, or in a database. Exit status 4.
struct CapacityError : InputError {
  using InputError::InputError;
};

/// Wrong use of the command line (options that do not go together). Exit status 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] inline void fail(const char* sentence, const std::source_location& where) {
  throw InternalError(std::string(where.file_name()) + ":" + std::to_string(where.line()) + ": expected that " + sentence);
}

/// Throws InternalError unless `condition` holds; `sentence` states the invariant. On in every build.
inline void expect(bool condition, const char* sentence, const std::source_location& where = std::source_location::current()) {
  if (!condition) [[unlikely]] {
    fail(sentence, where);
  }
}

}  // namespace dmpc::core
