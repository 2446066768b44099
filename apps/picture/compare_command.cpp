#include "apps/picture/compare_command.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "apps/line/shown_text.h"
#include "apps/picture/image_file.h"
#include "apps/picture/picture_error.h"
#include "apps/system/distinct_files.h"
#include "apps/system/output_file.h"

namespace dmpc::apps {
namespace {

void check_outputs(const CompareOptions& options) {
  std::vector<NamedFile> outputs;
  if (options.difference) {
    outputs.push_back({"--difference", *options.difference});
  }
  if (options.flip) {
    outputs.push_back({"--flip", *options.flip});
  }
  check_distinct({{"A", options.picture}, {"B", options.reference}}, outputs);
  for (const NamedFile& output : outputs) {
    check_image_path(output.path, output.name);
  }
}

void print_text(std::ostream& output, const CompareOptions& options, const PictureError& error) {
  const double share =
      100 * static_cast<double>(error.differing_pixels) / static_cast<double>(std::max<std::uint64_t>(error.pixels, 1));
  output << "A " << shown(options.picture.string()) << "\nB " << shown(options.reference.string()) << " (the reference)\n"
         << "root mean square error  " << error.root_mean_square << "\n"
         << "largest error           " << error.largest << "\n"
         << "99th percentile         " << error.percentile_99 << "\n"
         << "mean absolute error     " << error.mean_absolute << "\n"
         << "peak signal to noise    " << error.peak_signal_to_noise_decibels << " dB\n"
         << "relative mean square    " << error.relative_mean_square << "\n"
         << "FLIP, mean              " << error.flip_mean << "\n"
         << "FLIP, 99th percentile   " << error.flip_percentile_99 << "\n"
         << "differing pixels        " << error.differing_pixels << " of " << error.pixels << " (" << share << " %)\n";
}

void print_json(std::ostream& output, const CompareOptions& options, const PictureError& error) {
  const auto number = [](double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
  };
  const nlohmann::ordered_json json = {
      {"picture", options.picture.string()},
      {"reference", options.reference.string()},
      {"root_mean_square", number(error.root_mean_square)},
      {"largest", number(error.largest)},
      {"percentile_99", number(error.percentile_99)},
      {"mean_absolute", number(error.mean_absolute)},
      {"peak_signal_to_noise_decibels", number(error.peak_signal_to_noise_decibels)},
      {"relative_mean_square", number(error.relative_mean_square)},
      {"flip_mean", number(error.flip_mean)},
      {"flip_percentile_99", number(error.flip_percentile_99)},
      {"pixels", error.pixels},
      {"differing_pixels", error.differing_pixels},
  };
  output << json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
}

void write_picture(const std::filesystem::path& path, const Image& image, Interrupt& interrupt) {
  OutputFile file(path);
  file.write(encoded_picture(path, image));
  interrupt.set_consequence("the output may be incomplete");
  file.commit();
}

}  // namespace

void add_options(OptionSet options, CompareOptions& compare) {
  options.add_argument(
      "A", [&compare](const std::string& text) { compare.picture = text; }, "A picture");
  options.add_argument(
      "B", [&compare](const std::string& text) { compare.reference = text; }, "Another of the same size, the reference");
  options.add_path("--difference", "IMAGE", compare.difference, "Write the absolute differences as a picture");
  options.add_path("--flip", "IMAGE", compare.flip, "Write the differences that an eye perceives, by FLIP, as a picture");
  options.add_choice<CompareFormat>("--format", compare.format, {{"text", CompareFormat::text}, {"json", CompareFormat::json}},
                                    "How the figures are printed");
  options.set_examples(
      "Examples:\n"
      "  dmpc compare draft.exr final.exr --difference=error.exr --flip=seen.png\n"
      "  dmpc compare draft.exr final.exr --format=json");
}

int compare_command(const CompareOptions& options, Interrupt& interrupt, std::ostream& output) {
  check_outputs(options);
  const Interrupt::EndAtOnce end_at_once(interrupt);
  const Image picture = read_image(options.picture);
  const Image reference = read_image(options.reference);
  const PictureError error = measure_error(picture, reference);
  if (options.difference) {
    write_picture(*options.difference, difference_picture(picture, reference), interrupt);
  }
  if (options.flip) {
    write_picture(*options.flip, flip_picture(picture, reference), interrupt);
  }
  interrupt.set_consequence("the output may be incomplete");
  (options.format == CompareFormat::json ? print_json : print_text)(output, options, error);
  finish_output(output, "the figures");
  return 0;
}

}  // namespace dmpc::apps
