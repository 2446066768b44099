#include "apps/run/layer_options.h"

#include <algorithm>
#include <span>

#include "apps/frontend/line/words.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"

namespace dmpc::apps {

namespace {

using core::Layer;
using core::UsageError;

/// All but light.
constexpr std::span<const std::string_view> kinds = std::span(core::layer_names).subspan(1);

Layer parse_layer(const std::string& word, const std::string& text) {
  const auto name = std::find(kinds.begin(), kinds.end(), word);
  if (name == kinds.end()) {
    const std::string meant = core::did_you_mean(word, std::vector<std::string>(kinds.begin(), kinds.end()));
    throw UsageError("--aov=" + text + ": expected " + joined(kinds, "|") +
                     ", a colon and a file, such as albedo:albedo.exr, or some of them for the picture's own file, such as "
                     "albedo,normal" +
                     (meant.empty() ? "" : "." + meant));
  }
  return static_cast<Layer>(1 + (name - kinds.begin()));
}

}  // namespace

std::vector<LayerRequest> parse_layer_requests(const std::string& text) {
  std::vector<LayerRequest> requests;
  if (const std::size_t colon = text.find(':'); colon != std::string::npos) {
    const std::filesystem::path path = text.substr(colon + 1);
    requests.push_back({parse_layer(text.substr(0, colon), text), path});
    if (path.extension() != ".exr" && path.extension() != ".png") {
      throw UsageError("--aov=" + text + ": expected a file with the ending .exr (numbers) or .png (to look at)");
    }
    return requests;
  }
  for (const std::string& word : words_between(text, ',')) {
    requests.push_back({parse_layer(word, text)});
  }
  return requests;
}

void add_layer_option(OptionSet options, std::vector<LayerRequest>& requests) {
  options.add_texts(
      "--aov", "KIND:FILE|KIND,...",
      [&requests](const std::string& text) {
        const std::vector<LayerRequest> more = parse_layer_requests(text);
        requests.insert(requests.end(), more.begin(), more.end());
      },
      "Write a layer of what the eye sees first, as denoisers and compositors read it: " + joined(kinds, "|") +
          ", to FILE.exr as numbers, to FILE.png to look at, or, without files, as layers of the EXR file of -o. Albedo is the "
          "share of light that a surface sends on; normals are shading normals along the world's axes, on the eye's side; "
          "depth is the distance from the eye; id is 1 + the number of the primitive. Albedo and normals are means over as "
          "many samples as the picture has, or 16 where their number differs; depth and id are those of one ray through the "
          "pixel's middle. Where nothing is seen all are 0. May be given several times");
}

void check_layers(const std::vector<LayerRequest>& requests, const std::filesystem::path& picture) {
  if (requests.size() > layer_requests_max) {
    throw UsageError("--aov has " + std::to_string(requests.size()) + " layers: " + std::to_string(layer_requests_max) +
                     " are the most");
  }
  const bool are_within = std::any_of(requests.begin(), requests.end(), [](const LayerRequest& one) { return !one.path; });
  if (are_within && picture.extension() != ".exr") {
    throw UsageError(
        "--aov without a file puts layers into the picture, which only an EXR file has: give -o FILE.exr, or "
        "--aov=KIND:FILE");
  }
}

std::vector<Layer> layers_of(const std::vector<LayerRequest>& requests) {
  std::vector<Layer> layers;
  for (const LayerRequest& request : requests) {
    if (std::find(layers.begin(), layers.end(), request.layer) == layers.end()) {
      layers.push_back(request.layer);
    }
  }
  return layers;
}

}  // namespace dmpc::apps
