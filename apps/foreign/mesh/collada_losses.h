// What of a Collada file Assimp passes over without a word.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dmpc::apps {

/// Appends what of the text is not shown, once a kind, with a count.
void note_collada_losses(std::string_view text, std::vector<std::string>& notes);

}  // namespace dmpc::apps
