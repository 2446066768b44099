#include "apps/frontend/system/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <utility>

#include "apps/frontend/line/shown_text.h"

namespace dmpc::apps {

namespace {

constexpr std::uint64_t bar_width = 30;
bool is_silenced = false;

std::string bar(std::uint64_t done, std::uint64_t total) {
  const auto full = static_cast<std::size_t>(bar_width * done / total);
  std::string text(full, '=');
  text += full < bar_width ? ">" : "";
  text.resize(bar_width, ' ');
  return text;
}

}  // namespace

std::string clock_text(double seconds) {
  const auto whole = static_cast<std::uint64_t>(std::llround(std::min(seconds, 1e9)));
  std::ostringstream text;
  text << std::setfill('0');
  if (whole >= 3600) {
    text << whole / 3600 << ':' << std::setw(2);
  }
  text << whole / 60 % 60 << ':' << std::setw(2) << whole % 60;
  return text.str();
}

std::string progress_line(std::uint64_t done, std::uint64_t total, double seconds, const std::string& unit) {
  std::ostringstream text;
  text << std::setw(3) << 100 * done / total << " % [" << bar(done, total) << "]";
  if (done > 0 && seconds > 0) {
    const double rate = static_cast<double>(done) / seconds;
    text << ' ' << std::fixed << std::setprecision(0) << std::setw(8) << rate << ' ' << unit << "/s";
    if (seconds >= 10 || (seconds >= 1 && done >= total / 100)) {
      text << ", " << clock_text(static_cast<double>(total - done) / rate) << " left";
    }
  }
  return text.str();
}

void silence_progress() { is_silenced = true; }

bool stderr_is_terminal() { return ::isatty(STDERR_FILENO) == 1; }

Progress::Progress(std::ostream& output, bool shown, std::string label, std::string unit)
    : output_(output),
      shown_(shown && !is_silenced),
      label_(std::move(label)),
      unit_(std::move(unit)),
      start_(Clock::now()),
      next_(start_) {
  if (shown_ && !label_.empty()) {
    output_ << clear_line << label_ << std::flush;
  }
}

Progress::~Progress() {
  if (shown_) {
    output_ << clear_line << std::flush;
  }
}

bool Progress::is_due() {
  const Clock::time_point now = Clock::now();
  if (!shown_ || now < next_) {
    return false;
  }
  next_ = now + std::chrono::milliseconds(100);
  return true;
}

void Progress::show(const std::string& label, std::uint64_t done, std::uint64_t total) {
  if (is_due()) {
    output_ << clear_line << label << progress_line(done, total, 0) << std::flush;
  }
}

void Progress::update(std::uint64_t done, std::uint64_t total) {
  if (!is_due()) {
    return;
  }
  const Clock::time_point now = Clock::now();
  start_ = done < done_ ? now : start_;
  done_ = done;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  output_ << clear_line << label_ << progress_line(done, total, seconds, unit_) << std::flush;
}

}  // namespace dmpc::apps
