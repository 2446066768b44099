// Numbers in texts that Assimp reads up to their first letter: 1x is 1 there.
#pragma once

#include <string>
#include <string_view>

namespace dmpc::apps {

/// Throws core::InputError "line 3: found '1x', expected a number" for a word that begins as a number and is none, where FBX in
/// text, ASE, AMF or Collada have numbers, as `ending` says (lower case). Other files, and FBX in binary, are not looked at.
void check_numbers(std::string_view file, const std::string& ending);

}  // namespace dmpc::apps
