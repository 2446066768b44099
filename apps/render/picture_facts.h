// What a picture depends on, as text that can be compared.
#pragma once

#include <string>
#include <vector>

namespace dmpc::apps {

/// One thing that a picture depends on. Both texts are without line ends, the name without "=".
struct PictureFact {
  std::string name;
  std::string value;  ///< "#" and a digest where it would be too long
  bool operator==(const PictureFact&) const = default;
};

/// How the facts of another picture differ from those of `here`, as a part of a sentence: "depth is 5, here 4; other materials".
/// Empty if they are the same.
std::string difference_text(const std::vector<PictureFact>& other, const std::vector<PictureFact>& here);

}  // namespace dmpc::apps
