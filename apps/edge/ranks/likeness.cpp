#include "apps/edge/ranks/likeness.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <sstream>

#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

/// The first line of `text` that stands elsewhere or not at all in `other`; "nothing" if `text` ends there.
std::string first_difference(const std::string& text, const std::string& other) {
  const std::vector<std::string> lines = lines_of(text), others = lines_of(other);
  const std::size_t both = std::min(lines.size(), others.size());
  const auto place = std::mismatch(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(both), others.begin()).first;
  return place == lines.end() ? "nothing" : *place;
}

}  // namespace

Likeness build_likeness() {
  return {{"version of dmpc", DMPC_VERSION},
          {"build", DMPC_MODULES_BUILD},
          {"byte order", std::endian::native == std::endian::little ? "little" : "big"}};
}

std::string text_of(const Likeness& likeness) {
  std::string text;
  for (const auto& [what, value] : likeness) {
    text += what;
    text += ' ';
    text += value;
    text += '\n';
  }
  return text;
}

void expect_alike(std::span<const std::string> texts, std::span<const std::string> names) {
  for (std::size_t rank = 1; rank < texts.size(); ++rank) {
    if (texts[rank] != texts[0]) {
      throw core::InputError("the ranks are not alike, so no one result would come of them: " + names[rank] + " has " +
                             first_difference(texts[rank], texts[0]) + ", " + names[0] + " has " +
                             first_difference(texts[0], texts[rank]) + ": start the same on all of them");
    }
  }
}

}  // namespace dmpc::apps
