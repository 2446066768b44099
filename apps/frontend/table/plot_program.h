// Draws plots by Python's matplotlib, in a process of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dmpc::apps {

/// Makes NAME.svg from NAME.json (plot_data()) in `folder`, for each name, and waits for that. Returns why some are not drawn: a
/// sentence without its full stop; empty if all are.
std::string draw_plots(const std::filesystem::path& folder, const std::vector<std::string>& names);

}  // namespace dmpc::apps
