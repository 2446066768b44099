#include "apps/lab/bench/precision/precision.h"

#include <algorithm>
#include <cmath>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/lab/crowd/side_by_side.h"
#include "apps/lab/oracle/reference/emitters.h"
#include "apps/lab/oracle/trial_line.h"
#include "apps/scene/subject.h"
#include "core/base/expect.h"
#include "core/base/srgb.h"
#include "core/picture/ray_crowd.h"
#include "core/picture/render.h"
#include "core/record/records.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

std::vector<Vec3d> render_row(const Subject& subject, std::uint32_t row) {
  const core::RenderSettings& settings = subject.settings;
  core::LocalRecords records(subject.database.bytes());
  core::GridTracer tracer(records, settings.header, settings.skips);
  std::vector<core::HitState> stack(static_cast<std::size_t>(settings.shade.depth_max));
  core::PixelTask task(stack);
  core::Operations operations;
  const auto width = static_cast<std::uint32_t>(settings.camera.width());
  core::Film film(settings.camera.width(), 1, settings.shade.film_scale);
  std::vector<Vec3d> radiance(width);
  for (std::uint32_t column = 0; column < width; ++column) {
    film.deposit(column, core::render_pixel(task, row * width + column, {0, 1}, tracer, settings, operations));
    film.add_samples(column, 1);
    radiance[column] = film.radiance(column);
  }
  return radiance;
}

std::vector<Vec3d> product_radiance(const Subject& subject) {
  std::vector<Vec3d> radiance;
  radiance.reserve(subject.settings.camera.pixel_count());
  side_by_side(static_cast<std::size_t>(subject.settings.camera.height()), [&](std::size_t row) {
    return [&radiance, part = render_row(subject, static_cast<std::uint32_t>(row))] {
      radiance.insert(radiance.end(), part.begin(), part.end());
    };
  });
  return radiance;
}

bool same_bytes(const Vec3d& a, const Vec3d& b) {
  const auto byte = [](double value) { return core::srgb_byte(static_cast<float>(value)); };
  return byte(a.x) == byte(b.x) && byte(a.y) == byte(b.y) && byte(a.z) == byte(b.z);
}

/// Sets the errors, and returns the pixels that differ.
std::vector<std::uint32_t> compare(const std::vector<Vec3d>& product, const std::vector<Vec3d>& reference, Precision& precision) {
  std::vector<std::uint32_t> differing;
  double squares = 0;
  for (std::uint32_t pixel = 0; pixel < product.size(); ++pixel) {
    const Vec3d off = product[pixel] - reference[pixel];
    squares += dot(off, off);
    precision.largest = std::max(precision.largest, largest_component(off));
    if (!same_bytes(product[pixel], reference[pixel])) {
      differing.push_back(pixel);
    }
  }
  precision.pixels = product.size();
  precision.differing_pixels = differing.size();
  precision.root_mean_square = std::sqrt(squares / static_cast<double>(3 * product.size()));
  return differing;
}

/// If pixels differ at random, the means differ by no more than a few standard errors.
void judge_mean(const std::vector<Vec3d>& product, const std::vector<Vec3d>& reference, Precision& precision) {
  constexpr double errors_allowed = 4, rounding = 1e-6;
  double sum = 0, squares = 0;
  for (std::size_t pixel = 0; pixel < product.size(); ++pixel) {
    const Vec3d off = product[pixel] - reference[pixel];
    const double light = off.x + off.y + off.z;
    sum += light;
    squares += light * light;
  }
  const auto pixels = static_cast<double>(product.size());
  const double mean = sum / pixels, error = std::sqrt(squares) / pixels;
  if (std::fabs(mean) > errors_allowed * error + rounding) {
    precision.errors.push_back("the mean of all pixels is " + rounded(mean) + " more than in double, of a standard error of " +
                               rounded(error));
  }
}

void count(const Judgement& judgement, std::uint32_t pixel, std::uint32_t width, Precision& precision) {
  ++precision.causes[static_cast<std::size_t>(judgement.cause)];
  precision.largest_step = std::max(precision.largest_step, judgement.largest_step);
  if (judgement.cause == PixelCause::unexplained) {
    precision.errors.push_back(pixel_text(pixel, width) + ": " + judgement.error);
  }
}

}  // namespace

Precision measure_precision(const core::Scene& scene, const PictureOptions& picture, const Attendance& attendance) {
  core::expect(picture.samples == 1, "precision is measured with one sample a pixel");
  const Subject subject = build_subject(scene, picture);
  if (subject.settings.shade.one_child_from > 0) {
    throw core::UsageError("--depth=" + std::to_string(picture.depth) +
                           ": so deep, this picture's hits choose a ray of two, which the " +
                           "renderer in double does not: expected a depth of at most " + std::to_string(core::crowd_depth));
  }
  const core::Camera& product_camera = subject.settings.camera;
  ReferenceScene reference = reference_scene(scene);
  if (picture.transport.is_by_paths()) {
    aim_as_product(reference, subject.database);
  }
  const ReferenceCamera camera(scene.view, product_camera.width(), product_camera.height(), reference.bounds);
  const ReferenceFinder finder(reference, camera.start());
  const ReferencePicture right =
      render_accurately(reference, finder, camera, SamplePattern::of_product(1), subject.settings.shade, attendance);
  Precision precision{.primitives = subject.database.primitives().size(), .rays = right.rays};
  const std::vector<Vec3d> product = product_radiance(subject);
  const std::vector<std::uint32_t> differing = compare(product, right.radiance, precision);
  if (picture.transport.is_by_paths()) {
    precision.is_by_paths = true;
    judge_mean(product, right.radiance, precision);
    return precision;
  }
  const PixelJudge judge(subject.database, subject.settings, reference, finder, camera, subject.loss);
  side_by_side(differing.size(), [&](std::size_t index) {
    if (attendance.stop.stop_requested()) {
      throw Interrupted();
    }
    return [&, index, judgement = judge.judge(differing[index], product[differing[index]])] {
      count(judgement, differing[index], static_cast<std::uint32_t>(camera.width()), precision);
    };
  });
  return precision;
}

}  // namespace dmpc::apps
