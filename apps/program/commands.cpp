#include "apps/program/commands.h"

#include <algorithm>
#include <iostream>
#include <ostream>
#include <string_view>
#include <variant>

#include "apps/formats/landscape/names.h"
#include "apps/formats/mesh_file.h"
#include "apps/frontend/help/glossary.h"
#include "apps/frontend/line/help_text.h"
#include "apps/frontend/line/typed_line.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/machine/machines.h"
#include "apps/frontend/system/output_file.h"
#include "apps/help/choices.h"
#include "apps/program/word_help.h"
#include "apps/scene/database_facts.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"
#include "core/families/scenes.h"
#include "core/picture/heat_kind.h"

namespace dmpc::apps {

namespace {

const char* const about =
    "dmpc COMMAND --help shows the options of a command, with examples. dmpc list shows scenes, machines and other "
    "choices,\ndmpc help WORD explains a word.\nStart with: dmpc render teapot-12 --nodes=8 -o teapot.png";

const char* const first_steps =
    "dmpc renders scenes on a simulated cluster, and counts what its nodes send each other. To begin:\n"
    "  dmpc demo                                        a teapot on eight nodes, and where their time went\n"
    "  dmpc render teapot-12 --nodes=8 -o teapot.png    a built-in scene, or a file: glTF, OBJ, PLY, STL, pbrt, NFF\n"
    "  dmpc view model.glb                              find a camera in a browser\n"
    "  dmpc --help                                      all commands; dmpc help WORD explains a word\n";

Command help_command(const HelpText& help) {
  return {help, false, [help](Interrupt&, std::ostream& output) {
            print_help(output, help.text);
            finish_output(output, "the help");
            return 0;
          }};
}

/// Throws core::UsageError for words behind the glossary, or behind a command that has none within it.
void check_is_one_topic(const CommandDescription& program, std::span<const std::string> topic, const std::string& glossary) {
  const CommandDescription* here = &program;
  std::string known;
  for (const std::string& word : topic) {
    const auto inner = std::find_if(here->commands.begin(), here->commands.end(),
                                    [&word](const CommandDescription& command) { return command.name == word; });
    if (known == glossary || (!known.empty() && here->commands.empty())) {
      throw core::UsageError("there is no help about '" + word + "' of " + known + ": expected dmpc help " + known +
                             hint_at_help("help"));
    }
    if (inner == here->commands.end() && word != glossary) {
      return;  // whoever reads the line knows better what to say of it
    }
    here = inner == here->commands.end() ? here : &*inner;
    known += (known.empty() ? "" : " ") + word;
  }
}

/// What `help` explains, except names of options and values.
std::vector<std::string> known_words(const CommandDescription& program) {
  std::vector<std::string> words{"glossary"};
  for (const CommandDescription& command : program.commands) {
    words.push_back(command.name);
  }
  for (const GlossaryEntry& entry : glossary()) {
    words.emplace_back(entry.word);
  }
  return words;
}

Command read_by(Commands&& commands, std::span<const std::string> arguments) {
  const std::variant<HelpText, std::string> parsed = commands.line().parse(arguments);
  if (const auto* help = std::get_if<HelpText>(&parsed)) {
    return help_command(*help);
  }
  Command command = commands.named(std::get<std::string>(parsed));
  command.set_notes(commands.line().notes());
  return command;
}

}  // namespace

int Command::run(Interrupt& interrupt, std::ostream& output) const {
  for (const std::string& note : notes_) {
    std::cerr << "dmpc: " << note << '\n';
  }
  return run_(interrupt, output);
}

Commands::Commands(Declare declare, std::optional<Words> line)
    : declare_(declare),
      line_words_(std::move(line)),
      line_("dmpc: a distributed-memory parallel computer on one machine, for ray tracing", "dmpc " DMPC_VERSION, about) {
  line_.stand_for_options(standing_of_scene());
  declare(*this);
  declare_help();
  if (!line_words_) {
    declare_values();
  }
}

Command Commands::named(const std::string& name) const {
  return name == "help" ? help_command(help_about(topic_)) : rows_.at(name)();
}

void Commands::begin(const std::string& name, const std::string& description) {
  group_ = {name + " ", line_.add_command(name, description)};
  topics_.words.push_back(name);
}

void Commands::declare_help() {
  OptionSet help = line_.add_command("help", "Show help about a command or a word, or the glossary");
  help.add_arguments(
      "TOPIC", [this](const std::string& word) { topic_.push_back(word); },
      "A command, such as render or study cache; a word that tables show or options take, such as page, svm or hdr; or glossary, "
      "which explains all terms");
  help.set_examples("Examples:\n  dmpc help render\n  dmpc help study cache\n  dmpc help page wait\n  dmpc help glossary");
  topics_.words.emplace_back("glossary");
}

HelpText Commands::help_about(const std::vector<std::string>& topic) const {
  Commands all(declare_);
  const CommandDescription program = all.line().describe();
  const std::string words = joined(topic, " "), first = topic.empty() ? "" : topic.front();
  if (words == "glossary") {
    return {glossary_text()};
  }
  const bool is_command = std::any_of(program.commands.begin(), program.commands.end(),
                                      [&first](const CommandDescription& command) { return command.name == first; });
  if (is_command || topic.empty() || first == "glossary") {
    check_is_one_topic(program, topic, "glossary");
    std::vector<std::string> line = topic;
    line.emplace_back("--help");
    return std::get<HelpText>(all.line().parse(line));
  }
  if (const std::string meaning = word_help(words, program); !meaning.empty()) {
    return {meaning};
  }
  throw core::UsageError("there is no help about '" + words + "': expected a command, glossary, or a word that tables show." +
                         core::did_you_mean(words, known_words(program)) + hint_at_help("help"));
}

void Commands::declare_values() {
  Suggestion scenes{.files = true, .endings = {"nff", "pages"}}, families, machines{.files = true}, kinds, heats;
  for (const core::SceneName& scene : core::default_scenes()) {
    scenes.words.push_back(scene.text());
    families.words.push_back(scene.family);
  }
  scenes.words.insert(scenes.words.end(), {"landscape-10", "grove-5"});
  families.words.insert(families.words.end(), landscape_families.begin(), landscape_families.end());
  for (const std::string& ending : words_between(known_mesh_formats(), ',')) {
    scenes.endings.push_back(ending.substr(ending.find_first_not_of(' ')));
  }
  kinds.words.assign(choice_kinds.begin(), choice_kinds.end());
  for (const std::string_view heat : core::heat_kind_names) {
    heats.words.push_back(std::string(heat) + ":");
  }
  machines.words.assign(machine_names.begin(), machine_names.end());
  line_.suggest("SCENE", scenes);
  line_.suggest("FAMILY", families);
  line_.suggest("MACHINE", machines);
  line_.suggest("TOPIC", topics_);
  line_.suggest("KIND", kinds);
  line_.suggest("KIND:FILE", heats);
  line_.suggest("FOLDER", {.folders = true});
  line_.suggest("python:FILE", {.words = {"python:"}});
  for (const char* const name : {"FILE", "IMAGE", "A", "B"}) {
    line_.suggest(name, {.files = true});
  }
}

Command parse_command_line(Commands::Declare declare, std::span<const std::string> arguments) {
  if (arguments.empty()) {
    return help_command({first_steps});
  }
  try {
    return read_by(Commands(declare, Commands::Words(arguments.begin(), arguments.end())), arguments);
  } catch (const core::UsageError&) {
    // What is said of a wrong line may name options of other commands.
    return read_by(Commands(declare), arguments);
  }
}

}  // namespace dmpc::apps
