#include "apps/lab/oracle/accurate/reference.h"

#include <chrono>
#include <cmath>
#include <cstdlib>

#include "apps/edge/system/output_file.h"
#include "apps/lab/oracle/accurate/reference_file.h"
#include "apps/lab/oracle/accurate/reference_key.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;
using Clock = std::chrono::steady_clock;

/// What is added to a reference's value where relative errors are divided by it; as in apps/lab/difference/picture_error.h.
constexpr double relative_floor = 0.01;

Resolution resolution_of(const core::Scene& scene, const PictureOptions& picture) {
  return picture.resolution.value_or(Resolution{scene.view.width, scene.view.height});
}

/// What two halves of a picture share.
class Studio {
 public:
  Studio(const core::Scene& scene, const PictureOptions& picture, const Attendance& attendance)
      : scene_(accurate_scene(scene)),
        camera_(scene.view, resolution_of(scene, picture).width, resolution_of(scene, picture).height, scene_.bounds),
        finder_(scene_, camera_.start()),
        shade_{.convention = picture.convention, .depth_max = picture.depth},
        attendance_(attendance) {}

  /// `number`: 0 or 1.
  AccuratePicture half(std::uint64_t number, const SamplePattern& pattern) const {
    const Attendance both{
        .progress = [&](std::uint64_t done, std::uint64_t rows) { attendance_.progress(number * rows + done, 2 * rows); },
        .stop = attendance_.stop};
    return render_accurately(scene_, finder_, camera_, pattern, shade_, both);
  }

 private:
  AccurateScene scene_;
  AccurateCamera camera_;
  AccurateFinder finder_;
  core::ShadeOptions shade_;
  const Attendance& attendance_;
};

/// Picture and errors of two halves.
Reference joined(const AccuratePicture& a, const AccuratePicture& b) {
  Reference reference;
  reference.picture = Image(a.width, a.height);
  reference.rays = a.rays + b.rays;
  double squares = 0, relative_squares = 0;
  for (std::size_t pixel = 0; pixel < a.radiance.size(); ++pixel) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const double mean = (a.radiance[pixel][channel] + b.radiance[pixel][channel]) / 2;
      const double off = (a.radiance[pixel][channel] - b.radiance[pixel][channel]) / 2;
      reference.picture.rgb[3 * pixel + channel] = static_cast<float>(mean);
      squares += off * off;
      relative_squares += off * off / ((mean + relative_floor) * (mean + relative_floor));
    }
  }
  const auto values = static_cast<double>(3 * a.radiance.size());
  reference.own_error = std::sqrt(squares / values);
  reference.own_relative_mean_square = relative_squares / values;
  return reference;
}

Reference compute(const core::Scene& scene, const PictureOptions& picture, const ReferenceOptions& options,
                  const Attendance& attendance) {
  const Clock::time_point start = Clock::now();
  const Studio studio(scene, picture, attendance);
  const std::uint32_t n = options.samples_a_side;
  const AccuratePicture a = studio.half(0, SamplePattern::stratified(n, n / 2, 2 * options.seed));
  const AccuratePicture b = studio.half(1, SamplePattern::stratified(n / 2, n, 2 * options.seed + 1));
  Reference reference = joined(a, b);
  reference.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return reference;
}

std::optional<std::filesystem::path> absolute_path_in(const char* variable) {
  const char* const text = std::getenv(variable);
  const std::filesystem::path path = text == nullptr ? "" : text;
  return path.is_absolute() ? std::optional(path) : std::nullopt;
}

}  // namespace

std::optional<std::filesystem::path> default_reference_folder() {
  if (const auto cache = absolute_path_in("XDG_CACHE_HOME")) {
    return *cache / "dmpc";
  }
  const auto home = absolute_path_in("HOME");
  return home ? std::optional(*home / ".cache" / "dmpc") : std::nullopt;
}

Reference reference_for(const core::Scene& scene, const PictureOptions& picture, const ReferenceOptions& options,
                        const Attendance& attendance) {
  core::expect(options.samples_a_side >= 2 && options.samples_a_side % 2 == 0, "a reference has two halves of its samples");
  const std::optional<std::filesystem::path> folder = options.folder ? options.folder : default_reference_folder();
  if (!folder) {
    return compute(scene, picture, options, attendance);
  }
  const std::string key = reference_key(scene, resolution_of(scene, picture), picture, options);
  if (std::optional<Reference> kept = load_reference(*folder, key)) {
    return std::move(*kept);
  }
  make_reference_folder(*folder);
  Reference reference = compute(scene, picture, options, attendance);
  save_reference(*folder, key, reference);
  return reference;
}

}  // namespace dmpc::apps
