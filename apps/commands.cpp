#include "apps/commands.h"

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/formats/mesh_file.h"
#include "apps/help/choices.h"
#include "apps/help/glossary.h"
#include "apps/line/typed_line.h"
#include "apps/line/words.h"
#include "apps/machine/machines.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"
#include "core/families/scenes.h"
#include "nodes/watch/heat_map.h"

namespace dmpc::apps {

namespace {

/// All commands, declared, and what a line sets.
class Commands {
 public:
  Commands() {
    declare_simple_commands();
    declare_studies();
    declare_benches();
    declare_values();
  }
  // Options are bound to the members.
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;

  CommandLine& line() { return line_; }

  /// What `dmpc help` with the words given prints. Throws core::UsageError for a topic that there is none.
  static HelpText help_about(std::vector<std::string> topic) {
    static const std::vector<std::string> words_topic = {"glossary"};
    check_is_one_topic(topic, words_topic.front());
    if (topic == words_topic) {
      return {glossary_text()};
    }
    if (const std::string meant = core::did_you_mean(topic.empty() ? "" : topic.front(), words_topic); !meant.empty()) {
      throw core::UsageError("there is no help about " + topic.front() + "." + meant + hint_at_help("help"));
    }
    topic.emplace_back("--help");
    return std::get<HelpText>(Commands().line().parse(topic));
  }

  /// What was set for the command that the line names.
  Command named(const std::string& name) const {
    if (name == "help") {
      return help_about(topic_);
    }
    const std::map<std::string, Command> commands = {{"render", render_},
                                                     {"info", info_},
                                                     {"scene", scene_},
                                                     {"check", check_},
                                                     {"compare", compare_},
                                                     {"machine", machine_},
                                                     {"list", list_},
                                                     {"study balance", balance_},
                                                     {"study traffic", traffic_},
                                                     {"study cache", cache_},
                                                     {"study speedup", speedup_},
                                                     {"study paper", paper_},
                                                     {"study scale", scale_},
                                                     {"bench stability", stability_},
                                                     {"bench precision", precision_},
                                                     {"bench error", error_},
                                                     {"bench speed", speed_}};
    return commands.at(name);
  }

 private:
  /// Throws core::UsageError for words behind the glossary, or behind a command that has none within it.
  static void check_is_one_topic(std::span<const std::string> topic, const std::string& glossary) {
    const CommandDescription program = Commands().line().describe();
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

  void declare_simple_commands() {
    add_options(line_.add_command("render", "Render a scene on N nodes"), render_);
    add_options(line_.add_command("info", "Tell what a scene is, and what a render of it would take"), info_);
    add_options(line_.add_command("scene", "Write a built-in scene as an NFF file, or a landscape as glTF"), scene_);
    add_options(line_.add_command("check", "Trace every ray of a render with Embree too, and let a referee settle differences"),
                check_);
    add_options(line_.add_command("compare", "Measure how far two pictures lie apart"), compare_);
    add_options(line_.add_command("machine", "Print a machine's figures as JSON, to read or to start from"), machine_);
    add_options(line_.add_command("list", "Tell what scenes, machines, policies and others there are"), list_);
    declare_help();
  }

  void declare_help() {
    OptionSet help = line_.add_command("help", "Explain a command, or what dmpc's words mean");
    help.add_arguments(
        "TOPIC", [this](const std::string& word) { topic_.push_back(word); },
        "A command, such as render or study cache; or glossary, the list of dmpc's words");
    help.set_examples("Examples:\n  dmpc help render\n  dmpc help study cache\n  dmpc help glossary");
  }

  void declare_studies() {
    OptionSet study = line_.add_command("study", "Render a scene on several computers and print a table");
    add_options(study.add_command(BalanceStudy::name, BalanceStudy::description), balance_);
    add_options(study.add_command(TrafficStudy::name, TrafficStudy::description), traffic_);
    add_options(study.add_command(CacheStudy::name, CacheStudy::description), cache_);
    add_options(study.add_command(SpeedupStudy::name, SpeedupStudy::description), speedup_);
    add_options(study.add_command("paper", "Regenerate the tables and claims of the 1994 article"), paper_);
    add_options(study.add_command("scale", "What larger scenes and more nodes take, and how fast that grows"), scale_);
  }

  void declare_benches() {
    OptionSet bench = line_.add_command("bench", "Put our own arithmetic to the test and print a table");
    add_options(bench.add_command("stability", "Stress tests of numerical stability, beside Embree on the same rays"),
                stability_);
    add_options(bench.add_command("precision", "The picture in float against double precision, every differing pixel explained"),
                precision_);
    add_options(bench.add_command("error", "What every knob costs, and does to the picture's error"), error_);
    add_options(bench.add_command("speed", "Our grid, pictures, computers and databases beside Embree and each other"), speed_);
  }

  void declare_values() {
    Suggestion scenes{.files = true, .endings = {"nff"}}, families, machines{.files = true}, kinds, heats;
    for (const core::SceneName& scene : core::default_scenes()) {
      scenes.words.push_back(scene.text());
      families.words.push_back(scene.family);
    }
    families.words.emplace_back("landscape");
    for (const std::string& ending : words_between(known_mesh_formats(), ',')) {
      scenes.endings.push_back(ending.substr(ending.find_first_not_of(' ')));
    }
    for (const ChoiceList& list : all_choices()) {
      kinds.words.push_back(list.kind);
    }
    for (const std::string_view heat : nodes::heat_kind_names) {
      heats.words.push_back(std::string(heat) + ":");
    }
    for (const MachineDescription& preset : machine_presets()) {
      machines.words.push_back(preset.machine.name);
    }
    line_.suggest("SCENE", scenes);
    line_.suggest("FAMILY", families);
    line_.suggest("MACHINE", machines);
    line_.suggest("TOPIC",
                  {.words = {"render", "info", "scene", "check", "compare", "machine", "list", "study", "bench", "glossary"}});
    line_.suggest("KIND", kinds);
    line_.suggest("KIND:FILE", heats);
    line_.suggest("FOLDER", {.folders = true});
    for (const char* const name : {"FILE", "IMAGE", "A", "B"}) {
      line_.suggest(name, {.files = true});
    }
  }

  CommandLine line_{"dmpc: a distributed-memory parallel computer on one machine, for ray tracing", "dmpc " DMPC_VERSION,
                    "dmpc COMMAND --help says more, with examples; dmpc list what there is, dmpc help glossary what words "
                    "mean.\nStart with: dmpc render teapot-12 --nodes=8 -o teapot.png"};
  RenderOptions render_;
  InfoOptions info_;
  SceneOptions scene_;
  CheckOptions check_;
  CompareOptions compare_;
  MachineOptions machine_;
  ListOptions list_;
  std::vector<std::string> topic_;  ///< of `help`
  StudyOptions balance_{.study = BalanceStudy()}, traffic_{.study = TrafficStudy()}, cache_{.study = CacheStudy()},
      speedup_{.study = SpeedupStudy()};
  PaperStudyOptions paper_;
  ScaleOptions scale_;
  StabilityOptions stability_;
  PrecisionOptions precision_;
  ErrorOptions error_;
  SpeedOptions speed_;
};

}  // namespace

Command parse_command_line(std::span<const std::string> arguments) {
  Commands commands;
  const std::variant<HelpText, std::string> parsed = commands.line().parse(arguments);
  if (const auto* help = std::get_if<HelpText>(&parsed)) {
    return *help;
  }
  return commands.named(std::get<std::string>(parsed));
}

CommandDescription describe_command_line() { return Commands().line().describe(); }

}  // namespace dmpc::apps
