#include "apps/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "apps/words.h"
#include "core/expect.h"

namespace dmpc::apps {

namespace {

using core::UsageError;

/// "a", "a or b", "a, b or c".
std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  }
  return text;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : "|") + word;
  }
  return text;
}

/// Two commands, one in the other.
std::string joined(const std::string& outer, const std::string& inner) {
  return outer + (outer.empty() || inner.empty() ? "" : " ") + inner;
}

/// The commands given, outermost first: "study balance"; empty if none was understood.
std::string command_given(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return commands.empty() ? "" : joined(commands.front()->get_name(), command_given(*commands.front()));
}

std::string hint(const std::string& command) { return "\nTry: " + joined(joined("dmpc", command), "--help"); }

/// CLI11 would only say that a command is missing. `outer` is the command that `app` is.
void check_command_name(CLI::App& app, std::span<const std::string> arguments, const std::string& outer) {
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  if (arguments.empty() || arguments.front().rfind('-', 0) == 0 || commands.empty()) {
    return;
  }
  std::vector<std::string> names;
  for (CLI::App* const command : commands) {
    if (command->get_name() == arguments.front()) {
      return check_command_name(*command, arguments.subspan(1), joined(outer, command->get_name()));
    }
    names.push_back(command->get_name());
  }
  throw UsageError(arguments.front() + " is no command: expected " + listed(names) + hint(outer));
}

std::function<void(const std::vector<std::string>&)> one_by_one(const OptionSet::TakeText& take) {
  return [take](const std::vector<std::string>& given) {
    for (const std::string& word : given) {
      take(word);
    }
  };
}

}  // namespace

OptionSet::OptionSet(CLI::App& app) : app_(&app) {
  const auto checks = std::make_shared<Checks>();
  checks_ = checks.get();
  app.final_callback([checks] {
    for (const auto& check : *checks) {
      check();
    }
  });
}

OptionSet OptionSet::add_command(const std::string& name, const std::string& description) {
  app_->require_subcommand(1);
  return OptionSet(*app_->add_subcommand(name, description));
}

void OptionSet::begin_group(const std::string& title) { app_->option_defaults()->group(title); }

void OptionSet::add_argument(const std::string& name, const TakeText& take, const std::string& description) {
  app_->add_option_function<std::string>(name, take, description)->required()->option_text(" ");
}

void OptionSet::add_arguments(const std::string& name, const TakeText& take, const std::string& description) {
  app_->add_option_function<std::vector<std::string>>(name, one_by_one(take), description)->option_text(" ");
}

void OptionSet::add_required(const std::string& name, const std::string& shown, const TakeText& take,
                             const std::string& description) {
  app_->add_option_function<std::string>(name, take, description)->required()->option_text(shown);
}

void OptionSet::add_text(const std::string& name, const std::string& shown, const TakeText& take,
                         const std::string& description) {
  app_->add_option_function<std::string>(name, take, description)->option_text(shown);
}

void OptionSet::add_texts(const std::string& name, const std::string& shown, const TakeText& take,
                          const std::string& description) {
  app_->add_option_function<std::vector<std::string>>(name, one_by_one(take), description)
      ->allow_extra_args(false)
      ->type_name("")
      ->option_text(shown);
}

void OptionSet::add_path(const std::string& name, const std::string& shown, std::optional<std::filesystem::path>& path,
                         const std::string& description) {
  add_text(
      name, shown, [&path](const std::string& text) { path = text; }, description);
}

void OptionSet::add_flag(const std::string& name, bool& flag, const std::string& description) {
  app_->add_flag(name, flag, description);
}

void OptionSet::add_flag_with_text(const std::string& name, const std::string& standard, std::string& value,
                                   const std::string& description) {
  app_->add_flag(name + "{" + standard + "}", value, description);
}

void OptionSet::add_quiet(bool& quiet) { add_flag("--quiet", quiet, "No progress, on a terminal either"); }

void OptionSet::add_words(const std::string& name, const std::vector<std::string>& words, const TakeText& take,
                          const std::string& description) {
  const auto take_list = [name, words, take](const std::string& text) {
    for (const std::string& word : words_between_commas(text, name)) {
      if (std::find(words.begin(), words.end(), word) == words.end()) {
        throw core::UsageError(name + "=" + word + ": expected " + joined(words) + ", with commas between");
      }
      take(word);
    }
  };
  app_->add_option_function<std::vector<std::string>>(name, one_by_one(take_list), description)
      ->allow_extra_args(false)
      ->type_name("")
      ->option_text(joined(words));
}

void OptionSet::add_words_as(const std::string& name, const std::vector<std::string>& words, const std::string& shown_default,
                             const TakeText& take, const std::string& description) {
  app_->add_option_function<std::string>(name, take, description)
      ->check(CLI::IsMember(words))
      ->type_name("")
      ->option_text(joined(words) + " [" + shown_default + "]");
}

void OptionSet::add_number_as(const std::string& name, std::int64_t least, std::int64_t most, const std::string& shown_default,
                              const TakeNumber& take, const std::string& description) {
  app_->add_option_function<std::int64_t>(name, take, description)
      ->check(CLI::Range(least, most))
      ->option_text(std::to_string(least) + ".." + std::to_string(most) + " [" + shown_default + "]");
}

void OptionSet::set_examples(const std::string& text) { app_->footer(text); }

void OptionSet::check_in_the_end(const std::function<void()>& check) { checks_->push_back(check); }

bool OptionSet::is_given(const std::string& name) const {
  const CLI::Option* const option = app_->get_option_no_throw(name);
  return option != nullptr && option->count() > 0;
}

CommandLine::CommandLine(const std::string& description, const std::string& version, const std::string& examples)
    : app_(std::make_unique<CLI::App>(description, "dmpc")) {
  app_->set_version_flag("--version", version, "Print the version");
  app_->get_formatter()->column_width(36);
  app_->footer(examples);
}

CommandLine::~CommandLine() = default;

OptionSet CommandLine::add_command(const std::string& name, const std::string& description) {
  return OptionSet(*app_).add_command(name, description);
}

std::variant<HelpText, std::string> CommandLine::parse(std::span<const std::string> arguments) {
  check_command_name(*app_, arguments, "");
  try {
    app_->parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 takes them from the back
    return command_given(*app_);
  } catch (const CLI::Success& asked) {
    std::ostringstream output, errors;
    app_->exit(asked, output, errors);
    return HelpText{output.str()};
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what() + hint(command_given(*app_)));
  } catch (const UsageError& error) {
    throw UsageError(error.what() + hint(command_given(*app_)));
  }
}

void CommandLine::suggest(const std::string& name, const Suggestion& suggestion) { suggestions_[name] = suggestion; }

CommandDescription CommandLine::describe() const { return dmpc::apps::describe(*app_, suggestions_); }

}  // namespace dmpc::apps
