// What dmpc can be told to do: one row a command.
#pragma once

#include <any>
#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <utility>

#include "apps/edge/line/command_line.h"
#include "apps/edge/system/interrupt.h"

namespace dmpc::apps {

/// A command with its options, as a line asks for it.
class Command {
 public:
  /// Returns the exit status; what it prints goes to the stream.
  using Run = std::function<int(Interrupt&, std::ostream&)>;

  Command(std::any options, bool is_quiet, Run run) : options_(std::move(options)), is_quiet_(is_quiet), run_(std::move(run)) {}

  /// Throws as the command itself does.
  int run(Interrupt& interrupt, std::ostream& output) const { return run_(interrupt, output); }
  /// Whether progress is not wanted.
  bool is_quiet() const { return is_quiet_; }
  /// Requires that the command's options are of this type; HelpText where help is asked for.
  template <class Options>
  Options options() const {
    return std::any_cast<Options>(options_);
  }

 private:
  std::any options_;
  bool is_quiet_;
  Run run_;
};

/// `arguments` without the program's name. Throws core::UsageError, whose message ends with a hint at the right --help, for
/// anything wrong that can be seen without reading a file.
Command parse_command_line(std::span<const std::string> arguments);

/// All commands with all options, as parse_command_line() takes them.
CommandDescription describe_command_line();

}  // namespace dmpc::apps
