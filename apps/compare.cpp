#include "apps/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>

#include "apps/distinct_files.h"
#include "core/expect.h"

namespace dmpc::apps {

namespace {

/// |a - b|: 0 for equal values, infinities among them, infinite if either is not finite otherwise.
double distance(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) {
    return 0;
  }
  const double gap = std::abs(static_cast<double>(a) - static_cast<double>(b));
  return std::isfinite(gap) ? gap : std::numeric_limits<double>::infinity();
}

/// gap^2 / (b^2 + 0.01), without 0/0 or infinity/infinity.
double relative_square(double gap, float reference) {
  if (gap == 0 || std::isinf(gap)) {
    return gap;
  }
  return gap * gap / (static_cast<double>(reference) * static_cast<double>(reference) + 0.01);
}

void check_sizes(const Image& picture, const Image& reference) {
  const auto size = [](const Image& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); };
  if (picture.width != reference.width || picture.height != reference.height) {
    throw core::InputError("the pictures differ in size, " + size(picture) + " and " + size(reference) +
                           ": only pictures of one size can be compared");
  }
}

/// Sums for now, means after finish().
void add_channel(Difference& sum, double gap, float reference) {
  sum.root_mean_square += gap * gap;
  sum.largest = std::max(sum.largest, gap);
  sum.mean_absolute += gap;
  sum.relative_mean_square += relative_square(gap, reference);
}

void finish(Difference& sum) {
  const double channels = 3 * static_cast<double>(std::max<std::uint64_t>(sum.pixels, 1));
  sum.root_mean_square = std::sqrt(sum.root_mean_square / channels);
  sum.mean_absolute /= channels;
  sum.relative_mean_square /= channels;
  sum.peak_signal_to_noise_decibels = -20 * std::log10(sum.root_mean_square);
}

void check_outputs(const CompareOptions& options) {
  if (options.difference) {
    check_distinct({{"A", options.picture}, {"B", options.reference}}, {{"--difference", *options.difference}});
    check_image_path(*options.difference, "--difference");
  }
}

void print(std::ostream& output, const CompareOptions& options, const Difference& difference) {
  const double share =
      100 * static_cast<double>(difference.differing_pixels) / static_cast<double>(std::max<std::uint64_t>(difference.pixels, 1));
  output << "A " << options.picture.string() << "\nB " << options.reference.string() << " (the reference)\n"
         << "root mean square error  " << difference.root_mean_square << "\n"
         << "largest error           " << difference.largest << "\n"
         << "mean absolute error     " << difference.mean_absolute << "\n"
         << "peak signal to noise    " << difference.peak_signal_to_noise_decibels << " dB\n"
         << "relative mean square    " << difference.relative_mean_square << "\n"
         << "differing pixels        " << difference.differing_pixels << " of " << difference.pixels << " (" << share << " %)\n";
}

}  // namespace

void add_options(OptionSet options, CompareOptions& compare) {
  options.add_argument(
      "A", [&compare](const std::string& text) { compare.picture = text; }, "A picture");
  options.add_argument(
      "B", [&compare](const std::string& text) { compare.reference = text; }, "Another of the same size, the reference");
  options.add_path("--difference", "IMAGE", compare.difference, "Write the absolute differences as a picture");
  options.set_examples(
      "Example:\n"
      "  dmpc compare draft.exr final.exr --difference=error.png");
}

Difference measure_difference(const Image& picture, const Image& reference) {
  check_sizes(picture, reference);
  Difference result;
  result.pixels = picture.rgb.size() / 3;
  for (std::size_t pixel = 0; pixel < picture.rgb.size(); pixel += 3) {
    bool differs = false;
    for (std::size_t index = pixel; index < pixel + 3; ++index) {
      const double gap = distance(picture.rgb[index], reference.rgb[index]);
      differs = differs || gap != 0;
      add_channel(result, gap, reference.rgb[index]);
    }
    result.differing_pixels += differs ? 1 : 0;
  }
  finish(result);
  return result;
}

Image difference_picture(const Image& picture, const Image& reference) {
  check_sizes(picture, reference);
  Image result(picture.width, picture.height);
  std::transform(picture.rgb.begin(), picture.rgb.end(), reference.rgb.begin(), result.rgb.begin(),
                 [](float a, float b) { return static_cast<float>(distance(a, b)); });
  return result;
}

int compare_command(const CompareOptions& options, Interrupt& interrupt, std::ostream& output) {
  check_outputs(options);
  const Interrupt::EndAtOnce end_at_once(interrupt);
  const Image picture = read_image(options.picture);
  const Image reference = read_image(options.reference);
  const Difference difference = measure_difference(picture, reference);
  if (options.difference) {
    OutputFile file(*options.difference);
    write_image(*options.difference, difference_picture(picture, reference), file);
    interrupt.set_consequence("the output may be incomplete");
    file.commit();
  }
  interrupt.set_consequence("the output may be incomplete");
  print(output, options, difference);
  finish_output(output, "the figures");
  return 0;
}

}  // namespace dmpc::apps
