#include "apps/run/systems.h"

#include <utility>

#include "apps/frontend/machine/machine_file.h"
#include "apps/lab/study/python/python_study.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

constexpr Resolution systems_resolution{128, 128};

void declare_systems(OptionSet set, PythonStudy& study) {
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
  constexpr std::uint32_t draws_max = 10'000;
  set.add_number("--draws", study.number, 0, draws_max, "100",
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

PythonStudy systems_study() {
  PythonStudy study{.name = "systems", .module = "systems.command", .declare = declare_systems, .node_counts = {64}};
  study.picture.resolution = systems_resolution;
  study.words = {"--resolution=128x128"};
  return study;
}

}  // namespace dmpc::apps
