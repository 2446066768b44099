#include "apps/edge/line/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <sstream>

#include "apps/edge/line/typed_line.h"
#include "apps/edge/line/words.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"

namespace dmpc::apps {

namespace {

using core::UsageError;

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : "|") + word;
  }
  return text;
}

/// Where help's explanations begin.
constexpr std::size_t help_column = 36;

/// "--nodes", of "-n,--nodes".
std::string long_name(const std::string& names) { return names.substr(names.find(',') + 1); }

bool is_among(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

[[noreturn]] void refuse_word(const std::string& option, const std::string& word, const std::vector<std::string>& words,
                              const std::string& more = "") {
  const std::string advice = core::did_you_mean(word, words);
  throw UsageError(option + "=" + word + ": expected " + listed(words) + more + (advice.empty() ? "" : ".") + advice);
}

/// The whole number that the text is, from `least` to `most`.
std::int64_t whole_number(const std::string& option, const std::string& text, std::int64_t least, std::int64_t most) {
  std::int64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end || number < least || number > most) {
    throw UsageError(option + "=" + text + ": expected a whole number from " + std::to_string(least) + " to " +
                     std::to_string(most));
  }
  return number;
}

/// What CLI11 says of help or the version; nothing if it was asked for neither. It takes words from the back.
std::optional<std::string> parse_by(CLI::App& app, const std::vector<std::string>& words) {
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    return std::nullopt;
  } catch (const CLI::Success& asked) {
    std::ostringstream output, errors;
    app.exit(asked, output, errors);
    return output.str();
  } catch (const CLI::ParseError& error) {
    core::expect(false, "a line that was read has the form of a command");
    throw;
  }
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
  return OptionSet(*app_->add_subcommand(name, description)->group("Commands"));
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
  const auto take_list = [option = long_name(name), words, take](const std::string& text) {
    for (const std::string& word : words_between_commas(text, option)) {
      if (!is_among(words, word)) {
        refuse_word(option, word, words, ", with commas between");
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
  const auto take_word = [option = long_name(name), words, take](const std::string& word) {
    if (!is_among(words, word)) {
      refuse_word(option, word, words);
    }
    take(word);
  };
  add_text(name, joined(words) + " [" + shown_default + "]", take_word, description);
}

void OptionSet::add_number_as(const std::string& name, std::int64_t least, std::int64_t most, const std::string& shown_default,
                              const TakeNumber& take, const std::string& description) {
  const auto take_number = [option = long_name(name), least, most, take](const std::string& text) {
    take(whole_number(option, text, least, most));
  };
  add_text(name, std::to_string(least) + ".." + std::to_string(most) + " [" + shown_default + "]", take_number, description);
}

void OptionSet::set_examples(const std::string& text) { app_->footer(text); }

void OptionSet::check_in_the_end(const std::function<void()>& check) { checks_->push_back(check); }

bool OptionSet::is_given(const std::string& name) const {
  const CLI::Option* const option = app_->get_option_no_throw(name);
  return option != nullptr && option->count() > 0;
}

CommandLine::CommandLine(const std::string& description, const std::string& version, const std::string& examples,
                         const std::string& program)
    : app_(std::make_unique<CLI::App>(description, program)) {
  app_->set_help_flag("-h,--help", "Explain this");
  app_->set_version_flag("--version", version, "Print the version");
  for (const auto& [theirs, ours] : {std::pair{"Positionals", "Arguments"}, {"OPTIONS", "options"}, {"SUBCOMMAND", "COMMAND"}}) {
    app_->get_formatter()->label(theirs, ours);
  }
  app_->get_formatter()->column_width(help_column);
  app_->footer(examples);
}

CommandLine::~CommandLine() = default;

OptionSet CommandLine::own_options() { return OptionSet(*app_); }

OptionSet CommandLine::add_command(const std::string& name, const std::string& description) {
  return OptionSet(*app_).add_command(name, description);
}

std::variant<HelpText, std::string> CommandLine::parse(std::span<const std::string> arguments) {
  const TypedLine line = read_line(describe(), arguments);
  if (line.asks_for_help) {
    return HelpText{help(words_between(line.command, ' '))};
  }
  try {
    const std::optional<std::string> version = parse_by(*app_, line.words);
    return version ? std::variant<HelpText, std::string>(HelpText{*version}) : line.command;
  } catch (const UsageError& error) {
    throw UsageError(error.what() + hint_at_help(line.command, app_->get_name()));
  }
}

std::string CommandLine::help(std::vector<std::string> command) {
  std::erase(command, "");
  command.emplace_back("--help");
  return *parse_by(*app_, command);
}

void CommandLine::suggest(const std::string& name, const Suggestion& suggestion) { suggestions_[name] = suggestion; }

CommandDescription CommandLine::describe() const { return dmpc::apps::describe(*app_, suggestions_); }

}  // namespace dmpc::apps
