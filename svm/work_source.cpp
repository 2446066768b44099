#include "svm/work_source.h"

#include <algorithm>

#include "core/base/expect.h"
#include "core/base/units.h"

namespace dmpc::svm {
namespace {

PixelRectangle own_submap(const WorkShape& shape, std::uint32_t index) {
  return submap_of({0, 0, shape.width, shape.height}, index, shape.node_count);
}

/// A bit a pixel; at least a word, so that a node without pixels has a mask, too.
std::size_t mask_words(const WorkShape& shape, std::uint32_t index) {
  const std::uint64_t pixels = std::max<std::uint64_t>(own_submap(shape, index).pixel_count(), 1);
  return shape.is_masked ? core::ceil_divide<std::size_t>(pixels, 64) : 0;
}

/// A node that gives no work away has its submap as one item, or in masked ones.
std::uint32_t item_side_of(const WorkShape& shape) {
  return shape.is_masked && shape.item_side == 0 ? masked_side_max : shape.item_side;
}

}  // namespace

WorkSource::WorkSource(nodes::Node& node, const WorkShape& shape)
    : node_(&node),
      node_count_(shape.node_count),
      self_(nodes::index_of(node.id())),
      image_width_(shape.width),
      item_side_(item_side_of(shape)),
      tile_(shape.tile),
      submap_(own_submap(shape, self_)),
      mask_(node.memory().allocate<std::uint64_t>(nodes::Category::queues, mask_words(shape, self_))),
      items_(submap_, item_side_),
      last_giver_((self_ + 1) % node_count_),
      is_alone_(shape.item_side == 0 || node_count_ == 1),
      no_more_(is_alone_) {
  std::fill(mask_.begin(), mask_.end(), ~std::uint64_t{0});
  if (shape.start != nullptr) {
    want_only(shape.start->missing());
  }
}

/// The host has said before the start which pixels are wanted.
void WorkSource::want_only(const core::PixelMask& pixels) {
  std::fill(mask_.begin(), mask_.end(), 0);
  for (std::uint64_t i = 0; i < submap_.pixel_count(); ++i) {
    const std::uint64_t x = submap_.x + i % submap_.width, y = submap_.y + i / submap_.width;
    mask_[i / 64] |= std::uint64_t{pixels.has(static_cast<std::uint32_t>(y * image_width_ + x))} << (i % 64);
  }
  skip_unwanted();
}

void WorkSource::add_needs(nodes::MemoryPlan& memory, const WorkShape& shape, std::uint32_t index) {
  memory[nodes::Category::queues] += nodes::LocalMemory::bytes_for<std::uint64_t>(mask_words(shape, index));
}

void WorkSource::take_mask(const MaskPart& part) {
  core::expect(exhausted() && part.first_word < mask_.size(), "a mask is the next pass's, and the submap's");
  const std::size_t count = std::min(part.words.size(), mask_.size() - part.first_word);
  std::copy_n(part.words.begin(), count, mask_.begin() + part.first_word);
}

void WorkSource::begin_pass(const PixelTile& tile) {
  core::expect(exhausted() && !asking_, "a pass begins when the one before has ended");
  tile_ = tile;
  items_ = WorkItems(submap_, item_side_);
  last_giver_ = (self_ + 1) % node_count_;
  no_more_ = is_alone_;
  skip_unwanted();
}

/// The bits of an item of the submap; none of an empty one.
std::uint64_t WorkSource::wanted(const PixelRectangle& item) const {
  std::uint64_t bits = 0, bit = 1;
  for (std::uint32_t y = 0; y < item.height; ++y) {
    std::uint64_t index = std::uint64_t{item.y - submap_.y + y} * submap_.width + (item.x - submap_.x);
    for (std::uint32_t x = 0; x < item.width; ++x, ++index, bit <<= 1U) {
      bits |= (mask_[index / 64] >> (index % 64) & 1U) != 0 ? bit : 0;
    }
  }
  return bits;
}

PixelScan WorkSource::scan_of(const PixelRectangle& item) const {
  return is_masked() ? PixelScan(item, tile_, wanted(item)) : PixelScan(item, tile_);
}

/// So that the first item left, if any, has a pixel.
void WorkSource::skip_unwanted() {
  while (is_masked() && !items_.empty() && wanted(*items_.front()) == 0) {
    items_.take();
  }
}

/// The last item that has a pixel.
std::optional<PixelRectangle> WorkSource::give() {
  std::optional<PixelRectangle> item = items_.give();
  while (is_masked() && item && wanted(*item) == 0) {
    item = items_.give();
  }
  return item;
}

std::uint32_t WorkSource::next_pixel() {
  if (scan_.empty()) {
    const auto item = items_.take();
    core::expect(item.has_value(), "a node takes pixels only while it has some");
    scan_ = scan_of(*item);
    skip_unwanted();
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
  if (const auto item = give()) {
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
  const WorkReply work{item, self_};
  if (is_masked()) {
    node_->send_reserved(nodes::NodeId{asker}, control_channel, number_of(Kind::work_reply), MaskedWorkReply{work, wanted(item)});
  } else {
    node_->send_reserved(nodes::NodeId{asker}, control_channel, number_of(Kind::work_reply), work);
  }
}

void WorkSource::take_reply(const nodes::Packet& packet) {
  core::expect(asking_ && !has_pixel(), "a work reply answers the one request under way");
  const auto masked = is_masked() ? packet.as<MaskedWorkReply>() : MaskedWorkReply{packet.as<WorkReply>()};
  const WorkReply& reply = masked.reply;
  asking_ = false;
  if (reply.item.pixel_count() == 0) {
    no_more_ = true;
    return;
  }
  ++counters_.items_taken;
  last_giver_ = reply.giver;
  scan_ = is_masked() ? PixelScan(reply.item, tile_, masked.pixels) : PixelScan(reply.item, tile_);
}

std::string WorkSource::describe() const {
  return std::to_string(items_.count()) + " work items left" + (asking_ ? ", asking for work" : no_more_ ? ", no more work" : "");
}

}  // namespace dmpc::svm
