// The option --aov: layers beside the picture, and where they are written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "core/picture/surfaces/layer.h"

namespace dmpc::apps {

/// A layer to write: to an EXR file of numbers, to a PNG file to look at, or into the picture's own EXR file.
struct LayerRequest {
  core::Layer layer;
  std::optional<std::filesystem::path> path = {};
};

/// All layers in both formats. apps/frontend/system/interrupt.cpp has slots for that many.
inline constexpr std::size_t layer_requests_max = 8;

/// Parses "albedo:FILE.exr", "albedo:FILE.png" or "albedo,normal". Throws core::UsageError for anything else.
std::vector<LayerRequest> parse_layer_requests(const std::string& text);

/// Declares --aov, which can be repeated.
void add_layer_option(OptionSet options, std::vector<LayerRequest>& requests);

/// Throws core::UsageError for too many requests, or for layers in a picture whose format has none.
void check_layers(const std::vector<LayerRequest>& requests, const std::filesystem::path& picture);

/// Each layer once.
std::vector<core::Layer> layers_of(const std::vector<LayerRequest>& requests);

}  // namespace dmpc::apps
