#include "apps/lab/study/paper/archive.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "apps/frontend/system/child_process.h"
#include "apps/frontend/system/memory_file.h"
#include "apps/picture/deflater.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// The fields of both kinds of headers, little-endian.
class ZipFields {
 public:
  explicit ZipFields(std::string& text) : text_(text) {}
  ZipFields& two(std::uint32_t value) { return put(value, 2); }
  ZipFields& four(std::size_t value) { return put(value, 4); }

 private:
  ZipFields& put(std::size_t value, int bytes) {
    for (int byte = 0; byte < bytes; ++byte) {
      text_ += static_cast<char>(value >> 8 * byte & 0xffU);
    }
    return *this;
  }

  std::string& text_;
};

constexpr std::uint32_t version = 20, names_are_utf_8 = 0x800, is_deflated = 8, midnight = 0, january_1980 = 0x21;
constexpr std::size_t regular_file = 0100644U << 16U;

struct Packed {
  std::string bytes;
  std::uint32_t checksum = 0;
};

Packed packed(Deflater& deflater, const std::string& bytes) {
  const std::span plain(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  std::vector<std::uint8_t> room(deflater.packed_bytes_max(bytes.size()));
  const std::size_t size = deflater.pack_bare(plain, room);
  core::expect(size > 0, "packed bytes have the room that they need at most");
  return {{room.begin(), room.begin() + static_cast<std::ptrdiff_t>(size)}, checksum_of(plain)};
}

/// What a file's two headers have in common.
void put_head(ZipFields fields, const Packed& file, std::size_t plain_bytes, const std::string& name) {
  fields.two(version).two(names_are_utf_8).two(is_deflated).two(midnight).two(january_1980).four(file.checksum);
  fields.four(file.bytes.size()).four(plain_bytes).two(static_cast<std::uint32_t>(name.size())).two(0);
}

}  // namespace

std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files) {
  Deflater deflater(9);
  std::string zip, directory;
  for (const auto& [name, bytes] : files) {
    const Packed file = packed(deflater, bytes);
    ZipFields of_directory(directory);
    of_directory.four(0x02014b50).two(version | 3U << 8U);
    put_head(of_directory, file, bytes.size(), name);
    of_directory.two(0).two(0).two(0).four(regular_file).four(zip.size());
    directory += name;
    ZipFields here(zip);
    put_head(here.four(0x04034b50), file, bytes.size(), name);
    zip += name + file.bytes;
  }
  const std::size_t begin = zip.size();
  if (files.size() > std::numeric_limits<std::uint16_t>::max() ||
      begin + directory.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw core::InputError("a ZIP archive holds at most 4 GiB and 65,535 files");
  }
  zip += directory;
  const auto count = static_cast<std::uint32_t>(files.size());
  ZipFields(zip).four(0x06054b50).two(0).two(0).two(count).two(count).four(directory.size()).four(begin).two(0);
  return zip;
}

std::string hashes_of(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  const MemoryFile output;
  std::vector<std::string> arguments = {"--"};
  arguments.insert(arguments.end(), names.begin(), names.end());
  ChildProcess process({.program = "sha256sum", .arguments = arguments, .folder = folder, .output = output.descriptor()});
  if (process.wait() != 0) {
    throw core::InputError("sha256sum failed: " + process.errors());
  }
  return output.bytes();
}

}  // namespace dmpc::apps
