#include "apps/lab/study/decades/command.h"

#include "apps/frontend/system/python_program.h"

namespace dmpc::apps {

void add_options(OptionSet set, DecadesOptions& options) {
  const auto pass = [&words = options.words](const char* name) {
    return [&words, name](const std::string& value) { words.push_back(std::string(name) + "=" + value); };
  };
  set.add_required("-o,--output", "FOLDER", pass("--output"), "Folder of the page, its pictures, and the counters of all runs");
  set.add_text(
      "--part", "plan|run|hold [run]", pass("--part"),
      "plan: measure what a run of each kind costs, and print how many there are. run: make what the folder lacks, and the page. "
      "hold: time some renders over MPI on this computer beside their prediction, for the page");
  set.add_flag("--quick", options.is_quick, "Fewer cells, scenes and draws: minutes, where all take an hour or two on two cores");
  set.add_text("--jobs", "1..256 [all cores]", pass("--jobs"), "Runs at a time");
  set.add_quiet(options.quiet);
  set.set_examples(
      "Examples:\n"
      "  dmpc study decades --quick -o decades\n"
      "  dmpc study decades -o decades\n"
      "Needs Python with numpy, pandas, OpenImageIO and matplotlib.");
}

int study_decades_command(const DecadesOptions& options, std::ostream& output) {
  output.flush();
  std::vector<std::string> words = options.words;
  if (options.is_quick) {
    words.emplace_back("--quick");
  }
  if (options.quiet) {
    words.emplace_back("--quiet");
  }
  become_python("decades.command", "study decades", words);
}

}  // namespace dmpc::apps
