#include "apps/database/section_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <ostream>
#include <type_traits>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/available_memory.h"
#include "apps/frontend/system/digest.h"
#include "apps/frontend/system/trusted_path.h"
#include "core/base/expect.h"
#include "core/base/filling.h"
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

/// Calls work(run's bytes), which returns its digest, for all runs on all cores.
template <class Byte, class Work>
std::uint64_t digest_by_runs(std::span<Byte> bytes, const Work& work) {
  std::vector<std::uint64_t> digests(core::ceil_divide(bytes.size(), run_bytes));
  core::Parallel(0).for_each(digests.size(), [&](std::size_t run) {
    const std::size_t first = run * run_bytes;
    digests[run] = work(first, bytes.subspan(first, std::min(run_bytes, bytes.size() - first)));
  });
  Digest digest;
  digest.add(std::uint64_t{bytes.size()});
  for (const std::uint64_t of_run : digests) {
    digest.add(of_run);
  }
  return digest.value();
}

/// 0, or the errno; at the end of the file what there is no more stays as it is.
int read_at(const Descriptor& file, std::uint64_t offset, std::span<std::byte> room) {
  while (!room.empty()) {
    const ssize_t count = ::pread(file.number(), room.data(), room.size(), static_cast<off_t>(offset));
    if (count < 0 && errno != EINTR) {
      return errno;
    }
    if (count == 0) {
      return 0;
    }
    room = room.subspan(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    offset += static_cast<std::uint64_t>(std::max<ssize_t>(count, 0));
  }
  return 0;
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
  return digest_by_runs(bytes, [](std::size_t, std::span<const std::byte> run) { return digest_of_run(run); });
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

SectionFile::SectionFile(std::filesystem::path path, const FileKind& kind, std::size_t section_count)
    : path_(std::move(path)), advice_(kind.advice), file_(::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
  struct stat status {};
  if (!file_.is_open() || ::fstat(file_.number(), &status) != 0) {
    throw core::InputError(path_.string() + " cannot be read: " + std::strerror(errno));
  }
  if (!S_ISREG(status.st_mode)) {
    throw core::InputError(path_.string() + " is no ordinary file: expected " + kind.what);
  }
  if (const auto why = why_untrusted(file_)) {
    refuse("others can change it, since " + *why);
  }
  read_head(kind, section_count);
  if (head_.bytes != static_cast<std::uint64_t>(status.st_size)) {
    refuse("it should have " + bytes_text(head_.bytes) + ", and has " + bytes_text(static_cast<std::uint64_t>(status.st_size)));
  }
}

void SectionFile::read_head(const FileKind& kind, std::size_t section_count) {
  if (const int error = read_at(file_, 0, std::as_writable_bytes(std::span(&head_, 1)))) {
    throw core::InputError(path_.string() + " cannot be read: " + std::strerror(error));
  }
  if (head_.magic != kind.magic) {
    throw core::InputError(path_.string() + " is not " + kind.what);
  }
  if (head_.format != kind.format) {
    refuse("it has format " + std::to_string(head_.format) + ", and this program reads format " + std::to_string(kind.format));
  }
  sections_.resize(section_count);
  const int error = read_at(file_, sizeof(head_), std::as_writable_bytes(std::span(sections_)));
  if (error != 0 || head_.section_count != section_count || head_.digest != digest_of_head(head_, sections_)) {
    refuse("its head is damaged");
  }
  if (head_.program != kind.program) {
    refuse("it was written by another version of dmpc, whose records differ");
  }
}

std::pair<std::shared_ptr<const std::byte>, std::size_t> SectionFile::read(std::size_t section, std::size_t item_bytes) const {
  const SectionEntry& entry = sections_.at(section);
  if (entry.offset % alignment != 0 || entry.offset > head_.bytes || entry.bytes > head_.bytes - entry.offset ||
      entry.bytes % item_bytes != 0) {
    refuse("its table is damaged");
  }
  check_available_memory(entry.bytes, path_.string());
  const std::shared_ptr<std::byte> first(static_cast<std::byte*>(::operator new (entry.bytes, std::align_val_t{alignment})),
                                         [](std::byte* bytes) { ::operator delete (bytes, std::align_val_t{alignment}); });
  core::begin_filling({first.get(), entry.bytes});
  const auto digest = digest_by_runs(std::span(first.get(), entry.bytes), [&](std::size_t at, std::span<std::byte> run) {
    return read_at(file_, entry.offset + at, run) == 0 ? digest_of_run(run) : 0;
  });
  if (digest != entry.digest) {
    refuse("it is damaged");
  }
  return {first, entry.bytes};
}

std::string SectionFile::text(std::size_t section) const {
  const auto [first, bytes] = read(section, 1);
  return {reinterpret_cast<const char*>(first.get()), bytes};
}

void SectionFile::refuse(const std::string& what) const { throw core::InputError(path_.string() + ": " + what + "; " + advice_); }

}  // namespace dmpc::apps
