// A file of sections, each with a digest, of which this program trusts every byte once it is read.
//
// A head (FileHead), a table (SectionEntry for each section), then the sections, each at a multiple of 64 bytes; all in this
// computer's byte order. The head has a digest of itself and the table, and the table one of each section.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/database/held_array.h"

namespace dmpc::apps {

struct FileHead {
  std::uint64_t magic = 0;
  std::uint32_t format = 0, section_count = 0;
  std::uint64_t program = 0;  ///< a digest of what must be alike in the writing and the reading program
  std::uint64_t bytes = 0;    ///< of the whole file
  std::uint64_t digest = 0;   ///< of this head, with 0 here, and the table
};

struct SectionEntry {
  std::uint64_t offset = 0, bytes = 0, digest = 0;
};

/// A kind of file, and its reader.
struct FileKind {
  std::uint64_t magic = 0;
  std::uint32_t format = 0;
  std::uint64_t program = 0;
  const char* what = "";    ///< "a database of dmpc"
  const char* advice = "";  ///< to follow a colon
};

/// Writes all sections. `output` reports errors.
void write_sections(const FileKind& kind, std::span<const std::span<const std::byte>> sections, std::ostream& output);

/// It is mapped, and no section is read before it is asked for. Who cuts the file meanwhile ends the process
/// (apps/frontend/system/last_words.h).
class SectionFile {
 public:
  /// Reads head and table. Throws core::InputError, whose message begins with the path, if the file cannot be read, others than
  /// this user, root and the program's owner can write it, or it is not exactly of this kind, length and number of sections.
  SectionFile(std::filesystem::path path, const FileKind& kind, std::size_t section_count);

  /// Identifies the contents of the whole file.
  std::uint64_t digest() const { return head_.digest; }
  /// The bytes of all sections.
  std::uint64_t bytes() const { return head_.bytes; }

  /// A section, which keeps the mapping. Computes its digest on all cores: throws core::InputError if it is not what was written,
  /// or is no array of items of this size.
  template <class T>
  core::HeldArray<T> array(std::size_t section) const {
    const std::span<const std::byte> bytes = read(section, sizeof(T));
    return {{reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)}, mapping_};
  }
  std::string text(std::size_t section) const;

  /// Throws core::InputError: what the file has is wrong.
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  class Mapping;

  std::span<const std::byte> read(std::size_t section, std::size_t item_bytes) const;
  void read_head(const FileKind& kind, std::size_t section_count);

  std::filesystem::path path_;
  const char* advice_;
  std::shared_ptr<const Mapping> mapping_;
  FileHead head_;
  std::vector<SectionEntry> sections_;
};

/// FileHead::digest.
std::uint64_t digest_of_head(FileHead head, std::span<const SectionEntry> sections);

/// A digest of bytes, in runs of 1 MiB on all cores.
std::uint64_t digest_of(std::span<const std::byte> bytes);

}  // namespace dmpc::apps
