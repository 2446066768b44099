// Commands and their options: declared, parsed and explained.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "apps/frontend/line/command_description.h"

namespace dmpc::apps {

struct DeclaredCommand;

/// The request of `--help` or `--version`.
struct HelpText {
  std::string text;
};

/// Declares the options of one command. A handle that can be copied freely; it belongs to a CommandLine that outlives it. Options
/// are named as the user types them, "--nodes" or "-o,--output". The variable that an option sets, or `take`, must live until the
/// line is parsed; `take` may throw core::UsageError.
class OptionSet {
 public:
  using TakeText = std::function<void(const std::string&)>;
  using TakeNumber = std::function<void(std::int64_t)>;
  template <class T>
  using Choices = std::vector<std::pair<std::string, T>>;

  /// Declares a subcommand; the user must give one of them. Its own options follow its name.
  OptionSet add_command(const std::string& name, const std::string& description);
  /// Groups the options added from now on in the help, under `title`.
  void begin_group(const std::string& title);
  /// A mandatory positional argument; help calls it `name`.
  void add_argument(const std::string& name, const TakeText& take, const std::string& description);
  /// Any number of positional arguments, or none; `take` is called for each in order.
  void add_arguments(const std::string& name, const TakeText& take, const std::string& description);
  /// A mandatory option with a text; help shows its value as `shown`.
  void add_required(const std::string& name, const std::string& shown, const TakeText& take, const std::string& description);
  /// An option with a text; help shows its value as `shown`.
  void add_text(const std::string& name, const std::string& shown, const TakeText& take, const std::string& description);
  /// An option with a text that may be given several times; `take` is called for each text in order.
  void add_texts(const std::string& name, const std::string& shown, const TakeText& take, const std::string& description);
  void add_path(const std::string& name, const std::string& shown, std::optional<std::filesystem::path>& path,
                const std::string& description);
  void add_flag(const std::string& name, bool& flag, const std::string& description);
  /// A flag with an optional "=" and a text; `value` becomes that text, or `standard` without one, and is unchanged without the
  /// flag.
  void add_flag_with_text(const std::string& name, const std::string& standard, std::string& value,
                          const std::string& description);
  /// --quiet, for a command that prints nothing unasked but its progress.
  void add_quiet(bool& quiet);
  /// An option that takes one of `words`, or several separated by commas, and may be given several times.
  void add_words(const std::string& name, const std::vector<std::string>& words, const TakeText& take,
                 const std::string& description);

  /// An option whose values are words, one for each T; help shows `shown_default` as its default. `Field` is T or
  /// std::optional<T>.
  template <class T, class Field>
  void add_choice(const std::string& name, Field& value, const Choices<T>& choices, const std::string& shown_default,
                  const std::string& description);
  /// Adds a choice whose default is the current `value`.
  template <class T>
  void add_choice(const std::string& name, T& value, const Choices<T>& choices, const std::string& description);
  /// Values that are no words: help shows them as `shown`, and `take` returns whether a text is one, which it takes.
  struct Others {
    std::string shown;
    std::function<bool(const std::string&)> take;
  };
  /// Adds such a choice that may be another value.
  template <class T>
  void add_choice(const std::string& name, T& value, const Choices<T>& choices, const Others& others,
                  const std::string& description);

  /// An option whose values are integers from `least` to `most`; help shows `shown_default` as its default.
  template <class Field>
  void add_number(const std::string& name, Field& value, std::int64_t least, std::int64_t most, const std::string& shown_default,
                  const std::string& description);

  /// Sets the end of the help; without it, the end of the parent command's help is shown.
  void set_examples(const std::string& text);
  /// Sets what --help shows; --help=all shows everything.
  void set_brief_help(const std::vector<BriefGroup>& groups);
  /// Called when all options of a line with this command are read, after earlier checks; may throw core::UsageError.
  void check_in_the_end(const std::function<void()>& check);
  /// Whether the user gave the option, if it is one of this command; for check_in_the_end().
  bool is_given(const std::string& name) const;
  /// The options given, as --name=value, without those named here; for check_in_the_end().
  std::vector<std::string> given_words(const std::vector<std::string>& but) const;

 private:
  friend class CommandLine;

  explicit OptionSet(DeclaredCommand& command) : command_(&command) {}

  template <class T, class Field>
  void add_choice_as(const std::string& name, Field& value, const Choices<T>& choices, const std::string& shown_default,
                     const std::string& description, const Others& others);
  void add_words_as(const std::string& name, const std::vector<std::string>& words, const std::string& shown_default,
                    const TakeText& take, const std::string& description, const Others& others = {});
  void add_number_as(const std::string& name, std::int64_t least, std::int64_t most, const std::string& shown_default,
                     const TakeNumber& take, const std::string& description);

  DeclaredCommand* command_;
};

/// All commands of the program. Parses one line.
class CommandLine {
 public:
  CommandLine(const std::string& description, const std::string& version, const std::string& examples,
              const std::string& program = "dmpc");
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// The options of a program without commands.
  OptionSet own_options();
  /// Declares a command and returns its options.
  OptionSet add_command(const std::string& name, const std::string& description);

  /// Sets the variables of the given command's options, and returns its name, "study balance" for a subcommand; or help. Call it
  /// once, with `arguments` without the program's name. Throws core::UsageError, whose message ends with a hint at the right
  /// --help, as read_line() (typed_line.h) and the `take` functions do.
  std::variant<HelpText, std::string> parse(std::span<const std::string> arguments);

  /// Sentences about values of the line that was parsed, such as one that is called otherwise now.
  const std::vector<std::string>& notes() const { return notes_; }

  /// What --help prints about a command, {"study", "balance"}, or about the program.
  std::string help(const std::vector<std::string>& command, bool asks_for_all) const;

  /// An argument whose value stands for options, too, each as --name=value. They take effect if the command has them and the
  /// user does not give them; given(name) are the values that the user gives.
  struct Standing {
    using Given = std::function<std::vector<std::string>(const std::string&)>;
    std::string argument;
    std::function<std::vector<std::string>(const std::string& value, const Given& given)> words_of;
  };
  void stand_for_options(const Standing& standing) { standing_ = standing; }

  /// Sets the suggestion for a value that help calls `name`, up to its first dot: "FILE" for "FILE.nff [stdout]" and "SIZE|FILE".
  void suggest(const std::string& name, const Suggestion& suggestion);
  /// Everything declared so far.
  CommandDescription describe() const;

 private:
  std::unique_ptr<DeclaredCommand> program_;
  std::string version_;
  Suggestions suggestions_;
  std::vector<std::string> notes_;
  std::optional<Standing> standing_;
};

template <class T, class Field>
void OptionSet::add_choice(const std::string& name, Field& value, const Choices<T>& choices, const std::string& shown_default,
                           const std::string& description) {
  add_choice_as<T>(name, value, choices, shown_default, description, {});
}

template <class T>
void OptionSet::add_choice(const std::string& name, T& value, const Choices<T>& choices, const std::string& description) {
  add_choice<T>(name, value, choices, Others{}, description);
}

template <class T>
void OptionSet::add_choice(const std::string& name, T& value, const Choices<T>& choices, const Others& others,
                           const std::string& description) {
  std::string standard;
  for (const auto& [word, meaning] : choices) {
    standard = meaning == value ? word : standard;
  }
  add_choice_as<T>(name, value, choices, standard, description, others);
}

template <class T, class Field>
void OptionSet::add_choice_as(const std::string& name, Field& value, const Choices<T>& choices, const std::string& shown_default,
                              const std::string& description, const Others& others) {
  std::vector<std::string> words;
  for (const auto& [word, meaning] : choices) {
    words.push_back(word);
  }
  const auto take = [&value, choices](const std::string& text) {
    for (const auto& [word, meaning] : choices) {
      if (word == text) {
        value = meaning;
      }
    }
  };
  add_words_as(name, words, shown_default, take, description, others);
}

template <class Field>
void OptionSet::add_number(const std::string& name, Field& value, std::int64_t least, std::int64_t most,
                           const std::string& shown_default, const std::string& description) {
  const auto take = [&value](std::int64_t number) {
    if constexpr (requires { typename Field::value_type; }) {
      value = static_cast<typename Field::value_type>(number);
    } else {
      value = static_cast<Field>(number);
    }
  };
  add_number_as(name, least, most, shown_default, take, description);
}

}  // namespace dmpc::apps
