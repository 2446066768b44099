// A JSON file of ours, such as --stats writes, as named figures one after the other. Its .cpp names nlohmann-json.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace dmpc::apps {

/// What stands in one place: null, true or false, a whole number from 0 on, any other number, a text.
using FigureValue = std::variant<std::monostate, bool, std::uint64_t, double, std::string>;

struct Figure {
  std::string name;  ///< the keys that lead to it, with dots between, places in lists by number: "nodes.3.pages.faults"
  FigureValue value;
};

/// All that a text has, in its order; `file` is what messages call it. Throws core::InputError for what is no JSON, or none of
/// this dmpc's json_format.
std::vector<Figure> parse_figures(std::string_view text, const std::string& file);

/// More bytes than any file of ours has: that of the most nodes takes a few thousand a node.
inline constexpr std::uint64_t figures_bytes_max = std::uint64_t{128} << 20U;

/// Reads those of a file, or a pipe. Throws core::InputError if it cannot be read, too, or has more than figures_bytes_max.
std::vector<Figure> read_figures(const std::filesystem::path& file);

/// As JSON has it, but a text without quotes: "null", "812", "svm".
std::string text_of(const FigureValue& value);

/// Whether the figure stands at `key` or below it; "*" in a key is any one name: "nodes.*.pages" has "nodes.3.pages.faults".
bool is_within(std::string_view name, std::string_view key);

/// nullptr if there is none of this name.
const FigureValue* find_value(const std::vector<Figure>& figures, const std::string& name);
/// A figure's number; nothing where it is not there, or is no number. Throws core::InternalError for one that is needed.
std::optional<double> number_of(const FigureValue& value);
std::optional<double> number_of(const std::vector<Figure>& figures, const std::string& name);
double needed_number(const std::vector<Figure>& figures, const std::string& name);

}  // namespace dmpc::apps
