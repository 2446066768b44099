#include "apps/options.h"

#include <map>
#include <string>

namespace dmpc::apps {

Command parse_command_line(std::span<const std::string> arguments) {
  CommandLine line("dmpc: a distributed-memory parallel computer on one machine, for ray tracing", "dmpc " DMPC_VERSION,
                   "dmpc COMMAND --help says more, with examples.\nStart with: dmpc render teapot-12 --nodes=8 -o teapot.png");
  RenderOptions render;
  SceneOptions scene;
  CheckOptions check;
  CompareOptions compare;
  MachineOptions machine;
  StudyOptions balance{.study = BalanceStudy()}, traffic{.study = TrafficStudy()}, cache{.study = CacheStudy()},
      speedup{.study = SpeedupStudy()};
  add_options(line.add_command("render", "Render a scene on N nodes"), render);
  add_options(line.add_command("scene", "Write a built-in scene as an NFF file"), scene);
  add_options(line.add_command("check", "Trace every ray of a render with Embree too, and let a referee settle differences"),
              check);
  add_options(line.add_command("compare", "Measure how far two pictures lie apart"), compare);
  add_options(line.add_command("machine", "Print a machine's figures as JSON, to read or to start from"), machine);
  OptionSet study = line.add_command("study", "Render a scene on several computers and print a table");
  add_options(study.add_command(BalanceStudy::name, BalanceStudy::description), balance);
  add_options(study.add_command(TrafficStudy::name, TrafficStudy::description), traffic);
  add_options(study.add_command(CacheStudy::name, CacheStudy::description), cache);
  add_options(study.add_command(SpeedupStudy::name, SpeedupStudy::description), speedup);
  PaperStudyOptions paper;
  add_options(study.add_command("paper", "Regenerate the tables and claims of the 1994 article"), paper);
  ScaleOptions scale;
  add_options(study.add_command("scale", "What larger scenes and more nodes take, and how fast that grows"), scale);
  StabilityOptions stability;
  OptionSet bench = line.add_command("bench", "Put our own arithmetic to the test and print a table");
  add_options(bench.add_command("stability", "Stress tests of numerical stability, beside Embree on the same rays"), stability);
  PrecisionOptions precision;
  add_options(bench.add_command("precision", "The picture in float against double precision, every differing pixel explained"),
              precision);
  ErrorOptions error;
  add_options(bench.add_command("error", "What every knob costs, and does to the picture's error"), error);
  SpeedOptions speed;
  add_options(bench.add_command("speed", "Our grid, pictures, computers and databases beside Embree and each other"), speed);
  const std::variant<HelpText, std::string> parsed = line.parse(arguments);
  if (const auto* help = std::get_if<HelpText>(&parsed)) {
    return *help;
  }
  const auto& name = std::get<std::string>(parsed);
  const std::map<std::string, Command> commands = {{"render", render},
                                                   {"scene", scene},
                                                   {"check", check},
                                                   {"compare", compare},
                                                   {"machine", machine},
                                                   {"study balance", balance},
                                                   {"study traffic", traffic},
                                                   {"study cache", cache},
                                                   {"study speedup", speedup},
                                                   {"study paper", paper},
                                                   {"study scale", scale},
                                                   {"bench stability", stability},
                                                   {"bench precision", precision},
                                                   {"bench error", error},
                                                   {"bench speed", speed}};
  return commands.at(name);
}

}  // namespace dmpc::apps
