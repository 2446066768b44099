// The options of each study that is a program in Python.
#include "apps/lab/study/python/python_study.h"

#include <algorithm>
#include <set>

#include "apps/frontend/line/option_values.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/machine/machine_file.h"
#include "apps/frontend/run/option_words.h"
#include "apps/frontend/table/table_options.h"
#include "apps/run/systems.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

void declare_balance(OptionSet set, PythonStudy& study) {
  add_node_counts(set, study.node_counts);
  set.add_number("--subsample", study.run.rays.balance.subsample, 1, 65'536, "8",
                 "The subsampled picture has one pixel of every NxN");
  set.add_choice("--topology", *study.run.rays.topology, topology_choices(),
                 "The wiring onto which neighbouring regions are mapped");
  set.add_flag("--per-node", study.is_set, "Show each node's share of the work, too");
  add_scene_options(set, study);
  set.set_examples(
      "Examples:\n"
      "  dmpc study balance rings-3-t1\n"
      "  dmpc study balance teapot-12 --nodes=16 --topology=torus --per-node --format=csv -o teapot.csv");
}

void declare_traffic(OptionSet set, PythonStudy& study) {
  add_node_counts(set, study.node_counts);
  add_scene_options(set, study);
  set.set_examples(
      "Examples:\n"
      "  dmpc study traffic teapot-12\n"
      "  dmpc study traffic rings-4-t1 --nodes=8,64 --resolution=256x256 --format=json -o rings.json");
}

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

void check_machines(const std::string& text) {
  std::set<std::string> seen;
  for (const std::string& name : words_between_commas(text, "--machines")) {
    if (!seen.insert(name).second) {
      throw core::UsageError("--machines=" + text + ": " + name + " is there twice");
    }
    if (find_machine_preset(name) == nullptr) {
      throw core::UsageError("--machines=" + text + ": expected names of " + machine_preset_names() +
                             ", with commas between; a file goes with --machine");
    }
  }
}

void check_line(const OptionSet& set, const PythonStudy& study) {
  if (set.is_given("--camera-path") && set.is_given("--turntable")) {
    throw core::UsageError("--turntable does not go with --camera-path: the camera moves in one way");
  }
  if (set.is_given("--machines") && set.is_given("--machine")) {
    throw core::UsageError("--machines does not go with --machine: name all of them, or the one");
  }
  if (std::find(study.node_counts.begin(), study.node_counts.end(), 1U) != study.node_counts.end()) {
    throw core::UsageError("--nodes: expected at least 2, as a node alone fetches and sends nothing");
  }
  load_machine(study.machine_name);
}

void declare_frames(OptionSet set, PythonStudy& study) {
  add_node_counts(set, study.node_counts);
  set.add_number("--frames", study.number, 2, 10'000, "6", "Frames of the path, of which all but the first are counted");
  set.add_flag("--each-frame", study.is_set, "Rows for single frames, too, the first among them");
  set.add_text(
      "--turntable", "DEGREES [1]",
      [](const std::string& text) {
        parse_within(text, "--turntable", -360, 360, "degrees from one frame to the next, from -360 to 360");
      },
      "From one frame to the next the camera goes round the scene by so much");
  set.add_text("--camera-path", "FILE", passed_on,
               "Move the camera through the keyframes of FILE, lines of a frame and what --camera takes, from frame 1 on");
  add_machine_option(set, study.machine_name, "");
  set.add_text("--machines", "NAME,NAME,...", check_machines, "Several machines in place of one, each with rows of its own");
  set.check_in_the_end([set, &study] { check_line(set, study); });
  add_scene_options(set, study);
  set.set_examples(
      "Examples:\n"
      "  dmpc study frames rings-4-t1\n"
      "  dmpc study frames rings-4-t1 --resolution=128x128 --nodes=16,64 --machines=ipsc2,gigabit,hdr\n"
      "  dmpc study frames mount-6 --turntable=5 --each-frame --format=csv -o mount.csv");
}

PythonStudy of_one_scene(const char* name, void (*declare)(OptionSet, PythonStudy&),
                         const std::vector<std::uint32_t>& node_counts) {
  return {.name = name,
          .module = "computers.command",
          .declare = declare,
          .database = DatabaseOptions(),
          .node_counts = node_counts,
          .words = {name}};
}

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

void declare_paper(OptionSet set, PythonStudy& study) {
  set.add_number("--resolution", study.side, 8, 4096, "512, the article's", "Pixels a side of every picture");
  set.add_flag("--sensitivity", study.is_set,
               "Also change each figure of the machine by a fifth, and show what it does: some minutes more");
  set.add_text(
      "-o,--output", "FOLDER", passed_on,
      "Where the report goes, as a page and as Markdown, with each table as CSV and JSON, plots by Python's matplotlib, hashes, "
      "and all of it as paper.zip; and the counters of all runs");
  add_report_option(set, study.report, "with the tables and their plots");
  add_run_options(set, study);
  set.set_examples(
      "Examples:\n"
      "  dmpc study paper -o paper              the article's pictures: ten minutes of processor time\n"
      "  dmpc study paper --sensitivity -o paper\n"
      "  dmpc study paper --resolution=64       to see what it prints, not what is true");
}

void declare_systems(OptionSet set, PythonStudy& study) {
  study.node_counts = {64};
  study.picture.resolution = Resolution{128, 128};
  study.words = {"--resolution=128x128"};
  add_node_counts(set, study.node_counts);
  set.add_words("--systems", core::mapped<std::string>(systems(), &SystemDescription::name), passed_on,
                "Which are compared; all if none is given");
  set.add_words(
      "--tables", {"described", "equal"}, passed_on,
      "described: each system as it had it when it was described. equal: each on every structure at its best, with equal "
      "memory. Both if none is given");
  set.add_text(
      "--node-memory", "RULE,RULE,... [rays]", passed_on,
      "All that a node may store, in the table equal: rays, what the better of scattered and subsampled needs by default on the "
      "grid; S%, a share of the database; or a size such as 4MiB");
  set.add_flag("--search", study.is_set, "Adds the steps of each row's search as notes");
  set.add_number("--draws", study.number, 0, 10'000, "100",
                 "Draws of the machine's prices, within the certainty of their sources, for the best rows; 0: none");
  add_machine_option(set, study.machine_name, "");
  set.check_in_the_end([&study] { load_machine(study.machine_name); });
  add_scene_options(set, study);
  set.set_examples(
      "Examples:\n"
      "  dmpc study systems rings-4-t1\n"
      "  dmpc study systems balls-4 --machine=hdr --samples=16 --plots=plots -o systems.md\n"
      "  dmpc study systems mount-6-t6 --tables=equal --node-memory=rays,25%,1MiB --search --format=csv -o systems.csv\n"
      "A system that does not fit has a row without figures.");
}

}  // namespace

PythonStudy python_study(const std::string& name) {
  for (PythonStudy study :
       {of_one_scene("balance", declare_balance, {4, 8, 16, 32, 64}), of_one_scene("frames", declare_frames, {8}),
        of_one_scene("speedup", declare_speedup, {1, 2, 4, 8, 16, 32, 64}),
        of_one_scene("traffic", declare_traffic, {1, 2, 4, 8, 16, 32, 64}),
        PythonStudy{"decades", "decades.command", declare_decades}, PythonStudy{"paper", "paper.command", declare_paper},
        PythonStudy{"systems", "systems.command", declare_systems}}) {
    if (study.name == name) {
      return study;
    }
  }
  throw core::InternalError("there is no study " + name);
}

}  // namespace dmpc::apps
