// Reads the data of a played run back from a page. The file is untrusted, so nothing is used unchecked.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace dmpc::apps::html {

struct PlayedRun {
  nlohmann::json data;               ///< as from play_data(), without forecast and stats, and with no other key
  std::optional<std::string> stats;  ///< the page's part of --stats, as JSON; a page of an earlier dmpc has none
  std::string picture;               ///< a PNG's bytes, if the picture is one

  double total_ns() const { return data["total_ns"].get<double>(); }
};

/// Columns of tables of time; no activity of nodes has one of these names.
inline constexpr const char *run_column = "run", *rest_column = "all else";

/// `file` names the page in messages. Throws core::InputError if the page plays no run (it is of a study, of two runs, or of a
/// program) or has another format (both are named), if it was cut off, or if the data are inconsistent.
PlayedRun played_run(std::string_view page, const std::string& file);

}  // namespace dmpc::apps::html
