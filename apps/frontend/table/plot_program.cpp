#include "apps/frontend/table/plot_program.h"

#include <cstddef>
#include <string_view>

#include "apps/frontend/system/child_process.h"
#include "apps/frontend/system/python_program.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// Limit of the program's messages that are kept.
constexpr std::size_t words_bytes_max = 2000;

/// Returns the last line, which has the error in what Python says.
std::string last_line(std::string words) {
  words.erase(words.find_last_not_of(" \n") + 1);
  words = words.substr(words.find_last_of('\n') + 1, words_bytes_max);
  constexpr std::string_view program = "dmpc: ";
  return words.starts_with(program) ? words.substr(program.size()) : words;
}

}  // namespace

std::string draw_plots(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  std::vector<std::string> words = {folder.string()};
  words.insert(words.end(), names.begin(), names.end());
  std::string complaint;
  try {
    ChildProcess process({.program = python(), .arguments = python_words("plotting", "--plots", words)});
    if (process.wait() == 0) {
      return "";
    }
    complaint = last_line(process.errors());
  } catch (const core::InputError& error) {
    complaint = error.what();
  }
  return "the plots are not drawn: " + complaint;
}

}  // namespace dmpc::apps
