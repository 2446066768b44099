#include "svm/work_source.h"

#include "core/expect.h"

namespace dmpc::svm {

WorkSource::WorkSource(nodes::Node& node, const Plan& plan)
    : node_(&node),
      node_count_(plan.request.node_count),
      self_(nodes::index_of(node.id())),
      image_width_(plan.request.width),
      items_(submap_of({0, 0, plan.request.width, plan.request.height}, self_, node_count_), plan.request.work_item_side),
      last_giver_((self_ + 1) % node_count_),
      no_more_(plan.request.work_item_side == 0 || node_count_ == 1) {}

std::uint32_t WorkSource::next_pixel() {
  if (scan_.empty()) {
    const auto item = items_.take();
    core::expect(item.has_value(), "a node takes pixels only while it has some");
    scan_ = PixelScan(*item);
  }
  return scan_.next(image_width_);
}

/// The ring passes over the asker, who is known to have nothing.
std::uint32_t WorkSource::after(std::uint32_t node, std::uint32_t asker) const {
  const std::uint32_t next = (node + 1) % node_count_;
  return next == asker ? (next + 1) % node_count_ : next;
}

void WorkSource::ask() {
  core::expect(!has_pixel(), "only a node without pixels asks for some");
  if (asking_ || no_more_) {
    return;
  }
  asking_ = true;
  ++counters_.items_asked;
  node_->grant(nodes::NodeId{last_giver_}, ring_channel);  // its own place on the ring: one request a node
  node_->send_reserved(nodes::NodeId{last_giver_}, ring_channel, number_of(Kind::work_request),
                       WorkRequest{self_, node_count_ - 1});
}

void WorkSource::answer(const WorkRequest& request) {
  core::expect(request.asker != self_ && request.visits_left > 0, "a work request asks each other node once");
  if (const auto item = items_.give()) {
    ++counters_.items_given;
    reply(request.asker, *item);
  } else if (request.visits_left == 1) {
    reply(request.asker, {});
  } else {
    const nodes::NodeId next{after(self_, request.asker)};
    node_->grant(next, ring_channel);  // the asker's place on the ring
    node_->send_reserved(next, ring_channel, number_of(Kind::work_request), WorkRequest{request.asker, request.visits_left - 1});
  }
}

void WorkSource::reply(std::uint32_t asker, const PixelRectangle& item) {
  node_->grant(nodes::NodeId{asker}, control_channel);  // the place that the request has reserved
  node_->send_reserved(nodes::NodeId{asker}, control_channel, number_of(Kind::work_reply), WorkReply{item, self_});
}

void WorkSource::take_reply(const WorkReply& reply) {
  core::expect(asking_ && !has_pixel(), "a work reply answers the one request under way");
  asking_ = false;
  if (reply.item.pixel_count() == 0) {
    no_more_ = true;
    return;
  }
  ++counters_.items_taken;
  last_giver_ = reply.giver;
  scan_ = PixelScan(reply.item);
}

std::string WorkSource::describe() const {
  return std::to_string(items_.count()) + " work items left" + (asking_ ? ", asking for work" : no_more_ ? ", no more work" : "");
}

}  // namespace dmpc::svm
