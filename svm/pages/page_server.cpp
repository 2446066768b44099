#include "svm/pages/page_server.h"

#include "core/base/expect.h"

namespace dmpc::svm {

PageServer::PageServer(nodes::Node& node, const PageCapacity& capacity)
    : node_(&node),
      page_size_bytes_(capacity.page_size_bytes()),
      reply_(layout(capacity, nodes::index_of(node.id())).in(node.memory())) {}

nodes::Room<std::byte> PageServer::layout(const PageCapacity& capacity, std::uint32_t index) {
  return {nodes::Category::queues, capacity.is_asked(index) ? page_reply_bytes(capacity.page_size_bytes()) : 0};
}

void PageServer::reply(const PassedRequest& request, const std::byte* bytes) {
  const PageReplyHeader header{request.page};
  const nodes::NodeId asker{request.asker};
  node_->grant(asker, bulk_channel);
  core::expect(node_->try_send(asker, bulk_channel, number_of(Kind::page_reply), std::as_bytes(std::span(&header, 1)),
                               {bytes, page_size_bytes_}, reply_),
               "a reply always has room");
  ++served_;
}

}  // namespace dmpc::svm
