// Each parameter of each statement of pbrt-v4, and what becomes of it here.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace dmpc::apps::pbrt {

/// What a statement of one kind may say, "type name" each, with commas between; by pbrt-v4's source. What else it says means
/// nothing, in pbrt, too.
struct ParameterRow {
  std::string_view statement, kind;
  std::string_view used;    ///< shown, or a note of its own says how
  std::string_view said;    ///< not shown, which finish() says
  std::string_view silent;  ///< how pbrt renders, or what other words of ours are said of already: no picture of ours is another
};
std::span<const ParameterRow> parameter_table();
/// Whether pbrt-v4 has such a statement of this kind.
bool has_row(std::string_view statement, std::string_view kind);

enum class ParameterFate : std::uint8_t { used, said, silent, unknown };
ParameterFate fate_of(std::string_view statement, std::string_view kind, std::string_view name);

/// The next of such a list, which is cut off it: its type and its name, empty behind the last.
struct ListedParameter {
  std::string_view type, name;
};
ListedParameter next_of(std::string_view& list);

}  // namespace dmpc::apps::pbrt
