#include "apps/lab/compare/report.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <ostream>

#include "apps/edge/line/json_format.h"
#include "apps/edge/line/number_text.h"
#include "apps/edge/line/shown_text.h"

namespace dmpc::apps {
namespace {

using Json = nlohmann::ordered_json;

/// More are for a program to read.
constexpr std::size_t lines_max = 100;

void print_names(std::ostream& output, const ComparedFiles& files) {
  output << "A " << shown(files.a.string()) << "\nB " << shown(files.reference.string()) << " (the reference)\n";
}

void print(std::ostream& output, const Json& json) {
  output << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';  // names of files may be no UTF-8
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

}  // namespace

void print_text(std::ostream& output, const ComparedFiles& files, const PictureError& error) {
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

void print_json(std::ostream& output, const ComparedFiles& files, const PictureError& error,
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

void print_text(std::ostream& output, const ComparedFiles& files, const FigureComparison& comparison) {
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

void print_json(std::ostream& output, const ComparedFiles& files, const FigureComparison& comparison) {
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

}  // namespace dmpc::apps
