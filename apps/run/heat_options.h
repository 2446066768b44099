// The option --heatmap: heat maps of each pixel's cost, and their files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/run/strategy_options.h"
#include "core/picture/heat_kind.h"

namespace dmpc::apps {

/// A heat map to write: an EXR file of numbers, or a PNG file of colours with a legend.
struct HeatRequest {
  core::HeatKind kind;
  std::filesystem::path path;
};

/// Enough for all kinds in both formats, and for most of them twice. The files are written at the same time, for which
/// apps/frontend/system/interrupt.cpp has slots.
inline constexpr std::size_t heat_requests_max = 32;

/// Parses "KIND:FILE.exr" or "KIND:FILE.png". Throws core::UsageError for anything else.
HeatRequest parse_heat_request(const std::string& text);

/// Returns whether the file gets numbers rather than colours.
bool holds_numbers(const HeatRequest& request);

/// Declares --heatmap, which can be repeated.
void add_heat_option(OptionSet options, std::vector<HeatRequest>& requests);

/// Throws core::UsageError, with the reason, for a kind that the strategy does not have, or for too many requests.
void check_heat(const std::vector<HeatRequest>& requests, Strategy strategy);

std::vector<core::HeatKind> kinds_of(const std::vector<HeatRequest>& requests);

}  // namespace dmpc::apps
