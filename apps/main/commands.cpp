#include "apps/main/commands.h"

#include "apps/lab/bench/error/command.h"
#include "apps/lab/bench/precision/command.h"
#include "apps/lab/bench/speed/command.h"
#include "apps/lab/bench/stability/command.h"
#include "apps/lab/check/command.h"
#include "apps/lab/compare/command.h"
#include "apps/lab/study/cache.h"
#include "apps/lab/study/python/python_study.h"
#include "apps/lab/study/python/sweep.h"
#include "apps/lab/study/references/command.h"

namespace dmpc::apps {

namespace {

void declare_all(Commands& commands) {
  declare_renderer(commands);
  commands.add("check", "Compare every ray of a render with Embree, and let a referee settle differences", CheckOptions(),
               check_command);
  commands.add("compare", "Measure the difference of two pictures, or compare the counters of two runs", CompareOptions(),
               compare_command);
  commands.begin("study", "Render a scene on several computers and print a table");
  commands.add("balance", "How evenly the work of rays that travel is shared out", python_study("balance"), python_study_command);
  commands.add("traffic", "What travels when rays do, beside what travels when pages do", python_study("traffic"),
               python_study_command);
  commands.add("cache", "How often pages are missed with caches of every size and policy", StudyOptions(), study_command);
  commands.add("speedup", "How much faster a modelled machine gets by more nodes", python_study("speedup"), python_study_command);
  commands.add("systems", "The systems that the 1994 article classifies, side by side on one machine", python_study("systems"),
               python_study_command);
  commands.add("frames", "What frames of a moving camera fetch and send, with caches warm and cold", python_study("frames"),
               python_study_command);
  commands.add("paper", "Regenerate the tables and claims of the 1994 article", python_study("paper"), python_study_command);
  commands.add("decades", "Find what should travel, pages, rays or questions, on machines of 1988 to 2025",
               python_study("decades"), python_study_command);
  commands.add("references", "Simulate page caches on recorded references, and count misses", ReferencesOptions(),
               study_references_command);
  commands.add("sweep", "Render all combinations of chosen options, and print chosen counters", SweepStudy(),
               study_sweep_command);
  commands.begin("bench", "Test accuracy and speed of the renderer and print a table");
  commands.add("stability", "Stress tests of numerical stability, with Embree on the same rays", StabilityOptions(),
               bench_stability_command);
  commands.add("precision", "Compare the picture in float with double precision, and explain every differing pixel",
               PrecisionOptions(), bench_precision_command);
  commands.add("error", "Measure the cost of each quality setting and its effect on the picture's error", ErrorOptions(),
               bench_error_command);
  commands.add("speed", "Measure the speed of grid, pictures, computers and databases, next to Embree and each other",
               SpeedOptions(), bench_speed_command);
}

}  // namespace

Command parse_command_line(std::span<const std::string> arguments) { return parse_command_line(declare_all, arguments); }

CommandDescription describe_command_line() { return Commands(declare_all).line().describe(); }

}  // namespace dmpc::apps
