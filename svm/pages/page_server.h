// Replies to requests for pages that are here: at a node or, if all are at home there, at the host.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "nodes/layout.h"
#include "nodes/node.h"
#include "svm/pages/packets.h"
#include "svm/pages/page_capacity.h"

namespace dmpc::svm {

/// Copies a page, so it may serve at any time. Thread safety: belongs to one node, or the host.
class PageServer {
 public:
  PageServer(nodes::Node& node, const PageCapacity& capacity);
  /// What the constructor takes at node `index`, or at the host.
  static nodes::Room<std::byte> layout(const PageCapacity& capacity, std::uint32_t index);

  /// Replies at once, with the page's bytes: the request has reserved the reply's place.
  void reply(const PassedRequest& request, const std::byte* bytes);

  /// Replies so far.
  std::uint64_t served() const { return served_; }

 private:
  nodes::Node* node_;
  std::size_t page_size_bytes_;
  std::span<std::byte> reply_;  ///< where a reply is put together, if it is; empty where nobody asks
  std::uint64_t served_ = 0;
};

}  // namespace dmpc::svm
