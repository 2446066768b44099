// What a page of a render plays, read back: of a file that anybody may have made nothing is taken that was not looked at.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace dmpc::apps::html {

struct PlayedRun {
  nlohmann::json data;               ///< as from play_data(), without forecast and stats, and with no other key
  std::optional<std::string> stats;  ///< what the page has of --stats, as JSON; a page of an earlier dmpc has none
  std::string picture;               ///< a PNG's bytes, if it is one

  double total_ns() const { return data["total_ns"].get<double>(); }
};

/// Columns of tables of time, which nothing is called that nodes do.
inline constexpr const char *run_column = "run", *rest_column = "all else";

/// `file` is what messages call it. Throws core::InputError for what is no page that plays a run: of a study, of two runs, of a
/// program, of another format (both are named); for one that was cut off; and for data that do not hold together.
PlayedRun played_run(std::string_view page, const std::string& file);

}  // namespace dmpc::apps::html
