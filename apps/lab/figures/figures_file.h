// Reads our JSON files, such as those of --stats, as a list of named figures. Its .cpp names nlohmann-json.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace dmpc::apps {

/// A value: null, true or false, a whole number from 0 on, any other number, or a text.
using FigureValue = std::variant<std::monostate, bool, std::uint64_t, double, std::string>;

struct Figure {
  std::string name;  ///< the keys that lead to it, separated by dots, with indices for lists: "nodes.3.pages.faults"
  FigureValue value;
};

/// Returns all figures of a text in order; `file` is its name in messages. Throws core::InputError if it is no JSON, or not of
/// this dmpc's json_format.
std::vector<Figure> parse_figures(std::string_view text, const std::string& file);

/// More bytes than any file of ours has: with the largest number of nodes it has a few thousand a node.
inline constexpr std::uint64_t figures_bytes_max = std::uint64_t{128} << 20U;

/// Reads the figures of a file or a pipe. Also throws core::InputError if it cannot be read, or has more than figures_bytes_max.
std::vector<Figure> read_figures(const std::filesystem::path& file);

/// Returns the value as in JSON, but a text without quotes: "null", "812", "svm".
std::string text_of(const FigureValue& value);

/// Returns whether the figure is at `key` or below it; "*" in a key matches any one name: "nodes.*.pages" includes
/// "nodes.3.pages.faults".
bool is_within(std::string_view name, std::string_view key);

/// Returns the number of a value; nothing if it is absent or no number.
std::optional<double> number_of(const FigureValue& value);

}  // namespace dmpc::apps
