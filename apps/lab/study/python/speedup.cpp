#include "apps/frontend/machine/machine_file.h"
#include "apps/lab/study/engine/study_line.h"
#include "apps/lab/study/python/python_study.h"

namespace dmpc::apps {
namespace {

void declare_speedup(OptionSet set, PythonStudy& study) {
  StrategyOptions& run = study.run;
  run.runner.kind = RunnerKind::virtual_time;
  add_node_counts(set, study.node_counts);
  add_strategy_option(set, run.strategy);
  add_memory_option(set, run.computer.node_memory_bytes);
  add_machine_option(set, study.machine_name, "");
  add_scene_options(set, study);
  add_page_options(set, run, "16, replicated 1");
  add_ray_options(set, run.rays);
  set.check_in_the_end([set, &study] {
    settle_database(set, study.run.strategy, *study.database);
    check_together(set, study.run);
    load_machine(study.machine_name);
  });
  set.set_examples(
      "Examples:\n"
      "  dmpc study speedup rings-4-t1\n"
      "  dmpc study speedup rings-4-t1 --node-memory=1MiB --replacement=clock --in-flight=4 --format=csv -o rings.csv\n"
      "  dmpc study speedup teapot-12 --strategy=dataflow --machine=hdr --nodes=1,16,256,1024\n"
      "A number of nodes whose memory cannot hold the scene has a row without figures, and a note that says what would do.\n"
      "If none can, the exit status is 4.");
}

}  // namespace

PythonStudy speedup_study() {
  return {.name = "speedup",
          .module = "computers.command",
          .declare = declare_speedup,
          .database = DatabaseOptions(),
          .node_counts = {1, 2, 4, 8, 16, 32, 64},
          .words = {"speedup"}};
}

}  // namespace dmpc::apps
