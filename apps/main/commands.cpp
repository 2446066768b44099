#include "apps/main/commands.h"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <set>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "apps/edge/help/glossary.h"
#include "apps/edge/line/typed_line.h"
#include "apps/edge/line/words.h"
#include "apps/edge/machine/machine_command.h"
#include "apps/edge/machine/machines.h"
#include "apps/edge/ranks/launcher.h"
#include "apps/edge/ranks/rank_group.h"
#include "apps/edge/system/output_file.h"
#include "apps/formats/mesh_file.h"
#include "apps/help/choices.h"
#include "apps/help/list_command.h"
#include "apps/info/command.h"
#include "apps/lab/bench/error/command.h"
#include "apps/lab/bench/precision/command.h"
#include "apps/lab/bench/speed/command.h"
#include "apps/lab/bench/stability/command.h"
#include "apps/lab/check/command.h"
#include "apps/lab/compare/command.h"
#include "apps/lab/study/command.h"
#include "apps/lab/study/paper/command.h"
#include "apps/lab/study/references/command.h"
#include "apps/lab/study/scale/command.h"
#include "apps/lab/study/sweep/command.h"
#include "apps/render/command.h"
#include "apps/scene/scene_command.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"
#include "core/families/scenes.h"
#include "core/picture/heat_kind.h"

namespace dmpc::apps {

namespace {

Command help_command(const HelpText& help) {
  return {help, false, [help](Interrupt&, std::ostream& output) {
            output << help.text;
            finish_output(output, "the help");
            return 0;
          }};
}

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

/// All commands, declared, and what a line sets.
class Commands {
 public:
  /// With all their options, and what completes them.
  Commands() {
    declare_commands();
    declare_help();
    declare_values();
  }
  /// Only those commands have options that `line` may name. To declare all takes longer than anything else that a short
  /// command does.
  explicit Commands(std::span<const std::string> line) : line_words_(std::in_place, line.begin(), line.end()) {
    declare_commands();
    declare_help();
  }
  // Options are bound to the members.
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;

  CommandLine& line() { return line_; }

  /// What was set for the command that the line names.
  Command named(const std::string& name) const { return name == "help" ? help_command(help_about(topic_)) : rows_.at(name)(); }

 private:
  void declare_commands() {
    add("render", "Render a scene on N nodes", RenderOptions(),
        [](const RenderOptions& options, Interrupt& interrupt, std::ostream& output) {
          return render_command(options, interrupt, output);
        });
    add("info", "Tell what a scene is, and what a render of it would take", InfoOptions(), info_command);
    add("scene", "Write a built-in scene as an NFF file, or a landscape as glTF", SceneOptions(), scene_command);
    add("check", "Trace every ray of a render with Embree too, and let a referee settle differences", CheckOptions(),
        check_command);
    add("compare", "Measure how far two pictures lie apart, or where two runs' counters differ", CompareOptions(),
        compare_command);
    add("machine", "Print a machine's figures as JSON, to read or to start from", MachineOptions(), machine_command);
    add("list", "Tell what scenes, machines, policies and others there are", ListOptions(), list_command);
    begin("study", "Render a scene on several computers and print a table");
    add(BalanceStudy::name, BalanceStudy::description, StudyOptions{.study = BalanceStudy()}, study_command);
    add(TrafficStudy::name, TrafficStudy::description, StudyOptions{.study = TrafficStudy()}, study_command);
    add(CacheStudy::name, CacheStudy::description, StudyOptions{.study = CacheStudy()}, study_command);
    add(SpeedupStudy::name, SpeedupStudy::description, StudyOptions{.study = SpeedupStudy()}, study_command);
    add(SystemsStudy::name, SystemsStudy::description, StudyOptions{.study = SystemsStudy()}, study_command);
    add("paper", "Regenerate the tables and claims of the 1994 article", PaperStudyOptions(), study_paper_command);
    add("references", "How often pages are missed of references that a file has", ReferencesOptions(), study_references_command);
    add("scale", "What larger scenes and more nodes take, and how fast that grows", ScaleOptions(), study_scale_command);
    add("sweep", "All combinations of any options of render, and the figures asked for", StudySweepOptions(),
        study_sweep_command);
    begin("bench", "Put our own arithmetic to the test and print a table");
    add("stability", "Stress tests of numerical stability, beside Embree on the same rays", StabilityOptions(),
        bench_stability_command);
    add("precision", "The picture in float against double precision, every differing pixel explained", PrecisionOptions(),
        bench_precision_command);
    add("error", "What every knob costs, and does to the picture's error", ErrorOptions(), bench_error_command);
    add("speed", "Our grid, pictures, computers and databases beside Embree and each other", SpeedOptions(), bench_speed_command);
  }

  /// The commands added from now on are words behind this one.
  void begin(const std::string& name, const std::string& description) {
    group_ = {name + " ", line_.add_command(name, description)};
    topics_.words.push_back(name);
  }

  /// `run` takes the options, Interrupt& unless it is done at once, and the std::ostream& that it prints to.
  template <class Options, class Run>
  void add(const std::string& name, const std::string& description, Options defaults, Run run) {
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

  void declare_help() {
    OptionSet help = line_.add_command("help", "Explain a command, or what dmpc's words mean");
    help.add_arguments(
        "TOPIC", [this](const std::string& word) { topic_.push_back(word); },
        "A command, such as render or study cache; or glossary, the list of dmpc's words");
    help.set_examples("Examples:\n  dmpc help render\n  dmpc help study cache\n  dmpc help glossary");
    topics_.words.emplace_back("glossary");
  }

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
    for (const std::string_view heat : core::heat_kind_names) {
      heats.words.push_back(std::string(heat) + ":");
    }
    for (const MachineDescription& preset : machine_presets()) {
      machines.words.push_back(preset.machine.name);
    }
    line_.suggest("SCENE", scenes);
    line_.suggest("FAMILY", families);
    line_.suggest("MACHINE", machines);
    line_.suggest("TOPIC", topics_);
    line_.suggest("KIND", kinds);
    line_.suggest("KIND:FILE", heats);
    line_.suggest("FOLDER", {.folders = true});
    for (const char* const name : {"FILE", "IMAGE", "A", "B"}) {
      line_.suggest(name, {.files = true});
    }
  }

  std::optional<std::set<std::string, std::less<>>> line_words_;  ///< nothing: any
  CommandLine line_{"dmpc: a distributed-memory parallel computer on one machine, for ray tracing", "dmpc " DMPC_VERSION,
                    "dmpc COMMAND --help says more, with examples; dmpc list what there is, dmpc help glossary what words "
                    "mean.\nStart with: dmpc render teapot-12 --nodes=8 -o teapot.png"};
  std::optional<std::pair<std::string, OptionSet>> group_;  ///< of the commands being added
  std::map<std::string, std::function<Command()>> rows_;    ///< by the words of a line that name them
  std::vector<std::string> topic_;                          ///< of `help`
  Suggestion topics_;                                       ///< that `help` explains
};

Command read_by(Commands&& commands, std::span<const std::string> arguments) {
  const std::variant<HelpText, std::string> parsed = commands.line().parse(arguments);
  if (const auto* help = std::get_if<HelpText>(&parsed)) {
    return help_command(*help);
  }
  return commands.named(std::get<std::string>(parsed));
}

}  // namespace

Command parse_command_line(std::span<const std::string> arguments) {
  try {
    return read_by(Commands(arguments), arguments);
  } catch (const core::UsageError&) {
    // What is said of a wrong line may name options of other commands.
    return read_by(Commands(), arguments);
  }
}

CommandDescription describe_command_line() { return Commands().line().describe(); }

}  // namespace dmpc::apps
