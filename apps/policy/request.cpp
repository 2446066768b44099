#include "apps/policy/request.h"

#include <unistd.h>

#include <array>
#include <cerrno>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// Returns the number of bytes read: fewer at the end of the file.
std::size_t read_up_to(int file, void* into, std::size_t count) {
  std::size_t taken = 0;
  while (taken < count) {
    const ssize_t part = ::read(file, static_cast<char*>(into) + taken, count - taken);
    if (part == 0 || (part < 0 && errno != EINTR)) {
      break;
    }
    taken += part < 0 ? 0 : static_cast<std::size_t>(part);
  }
  return taken;
}

void read_all(int file, void* into, std::size_t count) {
  if (read_up_to(file, into, count) < count) {
    throw core::InternalError("dmpc_policy_host is started by dmpc alone, which tells it what to do");
  }
}

}  // namespace

void put_request(const WriteBytes& write, const PolicyTask& task, std::span<const std::uint32_t> cache_pages,
                 std::span<const svm::PageId> references, std::span<const std::uint32_t> prices, std::string_view source) {
  const std::array<std::uint32_t, 4> counts = {
      static_cast<std::uint32_t>(cache_pages.size()), static_cast<std::uint32_t>(source.size()),
      static_cast<std::uint32_t>(references.size()), static_cast<std::uint32_t>(prices.size())};
  write(&task, sizeof(task));
  write(counts.data(), sizeof(counts));
  write(cache_pages.data(), cache_pages.size_bytes());
  write(references.data(), references.size_bytes());
  write(prices.data(), prices.size_bytes());
  write(source.data(), source.size());
}

PolicyRequest take_request(int descriptor) {
  PolicyRequest request;
  std::array<std::uint32_t, 4> counts{};
  read_all(descriptor, &request.task, sizeof(request.task));
  read_all(descriptor, counts.data(), sizeof(counts));
  request.cache_pages.resize(counts[0]);
  request.source.resize(counts[1]);
  request.references.resize(counts[2]);
  request.prices.resize(counts[3]);
  read_all(descriptor, request.cache_pages.data(), counts[0] * sizeof(std::uint32_t));
  read_all(descriptor, request.references.data(), counts[2] * sizeof(svm::PageId));
  read_all(descriptor, request.prices.data(), counts[3] * sizeof(std::uint32_t));
  read_all(descriptor, request.source.data(), counts[1]);
  return request;
}

bool take_events(int descriptor, std::vector<PolicyEvent>& events) {
  std::uint32_t count = 0;
  if (read_up_to(descriptor, &count, sizeof(count)) < sizeof(count)) {
    return false;
  }
  events.resize(count);
  read_all(descriptor, events.data(), count * sizeof(PolicyEvent));
  return true;
}

}  // namespace dmpc::apps
