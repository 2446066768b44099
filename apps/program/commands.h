// The commands of dmpc, declared row by row, and a command as given on a line.
#pragma once

#include <any>
#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/ranks/launcher.h"
#include "apps/frontend/ranks/rank_group.h"
#include "apps/frontend/run/runner_kind.h"
#include "apps/frontend/system/interrupt.h"

namespace dmpc::apps {

/// A command with its options, as a line asks for it.
class Command {
 public:
  /// Returns the exit status; what it prints goes to the stream.
  using Run = std::function<int(Interrupt&, std::ostream&)>;

  Command(std::any options, bool is_quiet, Run run) : options_(std::move(options)), is_quiet_(is_quiet), run_(std::move(run)) {}

  /// Sentences about the line, which are printed when it is run.
  void set_notes(const std::vector<std::string>& notes) { notes_ = notes; }
  /// Throws as the command itself does.
  int run(Interrupt& interrupt, std::ostream& output) const;
  /// Whether progress is not wanted.
  bool is_quiet() const { return is_quiet_; }
  bool asks_for_help() const { return options_.type() == typeid(HelpText); }
  /// Requires that the command's options are of this type; HelpText where help is asked for.
  template <class Options>
  Options options() const {
    return std::any_cast<Options>(options_);
  }

 private:
  std::any options_;
  std::vector<std::string> notes_;
  bool is_quiet_;
  Run run_;
};

/// All commands of a program, declared, and what a line sets.
class Commands {
 public:
  /// Adds rows.
  using Declare = void (*)(Commands&);

  using Words = std::set<std::string, std::less<>>;

  /// With all their options, and what completes them; or, of those commands alone that `line` may name, with their options: to
  /// declare all takes longer than anything else that a short command does.
  explicit Commands(Declare declare, std::optional<Words> line = {});
  // Options are bound to the members.
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;

  CommandLine& line() { return line_; }

  /// What was set for the command that the line names.
  Command named(const std::string& name) const;

  /// The commands added from now on are words behind this one.
  void begin(const std::string& name, const std::string& description);
  /// `run` takes the options, Interrupt& unless it is done at once, and the std::ostream& that it prints to.
  template <class Options, class Run>
  void add(const std::string& name, const std::string& description, Options defaults, Run run);

 private:
  void declare_help();
  void declare_values();
  /// What `dmpc help` with the words given prints. Throws core::UsageError for a topic that there is none.
  HelpText help_about(const std::vector<std::string>& topic) const;

  Declare declare_;
  std::optional<Words> line_words_;  ///< nothing: any
  CommandLine line_;
  std::optional<std::pair<std::string, OptionSet>> group_;  ///< group of the commands being added
  std::map<std::string, std::function<Command()>> rows_;    ///< by the words of a line that name them
  std::vector<std::string> topic_;                          ///< topic of `help`
  Suggestion topics_;                                       ///< that `help` explains
};

template <class Options>
bool is_quiet(const Options& options) {
  if constexpr (requires { options.quiet; }) {
    return options.quiet;
  }
  return false;
}

/// Whether it is for all the processes that a launcher has started.
template <class Options>
bool runs_on_ranks(const Options& options) {
  if constexpr (requires { options.runner.kind; }) {
    return options.runner.kind == RunnerKind::mpi;
  }
  return false;
}

template <class Options, class Run>
void Commands::add(const std::string& name, const std::string& description, Options defaults, Run run) {
  const auto options = std::make_shared<Options>(std::move(defaults));
  const OptionSet declared = group_ ? group_->second.add_command(name, description) : line_.add_command(name, description);
  if (!line_words_ || line_words_->contains(name)) {
    add_options(declared, *options);
  }
  rows_[(group_ ? group_->first : "") + name] = [options, run] {
    return Command(*options, is_quiet(*options), [options, run](Interrupt& interrupt, std::ostream& output) {
      if (!runs_on_ranks(*options)) {
        with_words_agreed([] { expect_one_process("render together: dmpc render --runner=mpi"); });
      }
      if constexpr (std::is_invocable_v<Run, const Options&, std::ostream&>) {
        return run(*options, output);
      } else {
        return run(*options, interrupt, output);
      }
    });
  };
  if (!group_) {
    topics_.words.push_back(name);
  }
}

/// `arguments` without the program's name. Throws core::UsageError, whose message ends with a hint at the right --help, for
/// anything wrong that can be seen without reading a file.
Command parse_command_line(Commands::Declare declare, std::span<const std::string> arguments);

/// The commands of the renderer itself.
void declare_renderer(Commands& commands);

}  // namespace dmpc::apps
