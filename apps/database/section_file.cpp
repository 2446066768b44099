#include "apps/database/section_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <ostream>
#include <type_traits>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/descriptor.h"
#include "apps/frontend/system/digest.h"
#include "apps/frontend/system/last_words.h"
#include "apps/frontend/system/trusted_path.h"
#include "core/base/expect.h"
#include "core/base/units.h"
#include "core/database/parallel.h"

namespace dmpc::apps {
namespace {

constexpr std::size_t run_bytes = std::size_t{1} << 20U, alignment = 64;
static_assert(std::is_trivially_copyable_v<FileHead> && sizeof(FileHead) == 40 && sizeof(SectionEntry) == 24);

/// Four digests of every fourth word each: a processor computes them at a time.
std::uint64_t digest_of_run(std::span<const std::byte> bytes) {
  constexpr std::size_t lanes = 4, step = lanes * sizeof(std::uint64_t);
  std::array<Digest, lanes> all;
  std::array<std::uint64_t, lanes> words{};
  for (; bytes.size() >= step; bytes = bytes.subspan(step)) {
    std::memcpy(words.data(), bytes.data(), step);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      all[lane].add(words[lane]);
    }
  }
  Digest digest;
  for (const Digest& lane : all) {
    digest.add(lane.value());
  }
  digest.add(bytes);
  return digest.value();
}

}  // namespace

std::uint64_t digest_of_head(FileHead head, std::span<const SectionEntry> sections) {
  head.digest = 0;
  Digest digest;
  digest.add(std::as_bytes(std::span(&head, 1)));
  digest.add(std::as_bytes(sections));
  return digest.value();
}

std::uint64_t digest_of(std::span<const std::byte> bytes) {
  std::vector<std::uint64_t> digests(core::ceil_divide(bytes.size(), run_bytes));
  core::Parallel(digests.size() > 1 ? 0 : 1).for_each(digests.size(), [&](std::size_t run) {
    const std::size_t first = run * run_bytes;
    digests[run] = digest_of_run(bytes.subspan(first, std::min(run_bytes, bytes.size() - first)));
  });
  Digest digest;
  digest.add(std::uint64_t{bytes.size()});
  for (const std::uint64_t of_run : digests) {
    digest.add(of_run);
  }
  return digest.value();
}

void write_sections(const FileKind& kind, std::span<const std::span<const std::byte>> sections, std::ostream& output) {
  FileHead head{.magic = kind.magic,
                .format = kind.format,
                .section_count = static_cast<std::uint32_t>(sections.size()),
                .program = kind.program};
  std::vector<SectionEntry> entries;
  head.bytes = sizeof(FileHead) + sections.size() * sizeof(SectionEntry);
  for (const std::span<const std::byte> section : sections) {
    const std::uint64_t offset = core::round_up(head.bytes, std::uint64_t{alignment});
    entries.push_back({offset, section.size(), digest_of(section)});
    head.bytes = offset + section.size();
  }
  head.digest = digest_of_head(head, entries);
  std::uint64_t end = 0;
  const auto write = [&](std::span<const std::byte> bytes) {
    output.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    end += bytes.size();
  };
  write(std::as_bytes(std::span(&head, 1)));
  write(std::as_bytes(std::span(entries)));
  for (std::size_t i = 0; i < sections.size(); ++i) {
    constexpr std::array<std::byte, alignment> gap{};
    write(std::span(gap).first(entries[i].offset - end));
    write(sections[i]);
  }
}

class SectionFile::Mapping {
 public:
  /// Throws std::bad_alloc if there is no address space for them.
  Mapping(const Descriptor& file, std::size_t bytes, const std::filesystem::path& path)
      : bytes_(bytes == 0 ? nullptr : ::mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE, file.number(), 0), bytes),
        said_(this->bytes(), path.string()) {
    if (bytes_.first == MAP_FAILED) {
      throw std::bad_alloc();
    }
  }
  ~Mapping() {
    if (bytes_.second > 0) {
      ::munmap(bytes_.first, bytes_.second);
    }
  }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;

  std::span<const std::byte> bytes() const { return {static_cast<const std::byte*>(bytes_.first), bytes_.second}; }

 private:
  std::pair<void*, std::size_t> bytes_;
  MappedBytes said_;
};

SectionFile::SectionFile(std::filesystem::path path, const FileKind& kind, std::size_t section_count)
    : path_(std::move(path)), advice_(kind.advice) {
  const Descriptor file(::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  struct stat status {};
  if (!file.is_open() || ::fstat(file.number(), &status) != 0) {
    throw core::InputError(path_.string() + " cannot be read: " + std::strerror(errno));
  }
  if (!S_ISREG(status.st_mode)) {
    throw core::InputError(path_.string() + " is no ordinary file: expected " + kind.what);
  }
  if (const auto why = why_untrusted(file)) {
    refuse("others can change it, since " + *why);
  }
  mapping_ = std::make_shared<const Mapping>(file, static_cast<std::size_t>(status.st_size), path_);
  read_head(kind, section_count);
}

void SectionFile::read_head(const FileKind& kind, std::size_t section_count) {
  const std::span<const std::byte> all = mapping_->bytes();
  if (!all.empty()) {
    std::memcpy(&head_, all.data(), std::min(all.size(), sizeof(head_)));
  }
  if (head_.magic != kind.magic) {
    throw core::InputError(path_.string() + " is not " + kind.what);
  }
  if (head_.format != kind.format) {
    refuse("it has format " + std::to_string(head_.format) + ", and this program reads format " + std::to_string(kind.format));
  }
  sections_.resize(section_count);
  const std::span<const std::byte> table = all.subspan(std::min(all.size(), sizeof(head_)));
  std::memcpy(sections_.data(), table.data(), std::min(table.size(), section_count * sizeof(SectionEntry)));
  if (head_.section_count != section_count || head_.digest != digest_of_head(head_, sections_)) {
    refuse("its head is damaged");
  }
  if (head_.program != kind.program) {
    refuse("it was written by another version of dmpc, whose records differ");
  }
  if (head_.bytes != all.size()) {
    refuse("it should have " + bytes_text(head_.bytes) + ", and has " + bytes_text(all.size()));
  }
  std::uint64_t end = sizeof(FileHead) + section_count * sizeof(SectionEntry);
  for (const SectionEntry& entry : sections_) {
    if (entry.offset != core::round_up(end, std::uint64_t{alignment}) || entry.offset > all.size() ||
        entry.bytes > all.size() - entry.offset) {
      refuse("its table is damaged");
    }
    if (std::ranges::any_of(all.subspan(end, entry.offset - end), [](std::byte byte) { return byte != std::byte{0}; })) {
      refuse("it is damaged");
    }
    end = entry.offset + entry.bytes;
  }
}

std::span<const std::byte> SectionFile::read(std::size_t section, std::size_t item_bytes) const {
  const SectionEntry& entry = sections_.at(section);
  if (entry.bytes % item_bytes != 0) {
    refuse("its table is damaged");
  }
  const std::span<const std::byte> bytes = mapping_->bytes().subspan(entry.offset, entry.bytes);
  if (digest_of(bytes) != entry.digest) {
    refuse("it is damaged");
  }
  return bytes;
}

std::string SectionFile::text(std::size_t section) const {
  const std::span<const std::byte> bytes = read(section, 1);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void SectionFile::refuse(const std::string& what) const { throw core::InputError(path_.string() + ": " + what + "; " + advice_); }

}  // namespace dmpc::apps
