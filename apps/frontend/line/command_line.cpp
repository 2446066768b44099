#include "apps/frontend/line/command_line.h"

#include <algorithm>

#include "apps/frontend/line/help_text.h"
#include "apps/frontend/line/parsed_number.h"
#include "apps/frontend/line/typed_line.h"
#include "apps/frontend/line/unknown_option.h"
#include "apps/frontend/line/words.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"

namespace dmpc::apps {

/// What is declared of a command, and what of it is given.
struct DeclaredCommand {
  using Take = std::function<void(const std::string&)>;
  struct Option {
    OptionDescription described;
    Take take;
    std::vector<std::string> given = {};  ///< values; an empty one of a flag without

    bool is_argument() const { return described.names.empty(); }
  };

  /// `names`: of an option as the user types them, with commas between; of an argument none.
  OptionDescription& add(const std::string& names, const std::string& value, const std::string& meaning, const Take& take) {
    Option option;  // filled in member by member: where memory ends in a nested list, GCC 12 frees parts of it twice
    option.take = take;
    option.described.names = names.empty() ? std::vector<std::string>() : words_between(names, ',');
    option.described.value = value;
    option.described.text = meaning;
    option.described.group = group;
    options.push_back(std::move(option));
    return options.back().described;
  }
  OptionDescription& add_list(const std::string& names, const std::string& value, const std::string& meaning, const Take& take) {
    OptionDescription& described = add(names, value, meaning, take);
    described.is_repeatable = described.is_list = true;
    return described;
  }
  OptionDescription& add_flag(const std::string& names, const std::string& meaning, const Take& take) {
    OptionDescription& described = add(names, "", meaning, take);
    described.is_repeatable = true;
    return described;
  }

  std::string name, text, examples;
  std::string group = "Options";
  std::vector<Option> options = {};  ///< and arguments, as they were declared
  std::vector<std::unique_ptr<DeclaredCommand>> commands = {};
  std::vector<std::function<void()>> checks = {};
  std::vector<BriefGroup> brief = {};
  std::vector<std::string> notes = {};  ///< of the values given
};

namespace {

using core::UsageError;

/// "--nodes", of "-n,--nodes".
std::string long_name(const std::string& names) { return names.substr(names.find(',') + 1); }

bool is_among(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

[[noreturn]] void refuse_word(const std::string& option, const std::string& word, const std::vector<std::string>& words,
                              const std::string& more = "") {
  if (const std::string instead = said_instead_of(option + "=" + word); !instead.empty()) {
    throw UsageError(option + "=" + word + " no longer exists: " + instead);
  }
  const std::string advice = core::did_you_mean(word, words);
  throw UsageError(option + "=" + word + ": expected " + listed(words) + more + (advice.empty() ? "" : ".") + advice);
}

/// The whole number that the text is, from `least` to `most`.
std::int64_t whole_number(const std::string& option, const std::string& text, std::int64_t least, std::int64_t most) {
  const auto number = number_in<std::int64_t>(text);
  if (!number || *number < least || *number > most) {
    throw UsageError(option + "=" + text + ": expected a whole number from " + std::to_string(least) + " to " +
                     std::to_string(most));
  }
  return *number;
}

CommandDescription described(const DeclaredCommand& command, const Suggestions& known) {
  CommandDescription all{.name = command.name, .text = command.text, .examples = command.examples, .brief = command.brief};
  for (const DeclaredCommand::Option& option : command.options) {
    OptionDescription& one = (option.is_argument() ? all.arguments : all.options).emplace_back(option.described);
    one.is_list = one.is_list || value_alone(one).find(',') != std::string::npos;
    one.suggestion = suggestion_for(one.value, known);
  }
  for (const std::unique_ptr<DeclaredCommand>& inner : command.commands) {
    all.commands.push_back(described(*inner, known));
  }
  return all;
}

std::unique_ptr<DeclaredCommand> make_command(const std::string& name, const std::string& text, const std::string& examples) {
  auto command = std::make_unique<DeclaredCommand>(DeclaredCommand{.name = name, .text = text, .examples = examples});
  command->add_flag("-h,--help", "Show this help", [](const std::string&) {});
  return command;
}

DeclaredCommand::Option& option_of(DeclaredCommand& command, const std::string& name) {
  const auto found = std::find_if(command.options.begin(), command.options.end(),
                                  [&](const DeclaredCommand::Option& option) { return is_among(option.described.names, name); });
  core::expect(found != command.options.end(), "a line that was read has the form of a command");
  return *found;
}

/// The command of that name, as at() has it of one of `commands`.
template <class Commands, class At>
auto* find_command(Commands& commands, const std::string& name, const At& at) {
  const auto found = std::find_if(commands.begin(), commands.end(), [&](const auto& each) { return at(each)->name == name; });
  core::expect(found != commands.end(), "a line that was read names a command");
  return at(*found);
}

/// Notes which options are given by words that follow the command's name: options as --name or --name=value, --, arguments.
void note_given(DeclaredCommand& command, std::span<const std::string> words) {
  const auto end_of_options = std::find(words.begin(), words.end(), "--");
  for (auto word = words.begin(); word != end_of_options; ++word) {
    const std::size_t equals = word->find('=');
    option_of(command, word->substr(0, equals)).given.push_back(equals == std::string::npos ? "" : word->substr(equals + 1));
  }
  auto word = end_of_options + 1;
  for (DeclaredCommand::Option& option : command.options) {
    while (option.is_argument() && word != words.end() && (option.given.empty() || option.described.is_list)) {
      option.given.push_back(*word++);
    }
  }
}

/// The values given for an option, or an argument.
std::vector<std::string> given_in(const DeclaredCommand& command, const std::string& name) {
  for (const DeclaredCommand::Option& option : command.options) {
    if (option.is_argument() ? option.described.value == name : is_among(option.described.names, name)) {
      return option.given;
    }
  }
  return {};
}

/// Notes options that an argument stands for, as if they were given; returns those that were not.
std::vector<std::string> note_behind(DeclaredCommand& command, const std::vector<std::string>& words) {
  std::vector<std::string> noted;
  std::vector<DeclaredCommand::Option*> open;
  for (DeclaredCommand::Option& option : command.options) {
    if (!option.is_argument() && option.given.empty()) {
      open.push_back(&option);
    }
  }
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    const auto of_name = std::find_if(open.begin(), open.end(), [&](const DeclaredCommand::Option* option) {
      return is_among(option->described.names, word.substr(0, equals));
    });
    if (of_name != open.end()) {
      (*of_name)->given.push_back(equals == std::string::npos ? "" : word.substr(equals + 1));
      noted.push_back(word);
    }
  }
  return noted;
}

/// What explains a complaint of an option that nobody has typed, since `value` stands for it.
std::string said_of_value(const std::string& complaint, const std::string& value, const std::vector<std::string>& stands_for) {
  for (const std::string& word : stands_for) {
    if (complaint.starts_with(word + " ")) {
      return "; nobody typed " + word + ", but " + value + " was built with it";
    }
  }
  return "";
}

/// In the order in which options are declared, whatever that of the line.
void take_given(const DeclaredCommand& command) {
  for (const DeclaredCommand::Option& option : command.options) {
    for (const std::string& value : option.given) {
      option.take(value);
    }
  }
  for (const auto& check : command.checks) {
    check();
  }
}

}  // namespace

OptionSet OptionSet::add_command(const std::string& name, const std::string& description) {
  return OptionSet(*command_->commands.emplace_back(make_command(name, description, command_->examples)));
}

void OptionSet::begin_group(const std::string& title) { command_->group = title; }

void OptionSet::add_argument(const std::string& name, const TakeText& take, const std::string& description) {
  command_->add("", name, description, take).is_required = true;
}

void OptionSet::add_arguments(const std::string& name, const TakeText& take, const std::string& description) {
  command_->add_list("", name, description, take);
}

void OptionSet::add_required(const std::string& name, const std::string& shown, const TakeText& take,
                             const std::string& description) {
  command_->add(name, shown, description, take).is_required = true;
}

void OptionSet::add_text(const std::string& name, const std::string& shown, const TakeText& take,
                         const std::string& description) {
  command_->add(name, shown, description, take);
}

void OptionSet::add_texts(const std::string& name, const std::string& shown, const TakeText& take,
                          const std::string& description) {
  command_->add_list(name, shown, description, take);
}

void OptionSet::add_path(const std::string& name, const std::string& shown, std::optional<std::filesystem::path>& path,
                         const std::string& description) {
  add_text(
      name, shown, [&path](const std::string& text) { path = text; }, description);
}

void OptionSet::add_flag(const std::string& name, bool& flag, const std::string& description) {
  command_->add_flag(name, description, [&flag](const std::string&) { flag = true; });
}

void OptionSet::add_flag_with_text(const std::string& name, const std::string& standard, std::string& value,
                                   const std::string& description) {
  const auto take = [&value, standard](const std::string& text) { value = text.empty() ? standard : text; };
  OptionDescription& described = command_->add_flag(name, description, take);
  described.has_optional_value = true;
  described.standard = standard;
}

void OptionSet::add_quiet(bool& quiet) { add_flag("--quiet", quiet, "Print no progress, even on a terminal"); }

void OptionSet::add_words(const std::string& name, const std::vector<std::string>& words, const TakeText& take,
                          const std::string& description) {
  const auto take_list = [option = long_name(name), words, take](const std::string& text) {
    for (const std::string& word : words_between_commas(text, option)) {
      if (!is_among(words, word)) {
        refuse_word(option, word, words, ", with commas between");
      }
      take(word);
    }
  };
  add_texts(name, joined(words, "|"), take_list, description);
}

void OptionSet::add_words_as(const std::string& name, const std::vector<std::string>& words, const std::string& shown_default,
                             const TakeText& take, const std::string& description, const Others& others) {
  const std::string more = others.take ? " or " + others.shown : "";
  const auto take_word = [option = long_name(name), words, take, others, more, command = command_](const std::string& word) {
    if (others.take && others.take(word)) {
      return;
    }
    const std::string renamed = renamed_value(option + "=" + word);
    if (!renamed.empty()) {
      command->notes.push_back(option + "=" + word + " is called " + renamed + " now");
    } else if (!is_among(words, word)) {
      refuse_word(option, word, words, more);
    }
    take(renamed.empty() ? word : renamed);
  };
  add_text(name, joined(words, "|") + (others.take ? "|" + others.shown : "") + " [" + shown_default + "]", take_word,
           description);
}

void OptionSet::add_number_as(const std::string& name, std::int64_t least, std::int64_t most, const std::string& shown_default,
                              const TakeNumber& take, const std::string& description) {
  const auto take_number = [option = long_name(name), least, most, take](const std::string& text) {
    take(whole_number(option, text, least, most));
  };
  add_text(name, std::to_string(least) + ".." + std::to_string(most) + " [" + shown_default + "]", take_number, description);
}

void OptionSet::set_examples(const std::string& text) { command_->examples = text; }

void OptionSet::set_brief_help(const std::vector<BriefGroup>& groups) { command_->brief = groups; }

void OptionSet::check_in_the_end(const std::function<void()>& check) { command_->checks.push_back(check); }

bool OptionSet::is_given(const std::string& name) const { return !given_in(*command_, name).empty(); }

std::vector<std::string> OptionSet::given_words(const std::vector<std::string>& but) const {
  std::vector<std::string> words;
  for (const DeclaredCommand::Option& option : command_->options) {
    const bool is_left_out = option.is_argument() || is_among(but, option.described.names.back());
    for (const std::string& value : is_left_out ? std::vector<std::string>() : option.given) {
      words.push_back(option.described.names.back() + (option.described.value.empty() ? "" : "=" + value));
    }
  }
  return words;
}

CommandLine::CommandLine(const std::string& description, const std::string& version, const std::string& examples,
                         const std::string& program)
    : program_(make_command(program, description, examples)), version_(version) {
  program_->add_flag("--version", "Print the version", [](const std::string&) {});
}

CommandLine::~CommandLine() = default;

OptionSet CommandLine::own_options() { return OptionSet(*program_); }

OptionSet CommandLine::add_command(const std::string& name, const std::string& description) {
  return own_options().add_command(name, description);
}

std::variant<HelpText, std::string> CommandLine::parse(std::span<const std::string> arguments) {
  const TypedLine line = read_line(describe(), arguments);
  if (line.asks_for_help) {
    return HelpText{help(words_between(line.command, ' '), line.asks_for_all_help)};
  }
  if (line.asks_for_version) {
    return HelpText{version_ + "\n"};
  }
  DeclaredCommand* command = program_.get();
  std::span<const std::string> words = line.words;
  for (; !words.front().starts_with('-'); words = words.subspan(1)) {
    command = find_command(command->commands, words.front(), [](const auto& each) { return each.get(); });
  }
  std::string standing_value;
  std::vector<std::string> stands_for;
  try {
    note_given(*command, words);
    for (const std::string& value : standing_ ? given_in(*command, standing_->argument) : std::vector<std::string>()) {
      standing_value = value;
      stands_for =
          note_behind(*command, standing_->words_of(value, [&](const std::string& name) { return given_in(*command, name); }));
    }
    take_given(*command);
    notes_ = command->notes;
    return line.command;
  } catch (const UsageError& error) {
    throw UsageError(error.what() + said_of_value(error.what(), standing_value, stands_for) +
                     hint_at_help(line.command, program_->name));
  }
}

std::string CommandLine::help(const std::vector<std::string>& command, bool asks_for_all) const {
  const CommandDescription program = describe();
  const CommandDescription* here = &program;
  std::string path = program.name;
  for (const std::string& name : command) {
    if (!name.empty()) {
      here = find_command(here->commands, name, [](const auto& each) { return &each; });
      path += " " + name;
    }
  }
  return asks_for_all ? help_text(*here, path) : brief_help_text(*here, path);
}

void CommandLine::suggest(const std::string& name, const Suggestion& suggestion) { suggestions_[name] = suggestion; }

CommandDescription CommandLine::describe() const { return described(*program_, suggestions_); }

}  // namespace dmpc::apps
