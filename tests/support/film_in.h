// The film that a file of figures tells of.
#pragma once

#include <filesystem>
#include <string>

#include "core/base/expect.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests {

/// Its hash, as --stats has written it.
inline std::string film_in(const std::filesystem::path& stats) {
  static const std::string name = "\"film_hash\": \"";
  const std::string text = file_text(stats);
  const std::size_t begin = text.find(name);
  core::expect(begin != std::string::npos, "the figures of a render have its film");
  return text.substr(begin + name.size(), text.find('"', begin + name.size()) - begin - name.size());
}

}  // namespace dmpc::tests
