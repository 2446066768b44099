// Which objects of an FBX file are switched off.
#pragma once

#include <cstdint>
#include <string_view>

namespace dmpc::apps {

/// How many properties of the file, in text or binary, say Visibility or Show, and 0: Assimp drops the first and shows all.
std::uint64_t count_hidden_nodes(std::string_view file);

}  // namespace dmpc::apps
