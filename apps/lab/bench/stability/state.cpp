#include "apps/lab/bench/stability/state.h"

#include <cstring>
#include <sstream>

#include "apps/edge/system/file_source.h"
#include "apps/edge/system/output_file.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr const char* first_line = "dmpc bench stability, state 3";

std::ostream& operator<<(std::ostream& text, const StabilityCounts& counts) {
  return text << counts.tried << ' ' << counts.leaks << ' ' << counts.wrong_hits << ' ' << counts.double_claims << ' '
              << counts.unexplained << ' ' << counts.explained << ' ' << counts.error_milliulp << ' ' << counts.sure_hits << ' '
              << counts.sure_misses << ' ' << counts.heard;
}

std::istream& operator>>(std::istream& text, StabilityCounts& counts) {
  return text >> counts.tried >> counts.leaks >> counts.wrong_hits >> counts.double_claims >> counts.unexplained >>
         counts.explained >> counts.error_milliulp >> counts.sure_hits >> counts.sure_misses >> counts.heard;
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw core::InputError("--resume=" + path.string() + ": " + why);
}

/// States have less than a KiB for each kernel; other files may have any number.
std::string whole_text(const std::filesystem::path& path, Files& files) {
  constexpr std::size_t bytes_max = std::size_t{1} << 20U;
  FileSource source(path, files);
  std::string text(bytes_max, ' ');
  source.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(source.gcount()));
  if (source.error() != 0) {
    refuse(path, std::string("cannot be read: ") + std::strerror(source.error()));
  }
  return text;
}

/// The counts of a line: those of a row and kernel or, behind all rows, of a case; null if there are none.
StabilityCounts* counts_at(StabilityState& state, std::size_t row, std::size_t kernel) {
  if (row < state.rows.size()) {
    return kernel < stability_kernel_count ? &state.rows[row].counts[kernel] : nullptr;
  }
  const std::size_t trial = row - state.rows.size();
  return trial < state.trials.size() && kernel == 0 ? &state.trials[trial].counts : nullptr;
}

/// Reads the lines behind the first two; false if they are damaged.
bool read_counts(std::istream& text, StabilityState& state) {
  std::size_t lines = 0;
  if (!(text >> state.case_index >> state.rays_done >> lines)) {
    return false;
  }
  for (; lines > 0; --lines) {
    std::size_t row = 0, kernel = 0;
    StabilityCounts* const counts = text >> row >> kernel ? counts_at(state, row, kernel) : nullptr;
    if (counts == nullptr || !(text >> *counts)) {
      return false;
    }
  }
  std::string rest;
  return !(text >> rest);
}

}  // namespace

std::string text_of(const StabilityState& state, const std::string& options) {
  std::ostringstream lines;
  std::size_t count = 0;
  const auto add = [&](std::size_t row, std::size_t kernel, const StabilityCounts& counts) {
    if (counts.tried > 0) {
      lines << row << ' ' << kernel << ' ' << counts << '\n';
      ++count;
    }
  };
  for (std::size_t row = 0; row < state.rows.size(); ++row) {
    for (std::size_t kernel = 0; kernel < stability_kernel_count; ++kernel) {
      add(row, kernel, state.rows[row].counts[kernel]);
    }
  }
  for (std::size_t trial = 0; trial < state.trials.size(); ++trial) {
    add(state.rows.size() + trial, 0, state.trials[trial].counts);
  }
  std::ostringstream text;
  text << first_line << '\n' << options << '\n' << state.case_index << ' ' << state.rays_done << ' ' << count << '\n';
  return text.str() + lines.str();
}

void save_state(const std::filesystem::path& path, const StabilityState& state, const std::string& options, Files& files) {
  write_file(path, text_of(state, options), Durability::on_disk, files);
}

void load_state(const std::filesystem::path& path, StabilityState& state, const std::string& options, Files& files) {
  if (!std::filesystem::exists(path)) {
    return;
  }
  const std::string whole = whole_text(path, files);
  std::istringstream text(whole);
  std::string kind, theirs;
  if (!std::getline(text, kind) || kind != first_line || !std::getline(text, theirs)) {
    refuse(path, "this is no state of `dmpc bench stability`, expected one or a file that is not there yet");
  }
  if (theirs != options) {
    refuse(path, "this is the state of a run with other options (" + theirs + "), expected " + options);
  }
  // A last number that is cut short would be another number.
  if (!whole.ends_with('\n') || !read_counts(text, state)) {
    refuse(path, "this state is damaged, remove it and start again");
  }
}

}  // namespace dmpc::apps
