#include "apps/lab/study/python/python_study.h"

#include <ostream>

#include "apps/frontend/line/option_values.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/machine/machines.h"
#include "apps/frontend/system/python_program.h"
#include "apps/frontend/table/table_files.h"
#include "apps/scene/load_scene.h"
#include "nodes/node_id.h"

namespace dmpc::apps {

void add_options(OptionSet set, PythonStudy& study) {
  study.declare(set, study);
  set.check_in_the_end([set, &study] {
    std::erase_if(study.words, [&](const std::string& word) { return set.is_given(word.substr(0, word.find('='))); });
    const std::vector<std::string> given = set.given_words({});
    study.words.insert(study.words.end(), given.begin(), given.end());
    if (!study.picture.scene.empty()) {
      study.words.push_back(study.picture.scene);
    }
  });
}

void add_node_counts(OptionSet set, std::vector<std::uint32_t>& counts) {
  const std::string listed = joined(counts, ",", [&](const std::uint32_t count) { return std::to_string(count); });
  set.add_text(
      "--nodes", "N,N,... [" + listed + "]",
      [&counts](const std::string& text) { counts = parse_numbers(text, "--nodes", nodes::node_count_max); },
      "Nodes of the computers, one after the other");
}

void add_scene_options(OptionSet set, PythonStudy& study) {
  add_options(set, study.picture);
  add_transport_options(set, study.picture);
  if (study.database) {
    add_options(set, *study.database);
  }
  add_options(set, study.table.emplace(), TableExtras::none);
  set.add_path("--plots", "FOLDER", study.table->plots, "Write plots by Python's matplotlib to this folder, with their data");
  set.add_quiet(study.quiet);
}

void add_run_options(OptionSet set, PythonStudy& study) {
  set.add_text("--jobs", "1..256 [all cores]", passed_on, "Runs at a time");
  set.add_quiet(study.quiet);
}

int python_study_command(const PythonStudy& study, std::ostream& output) {
  if (study.table) {
    std::vector<NamedFile> inputs;
    add_scene_file(study.picture, inputs);
    if (find_machine_preset(study.machine_name) == nullptr) {
      inputs.push_back({"--machine", study.machine_name});
    }
    static_cast<void>(TableFiles(*study.table, {}, {.inputs = std::move(inputs)}));
  }
  output.flush();
  become_python(study.module, "study " + study.name, study.words);
}

}  // namespace dmpc::apps
