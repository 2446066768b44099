#include "apps/computer/program_outputs.h"

#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/computer/program_page.h"
#include "apps/computer/task_heat_file.h"
#include "apps/edge/machine/machines.h"
#include "apps/edge/show/references/reference_file.h"
#include "apps/edge/system/attempts.h"
#include "apps/edge/system/scratch_folder.h"

namespace dmpc::apps {
namespace {

void write_stats(const ProgramRecord& record, std::ostream& output) { output << stats_json(record); }

void write_program_references(const ProgramRecord& record, std::ostream& output) {
  write_references(output, record.tasks.references, record.options.tasks.page_size_bytes);
}

/// The files that a program reads.
std::vector<NamedFile> inputs_of(const ProgramOptions& options) {
  const bool reads_file = options.is_modelled() && find_machine_preset(options.machine_name) == nullptr;
  return reads_file ? std::vector<NamedFile>{{"--machine", options.machine_name}} : std::vector<NamedFile>();
}

void print_result(const ProgramRecord& record) {
  const std::string& result = record.result;
  std::cout << result << (result.empty() || result.ends_with('\n') ? "" : "\n") << (record.options.quiet ? "" : summary(record));
  finish_output(std::cout, "what the program came to");
}

}  // namespace

ProgramOutputs outputs_of(const ProgramOptions& options) {
  ProgramOutputs outputs;
  const auto add = [&](const char* option, const std::optional<std::filesystem::path>& path, ProgramOutputs::Write write) {
    if (path) {
      outputs.add(option, *path, check_output_path, std::move(write));
    }
  };
  add("--stats", options.stats, write_stats);
  add("--references", options.references, write_program_references);
  add("--trace", options.trace, write_program_trace);
  add("--heat", options.heat, write_task_heat);
  add("--report", options.report, html::write_program_page);
  return outputs;
}

void check_outputs(const ProgramOptions& options, const ProgramOutputs& outputs) {
  check_outputs(inputs_of(options), outputs.names());
  if (options.report) {
    const ScratchFolder probe;
  }
}

int end_program(const ProgramRecord& record, const ProgramOutputs& outputs) {
  Attempts attempts(std::cerr, record.name);
  outputs.write(record, attempts);
  attempts.make([&] { print_result(record); });
  return attempts.status();
}

}  // namespace dmpc::apps
