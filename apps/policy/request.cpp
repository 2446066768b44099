#include "apps/policy/request.h"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>

#include "apps/frontend/system/resource_exhaustion.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

void write_all(int file, const void* from, std::size_t count) {
  const char* at = static_cast<const char*>(from);
  while (count > 0) {
    const ssize_t written = ::write(file, at, count);
    if (written < 0 && errno != EINTR) {
      throw ComputerCapacityError(std::string("the references cannot be kept in memory for a policy: ") + std::strerror(errno));
    }
    at += written < 0 ? 0 : written;
    count -= written < 0 ? 0 : static_cast<std::size_t>(written);
  }
}

void read_all(int file, void* into, std::size_t count) {
  char* at = static_cast<char*>(into);
  while (count > 0) {
    const ssize_t taken = ::read(file, at, count);
    if (taken == 0 || (taken < 0 && errno != EINTR)) {
      throw core::InternalError("dmpc_policy_host is started by dmpc alone, which tells it what to do");
    }
    at += taken < 0 ? 0 : taken;
    count -= taken < 0 ? 0 : static_cast<std::size_t>(taken);
  }
}

}  // namespace

void put_request(const MemoryFile& file, std::uint32_t node, std::span<const std::uint32_t> cache_pages,
                 std::span<const svm::PageId> references, std::span<const std::uint32_t> prices, std::string_view source) {
  const std::array<std::uint32_t, 5> head = {
      node, static_cast<std::uint32_t>(cache_pages.size()), static_cast<std::uint32_t>(source.size()),
      static_cast<std::uint32_t>(references.size()), static_cast<std::uint32_t>(prices.size())};
  write_all(file.descriptor(), head.data(), sizeof(head));
  write_all(file.descriptor(), cache_pages.data(), cache_pages.size_bytes());
  write_all(file.descriptor(), references.data(), references.size_bytes());
  write_all(file.descriptor(), prices.data(), prices.size_bytes());
  write_all(file.descriptor(), source.data(), source.size());
  core::expect(::lseek(file.descriptor(), 0, SEEK_SET) == 0, "a file in memory has a beginning");
}

PolicyRequest take_request(int descriptor) {
  std::array<std::uint32_t, 5> head{};
  read_all(descriptor, head.data(), sizeof(head));
  PolicyRequest request{.node = head[0],
                        .cache_pages = std::vector<std::uint32_t>(head[1]),
                        .references = std::vector<svm::PageId>(head[3]),
                        .prices = std::vector<std::uint32_t>(head[4]),
                        .source = std::string(head[2], '\0')};
  read_all(descriptor, request.cache_pages.data(), head[1] * sizeof(std::uint32_t));
  read_all(descriptor, request.references.data(), head[3] * sizeof(svm::PageId));
  read_all(descriptor, request.prices.data(), head[4] * sizeof(std::uint32_t));
  read_all(descriptor, request.source.data(), head[2]);
  return request;
}

}  // namespace dmpc::apps
