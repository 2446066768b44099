#include "apps/lab/bench/speed/pov_rival.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "apps/edge/line/number_text.h"
#include "apps/edge/system/output_file.h"
#include "apps/lab/bench/speed/plain_stage.h"
#include "apps/lab/bench/speed/pov_file.h"
#include "apps/lab/bench/speed/timed_process.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr const char *pov_program = "povray", *scene_name = "scene.pov", *picture_name = "picture.ppm";

/// The number that ends before `unit`, behind `from` in the text, which is then behind both.
std::optional<double> number_before(std::string_view unit, std::string_view& text) {
  const std::size_t end = text.find(unit);
  if (end == std::string_view::npos) {
    return std::nullopt;
  }
  const std::string_view before = text.substr(0, end);
  const std::size_t first = before.find_last_not_of("0123456789.") + 1;
  double number = 0;
  const auto read = std::from_chars(before.data() + first, before.data() + end, number);
  text.remove_prefix(end + unit.size());
  return read.ec == std::errc() ? std::optional(number) : std::nullopt;
}

double up_to_one(double value) { return std::clamp(value, 0.0, 1.0); }

}  // namespace

PovRival::PovRival(const Subject& subject) : width_(subject.settings.camera.width()), height_(subject.settings.camera.height()) {
  write_file(folder_ / scene_name, pov_of(PlainStage(subject, EmbreeMode::robust)));
}

bool PovRival::is_installed() { return program_on_path(pov_program).has_value(); }

Times PovRival::render(std::uint32_t thread_count, const Interrupt& interrupt) const {
  const TimedProcess timed = time_process(
      pov_program,
      {std::string("+I") + scene_name, std::string("+O") + picture_name, "+FP16", "File_Gamma=1.0", "+W" + std::to_string(width_),
       "+H" + std::to_string(height_), "+WT" + std::to_string(thread_count), "-D", "-A", "-V"},
      interrupt, folder_ / "");
  const std::optional<Times> times = trace_times_in(timed.complaint);
  if (!times) {
    throw core::InputError("POV-Ray was expected to say what tracing took, and said: " + timed.complaint);
  }
  return *times;
}

PlainPicture PovRival::picture() const {
  std::ostringstream bytes;
  bytes << std::ifstream(folder_ / picture_name, std::ios::binary).rdbuf();
  return picture_in_ppm(bytes.str());
}

std::optional<Times> trace_times_in(std::string_view statistics) {
  constexpr std::string_view head = "Trace Time:";
  const std::size_t at = statistics.find(head);
  if (at == std::string_view::npos) {
    return std::nullopt;
  }
  statistics.remove_prefix(at + head.size());
  const std::size_t bracket = statistics.find('(');
  statistics.remove_prefix(std::min(bracket, statistics.size()));
  const std::optional<double> wall = number_before(" seconds)", statistics);
  const std::optional<double> processor = number_before(" CPU-seconds", statistics);
  return wall && processor ? std::optional(Times{*wall, *processor}) : std::nullopt;
}

double pov_distance_to_ours(const PlainPicture& picture, const core::Film& film, const std::string& scene) {
  double sum = 0;
  for (std::uint32_t pixel = 0; pixel < picture.pixels.size(); ++pixel) {
    const core::Vec3d ours = film.radiance(pixel);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const double apart = double{picture.pixels[pixel][channel]} - up_to_one(ours[channel]);
      sum += apart * apart;
    }
  }
  const double distance = std::sqrt(sum / (3.0 * static_cast<double>(picture.pixels.size())));
  if (!(distance <= pov_error_max)) {
    throw core::InternalError("POV-Ray's picture of " + scene + " is " + fixed(255 * distance, 2) +
                              "/255 from ours, root mean square: expected " + fixed(255 * pov_error_max, 0) + "/255 at most");
  }
  return distance;
}

}  // namespace dmpc::apps
