#include "apps/effort/effort.h"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "apps/edge/line/number_text.h"
#include "apps/edge/system/progress.h"

namespace dmpc::apps {
namespace {

/// What takes less is over before one has read of it.
constexpr double short_seconds = 5;
constexpr std::size_t small_bytes = std::size_t{256} << 20U;

/// The guess may be off by so much to either side.
constexpr double uncertainty = 2;

/// To one significant digit, two from ten on: more would promise too much.
double coarse(double value) { return value < 10 ? std::max(std::round(value), 1.0) : 5 * std::round(value / 5); }

std::string memory_text(std::size_t bytes) {
  constexpr std::size_t gibibyte = std::size_t{1} << 30U;
  return bytes < gibibyte ? bytes_text(bytes) : fixed(static_cast<double>(bytes) / gibibyte, 1) + " GiB";
}

/// A number of a unit that suits it.
struct Duration {
  std::string number, unit;
};

Duration duration_of(double seconds) {
  const auto in = [seconds](double unit_seconds, const char* unit) {
    return Duration{fixed(coarse(seconds / unit_seconds), 0), unit};
  };
  constexpr double day = 86'400, year = 365 * day;
  return seconds < 90        ? in(1, " seconds")
         : seconds < 90 * 60 ? in(60, " minutes")
         : seconds < 4 * day ? in(3600, " hours")
         : seconds < year    ? in(day, " days")
                             : in(year, " years");
}

/// "2 to 8 minutes", "45 seconds to 3 minutes".
std::string duration_text(double seconds) {
  if (seconds < short_seconds) {
    return "some seconds";
  }
  const Duration least = duration_of(seconds / uncertainty), most = duration_of(seconds * uncertainty);
  return least.number + (least.unit == most.unit ? "" : least.unit) + " to " + most.number + most.unit;
}

}  // namespace

std::string text_of(const Effort& effort) {
  if (effort.bytes < small_bytes) {
    return duration_text(effort.seconds);
  }
  const std::string memory = memory_text(effort.bytes) + " of memory";
  return duration_text(effort.seconds) +
         (effort.is_given ? "; nodes are given up to " + memory + ", and may touch less" : " and up to " + memory);
}

bool is_long(const Effort& effort) {
  constexpr double long_seconds = 30;
  return effort.seconds >= long_seconds;
}

void announce(const std::string& what, const Effort& effort, bool quiet, std::ostream& messages) {
  const bool is_worth_saying = effort.seconds >= short_seconds || effort.bytes >= small_bytes;
  if (is_worth_saying && !quiet && stderr_is_terminal()) {
    messages << "dmpc: " << what << ": " << text_of(effort) << std::endl;
  }
}

}  // namespace dmpc::apps
