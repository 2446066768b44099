#include "apps/lab/oracle/reference/reference.h"

#include <chrono>
#include <cmath>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;
using Clock = std::chrono::steady_clock;

/// Added to a reference's value in the denominator of relative errors, as in apps/lab/difference/picture_error.h.
constexpr double relative_floor = 0.01;

}  // namespace

void HalvesSum::add(std::size_t pixel, const Vec3d& a, const Vec3d& b, Reference& reference) {
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double mean = (a[channel] + b[channel]) / 2, off = (a[channel] - b[channel]) / 2;
    reference.picture.rgb[3 * pixel + channel] = static_cast<float>(mean);
    reference.difference.rgb[3 * pixel + channel] = static_cast<float>(off);
    squares += off * off;
    relative_squares += off * off / ((mean + relative_floor) * (mean + relative_floor));
  }
}

void HalvesSum::finish(Reference& reference) const {
  const auto values = static_cast<double>(reference.picture.rgb.size());
  reference.own_error = std::sqrt(squares / values);
  reference.own_relative_mean_square = relative_squares / values;
}

Reference reference_for(const core::Scene& scene, const PictureOptions& picture, const ReferenceOptions& options,
                        const Attendance& attendance) {
  const std::uint32_t n = options.samples_a_side;
  core::expect(n >= 2 && n % 2 == 0, "a reference has two halves of its samples");
  const Clock::time_point start = Clock::now();
  const ReferenceScene doubled = reference_scene(scene);
  const Resolution size = picture.resolution.value_or(Resolution{scene.view.width, scene.view.height});
  const ReferenceCamera camera(scene.view, size.width, size.height, doubled.bounds);
  const ReferenceFinder finder(doubled, camera.start());
  const auto half = [&](std::uint64_t number, const SamplePattern& pattern) {
    const Attendance both{
        .progress = [&](std::uint64_t done, std::uint64_t rows) { attendance.progress(number * rows + done, 2 * rows); },
        .stop = attendance.stop};
    return render_accurately(doubled, finder, camera, pattern, {.convention = picture.convention, .depth_max = picture.depth},
                             both);
  };
  const ReferencePicture a = half(0, SamplePattern::stratified(n, n / 2, 2 * options.seed));
  const ReferencePicture b = half(1, SamplePattern::stratified(n / 2, n, 2 * options.seed + 1));
  Reference reference{.picture = Image(a.width, a.height), .difference = Image(a.width, a.height), .rays = a.rays + b.rays};
  HalvesSum sum;
  for (std::size_t pixel = 0; pixel < a.radiance.size(); ++pixel) {
    sum.add(pixel, a.radiance[pixel], b.radiance[pixel], reference);
  }
  sum.finish(reference);
  reference.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return reference;
}

}  // namespace dmpc::apps
