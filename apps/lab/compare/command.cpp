#include "apps/lab/compare/command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/frontend/line/exit_status.h"
#include "apps/frontend/line/json_format.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"
#include "apps/frontend/system/distinct_files.h"
#include "apps/frontend/system/output_file.h"
#include "apps/lab/compare/pages.h"
#include "apps/lab/difference/picture_error.h"
#include "apps/picture/image_file.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using Json = nlohmann::ordered_json;

/// Limit of lines for readers.
constexpr std::size_t lines_max = 100;

void print_names(std::ostream& output, const CompareOptions& files) {
  output << "A " << shown(files.a.string()) << "\nB " << shown(files.reference.string()) << " (the reference)\n";
}

void print(std::ostream& output, const Json& json) {
  output << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';  // names of files may be invalid UTF-8
}

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(); }

std::string side_text(const std::optional<FigureValue>& value) { return value ? shown(text_of(*value)) : "not there"; }

struct ValueJson {
  Json operator()(std::monostate) const { return nullptr; }
  template <class Value>
  Json operator()(const Value& value) const {
    return value;
  }
};

Json difference_json(const Difference& difference) {
  Json json = {{"figure", difference.name}};
  if (difference.figure) {
    json["a"] = std::visit(ValueJson(), *difference.figure);
  }
  if (difference.reference) {
    json["b"] = std::visit(ValueJson(), *difference.reference);
  }
  return json;
}

/// Prints a line for each figure.
void print_text(std::ostream& output, const CompareOptions& files, const PictureError& error) {
  const double share =
      100 * static_cast<double>(error.differing_pixels) / static_cast<double>(std::max<std::uint64_t>(error.pixels, 1));
  print_names(output, files);
  output << "root mean square error  " << error.root_mean_square << "\n"
         << "largest error           " << error.largest << "\n"
         << "99th percentile         " << error.percentile_99 << "\n"
         << "mean absolute error     " << error.mean_absolute << "\n"
         << "peak signal to noise    " << error.peak_signal_to_noise_decibels << " dB\n"
         << "relative mean square    " << error.relative_mean_square << "\n"
         << "FLIP, mean              " << error.flip_mean << "\n"
         << "FLIP, 99th percentile   " << error.flip_percentile_99 << "\n"
         << "differing pixels        " << error.differing_pixels << " of " << error.pixels << " (" << share << " %)\n";
}

/// Prints one object, in which infinity is null; `passed` are exceeded limits of --fail-above.
void print_json(std::ostream& output, const CompareOptions& files, const PictureError& error,
                const std::vector<std::string>& passed) {
  print(output, {
                    {"format", json_format},
                    {"picture", files.a.string()},
                    {"reference", files.reference.string()},
                    {"root_mean_square", finite(error.root_mean_square)},
                    {"largest", finite(error.largest)},
                    {"percentile_99", finite(error.percentile_99)},
                    {"mean_absolute", finite(error.mean_absolute)},
                    {"peak_signal_to_noise_decibels", finite(error.peak_signal_to_noise_decibels)},
                    {"relative_mean_square", finite(error.relative_mean_square)},
                    {"flip_mean", finite(error.flip_mean)},
                    {"flip_percentile_99", finite(error.flip_percentile_99)},
                    {"pixels", error.pixels},
                    {"differing_pixels", error.differing_pixels},
                    {"passed_limits", passed},
                });
}

/// Prints a line for each difference, and their number.
void print_text(std::ostream& output, const CompareOptions& files, const FigureComparison& comparison) {
  print_names(output, files);
  const std::size_t count = std::min(comparison.differences.size(), lines_max);
  std::size_t width = 0;
  for (std::size_t i = 0; i < count; ++i) {
    width = std::max(width, comparison.differences[i].name.size());
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Difference& difference = comparison.differences[i];
    output << std::left << std::setw(static_cast<int>(width)) << shown(difference.name) << "  A " << side_text(difference.figure)
           << "  B " << side_text(difference.reference) << "\n";
  }
  if (count < comparison.differences.size()) {
    output << "and " << grouped(comparison.differences.size() - count) << " more: --format=json has them all\n";
  }
  output << counted(comparison.compared, "figure") << " compared, " << grouped(comparison.differences.size())
         << (comparison.differences.size() == 1 ? " differs\n" : " differ\n");
}

/// Prints one object with all differences; a figure that a file lacks is absent.
void print_json(std::ostream& output, const CompareOptions& files, const FigureComparison& comparison) {
  Json differences = Json::array();
  for (const Difference& difference : comparison.differences) {
    differences.push_back(difference_json(difference));
  }
  print(output, {{"format", json_format},
                 {"counters", files.a.string()},
                 {"reference", files.reference.string()},
                 {"compared", comparison.compared},
                 {"differences", differences}});
}

enum class Kind : std::uint8_t { pictures, counters, pages };

Kind kind_of(const std::filesystem::path& path) {
  const std::filesystem::path ending = path.extension();
  return ending == ".json" ? Kind::counters : ending == ".html" || ending == ".htm" ? Kind::pages : Kind::pictures;
}

void check_outputs(const CompareOptions& options) {
  std::vector<NamedFile> outputs;
  if (options.difference) {
    outputs.push_back({"--difference", *options.difference});
  }
  if (options.flip) {
    outputs.push_back({"--flip", *options.flip});
  }
  const std::vector<NamedFile> pictures = outputs;
  if (options.report) {
    outputs.push_back({"--report", *options.report});
  }
  check_distinct({{"A", options.a}, {"B", options.reference}}, outputs);
  for (const NamedFile& picture : pictures) {
    check_image_path(picture.path, picture.name);
  }
  if (options.report) {
    check_output_path(*options.report, "--report");
  }
}

void write_picture(const std::filesystem::path& path, const Image& image, Interrupt& interrupt) {
  OutputFile file(path);
  file.write(encoded_picture(path, image));
  interrupt.set_consequence("the output may be incomplete");
  file.commit();
}

/// Prints `sentences`, if there are any, on stderr.
int status_after(const CompareOptions& options, const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences) {
    std::cerr << "dmpc: " << options.a.string() << " and " << options.reference.string() << " differ: " << sentence << '\n';
  }
  return sentences.empty() ? 0 : differs_status;
}

int compare_pictures(const CompareOptions& options, Interrupt& interrupt, std::ostream& output) {
  const Image picture = read_image(options.a, options.sandbox);
  const Image reference = read_image(options.reference, options.sandbox);
  const PictureError error = measure_error(picture, reference);
  if (options.difference) {
    write_picture(*options.difference, difference_picture(picture, reference), interrupt);
  }
  if (options.flip) {
    write_picture(*options.flip, flip_picture(picture, reference), interrupt);
  }
  interrupt.set_consequence("the output may be incomplete");
  const std::vector<std::string> passed = passed_limits(options.limits, error);
  if (options.format == CompareFormat::json) {
    print_json(output, options, error, passed);
  } else {
    print_text(output, options, error);
  }
  finish_output(output, "the figures");
  return status_after(options, passed);
}

int report_counters(const CompareOptions& options, const FigureComparison& comparison, std::ostream& output) {
  if (options.format == CompareFormat::json) {
    print_json(output, options, comparison);
  } else {
    print_text(output, options, comparison);
  }
  finish_output(output, "the figures");
  std::vector<std::string> sentences;
  if (const std::size_t count = comparison.differences.size(); count > 0) {
    sentences.push_back(counted(count, "counter") + " of " + grouped(comparison.compared));
  }
  return status_after(options, sentences);
}

int compare_counters(const CompareOptions& options, std::ostream& output) {
  return report_counters(options, compare_figures(read_figures(options.a), read_figures(options.reference), options.figures),
                         output);
}

int compare_pages(const CompareOptions& options, Interrupt& interrupt, std::ostream& output) {
  const std::array<PlayedPage, 2> pages = {read_page(options.a), read_page(options.reference)};
  const std::optional<FigureComparison> counters = compare_counters_of(pages, options.figures, options.report.has_value());
  if (options.report) {
    OutputFile file(*options.report);
    file.write(page_of(pages, counters, options.sandbox));
    interrupt.set_consequence("the output may be incomplete");
    file.commit();
  }
  if (counters) {
    return report_counters(options, *counters, output);
  }
  std::cerr << "dmpc: " << without_counters(pages) << '\n';
  return 0;
}

/// Options for one kind of file exclude the other kind.
void check_together(const OptionSet& set, const CompareOptions& compare) {
  const Kind kind = kind_of(compare.a);
  if (kind != kind_of(compare.reference)) {
    throw core::UsageError("A " + compare.a.string() + " and B " + compare.reference.string() +
                           ": expected two pictures, two files of counters, which end in .json, or two pages of renders, which "
                           "end in .html");
  }
  for (const char* const option : {"--difference", "--flip", "--fail-above"}) {
    if (kind != Kind::pictures && set.is_given(option)) {
      throw core::UsageError(std::string(option) + " goes with pictures: for counters --tolerance sets what may differ");
    }
  }
  for (const char* const option : {"--only", "--tolerance"}) {
    if (kind == Kind::pictures && set.is_given(option)) {
      throw core::UsageError(std::string(option) + " goes with counters: for pictures --fail-above sets how far they may differ");
    }
  }
  if (kind != Kind::pages && set.is_given("--report")) {
    throw core::UsageError(
        "--report goes with two pages that dmpc render --report=FILE.html wrote, whose runs it plays on one clock: " +
        std::string(kind == Kind::pictures ? "for pictures --difference and --flip show where they differ"
                                           : "counters alone cannot be played"));
  }
}

}  // namespace

void add_options(OptionSet options, CompareOptions& compare) {
  options.add_argument(
      "A", [&compare](const std::string& text) { compare.a = text; },
      "A picture, or a file that render wrote by --stats (.json) or --report (.html)");
  options.add_argument(
      "B", [&compare](const std::string& text) { compare.reference = text; }, "The reference, of the same size");
  options.add_path("--difference", "IMAGE", compare.difference, "Write the absolute differences as a picture");
  options.add_path("--flip", "IMAGE", compare.flip, "Write the perceived differences, by FLIP, as a picture");
  options.add_path("--report", "FILE", compare.report, "Write a page that plays the runs of two pages (.html) on one clock");
  options.add_texts(
      "--fail-above", "MEASURE:NUMBER", [&compare](const std::string& text) { compare.limits.push_back(parse_limit(text)); },
      "Exit with status 5 if the pictures differ by more than this, measured by " + measure_names() +
          "; may be given several times");
  options.add_texts(
      "--only", "KEY", [&compare](const std::string& text) { compare.figures.only.push_back(text); },
      "Compare these counters and those below them only, such as rays or nodes.*.pages; may be given several times");
  options.add_texts(
      "--tolerance", "KEY:SHARE",
      [&compare](const std::string& text) { compare.figures.tolerances.push_back(parse_tolerance(text)); },
      "Allow these counters to differ by a fraction of the reference's value; may be given several times");
  options.add_choice<CompareFormat>("--format", compare.format, {{"text", CompareFormat::text}, {"json", CompareFormat::json}},
                                    "Format of the results");
  add_sandbox_option(options, compare.sandbox);
  options.check_in_the_end([options, &compare] { check_together(options, compare); });
  options.set_examples(
      "Examples:\n"
      "  dmpc compare draft.exr final.exr --difference=error.exr --flip=seen.png\n"
      "  dmpc compare draft.exr final.exr --format=json\n"
      "  dmpc compare new.exr kept.exr --fail-above=rmse:1/255 --fail-above=max:0.1\n"
      "  dmpc compare new.json kept.json\n"
      "  dmpc compare new.json kept.json --only=film_hash --only=pages --tolerance=pages.faults:0.05\n"
      "  dmpc compare a.html b.html --report=ab.html\n"
      "  dmpc compare new.json kept.json --only=seconds --tolerance=seconds:0.5\n"
      "The exit status is 5 if they differ. Seconds of the wall clock are compared only if they have a tolerance. With threads,\n"
      "faults and packets depend on the schedule; with --runner=virtual all counters are the same in every run.");
}

int compare_command(const CompareOptions& options, Interrupt& interrupt, std::ostream& output) {
  check_outputs(options);
  const Interrupt::EndAtOnce end_at_once(interrupt);
  switch (kind_of(options.a)) {
    case Kind::counters:
      return compare_counters(options, output);
    case Kind::pages:
      return compare_pages(options, interrupt, output);
    case Kind::pictures:
      break;
  }
  return compare_pictures(options, interrupt, output);
}

}  // namespace dmpc::apps
