// Which set of texture coordinates each part of a Collada file's geometry shows its texture by.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dmpc::apps {

/// By geometry and symbol of a material, the set that bind_vertex_input names for the texture of the diffuse colour (Collada
/// 1.4.1, chapter 5), or that the digits in the texture's own name of its coordinates do: CHANNEL1 is 1. None where neither does.
using ColladaSets = std::map<std::pair<std::string, std::string>, unsigned>;

/// Throws core::InputError for a geometry that stands in two places with different sets, which is not shown.
ColladaSets collada_sets(std::string_view text);

/// Appends which materials are bound and lead nowhere, or have an effect that is not there: what is bound to them is grey.
void note_loose_bindings(std::string_view text, std::vector<std::string>& notes);

/// The whole number that a text begins with.
std::optional<unsigned> leading_number(std::string_view text);

}  // namespace dmpc::apps
