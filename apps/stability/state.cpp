#include "apps/stability/state.h"

#include <fstream>
#include <sstream>

#include "apps/output_file.h"
#include "core/expect.h"

namespace dmpc::apps {
namespace {

constexpr const char* first_line = "dmpc bench stability, state 1";

std::ostream& operator<<(std::ostream& text, const StabilityCounts& counts) {
  return text << counts.tried << ' ' << counts.leaks << ' ' << counts.wrong_hits << ' ' << counts.double_claims << ' '
              << counts.unexplained << ' ' << counts.explained << ' ' << counts.error_milliulp;
}

std::istream& operator>>(std::istream& text, StabilityCounts& counts) {
  return text >> counts.tried >> counts.leaks >> counts.wrong_hits >> counts.double_claims >> counts.unexplained >>
         counts.explained >> counts.error_milliulp;
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw core::InputError("--resume=" + path.string() + ": " + why);
}

/// Reads the lines behind the first two; false if they are damaged.
bool read_counts(std::istream& text, StabilityState& state) {
  std::size_t lines = 0;
  if (!(text >> state.case_index >> state.rays_done >> lines)) {
    return false;
  }
  for (; lines > 0; --lines) {
    std::size_t row = 0, kernel = 0;
    if (!(text >> row >> kernel) || row >= state.rows.size() || kernel >= stability_kernel_count ||
        !(text >> state.rows[row].counts[kernel])) {
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
  for (std::size_t row = 0; row < state.rows.size(); ++row) {
    for (std::size_t kernel = 0; kernel < stability_kernel_count; ++kernel) {
      const StabilityCounts& counts = state.rows[row].counts[kernel];
      if (counts.tried > 0) {
        lines << row << ' ' << kernel << ' ' << counts << '\n';
        ++count;
      }
    }
  }
  std::ostringstream text;
  text << first_line << '\n' << options << '\n' << state.case_index << ' ' << state.rays_done << ' ' << count << '\n';
  return text.str() + lines.str();
}

void save_state(const std::filesystem::path& path, const StabilityState& state, const std::string& options) {
  write_file(path, text_of(state, options));
}

void load_state(const std::filesystem::path& path, StabilityState& state, const std::string& options) {
  if (!std::filesystem::exists(path)) {
    return;
  }
  std::ifstream text(path);
  std::string kind, theirs;
  if (!std::getline(text, kind) || kind != first_line || !std::getline(text, theirs)) {
    refuse(path, "this is no state of `dmpc bench stability`, expected one or a file that is not there yet");
  }
  if (theirs != options) {
    refuse(path, "this is the state of a run with other options (" + theirs + "), expected " + options);
  }
  if (!read_counts(text, state)) {
    refuse(path, "this state is damaged, remove it and start again");
  }
}

}  // namespace dmpc::apps
