#include "apps/main/commands.h"

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

namespace dmpc::apps {

namespace {

void declare_all(Commands& commands) {
  declare_renderer(commands);
  commands.add("check", "Trace every ray of a render with Embree too, and let a referee settle differences", CheckOptions(),
               check_command);
  commands.add("compare", "Measure how far two pictures lie apart, or where two runs' counters differ", CompareOptions(),
               compare_command);
  commands.begin("study", "Render a scene on several computers and print a table");
  commands.add(BalanceStudy::name, BalanceStudy::description, StudyOptions{.study = BalanceStudy()}, study_command);
  commands.add(TrafficStudy::name, TrafficStudy::description, StudyOptions{.study = TrafficStudy()}, study_command);
  commands.add(CacheStudy::name, CacheStudy::description, StudyOptions{.study = CacheStudy()}, study_command);
  commands.add(SpeedupStudy::name, SpeedupStudy::description, StudyOptions{.study = SpeedupStudy()}, study_command);
  commands.add(SystemsStudy::name, SystemsStudy::description, StudyOptions{.study = SystemsStudy()}, study_command);
  commands.add(FramesStudy::name, FramesStudy::description, StudyOptions{.study = FramesStudy()}, study_command);
  commands.add("paper", "Regenerate the tables and claims of the 1994 article", PaperStudyOptions(), study_paper_command);
  commands.add("references", "How often pages are missed of references that a file has", ReferencesOptions(),
               study_references_command);
  commands.add("scale", "What larger scenes and more nodes take, and how fast that grows", ScaleOptions(), study_scale_command);
  commands.add("sweep", "All combinations of any options of render, and the figures asked for", StudySweepOptions(),
               study_sweep_command);
  commands.begin("bench", "Put our own arithmetic to the test and print a table");
  commands.add("stability", "Stress tests of numerical stability, beside Embree on the same rays", StabilityOptions(),
               bench_stability_command);
  commands.add("precision", "The picture in float against double precision, every differing pixel explained", PrecisionOptions(),
               bench_precision_command);
  commands.add("error", "What every knob costs, and does to the picture's error", ErrorOptions(), bench_error_command);
  commands.add("speed", "Our grid, pictures, computers and databases beside Embree and each other", SpeedOptions(),
               bench_speed_command);
}

}  // namespace

Command parse_command_line(std::span<const std::string> arguments) { return parse_command_line(declare_all, arguments); }

CommandDescription describe_command_line() { return Commands(declare_all).line().describe(); }

}  // namespace dmpc::apps
