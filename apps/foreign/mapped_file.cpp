#include "apps/foreign/mapped_file.h"

#include <sys/mman.h>

#include <new>

namespace dmpc::apps {
namespace {

/// Files no longer than that are mapped with all their pages at once, since to touch one by one takes a twentieth of reading a
/// PLY. Longer ones may be refused by their first bytes, and show how far they are while they come from a slow disk.
constexpr std::uint64_t populated_bytes_max = std::uint64_t{1} << 26U;

class MappedFile final : public FileBytes {
 public:
  MappedFile(const Descriptor& file, std::uint64_t bytes) : size_(bytes) {
    if (size_ > 0) {
      const int flags = MAP_PRIVATE | (bytes <= populated_bytes_max ? MAP_POPULATE : 0);
      begin_ = ::mmap(nullptr, size_, PROT_READ, flags, file.number(), 0);
      if (begin_ == MAP_FAILED) {
        throw std::bad_alloc();
      }
    }
  }
  ~MappedFile() override {
    if (size_ > 0) {
      ::munmap(begin_, size_);
    }
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::span<const std::byte> bytes() const override { return {static_cast<const std::byte*>(begin_), size_}; }

 private:
  void* begin_ = nullptr;
  std::size_t size_;
};

}  // namespace

std::unique_ptr<FileBytes> map_file(const Descriptor& file, std::uint64_t bytes) {
  return std::make_unique<MappedFile>(file, bytes);
}

}  // namespace dmpc::apps
