#include "apps/options.h"

#include <map>
#include <string>

#include "apps/machines.h"
#include "core/scenes.h"

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

  /// What was set for the command that the line names.
  Command named(const std::string& name) const {
    const std::map<std::string, Command> commands = {{"render", render_},
                                                     {"info", info_},
                                                     {"scene", scene_},
                                                     {"check", check_},
                                                     {"compare", compare_},
                                                     {"machine", machine_},
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
  void declare_simple_commands() {
    add_options(line_.add_command("render", "Render a scene on N nodes"), render_);
    add_options(line_.add_command("info", "Tell what a scene is, and what a render of it would take"), info_);
    add_options(line_.add_command("scene", "Write a built-in scene as an NFF file, or a landscape as glTF"), scene_);
    add_options(line_.add_command("check", "Trace every ray of a render with Embree too, and let a referee settle differences"),
                check_);
    add_options(line_.add_command("compare", "Measure how far two pictures lie apart"), compare_);
    add_options(line_.add_command("machine", "Print a machine's figures as JSON, to read or to start from"), machine_);
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
    Suggestion scenes{.files = true}, families, machines{.files = true};
    for (const core::SceneName& scene : core::default_scenes()) {
      scenes.words.push_back(scene.text());
      families.words.push_back(scene.family);
    }
    families.words.emplace_back("landscape");
    for (const MachineDescription& preset : machine_presets()) {
      machines.words.push_back(preset.machine.name);
    }
    line_.suggest("SCENE", scenes);
    line_.suggest("FAMILY", families);
    line_.suggest("MACHINE", machines);
    line_.suggest("FOLDER", {.folders = true});
    for (const char* const name : {"FILE", "IMAGE", "A", "B"}) {
      line_.suggest(name, {.files = true});
    }
  }

  CommandLine line_{"dmpc: a distributed-memory parallel computer on one machine, for ray tracing", "dmpc " DMPC_VERSION,
                    "dmpc COMMAND --help says more, with examples.\nStart with: dmpc render teapot-12 --nodes=8 -o teapot.png"};
  RenderOptions render_;
  InfoOptions info_;
  SceneOptions scene_;
  CheckOptions check_;
  CompareOptions compare_;
  MachineOptions machine_;
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
