// Replies to requests for pages that are here: on a node or, if all are at home there, on the host.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/expect.h"
#include "nodes/layout.h"
#include "nodes/node.h"
#include "svm/pages/packets.h"
#include "svm/pages/page_capacity.h"

namespace dmpc::svm {

/// Copies a page, so it may reply at any time. Thread safety: belongs to one node, or the host.
class PageServer {
 public:
  PageServer(nodes::Node& node, const PageCapacity& capacity)
      : node_(&node),
        page_size_bytes_(capacity.page_size_bytes()),
        reply_(layout(capacity, nodes::index_of(node.id())).in(node.memory())) {}

  /// The memory that the constructor takes at node `index`, or at the host.
  static nodes::Room<std::byte> layout(const PageCapacity& capacity, std::uint32_t index) {
    return {nodes::Category::queues, capacity.is_asked(index) ? page_reply_bytes(capacity.page_size_bytes()) : 0};
  }

  /// Replies at once, with the page's bytes: the request has reserved the reply's slot.
  void reply(const PassedRequest& request, const std::byte* bytes) {
    const PageReplyHeader header{request.page};
    const nodes::NodeId requester{request.requester};
    node_->grant(requester, bulk_channel);
    core::expect(node_->try_send(requester, bulk_channel, number_of(Kind::page_reply), std::as_bytes(std::span(&header, 1)),
                                 {bytes, page_size_bytes_}, reply_),
                 "a reply always has room");
    ++served_;
  }

  /// Number of replies so far.
  std::uint64_t served() const { return served_; }

 private:
  nodes::Node* node_;
  std::size_t page_size_bytes_;
  std::span<std::byte> reply_;  ///< buffer in which a reply is put together; empty if not needed
  std::uint64_t served_ = 0;
};

}  // namespace dmpc::svm
