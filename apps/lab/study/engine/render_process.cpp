#include "apps/lab/study/engine/render_process.h"

#include <algorithm>
#include <csignal>
#include <string_view>
#include <utility>

#include "apps/frontend/line/exit_status.h"
#include "apps/frontend/system/completed_process.h"
#include "apps/frontend/system/text_input.h"
#include "core/base/expect.h"

namespace dmpc::apps {

std::string sentence_of(std::string complaint) {
  constexpr std::string_view program = "dmpc: ";
  if (complaint.starts_with(program)) {
    complaint.erase(0, program.size());
  }
  complaint.erase(complaint.find_last_not_of(" \n.") + 1);
  return complaint.empty() ? "It did not say why" : complaint;
}

namespace {

/// Returns nothing after success, and the reason if there was not enough memory.
std::optional<std::string> misfit_of(const CompletedProcess& process) {
  if (process.status == 0) {
    return std::nullopt;
  }
  if (process.status == -SIGKILL) {
    return "It was killed, as a computer without memory to spare does";
  }
  if (process.status == no_capacity_status) {
    return sentence_of(process.complaint);
  }
  if (process.status == input_status) {
    throw core::InputError(sentence_of(process.complaint));
  }
  throw core::InternalError("a render ended with status " + std::to_string(process.status) + ": " +
                            sentence_of(process.complaint));
}

/// The computer is responsible for what the disk returns, dmpc for its consistency.
std::vector<Figure> figures_in(const std::filesystem::path& stats) {
  const std::string text = bounded_text(stats, figures_bytes_max, "what dmpc render --stats writes");
  try {
    return parse_figures(text, stats.string());
  } catch (const core::InputError& error) {
    throw core::InternalError(std::string("the statistics of a render cannot be read: ") + error.what());
  }
}

}  // namespace

std::vector<std::string> RenderProcesses::with_outputs(std::vector<std::string> words, const std::string& stats,
                                                       const std::string& picture) {
  words.insert(words.end(), {"--quiet", "--stats=" + stats, "--output=" + picture});
  return words;
}

RenderEnd RenderProcesses::run(std::vector<std::string> words, const std::string& name, const Keep& keep) const {
  const std::filesystem::path counters = folder_ / (name + ".json"), picture = folder_ / (name + ".exr");
  const CompletedProcess process =
      run_process(program_, with_outputs(std::move(words), counters.string(), picture.string()), interrupt_);
  std::error_code ignored;
  std::filesystem::remove(picture, ignored);
  if (std::optional<std::string> misfit = misfit_of(process)) {
    return {{}, std::move(*misfit)};
  }
  RenderEnd end{figures_in(counters), {}};
  if (keep) {
    keep(counters);
  }
  return end;
}

}  // namespace dmpc::apps
