#include "apps/run/heat_options.h"

#include <algorithm>

#include "apps/frontend/line/words.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"
#include "core/base/ranges.h"

namespace dmpc::apps {

namespace {

using core::HeatKind;
using core::UsageError;

std::string all_kinds() { return joined(core::heat_kind_names, "|"); }

/// Returns " Did you mean faults?"; empty if no kind is similar.
std::string kind_meant(const std::string& typed) {
  const std::vector<std::string> names(core::heat_kind_names.begin(), core::heat_kind_names.end());
  return core::did_you_mean(typed, names);
}

bool is_of_pages(HeatKind kind) { return kind == HeatKind::faults || kind == HeatKind::references || kind == HeatKind::pages; }

const char* reason_without_pages(Strategy strategy) {
  return strategy == Strategy::dataflow ? "rays travel to where the records are, and look up no pages"
         : strategy == Strategy::forest ? "nodes ask about records of others, and fetch no pages"
                                        : "every node holds the whole scene, and looks up no pages";
}

}  // namespace

HeatRequest parse_heat_request(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto& names = core::heat_kind_names;
  const auto name = std::find(names.begin(), names.end(), text.substr(0, colon));
  if (colon == std::string::npos || name == names.end()) {
    const std::string meant = name == names.end() ? kind_meant(text.substr(0, colon)) : "";
    throw UsageError("--heatmap=" + text + ": expected " + all_kinds() + ", a colon and a file, such as rays:rays.png" +
                     (meant.empty() ? "" : ".") + meant);
  }
  const HeatRequest request{static_cast<HeatKind>(name - names.begin()), text.substr(colon + 1)};
  if (!holds_numbers(request) && request.path.extension() != ".png") {
    throw UsageError("--heatmap=" + text + ": expected a file with the ending .exr (numbers) or .png (colours and a legend)");
  }
  return request;
}

bool holds_numbers(const HeatRequest& request) { return request.path.extension() == ".exr"; }

void add_heat_option(OptionSet options, std::vector<HeatRequest>& requests) {
  options.add_texts(
      "--heatmap", "KIND:FILE", [&requests](const std::string& text) { requests.push_back(parse_heat_request(text)); },
      "Write a map of what each pixel took, of the kind " + all_kinds() +
          ": to FILE.exr as numbers, to FILE.png as colours with a legend; may be given several times (faults, references and "
          "pages: svm)");
}

void check_heat(const std::vector<HeatRequest>& requests, Strategy strategy) {
  if (requests.size() > heat_requests_max) {
    throw UsageError("--heatmap is given " + std::to_string(requests.size()) + " times: " + std::to_string(heat_requests_max) +
                     " are the most");
  }
  for (const HeatRequest& request : requests) {
    if (strategy != Strategy::svm && is_of_pages(request.kind)) {
      throw UsageError("--heatmap=" + std::string(core::name_of(request.kind)) + ":" + request.path.string() +
                       " goes with --strategy=svm: with --strategy=" + name_of(strategy) + " " + reason_without_pages(strategy));
    }
  }
}

std::vector<HeatKind> kinds_of(const std::vector<HeatRequest>& requests) {
  return core::mapped<HeatKind>(requests, &HeatRequest::kind);
}

}  // namespace dmpc::apps
