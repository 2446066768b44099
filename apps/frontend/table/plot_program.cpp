#include "apps/frontend/table/plot_program.h"

#include <cstddef>

#include "apps/frontend/system/child_process.h"
#include "apps/frontend/system/output_file.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace fs = std::filesystem;

namespace {

/// Limit of the program's messages that are kept.
constexpr std::size_t words_bytes_max = 2000;

/// Returns the words without empty lines, on one line.
std::string on_one_line(const std::string& words) {
  std::string line;
  for (const char character : words) {
    const bool is_space = character == ' ' || character == '\n' || character == '\t';
    if (!is_space || (!line.empty() && line.back() != ' ')) {
      line += is_space ? ' ' : character;
    }
  }
  return line.substr(0, line.find_last_not_of(' ') + 1);
}

std::string end_of(int status) {
  return status == 0  ? ""
         : status < 0 ? "it was ended by signal " + std::to_string(-status)
                      : "its exit status is " + std::to_string(status);
}

PlotOutcome run_script(const fs::path& folder, const std::string& name, const std::string& program) {
  ChildProcess process({.program = program, .arguments = {name + ".gnuplot"}, .folder = folder});
  const std::string end = end_of(process.wait()), words = on_one_line(process.errors().substr(0, words_bytes_max));
  std::error_code ignored;
  if (end.empty() && fs::exists(folder / (name + ".svg"), ignored)) {
    return {.is_drawn = true};
  }
  return {.complaint = program + " could not draw " + name + ".svg" + (end.empty() ? "" : ", " + end) +
                       (words.empty() ? "" : ": " + words)};
}

/// Returns the outcome if the program is missing.
PlotOutcome outcome_of(const fs::path& folder, const std::string& name, const std::string& program) {
  try {
    return run_script(folder, name, program);
  } catch (const core::InputError& error) {
    return {.is_program_missing = true, .complaint = error.what()};
  }
}

}  // namespace

std::string sentence_on(const PlotOutcome& outcome) {
  return outcome.is_program_missing ? "the plots are not drawn: " + outcome.complaint +
                                          " (package gnuplot-nox); once it is there, `gnuplot *.gnuplot` in the folder draws them"
                                    : outcome.complaint;
}

std::optional<PlotOutcome> draw(const Plot& plot, const Table& table, const fs::path& folder, const std::string& data_file,
                                const std::string& program) {
  const fs::path script_path = folder / (plot.name + ".gnuplot"), picture_path = folder / (plot.name + ".svg");
  std::error_code ignored;
  fs::remove(picture_path, ignored);
  const std::optional<std::string> script = script_of(plot, table, data_file);
  if (!script) {
    fs::remove(script_path, ignored);
    return std::nullopt;
  }
  write_file(script_path, *script, Durability::until_power_loss);
  PlotOutcome outcome = outcome_of(folder, plot.name, program);
  if (!outcome.is_drawn) {
    fs::remove(picture_path, ignored);
  }
  return outcome;
}

}  // namespace dmpc::apps
