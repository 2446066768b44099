// The parameters of each statement of pbrt-v4, and how each is treated.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace dmpc::apps::pbrt {

/// The valid parameters of a statement of one kind, from pbrt-v4's source: comma-separated lists of "type name". Other
/// parameters have no meaning in pbrt either.
struct ParameterRow {
  std::string_view statement, kind;
  std::string_view used;    ///< shown, or covered by a specific note
  std::string_view said;    ///< not shown; finish() notes it
  std::string_view silent;  ///< concerns only how pbrt renders, or is covered by other notes; does not affect our pictures
};
std::span<const ParameterRow> parameter_table();
/// Returns whether pbrt-v4 has this kind of the statement.
bool has_row(std::string_view statement, std::string_view kind);

enum class ParameterFate : std::uint8_t { used, said, silent, unknown };
ParameterFate fate_of(std::string_view statement, std::string_view kind, std::string_view name);

/// The first entry of such a list, which is removed from the list; empty after the last entry.
struct ListedParameter {
  std::string_view type, name;
};
ListedParameter next_of(std::string_view& list);

}  // namespace dmpc::apps::pbrt
