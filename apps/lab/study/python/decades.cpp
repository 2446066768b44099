#include "apps/lab/study/python/python_study.h"

namespace dmpc::apps {
namespace {

void declare_decades(OptionSet set, PythonStudy& study) {
  set.add_required("-o,--output", "FOLDER", passed_on, "Folder of the page, its pictures, and the counters of all runs");
  set.add_text(
      "--part", "plan|run|hold [run]", passed_on,
      "plan: measure what a run of each kind costs, and print how many there are. run: make what the folder lacks, and the page. "
      "hold: time some renders over MPI on this computer beside their prediction, for the page");
  set.add_flag("--quick", study.is_set, "Fewer cells, scenes and draws: minutes, where all take an hour or two on two cores");
  add_run_options(set, study);
  set.set_examples(
      "Examples:\n"
      "  dmpc study decades --quick -o decades\n"
      "  dmpc study decades -o decades\n"
      "Needs Python with numpy, pandas, OpenImageIO and matplotlib.");
}

}  // namespace

PythonStudy decades_study() { return {.name = "decades", .module = "decades.command", .declare = declare_decades}; }

}  // namespace dmpc::apps
