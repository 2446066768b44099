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

/// What `--help` or `--version` asks for.
struct HelpText {
  std::string text;
};

/// The options of one command. A handle, to be copied freely; it belongs to a CommandLine that outlives it. Options are called
/// as the user types them, "--nodes" or "-o,--output". What an option is to set, or `take`, must live until the line is parsed;
/// `take` may throw core::UsageError.
class OptionSet {
 public:
  using TakeText = std::function<void(const std::string&)>;
  using TakeNumber = std::function<void(std::int64_t)>;
  template <class T>
  using Choices = std::vector<std::pair<std::string, T>>;

  /// A command of this command, to be declared: one of them must be given. Its own options follow its name.
  OptionSet add_command(const std::string& name, const std::string& description);
  /// The options added from now on stand together in the help, under `title`.
  void begin_group(const std::string& title);
  /// A word without an option's name that must be given; help calls it `name`.
  void add_argument(const std::string& name, const TakeText& take, const std::string& description);
  /// Any number of such words, or none; `take` is called with one after the other.
  void add_arguments(const std::string& name, const TakeText& take, const std::string& description);
  /// An option with a text that must be given; `shown` is what the help says of its value.
  void add_required(const std::string& name, const std::string& shown, const TakeText& take, const std::string& description);
  /// An option with a text; `shown` is what the help says of its value.
  void add_text(const std::string& name, const std::string& shown, const TakeText& take, const std::string& description);
  /// An option with a text that may be given several times; `take` is called with one text after the other.
  void add_texts(const std::string& name, const std::string& shown, const TakeText& take, const std::string& description);
  void add_path(const std::string& name, const std::string& shown, std::optional<std::filesystem::path>& path,
                const std::string& description);
  void add_flag(const std::string& name, bool& flag, const std::string& description);
  /// A flag that may be followed by "=" and a text; `value` is that, or `standard` without one, or as it is without the flag.
  void add_flag_with_text(const std::string& name, const std::string& standard, std::string& value,
                          const std::string& description);
  /// --quiet, of a command that says nothing but its progress unasked.
  void add_quiet(bool& quiet);
  /// An option that takes one of `words`, or several with commas between, and may be given several times.
  void add_words(const std::string& name, const std::vector<std::string>& words, const TakeText& take,
                 const std::string& description);

  /// An option whose values are words, one for each T; `shown_default` is what the help says of its default. `Field` is T or
  /// std::optional<T>.
  template <class T, class Field>
  void add_choice(const std::string& name, Field& value, const Choices<T>& choices, const std::string& shown_default,
                  const std::string& description);
  /// Adds a choice whose default is the current `value`.
  template <class T>
  void add_choice(const std::string& name, T& value, const Choices<T>& choices, const std::string& description);

  /// An option whose values are whole numbers from `least` to `most`; `shown_default` is what the help says of its default.
  template <class Field>
  void add_number(const std::string& name, Field& value, std::int64_t least, std::int64_t most, const std::string& shown_default,
                  const std::string& description);

  /// What help says in the end; without it what it says in the end of the command that has this one.
  void set_examples(const std::string& text);
  /// Called when all options of a line with this command are read, after the checks given before; may throw core::UsageError.
  void check_in_the_end(const std::function<void()>& check);
  /// Whether the user gave the option, if it is one of this command; for check_in_the_end().
  bool is_given(const std::string& name) const;

 private:
  friend class CommandLine;

  explicit OptionSet(DeclaredCommand& command) : command_(&command) {}

  void add_words_as(const std::string& name, const std::vector<std::string>& words, const std::string& shown_default,
                    const TakeText& take, const std::string& description);
  void add_number_as(const std::string& name, std::int64_t least, std::int64_t most, const std::string& shown_default,
                     const TakeNumber& take, const std::string& description);

  DeclaredCommand* command_;
};

/// All commands of the program, for one line.
class CommandLine {
 public:
  CommandLine(const std::string& description, const std::string& version, const std::string& examples,
              const std::string& program = "dmpc");
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// The options of a program without commands, to be declared.
  OptionSet own_options();
  /// The options of a new command, to be declared.
  OptionSet add_command(const std::string& name, const std::string& description);

  /// Sets what the options of the command given are to set, and returns its name, "study balance" if it is a command's command;
  /// or help. Call it once. `arguments` without the program's name. Throws core::UsageError, whose message ends with a hint at
  /// the right --help, as read_line() does (typed_line.h) and what takes a value.
  std::variant<HelpText, std::string> parse(std::span<const std::string> arguments);

  /// What --help prints about a command, {"study", "balance"}, or about the program.
  std::string help(const std::vector<std::string>& command) const;

  /// What a value is that help calls `name`, up to its first dot: "FILE" for "FILE.nff [stdout]" and "SIZE|FILE".
  void suggest(const std::string& name, const Suggestion& suggestion);
  /// Everything declared so far.
  CommandDescription describe() const;

 private:
  std::unique_ptr<DeclaredCommand> program_;
  std::string version_;
  Suggestions suggestions_;
};

template <class T, class Field>
void OptionSet::add_choice(const std::string& name, Field& value, const Choices<T>& choices, const std::string& shown_default,
                           const std::string& description) {
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
  add_words_as(name, words, shown_default, take, description);
}

template <class T>
void OptionSet::add_choice(const std::string& name, T& value, const Choices<T>& choices, const std::string& description) {
  std::string standard;
  for (const auto& [word, meaning] : choices) {
    standard = meaning == value ? word : standard;
  }
  add_choice<T, T>(name, value, choices, standard, description);
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
