#include "apps/frontend/system/bounded_text.h"

#include <algorithm>
#include <array>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/text_input.h"
#include "core/base/expect.h"

namespace dmpc::apps {

std::string bounded_text(const std::filesystem::path& file, std::uint64_t bytes_max, const std::string& expected) {
  TextInput stream(file);
  std::string text;
  std::array<char, 65536> part;
  std::uint64_t bytes = stream.file_bytes();
  while (bytes <= bytes_max && (stream.read(part.data(), part.size()) || stream.gcount() > 0)) {
    text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
    bytes = std::max<std::uint64_t>(bytes, text.size());
  }
  if (bytes > bytes_max) {
    throw core::InputError(file.string() + ": has more than " + mebibytes_text(bytes_max) + ", expected " + expected);
  }
  return text;
}

}  // namespace dmpc::apps
