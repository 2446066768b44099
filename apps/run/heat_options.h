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

/// One heat map to be written: to an EXR file as numbers, to a PNG file as colours and a legend.
struct HeatRequest {
  core::HeatKind kind;
  std::filesystem::path path;
};

/// All kinds in both formats, and most of them again. They are written at the same time, for which
/// apps/frontend/system/interrupt.cpp has slots.
inline constexpr std::size_t heat_requests_max = 32;

/// "KIND:FILE.exr" or "KIND:FILE.png". Throws core::UsageError for anything else.
HeatRequest parse_heat_request(const std::string& text);

/// Whether the file gets numbers, or else colours.
bool holds_numbers(const HeatRequest& request);

/// Declares --heatmap, which can be repeated.
void add_heat_option(OptionSet options, std::vector<HeatRequest>& requests);

/// Throws core::UsageError, with the reason, for a kind that the strategy does not have, or for too many.
void check_heat(const std::vector<HeatRequest>& requests, Strategy strategy);

/// The kinds of all requests.
std::vector<core::HeatKind> kinds_of(const std::vector<HeatRequest>& requests);

}  // namespace dmpc::apps
